//! The feature `alloc` for programs with the standard library.

use goodbot::feedback::Feedback;
use goodbot::home::paper_tasks;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use std::error::Error;

use crate::rooms::rooms;

/// Such an error can be sent to another thread, and be any program's error.
fn is_error<E: Error + Send + Sync + 'static>() {}

#[test]
fn every_error_is_one_of_the_standard_library() {
    is_error::<goodbot::AgentError>();
    is_error::<goodbot::capacity::CapacityError>();
    is_error::<goodbot::capacity::UnknownCapacity>();
    is_error::<goodbot::feedback::BeliefError>();
    is_error::<goodbot::feedback::StrategyError>();
    is_error::<goodbot::feedback::UnknownFeedback>();
    is_error::<goodbot::home::HomeError>();
    is_error::<goodbot::language::SettingError>();
    is_error::<goodbot::language::SynonymError<'static>>();
    is_error::<goodbot::oomdp::DomainFlaw>();
    is_error::<goodbot::oomdp::ObjectError>();
    is_error::<goodbot::task::NoMarker>();
    is_error::<goodbot::task::TaskTextError>();
    is_error::<goodbot::snapshot::RestoreError>();
    is_error::<goodbot::snapshot::SaveError>();
    is_error::<goodbot::storage::StorageError<()>>();
    #[cfg(feature = "talk")]
    is_error::<goodbot::talk::ClosedWordsError<'static>>();
}

#[test]
fn a_robot_on_the_heap_goes_to_another_thread_and_its_refusals_come_back() -> Result<(), Box<dyn Error + Send + Sync>> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = rooms(&mut memory.home, None);
    let mut agent = Agent::new(memory.agent, &paper_tasks()?, Options::DEFAULT)?;
    agent.hear(&home, &state, "go to the green room")?;
    let elsewhere = std::thread::spawn(move || -> Result<(), Box<dyn Error + Send + Sync>> {
        // It has done nothing yet.
        let _ = agent.feedback(Feedback::Reward)?;
        Ok(())
    });
    let refused = elsewhere.join().expect("no panic").expect_err("there is nothing to reward");
    assert!(refused.is::<AgentError>(), "{refused}");
    Ok(())
}
