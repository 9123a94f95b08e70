//! Tasks as texts: the canonical form, and errors.

use goodbot_formats::task_text::{GroundAtomText, GroundTaskText, LiftedAtomText, LiftedTaskText, TaskTextError};

#[test]
fn the_canonical_form_is_written_as_it_was_read() {
    for text in [
        "agentInRoom(agent0,room1)",
        "agentInRoom(agent0,room1) & blockInRoom(block0,room2)",
        "roomIsRed(room0)",
        "näheBei(küche,стол) & AND(x-1,y.2)",
    ] {
        assert_eq!(text.parse::<GroundTaskText>().unwrap().to_string(), text);
    }
    let text = "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)";
    assert_eq!(text.parse::<LiftedTaskText>().unwrap().to_string(), text);
}

#[test]
fn blanks_and_the_word_and_are_accepted_and_made_canonical() {
    let wanted = "agentInRoom(agent0,room1) & blockInRoom(block0,room2)";
    for text in ["agentInRoom(agent0, room1) AND blockInRoom(block0, room2)", " agentInRoom ( agent0 ,room1 )&blockInRoom(block0,\troom2) "]
    {
        assert_eq!(text.parse::<GroundTaskText>().unwrap().to_string(), wanted);
    }
    let lifted: LiftedTaskText = "f( ?a , ? b) AND g(?c)".parse().unwrap();
    assert_eq!(lifted.to_string(), "f(?a,?b) & g(?c)");
}

#[test]
fn what_is_no_task_is_refused_where_it_goes_wrong() {
    for (text, column) in [
        ("agentInRoom", 12),
        ("agentInRoom(", 13),
        ("agentInRoom()", 13),
        ("agentInRoom(a,)", 15),
        ("agentInRoom(a b)", 15),
        ("agentInRoom(a", 14),
        ("f(a))", 5),
        ("f(a) and g(b)", 6),
        ("f(a) & ", 8),
        ("f(a) AND", 6),
        ("& f(a)", 1),
        ("f(ä,(b))", 5),
        ("f(a)\u{0}", 5),
    ] {
        match text.parse::<GroundTaskText>() {
            Err(TaskTextError::Expected { column: found, .. }) => {
                assert_eq!(found, column, "{text}")
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    assert_eq!("  ".parse::<GroundTaskText>(), Err(TaskTextError::Empty));
}

#[test]
fn ground_and_lifted_are_not_mixed() {
    let ground = "f(a,?b)".parse::<GroundTaskText>();
    assert_eq!(ground, Err(TaskTextError::VariableInGround { column: 5 }));
    let lifted = "f(?a,b)".parse::<LiftedTaskText>();
    assert_eq!(lifted, Err(TaskTextError::ObjectInLifted { column: 6 }));
}

#[test]
fn an_atom_is_one_proposition_only() {
    let atom: GroundAtomText = "f(a, b)".parse().unwrap();
    assert_eq!((atom.function(), atom.arguments().len()), ("f", 2));
    let error = "f(a) & g(b)".parse::<GroundAtomText>().unwrap_err();
    assert!(error.to_string().starts_with("is no task, the end belongs at its character 6"));
}

#[test]
fn what_cannot_be_read_again_cannot_be_built() {
    let name = |name: &str| Err(TaskTextError::UnusableName { name: name.into() });
    assert_eq!(GroundAtomText::new("f", ["a b"]), name("a b"));
    assert_eq!(GroundAtomText::new("", ["a"]), name(""));
    assert_eq!(GroundAtomText::new("f", Vec::<String>::new()), Err(TaskTextError::Empty));
    assert_eq!(GroundTaskText::new(Vec::new()), Err(TaskTextError::Empty));
    assert_eq!(LiftedTaskText::new(Vec::new()), Err(TaskTextError::Empty));
    assert!(LiftedAtomText::new("f", ["?a"]).is_err());
    let task = LiftedTaskText::new(vec![LiftedAtomText::new("f", ["a"]).unwrap()]).unwrap();
    assert_eq!(task.to_string().parse(), Ok(task));
}

#[test]
fn a_conjunction_is_compared_without_its_order() {
    let task: GroundTaskText = "f(a) & g(b)".parse().unwrap();
    let other: GroundTaskText = "g(b) & f(a)".parse().unwrap();
    assert!(task.is_same(&other) && task != other);
    assert!(!task.is_same(&"f(a)".parse().unwrap()));
}

#[test]
fn a_very_long_task_is_read_in_linear_time() {
    let text = format!("f({}a)", "a,".repeat(1 << 20));
    let task: GroundTaskText = text.parse().unwrap();
    assert_eq!(task.atoms()[0].arguments().len(), (1 << 20) + 1);
    let open = "f(".repeat(1 << 20);
    assert!(open.parse::<GroundTaskText>().is_err());
}

#[test]
fn an_exclamation_mark_says_what_shall_not_be() {
    let task: GroundTaskText = "! f(a) then g(b)".parse().unwrap();
    assert_eq!(task.to_string(), "!f(a) then g(b)");
    assert!(task.way().before[0][0].is_negated() && !task.atoms()[0].is_negated());
    assert!(!task.is_same(&"f(a) then g(b)".parse().unwrap()));
    assert!("!f(?a)".parse::<LiftedTaskText>().is_err());
}
