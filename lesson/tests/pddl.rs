//! Problems of the planning field as worlds: the robot's plans cost as much as the best plans.

use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::world::{pddl, robot};
use std::collections::BTreeSet;

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

fn converted(domain: &str, problem: &str) -> Result<WorldFile, String> {
    pddl::convert(domain, problem).map(|converted| converted.world).map_err(|error| error.to_string())
}

/// The goal as a task: `(:goal (and (at a b) (lit)))` is `at(a,b) & lit(whole)`.
fn goal(problem: &str) -> GroundTaskText {
    let goal = problem.split("(:goal").nth(1).expect("a goal").split("(:metric").next().expect("a goal");
    let atoms = goal.split(['(', ')']).map(str::trim).filter(|atom| !atom.is_empty() && *atom != "and");
    let text = |atom: &str| match atom.split_once(char::is_whitespace) {
        Some((predicate, terms)) => format!("{predicate}({})", terms.split_whitespace().collect::<Vec<_>>().join(",")),
        None => format!("{atom}(whole)"),
    };
    atoms.map(text).collect::<Vec<_>>().join(" & ").parse().expect("a task")
}

/// What the cheapest actions that make the goal hold cost together, looked for in the robot's states one by one; `None` if none do.
fn best(world: &WorldFile, problem: &str) -> Option<u32> {
    robot::with(world, |robot, start| {
        let named = robot.world();
        let ground = |atom: &GroundAtomText| {
            let objects: Vec<_> = atom.arguments().iter().map(|name| named.objects.find(name).expect("an object")).collect();
            GroundProposition::new(named.schema.proposition(atom.function()).expect("a proposition"), &objects)
        };
        let goal: Vec<GroundProposition> = goal(problem).atoms().iter().map(ground).collect();
        let mut open = BTreeSet::from([(0, start)]);
        let mut known = BTreeSet::new();
        while let Some((cost, state)) = open.pop_first() {
            if goal.iter().all(|proposition| robot.holds(proposition, &state)) {
                return Some(cost);
            }
            if known.insert(state) {
                let next = |(number, kind): (usize, &ActionKind<'_>)| {
                    Some((cost + u32::from(kind.cost), robot.step(&state, Action::new(u8::try_from(number).ok()?))?))
                };
                open.extend(robot.actions().iter().enumerate().filter_map(next));
            }
        }
        None
    })
    .expect("a robot")
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
        assert_eq!((cost(&world, &plan), self::best(&world, problem)), (best, Some(best)), "{}: {plan:?}", world.name);
        // Written and read, it is the same.
        assert_eq!(WorldFile::parse(&world.to_json_line().expect("a line")).expect("a world"), world);
    }
}

#[test]
fn each_state_is_told_as_it_is_visited() {
    let mut told = vec![];
    let converted = pddl::convert_in_steps(UNTYPED.0, UNTYPED.1, |states| told.push(states)).expect("a world");
    // 256 states for the balls, the grippers and the robot.
    assert_eq!(told, (1..=256).collect::<Vec<_>>());
    assert_eq!(Ok(converted.world), self::converted(UNTYPED.0, UNTYPED.1));
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
fn what_is_not_understood_is_refused_with_its_text_and_line() {
    for (from, to, told) in [
        ("(at-robby ?from)\n    :effect", "(or (at-robby ?from))\n    :effect", "line 7 of the domain: \"or\" is not understood"),
        ("(at-robby ?from)\n    :effect", "(not (and (at-robby ?from)))\n    :effect", "line 7 of the domain: \"and\" is not understood"),
        ("(at-robby ?from)\n    :effect", "(not (not (at-robby ?from)))\n    :effect", "line 7 of the domain: \"not\" is not understood"),
        ("(at-robby ?from)\n    :effect", "(>= (fuel) 1)\n    :effect", "line 7 of the domain: \">=\" is not understood: numbers"),
        ("(at-robby ?from)\n    :effect", "(= (fuel) 1)\n    :effect", "line 7 of the domain: \"=\" of a function is not understood"),
        ("(:types room ball gripper)", "(:types room ball gripper", "opens a bracket that is not closed"),
        ("(:types room ball gripper)", "(:derived (x) (y))", "line 4 of the domain: \":derived\" is not understood: derived predicates"),
        ("- gripper) (carry", "- (either gripper ball)) (carry", "line 5 of the domain: one of several types is not understood"),
    ] {
        let refused = converted(&GRIPPER.replacen(from, to, 1), GRIPPER_4).expect_err(told);
        assert!(refused.contains(told), "{told}: {refused}");
    }
    assert!(converted(&"(".repeat(100_000), GRIPPER_4).is_err_and(|it| it.contains("more than 64 open brackets")));
    for cost in [0, 256] {
        let refused = converted(DELIVERY, &DELIVERY_4.replace("home park) 4", &format!("home park) {cost}"))).expect_err("a cost");
        assert!(refused.contains(&format!("go costs {cost}, and a world's action costs 1 to 255")), "{refused}");
    }
}

#[test]
fn a_problem_that_is_too_large_is_refused_soon() {
    let objects: String = (0..200).map(|number| format!(" o{number}")).collect();
    let wide = format!("(define (problem wide) (:domain d) (:objects{objects}) (:init (p o0)) (:goal (q o0)))");
    for domain in [
        // Many choices, although no action is ever possible.
        "(define (domain d) (:predicates (p ?x) (q ?x) (r ?x)) (:action a :parameters (?a ?b ?c ?d ?e) :precondition (r ?e) :effect (q ?a)))",
        // Many states.
        "(define (domain d) (:predicates (p ?x) (q ?x)) (:action a :parameters (?a) :effect (q ?a)))",
        // Many actions, and many states.
        "(define (domain d) (:predicates (p ?x) (q ?x) (r ?x ?y)) (:action a :parameters (?a ?b) :precondition (not (p ?b)) :effect (r ?a ?b)))",
    ] {
        let refused = converted(domain, &wide).expect_err("too large");
        assert!(refused.contains("more states or actions than can be looked at"), "{refused}");
    }
}

/// Two lamps in two rooms; the best plan lights one, goes, and lights the other.
const LAMPS: (&str, &str) = (
    "(define (domain lamps)
  (:requirements :strips :typing)
  (:types lamp room)
  (:predicates (on ?l - lamp) (in ?l - lamp ?r - room) (at ?r - room))
  (:action go :parameters (?from ?to - room) :precondition (at ?from) :effect (and (at ?to) (not (at ?from))))
  (:action light :parameters (?l - lamp ?r - room) :precondition (and (at ?r) (in ?l ?r)) :effect (on ?l)))",
    "(define (problem two)
  (:domain lamps)
  (:objects a b - lamp kitchen hall - room)
  (:init (at kitchen) (in a kitchen) (in b hall))
  (:goal (and (on a) (on b))))",
);

#[test]
fn every_name_is_checked_and_a_fault_names_its_line() {
    let (domain, problem) = LAMPS;
    for (from, to, told) in [
        ("(not (at ?from))", "(not (at ?form))", "line 5 of the domain: ?form in (at ?form) is no object and no parameter"),
        (
            ":precondition (at ?from)",
            ":precondition (and (at ?from) (not (= ?to hal)))",
            "line 5 of the domain: hal in an equality is no object",
        ),
        ("(at ?r) (in", "(at ?r ?r) (in", "line 6 of the domain: (at ?r ?r) has 2 terms, and 1 are wanted"),
        ("(in ?l ?r))", "(in ?r ?l))", "line 6 of the domain: ?r in (in ?r ?l) is of the type room, and lamp is wanted"),
        ("(?l - lamp ?r - room) :prec", "(?l - lamp r - room) :prec", "line 6 of the domain: the name of a parameter begins with ?"),
        ("?l - lamp) (in", "?l - lump) (in", "line 4 of the domain: ?l is of the type lump, which the domain does not have"),
        ("(:types lamp room)", "(:types lamp room) (:types house)", "line 3 of the domain: gives the section :types twice"),
        ("(:types lamp room)", "(:types lamp room lamp)", "line 3 of the domain: gives the type lamp twice"),
        ("(:types lamp room)", "(:types lamp - room room - lamp)", "line 3 of the domain: the type lamp is above itself"),
        ("(:types lamp room)", "(:types lamp room -thing)", "line 3 of the domain: \"-thing\" is no name; write a blank after -"),
        (
            ":effect (on ?l)",
            ":effect (and (on ?l) (increase (total-cost) 1) (increase (total-cost) 1))",
            "line 6 of the domain: changes total-cost a second time",
        ),
        (":effect (on ?l)", ":effect (and (on ?l) (not (increase (total-cost) 1)))", "line 6 of the domain: changes total-cost"),
        (":effect (on ?l)", ":effect (on ?l) :effect (at ?r)", "line 6 of the domain: gives the field :effect twice"),
    ] {
        let refused = converted(&domain.replacen(from, to, 1), problem).expect_err(told);
        assert!(refused.starts_with(told), "{told}: {refused}");
    }
    for (from, to, told) in [
        ("(at kitchen)", "(at kitchen hall)", "line 4 of the problem: (at kitchen hall) has 2 terms, and 1 are wanted"),
        ("(in a kitchen)", "(in kitchen a)", "line 4 of the problem: kitchen in (in kitchen a) is of the type room, and lamp is wanted"),
        ("(on a)", "(on hall)", "line 5 of the problem: hall in (on hall) is of the type room, and lamp is wanted"),
        ("(at kitchen)", "(is kitchen)", "line 4 of the problem: (is kitchen) is of a predicate that the domain does not have"),
        ("(at kitchen)", "(at cellar)", "line 4 of the problem: cellar in (at cellar) is no object"),
        ("a b - lamp", "a b - object", "line 4 of the problem: a in (in a kitchen) is of the type object, and lamp is wanted"),
        ("a b - lamp", "?a b - lamp", "line 3 of the problem: the name of a parameter begins with ?"),
        ("(:domain lamps)", "(:domain lumps)", "line 2 of the problem: two is of the domain lumps, and this is lamps"),
        ("(in b hall)", "(= (price a) 2) (= (price a) 3)", "line 4 of the problem: gives (price a) a second value"),
    ] {
        let refused = converted(domain, &problem.replacen(from, to, 1)).expect_err(told);
        assert!(refused.starts_with(told), "{told}: {refused}");
    }
}

#[test]
fn marks_and_blanks_that_some_editors_write_or_leave_out_change_nothing() {
    let (domain, problem) = LAMPS;
    let world = converted(domain, problem).expect("a world");
    assert_eq!(best(&world, problem), Some(3));
    assert_eq!(converted(&domain.replace("(at ?r)", "(at?r)"), problem), Ok(world.clone()));
    assert_eq!(converted(&format!("\u{feff}{domain}"), &format!("\u{feff}{problem}")), Ok(world));
}

#[test]
fn equalities_and_inequalities_with_constants_and_in_chains_count() {
    let domain = "(define (domain tour) (:types place) (:constants home - place)
        (:predicates (at ?p - place) (next ?a ?b - place) (paid))
        (:action go :parameters (?from ?to - place) :precondition (and (at ?from) (next ?from ?to)) :effect (and (at ?to) (not (at ?from))))
        (:action pay :parameters (?p - place) :precondition (and (at ?p) (not (= ?p home))) :effect (paid)))";
    let problem = "(define (problem t) (:domain tour) (:objects bank shop - place)
        (:init (at home) (next home shop) (next shop bank) (next bank home)) (:goal (and (paid))))";
    let of = |condition: &str| {
        let domain = domain.replace("(?p - place) :precondition (and (at ?p) (not (= ?p home)))", condition);
        best(&converted(&domain, problem).expect("a world"), problem)
    };
    assert_eq!(of("(?p - place) :precondition (and (at ?p) (not (= ?p home)))"), Some(2));
    assert_eq!(of("(?p - place) :precondition (and (at ?p) (not (= ?p home)) (not (= shop ?p)))"), Some(3));
    assert_eq!(of("(?p - place) :precondition (and (at ?p) (= ?p bank))"), Some(3));
    assert_eq!(of("(?p ?q ?r - place) :precondition (and (at ?p) (= ?q ?p) (= ?q ?r) (= ?r bank))"), Some(3));
    assert_eq!(of("(?p ?q ?r - place) :precondition (and (at ?r) (= ?p ?q) (= ?r ?q) (not (= ?p home)))"), Some(2));
    let never = domain.replace("(not (= ?p home)))", "(= ?p home) (= ?p bank))");
    let told = pddl::convert(&never, problem).expect("a world").warnings.join("\n");
    assert!(told.contains("pay can never be done") && told.contains("no plan reaches the goal"), "{told}");
}

#[test]
fn one_object_for_two_parameters_is_an_action_of_its_own() {
    let domain =
        "(define (domain report) (:types place) (:predicates (at ?p - place) (next ?a ?b - place) (have ?p - place) (told ?p - place))
        (:action go :parameters (?a ?b - place) :precondition (and (at ?a) (next ?a ?b)) :effect (and (at ?b) (not (at ?a))))
        (:action sample :parameters (?p - place) :precondition (at ?p) :effect (have ?p))
        (:action tell :parameters (?sample ?here - place) :precondition (and (at ?here) (have ?sample)) :effect (told ?sample)))";
    let problem = "(define (problem one) (:domain report) (:objects a b - place) (:init (at a) (next a b)) (:goal (told b)))";
    let world = converted(domain, problem).expect("a world");
    assert_eq!(best(&world, problem), Some(3));
    let names: Vec<&str> = world.actions.iter().map(|action| action.name.as_str()).collect();
    assert_eq!(names, ["go", "sample", "tell-here-is-sample", "tell"]);
    // Where two must differ, no plan tells of b, and a warning says so.
    let differ = domain.replace("(have ?sample))", "(have ?sample) (not (= ?sample ?here)))");
    let told = pddl::convert(&differ, problem).expect("a world").warnings;
    assert!(told.len() == 1 && told[0].contains("no plan reaches the goal"), "{told:?}");
}

#[test]
fn a_name_that_the_converter_would_give_is_left_to_the_domain() {
    let (domain, problem) = (
        "(define (domain lamps) (:requirements :strips :typing) (:types lamp room - thing thing)
        (:predicates (on ?l - lamp) (in ?l - lamp ?r - room) (at ?r - room) (is-room ?t - thing) (price-2 ?r - room) (lit))
        (:functions (total-cost) (price ?t - thing))
        (:action go :parameters (?from ?to - room) :precondition (at ?from) :effect (and (at ?to) (not (at ?from)) (increase (total-cost) 1)))
        (:action poke :parameters (?r - room) :precondition (at ?r) :effect (and (lit) (increase (total-cost) (price ?r))))
        (:action poke-2 :parameters (?r - room) :precondition (price-2 ?r) :effect (and (lit) (increase (total-cost) 1))))",
        "(define (problem two) (:domain lamps) (:objects a b whole - lamp kitchen hall - room)
        (:init (at kitchen) (in a kitchen) (in b hall) (= (price kitchen) 3) (= (price hall) 1)) (:goal (lit)) (:metric minimize (total-cost)))",
    );
    let world = converted(domain, problem).expect("a world");
    let plan = robot::plan(&world, &"lit(whole-2)".parse().expect("a task")).expect("a robot").expect("a plan");
    assert_eq!(cost(&world, &plan), 2, "{plan:?}");
}

#[test]
fn an_action_whose_name_is_every_robots_gets_another() {
    let domain = "(define (domain d) (:predicates (p)) (:action noop :effect (p)))";
    let world = converted(domain, "(define (problem one) (:domain d) (:init) (:goal (p)))").expect("a world");
    assert_eq!(WorldFile::parse(&world.to_json_line().expect("a line")), Ok(world.clone()));
    assert_eq!(world.actions[0].name, "noop-2");
}

#[test]
fn a_function_may_have_values_for_objects_of_several_types() {
    let domain = "(define (domain shop) (:requirements :typing :action-costs) (:types truck box)
        (:predicates (have ?x - truck) (got ?x - box)) (:functions (total-cost) - number (price ?x) - number)
        (:action buytruck :parameters (?t - truck) :effect (and (have ?t) (increase (total-cost) (price ?t))))
        (:action buybox :parameters (?b - box) :effect (and (got ?b) (increase (total-cost) (price ?b)))))";
    let problem = "(define (problem c) (:domain shop) (:objects t1 t2 - truck b1 - box)
        (:init (= (total-cost) 0) (= (price t1) 2) (= (price t2) 3) (= (price b1) 3)) (:goal (and (have t2) (got b1))) (:metric minimize (total-cost)))";
    assert_eq!(best(&converted(domain, problem).expect("a world"), problem), Some(6));
}

#[test]
fn of_all_parameters_that_settle_the_rest_those_with_the_fewest_actions_stay() {
    let domain = "(define (domain tower) (:predicates (free ?x) (lies ?x ?y) (fits ?x ?y))
        (:action shift :parameters (?x ?old ?new)
            :precondition (and (fits ?x ?new) (lies ?x ?old) (free ?x) (free ?new))
            :effect (and (lies ?x ?new) (not (lies ?x ?old)) (free ?old) (not (free ?new)))))";
    let problem = "(define (problem three) (:domain tower) (:objects big mid small a b c)
        (:init (fits big a) (fits big b) (fits big c) (fits mid a) (fits mid b) (fits mid c) (fits small a) (fits small b) (fits small c)
            (fits mid big) (fits small big) (fits small mid) (lies big a) (lies mid big) (lies small mid) (free small) (free b) (free c))
        (:goal (and (lies big c) (lies mid big) (lies small mid))))";
    let world = converted(domain, problem).expect("a world");
    assert_eq!(best(&world, problem), Some(7));
    assert_eq!(robot::with(&world, |robot, _| robot.actions().len()), Ok(12));
}

#[test]
fn types_that_nothing_mixes_are_classes_of_their_own() {
    let domain = "(define (domain d) (:types lamp room - thing cat dog - pet) (:predicates (on ?l - lamp) (fed ?p - pet) (at ?r - room))
        (:action light :parameters (?l - lamp) :effect (on ?l)) (:action feed :parameters (?p - pet) :effect (fed ?p)))";
    let problem =
        "(define (problem p) (:domain d) (:objects l - lamp r - room c - cat d - dog) (:init (at r)) (:goal (and (on l) (fed c))))";
    let world = converted(domain, problem).expect("a world");
    assert_eq!(world.classes, ["lamp", "room", "pet"]);
    // Words tell the types of one class apart.
    assert_eq!(world.attributes[1], ("type".to_owned(), vec!["pet".to_owned()]));
    let types: Vec<_> = world.objects.iter().filter_map(|object| object.attributes.get(1)).map(|(_, value)| value.as_str()).collect();
    assert_eq!(types, ["cat", "dog"]);
}

#[test]
fn a_goal_that_is_left_out_or_holds_is_told() {
    let (domain, problem) = LAMPS;
    let warnings = |goal: &str| pddl::convert(domain, &problem.replace("(:goal (and (on a) (on b)))", goal)).expect("a world").warnings;
    assert_eq!(warnings("(:goal (and (on a) (on b)))"), [""; 0]);
    assert_eq!(warnings("(:goal (at kitchen))"), ["the goal holds at first; no plan is needed"]);
    let several = warnings("(:goal (and (on a) (on b) (at hall) (at kitchen) (in a kitchen)))");
    assert!(
        several[0].starts_with("no plan reaches the goal") && several[1].contains("it has 5 propositions, and 4 are the most"),
        "{several:?}"
    );
}

#[test]
fn what_contradicts_itself_in_a_domain_or_a_problem_is_refused_by_its_name() {
    let (blocks, three) = (include_str!("pddl/blocks.pddl"), include_str!("pddl/blocks-3.pddl"));
    let goal_from = three.find("(:goal").expect("a goal");
    let with_goal = |goal: &str| format!("{}(:goal {goal}))", &three[..goal_from]);
    for (domain, problem, told) in [
        (blocks.replacen("(:predicates", "(:predicates (clear ?z)", 1), three.to_owned(), "gives the predicate clear twice"),
        (blocks.replacen("(:action", "(:action stack :effect (handempty)) (:action", 1), three.to_owned(), "gives the action stack twice"),
        (
            GRIPPER.replacen("ball ", "", 1),
            GRIPPER_4.to_owned(),
            "is of the type ball, which the domain does not have; add it to (:types ...)",
        ),
        (
            GRIPPER.to_owned(),
            GRIPPER_4.replacen("(:objects", "(:objects ball1 - ball", 1),
            "gives the object ball1 twice; give each a name of its own",
        ),
        (blocks.to_owned(), with_goal("(on c c)"), "(on c c) has one object twice"),
        (blocks.to_owned(), with_goal("(handempty)"), "holds at first, and so does all else of its kind"),
        (GRIPPER.replacen("?from ?to", "?from ?from", 1), GRIPPER_4.to_owned(), "gives the parameter ?from twice"),
    ] {
        let refused = converted(&domain, &problem).expect_err(told);
        assert!(refused.contains(told), "{told}: {refused}");
    }
    let constant = GRIPPER.replacen("(:predicates", "(:constants left - gripper)\n(:predicates", 1);
    assert!(converted(&constant, GRIPPER_4).is_err_and(|it| it.contains("left is a constant of the domain already; leave it out")));
    let itself = "(define (domain d) (:predicates (p ?x ?y)) (:action a :parameters (?x) :effect (p ?x ?x)))";
    let one = "(define (problem one) (:domain d) (:objects a b) (:init) (:goal (p a b)))";
    assert!(converted(itself, one).is_err_and(|it| it.contains("line 1 of the domain: an effect of a on p has one object twice")));
    // A fact that is given twice counts once.
    let twice = GRIPPER_4.replacen("(:init", "(:init (at-robby rooma)", 1);
    assert_eq!(converted(GRIPPER, &twice), converted(GRIPPER, GRIPPER_4));
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
