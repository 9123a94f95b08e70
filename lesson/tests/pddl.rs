//! Problems of the planning field as worlds: the robot's plans cost as much as the best plans.

use goodbot_formats::pddl::{Domain, PddlError, Problem};
use goodbot_formats::task_text::GroundTaskText;
use goodbot_formats::world::WorldFile;
use goodbot_lesson::world::pddl;
use goodbot_lesson::world::robot::{self, WorldFlaw};

const GRIPPER: &str = include_str!("pddl/gripper.pddl");
const GRIPPER_4: &str = include_str!("pddl/gripper-4.pddl");
const DELIVERY: &str = include_str!("pddl/delivery.pddl");
const DELIVERY_4: &str = include_str!("pddl/delivery-4.pddl");

/// Problems, with the cost of the best plan for the goal. With equal costs, it is the length of pyperplan's plan, found breadth first.
const PROBLEMS: [(&str, &str, u32); 6] = [
    (GRIPPER, GRIPPER_4, 9),
    (include_str!("pddl/blocks.pddl"), include_str!("pddl/blocks-3.pddl"), 6),
    (include_str!("pddl/ferry.pddl"), include_str!("pddl/ferry-3.pddl"), 8),
    (include_str!("pddl/visitall.pddl"), include_str!("pddl/visitall-6.pddl"), 3),
    (include_str!("pddl/logistics.pddl"), include_str!("pddl/logistics-1.pddl"), 11),
    // Take 2, go 4 + 5, give 3.
    (DELIVERY, DELIVERY_4, 14),
];

fn converted(domain: &str, problem: &str) -> Result<WorldFile, WorldFlaw> {
    pddl::world(&Domain::parse(domain).expect("a domain"), &Problem::parse(problem).expect("a problem"))
}

/// The goal as a task.
fn goal(problem: &str) -> GroundTaskText {
    let atom = |atom: &goodbot_formats::pddl::Atom| format!("{}({})", atom.predicate, atom.terms.join(","));
    let goal: Vec<String> = Problem::parse(problem).expect("a problem").goal.iter().map(atom).collect();
    goal.join(" & ").parse().expect("a task")
}

fn cost(world: &WorldFile, plan: &[String]) -> u32 {
    let of = |name: &String| {
        let name = name.split('(').next().unwrap_or(name);
        world.actions.iter().find(|action| action.name == name).map_or(0, |action| u32::from(action.cost))
    };
    plan.iter().map(of).sum()
}

#[test]
fn plans_cost_what_the_best_plans_cost() {
    for (domain, problem, best) in PROBLEMS {
        let world = converted(domain, problem).expect("a world");
        let plan = robot::plan(&world, &goal(problem)).expect("a robot").expect("a plan");
        assert_eq!(cost(&world, &plan), best, "{}: {plan:?}", world.name);
        // Written and read, it is the same.
        assert_eq!(WorldFile::parse(&world.to_json_line().expect("a line")).expect("a world"), world);
    }
}

#[test]
fn what_other_parameters_settle_is_no_parameter() {
    let world = converted(GRIPPER, GRIPPER_4).expect("a world");
    let parameters = |name: &str| {
        let action = world.actions.iter().find(|action| action.name == name).expect("an action");
        action.parameters.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>()
    };
    assert_eq!([parameters("move"), parameters("pick"), parameters("drop")], [vec!["to"], vec!["b", "g"], vec!["g"]]);
    assert_eq!(world.variables, ["at-robby"]);
}

#[test]
fn what_is_not_understood_is_refused_by_line() {
    let domain = |text: &str| Domain::parse(text).map(drop).map_err(|error: PddlError| error.to_string());
    for (from, to, told) in [
        ("(at-robby ?from)\n    :effect", "(or (at-robby ?from))\n    :effect", "line 7: \"or\" is not understood"),
        ("(:types room ball gripper)", "(:types room ball gripper", "opens a bracket that is not closed"),
        ("(:types room ball gripper)", "(:derived (x) (y))", "line 4: \":derived\" is not understood: derived predicates"),
        ("- gripper) (carry", "- (either gripper ball)) (carry", "line 5: one of several types is not understood"),
    ] {
        let refused = domain(&GRIPPER.replacen(from, to, 1)).expect_err(told);
        assert!(refused.contains(told), "{told}: {refused}");
    }
    assert!(domain(&"(".repeat(100_000)).is_err_and(|it| it.contains("more than 64 open brackets")));
    let refused = |domain: &str, problem: &str| converted(domain, problem).expect_err("a flaw").to_string();
    assert!(refused(GRIPPER, &GRIPPER_4.replace("(free left)", "(full left)")).contains("predicate that the domain does not have"));
    assert!(
        refused(GRIPPER, &GRIPPER_4.replace("(at ball1 rooma)", "(at ball9 rooma)")).contains("ball9 in (at ball9 rooma) is no object")
    );
    assert!(
        refused(DELIVERY, &DELIVERY_4.replace("home park) 4", "home park) 40")).contains("go costs 40, and a world's action costs 1 to 16")
    );
    let swap = "(define (domain d) (:predicates (p ?x) (q ?x)) (:action a :parameters (?x ?y) :precondition (p ?x) :effect (q ?y)))";
    let two = "(define (problem two) (:domain d) (:objects a b) (:init (p a)) (:goal (q a)))";
    assert!(refused(swap, two).contains("add (not (= ?x ?y))"));
    // A search over many choices ends soon, even if no action is ever possible.
    let objects: String = (0..200).map(|number| format!(" o{number}")).collect();
    let many = "(define (domain d) (:predicates (p ?x) (q ?x) (r ?x)) (:action a :parameters (?a ?b ?c ?d ?e) :precondition (r ?e) :effect (q ?a)))";
    let wide = format!("(define (problem wide) (:domain d) (:objects{objects}) (:init (p o0)) (:goal (q o0)))");
    assert!(refused(many, &wide).contains("more states or actions than can be looked at"));
}

#[test]
fn what_contradicts_itself_in_a_domain_or_a_problem_is_refused_by_its_name() {
    let read = |domain: &str, problem: &str| -> Result<WorldFile, String> {
        let domain = Domain::parse(domain).map_err(|error| error.to_string())?;
        let problem = Problem::parse(problem).map_err(|error| error.to_string())?;
        pddl::world(&domain, &problem).map_err(|flaw| flaw.to_string())
    };
    let (blocks, three) = (include_str!("pddl/blocks.pddl"), include_str!("pddl/blocks-3.pddl"));
    let domain_name = Domain::parse(blocks).expect("a domain").name;
    let goal_from = three.find("(:goal").expect("a goal");
    let with_goal = |goal: &str| format!("{}(:goal {goal}))", &three[..goal_from]);
    for (domain, problem, told) in [
        (blocks.replacen("(:predicates", "(:predicates (clear ?z)", 1), three.to_owned(), "gives the predicate clear twice"),
        (blocks.replacen("(:action", "(:action stack :effect (handempty)) (:action", 1), three.to_owned(), "gives the action stack twice"),
        (
            GRIPPER.replacen("ball ", "", 1),
            GRIPPER_4.to_owned(),
            "ball1 is of the type ball, which the domain does not have; add it to (:types ...)",
        ),
        (
            GRIPPER.replacen("?b - ball", "?b - bull", 1),
            GRIPPER_4.to_owned(),
            "?b of the predicate at is of the type bull, which the domain does not have",
        ),
        (GRIPPER.to_owned(), three.to_owned(), &format!("is of the domain {domain_name}, and this is gripper")),
        (
            GRIPPER.to_owned(),
            GRIPPER_4.replacen("(:objects", "(:objects ball1 - ball", 1),
            "gives the object ball1 twice; give each a name of its own",
        ),
        (blocks.to_owned(), with_goal("(on c c)"), "field \"goal\": (on c c) has one object twice"),
        (blocks.to_owned(), with_goal("(handempty)"), "field \"goal\": holds at first, and so does all else of its kind"),
        (GRIPPER.replacen("?from ?to", "?from ?from", 1), GRIPPER_4.to_owned(), "gives the parameter ?from twice"),
    ] {
        let refused = read(&domain, &problem).expect_err(told);
        assert!(refused.contains(told), "{told}: {refused}");
    }
    let constant = GRIPPER.replacen("(:predicates", "(:constants left - gripper)\n(:predicates", 1);
    assert!(read(&constant, GRIPPER_4).is_err_and(|it| it.contains("left is a constant of the domain already; leave it out")));
    let itself = "(define (domain d) (:predicates (p ?x ?y)) (:action a :parameters (?x) :effect (p ?x ?x)))";
    let one = "(define (problem one) (:domain d) (:objects a b) (:init) (:goal (p a b)))";
    assert!(read(itself, one).is_err_and(|it| it.contains("line 1: an effect of a on p has one object twice")));
    // A fact that is given twice counts once.
    let twice = GRIPPER_4.replacen("(:init", "(:init (at-robby rooma)", 1);
    assert_eq!(read(GRIPPER, &twice), read(GRIPPER, GRIPPER_4));
}

/// The first problem of the first planning competition, as it is: without types, so that its four balls could be rooms too.
const UNTYPED: (&str, &str) = (
    "(define (domain gripper-strips)
   (:predicates (room ?r) (ball ?b) (gripper ?g) (at-robby ?r) (at ?b ?r) (free ?g) (carry ?o ?g))
   (:action move :parameters (?from ?to) :precondition (and (room ?from) (room ?to) (at-robby ?from))
       :effect (and (at-robby ?to) (not (at-robby ?from))))
   (:action pick :parameters (?obj ?room ?gripper)
       :precondition (and (ball ?obj) (room ?room) (gripper ?gripper) (at ?obj ?room) (at-robby ?room) (free ?gripper))
       :effect (and (carry ?obj ?gripper) (not (at ?obj ?room)) (not (free ?gripper))))
   (:action drop :parameters (?obj ?room ?gripper)
       :precondition (and (ball ?obj) (room ?room) (gripper ?gripper) (carry ?obj ?gripper) (at-robby ?room))
       :effect (and (at ?obj ?room) (free ?gripper) (not (carry ?obj ?gripper)))))",
    "(define (problem strips-gripper-x-1) (:domain gripper-strips)
   (:objects rooma roomb ball4 ball3 ball2 ball1 left right)
   (:init (room rooma) (room roomb) (ball ball4) (ball ball3) (ball ball2) (ball ball1) (at-robby rooma) (free left) (free right)
          (at ball4 rooma) (at ball3 rooma) (at ball2 rooma) (at ball1 rooma) (gripper left) (gripper right))
   (:goal (and (at ball4 roomb) (at ball3 roomb) (at ball2 roomb) (at ball1 roomb))))",
);

#[test]
fn what_objects_without_types_could_be_makes_no_states() {
    let world = converted(UNTYPED.0, UNTYPED.1).expect("a world");
    let checked = robot::with(&world, |robot, start| goodbot::oomdp::check(robot, start, 10_000)).expect("a robot").expect("sound");
    assert_eq!((checked.states, checked.all), (256, true));
    let plan = robot::plan(&world, &"at(ball1,roomb)".parse().expect("a task")).expect("a robot").expect("a plan");
    assert_eq!(plan.len(), 3, "{plan:?}");
}
