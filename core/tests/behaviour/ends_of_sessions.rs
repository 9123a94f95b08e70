//! The end of a session: an ended session stays ended until it is resumed.

use crate::rooms::{Memory, robot};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::language::Settings;
use goodbot::memory::{AgentArrays, AgentMemory};
use goodbot::oomdp::Action;
use goodbot::planning::Progress;
use goodbot::session::Phase;
use goodbot::{Agent, AgentError, Capacities, Options};

#[test]
fn a_session_is_learned_from_once() {
    let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
    agent.hear(&home, &start, "go to the red room").unwrap();
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
    assert_eq!(agent.finish(&home), Err(AgentError::NotNow(Phase::Ended)));
    assert_eq!(agent.plan(&home, &start, 1), Err(AgentError::NotNow(Phase::Ended)));
    assert_eq!(agent.language().bitext().sessions(), 1);
    // Heard again in the same place, the session is resumed, and counts as another one.
    agent.hear_again(&home, &start).unwrap();
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
    assert_eq!(agent.language().bitext().sessions(), 2);
}

#[test]
fn a_session_is_taken_up_again_when_it_is_learned_and_planned_as_before() {
    let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
    agent.hear(&home, &start, "go to the red room").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    let plans = |agent: &Agent<AgentArrays<Memory>>| [0, 1].map(|task| agent.planned().optimal(task));
    let before = plans(&agent);
    let _ = agent.finish(&home).unwrap();
    // Planning and training share one memory.
    assert_eq!(agent.hear_again(&home, &start), Err(AgentError::NotNow(Phase::Learning)));
    agent.learn_fully();
    agent.hear_again(&home, &start).unwrap();
    agent.plan_fully(&home, &start).unwrap();
    assert_eq!(plans(&agent), before);
}

#[test]
fn a_forgotten_session_is_not_learned_from() {
    let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
    agent.hear(&home, &start, "go to the red room").unwrap();
    agent.forget();
    assert_eq!(agent.finish(&home), Err(AgentError::NotNow(Phase::Ended)));
    assert_eq!(agent.plan(&home, &start, 1), Err(AgentError::NotNow(Phase::Ended)));
    assert_eq!(agent.language().bitext().sessions(), 0);
}

#[test]
fn after_a_prior_that_is_no_probability_no_session_is_under_way() {
    let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
    for prior in [f32::NAN, -1.0, f32::INFINITY, 0.0] {
        let error = agent.hear_with_prior(&home, &start, "go", |_, _| prior).unwrap_err();
        assert!(
            matches!(error, AgentError::Prior { task: 0, value } if value.to_bits() == prior.to_bits()) || error == AgentError::NoPrior
        );
        assert_eq!(agent.plan(&home, &start, 1), Err(AgentError::NotNow(Phase::Idle)));
        assert_eq!(agent.hear_again(&home, &start), Err(AgentError::NotNow(Phase::Idle)));
    }
}

#[test]
fn a_command_of_a_length_never_heard_is_learned_from_too() {
    let options = Options { language: Settings { length: true, ..Settings::PAPER }, ..Options::PAPER };
    let (home, start, mut agent) = robot(Memory::new().agent, None, options);
    agent.hear(&home, &start, "go to the red room").unwrap();
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
    let pairs = agent.language().bitext().pairs().len();
    // Pr(n|l) is 0 for each machine command: nothing explains three words, and only the feedback shows their meaning.
    agent.hear(&home, &start, "red room now").unwrap();
    agent.plan_fully(&home, &start).unwrap();
    agent.acted(&home, &start, Action::new(2)).unwrap();
    let _ = agent.feedback(Feedback::Reward).unwrap();
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
    let added = agent.language().bitext().pairs().get(pairs..).unwrap();
    let whole: f32 = added.iter().map(|pair| pair.weight).sum();
    assert!((whole - 1.0).abs() < 1e-5, "the session's weights add up to {whole}");
}

/// Every word's probability for every machine token.
fn learned(agent: &Agent<AgentArrays<Memory>>) -> Vec<(String, String, u32)> {
    let (language, mut all) = (agent.language(), vec![]);
    for (token, of) in language.tokens().iter().take(language.tables().tokens()) {
        for (word, said) in language.words().iter().take(language.tables().words()) {
            all.push((of.to_owned(), said.to_owned(), language.tables().translation(word, Some(token)).to_bits()));
        }
    }
    all
}

#[test]
fn what_is_learned_later_is_learned_alike_and_words_mean_the_same_until_then() {
    const COMMANDS: [&str; 4] = ["go to the red room", "walk into the green one", "enter red now", "to green please"];
    for language in [Settings::PAPER, Settings::DEFAULT] {
        // Their weights do not depend on words, so they are the same whenever the sessions are learned.
        let options = Options { weights: goodbot::session::Weights::Evidence, language, ..Options::PAPER };
        let tables = |later: bool| {
            let (home, start, mut agent) = robot(Memory::new().agent, None, options);
            agent.hear(&home, &start, "go to the red room").unwrap();
            let _ = agent.finish(&home).unwrap();
            agent.learn_fully();
            let first = learned(&agent);
            for command in COMMANDS {
                agent.hear(&home, &start, command).unwrap();
                agent.plan_fully(&home, &start).unwrap();
                agent.acted(&home, &start, Action::new(0)).unwrap();
                let _ = agent.feedback(Feedback::Reward).unwrap();
                if later {
                    agent.finish_for_later(&home).unwrap();
                    assert_eq!(agent.finish_for_later(&home), Err(AgentError::NotNow(Phase::Ended)));
                    assert_eq!(learned(&agent), first);
                } else {
                    let _ = agent.finish(&home).unwrap();
                    agent.learn_fully();
                }
            }
            assert_eq!(agent.language().bitext().sessions(), 5);
            agent.begin_learning();
            assert_eq!(agent.hear(&home, &start, "go"), Err(AgentError::NotNow(Phase::Learning)));
            agent.learn_fully();
            assert!(learned(&agent).len() > first.len());
            learned(&agent)
        };
        assert_eq!(tables(true), tables(false));
    }
}

#[test]
fn a_session_that_finds_no_room_for_later_goes_on_and_finishing_makes_room() {
    let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
    let refused = loop {
        agent.hear(&home, &start, "go to the red room").unwrap();
        if let Err(error) = agent.finish_for_later(&home) {
            break error;
        }
    };
    assert!(matches!(refused, AgentError::Capacity(_)), "{refused}");
    let full = agent.language().bitext().sessions();
    assert!(full > 1);
    assert!(agent.finish(&home).unwrap().gave_way.count() > 0);
    agent.learn_fully();
    assert_eq!(agent.language().bitext().sessions(), full);
}

#[test]
fn the_agent_says_what_it_is_doing_from_a_command_to_the_next() {
    let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
    let mut phases = vec![agent.phase()];
    agent.begin_hearing(&home, &start, "go to the red room").unwrap();
    phases.push(agent.phase());
    while agent.hear_on(&home, 1).unwrap() == Progress::Working {}
    phases.push(agent.phase());
    assert_eq!(agent.finish_on(&home, 1), Err(AgentError::NotNow(Phase::Ready)), "nobody began to finish");
    agent.begin_finishing(&home).unwrap();
    phases.push(agent.phase());
    while agent.finish_on(&home, 1).unwrap().is_none() {}
    phases.push(agent.phase());
    agent.learn_fully();
    phases.push(agent.phase());
    agent.hear_again(&home, &start).unwrap();
    phases.push(agent.phase());
    use Phase::{Ended, Finishing, Hearing, Idle, Learning, Ready};
    assert_eq!(phases, [Idle, Hearing, Ready, Finishing, Learning, Ended, Ready]);
    let refused = AgentError::NotNow(Finishing).to_string();
    assert_eq!(refused, "the session is not finished; finish on until it is");
}

/// The commands in the training data, as text.
fn kept<M: AgentMemory>(agent: &Agent<M>) -> Vec<String> {
    let (words, bitext) = (agent.language().words(), agent.language().bitext());
    let command = |session| bitext.sentence(session).iter().map(|&word| words.text(word)).collect::<Vec<_>>().join(" ");
    (0..bitext.sessions() as u16).map(command).collect()
}

#[test]
fn a_session_that_has_joined_keeps_its_words_whatever_breaks_its_end_off() {
    let interruptions: [fn(&mut Agent<AgentArrays<Memory>>); 5] = [
        |_| {},
        |agent| agent.leave(),
        |agent| agent.forget(),
        |agent| agent.set_options(*agent.options()).unwrap(),
        |agent| agent.set_strategies(&[(Strategy::BALANCED, 1.0)]).unwrap(),
    ];
    for (which, interrupt) in interruptions.into_iter().enumerate() {
        let (home, start, mut agent) = robot(Memory::new().agent, None, Options::DEFAULT);
        agent.hear(&home, &start, "go to the red room").unwrap();
        agent.begin_finishing(&home).unwrap();
        while agent.language().bitext().sessions() == 0 {
            assert_eq!(agent.finish_on(&home, 1), Ok(None));
        }
        assert_eq!(agent.phase(), Phase::Finishing);
        interrupt(&mut agent);
        let heard = agent.hear(&home, &start, "take that star now please");
        assert_eq!(kept(&agent), ["go to the red room"], "{which}");
        assert!(matches!(heard, Err(AgentError::NotNow(_))), "{which}: the session is to be learned from first");
        while agent.phase() == Phase::Finishing {
            let _ = agent.finish_on(&home, 1).unwrap();
        }
        agent.learn_fully();
        assert!(agent.hear(&home, &start, "take that star now please").is_ok(), "{which}");
        assert_eq!(kept(&agent), ["go to the red room"], "{which}");
    }
}

#[test]
fn what_an_observer_asks_while_a_session_ends_changes_nothing_that_is_learned() {
    let learned = |looks: bool| {
        let (home, start, mut agent) = robot(Memory::new().agent, None, Options::PAPER);
        agent.hear(&home, &start, "go to the red room").unwrap();
        agent.begin_finishing(&home).unwrap();
        let _ = agent.finish_on(&home, 1).unwrap();
        if looks {
            agent.weigh(&home).unwrap();
        }
        while agent.finish_on(&home, 1).unwrap().is_none() {}
        let pairs = agent.language().bitext().pairs();
        pairs.iter().map(|pair| (pair.command, pair.weight.to_bits())).collect::<Vec<_>>()
    };
    assert_eq!(learned(true), learned(false));
}

#[cfg(feature = "alloc")]
#[test]
fn no_other_session_is_unlearned_where_one_is_about_to_give_way() {
    let capacities = Capacities { words: 20, ..Capacities::SMALL };
    for learned in 2..8 {
        let mut memory = goodbot::HeapMemory::new(&capacities);
        let (home, start, mut agent) = robot(&mut memory.agent, None, Options::DEFAULT);
        for number in 0..=learned {
            let words: Vec<String> = (b'a'..=b'e').map(|letter| format!("{}{number}", char::from(letter).to_string().repeat(3))).collect();
            agent.hear(&home, &start, &words.join(" ")).unwrap();
            if number < learned {
                let _ = agent.finish(&home).unwrap();
                agent.learn_fully();
            }
        }
        agent.begin_finishing(&home).unwrap();
        let joined = format!("eee{learned}");
        while !kept(&agent).iter().any(|command| command.ends_with(&joined)) {
            assert_eq!(agent.finish_on(&home, 1), Ok(None));
        }
        let mut rest = kept(&agent);
        rest.remove(1);
        assert!(agent.unlearn(1), "{learned}");
        assert_eq!(kept(&agent), rest, "{learned}");
        agent.learn_fully();
    }
}

#[cfg(feature = "alloc")]
#[test]
fn a_session_that_gives_way_goes_whole_whatever_breaks_its_end_off() {
    let capacities = Capacities { sessions: 5, ..Capacities::SMALL };
    let mut memory = goodbot::HeapMemory::new(&capacities);
    let interruptions: [fn(&mut Agent<&mut goodbot::memory::AgentHeap>); 4] = [
        |agent| agent.leave(),
        |agent| agent.forget(),
        |agent| agent.set_options(*agent.options()).unwrap(),
        |agent| assert!(agent.unlearn(2)),
    ];
    for (which, interrupt) in interruptions.into_iter().enumerate() {
        let mut removing = 0;
        for calls in 1.. {
            let (home, start, mut agent) = robot(&mut memory.agent, None, Options::DEFAULT);
            for number in 0..capacities.sessions {
                agent.hear(&home, &start, ["go to the red room", "take the star to the blue room", "push it"][number % 3]).unwrap();
                agent.finish_for_later(&home).unwrap();
            }
            agent.hear(&home, &start, "go to the green room").unwrap();
            agent.begin_finishing(&home).unwrap();
            let done = (0..calls).any(|_| agent.finish_on(&home, 1).unwrap().is_some());
            let in_order = |agent: &Agent<_>| agent.language().bitext().pairs().is_sorted_by_key(|pair| pair.session);
            assert!(in_order(&agent), "{which}, after {calls} calls: a reader finds each session's pairs");
            removing += u32::from(agent.language().bitext().pairs_of(capacities.sessions as u16 - 2).is_empty());
            interrupt(&mut agent);
            let data = agent.language().bitext();
            assert!(in_order(&agent), "{which}, after {calls} calls");
            assert!((0..data.sessions() as u16).all(|session| !data.pairs_of(session).is_empty()), "{which}, after {calls} calls");
            let used = |command| data.pairs().iter().any(|pair| pair.command == command);
            assert!((0..data.commands() as u16).all(used), "{which}, after {calls} calls");
            if done {
                break;
            }
        }
        assert!(removing > 0, "{which}: an end was broken off while a session gave way");
    }
}
