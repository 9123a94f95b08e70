//! Invalid texts of tasks with a way.

use goodbot::capacity::Capacity;
use goodbot::home::SCHEMA;
use goodbot::task::{LiftedTask, TaskTextError};

fn refused(text: &str) -> TaskTextError {
    LiftedTask::parse(text, &SCHEMA).unwrap_err()
}

#[test]
fn a_way_that_avoids_its_own_goal_is_refused() {
    let error = refused("agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?goal)");
    assert_eq!(error, TaskTextError::AvoidsGoal);
    assert_eq!(error.to_string(), "what is to be avoided is asked for as well; give what is avoided a variable of its own");
    assert_eq!(refused("agentInRoom(?a, ?g) through agentInRoom(?a, ?v) avoiding agentInRoom(?a, ?v)"), TaskTextError::AvoidsGoal);
}

#[test]
fn a_way_through_its_own_goal_is_refused_for_it_says_nothing() {
    assert_eq!(refused("agentInRoom(?a, ?goal) through agentInRoom(?a, ?goal)"), TaskTextError::SaysNothing);
}

#[test]
fn nine_clauses_are_refused_with_the_capacity_that_is_full() {
    let clauses = " through agentInRoom(?a, ?g0)".repeat(9);
    let text = format!("agentInRoom(?a, ?goal){clauses}");
    let TaskTextError::Capacity(error) = refused(&text) else { panic!("nine clauses are too many") };
    assert_eq!((error.capacity, error.limit), (Capacity::PropositionsPerTask, 4));
    let text: String = (0..9).map(|clause| format!(" avoiding agentInRoom(?a, ?g{clause})")).collect();
    assert!(matches!(refused(&format!("agentInRoom(?a, ?goal){text}")), TaskTextError::Capacity(_)));
}
