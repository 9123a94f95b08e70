//! Invalid options are refused with the name of the field.

use crate::rooms::Memory;

use goodbot::feedback::{Ending, Hazard};
use goodbot::home::paper_tasks;
use goodbot::language::{LanguageModel, SettingError, Settings};
use goodbot::{Agent, AgentError, Options};

fn refused(options: Options) -> Option<AgentError> {
    Agent::new(Memory::new().agent, &paper_tasks().unwrap(), options).err()
}

#[test]
fn an_agent_names_the_option_that_is_none_to_learn_with() {
    for wrong in [f32::NAN, f32::INFINITY, -0.1] {
        let language = Settings { smoothing: wrong, ..Settings::PAPER };
        let error = refused(Options { language, ..Options::PAPER }).unwrap();
        assert_eq!(error.to_string(), format!("Settings::smoothing is {wrong}; it must be a number from 0 to 1000000"));
        let language = Settings { alignment_prior: wrong, ..Settings::PAPER };
        let error = refused(Options { language, ..Options::PAPER }).unwrap();
        assert_eq!(error.to_string(), format!("Settings::alignment_prior is {wrong}; it must be a number from 0 to 1000000"));
        let error = refused(Options { least_weight: wrong, ..Options::PAPER }).unwrap();
        assert_eq!(error.to_string(), format!("Options::least_weight is {wrong}; it must be a number from 0 to less than 1"));
    }
    assert_eq!(refused(Options { done: 1.0, ..Options::PAPER }), Some(AgentError::Setting(SettingError::Done(1.0))));
    assert_eq!(refused(Options { least_weight: 1.0, ..Options::PAPER }), Some(AgentError::Setting(SettingError::LeastWeight(1.0))));
    assert_eq!((refused(Options::PAPER), refused(Options::DEFAULT)), (None, None));
}

#[test]
fn the_end_of_a_session_is_less_than_sure_at_every_moment() {
    let ending = |at_goal| Ending { at_goal, elsewhere: Hazard::of(0.0) };
    let swapped = |at_goal| Ending { at_goal: Hazard::of(0.0), elsewhere: at_goal };
    let half = Hazard::of(0.5);
    for taken in [half, Hazard { praised: 1.5, ..half }, Hazard { scolded: 1.5, ..half }, Hazard { praised: 0.0, scolded: 0.0, ..half }] {
        assert_eq!(refused(Options { ending: ending(taken), ..Options::PAPER }), None, "{taken:?}");
        assert_eq!(refused(Options { ending: swapped(taken), ..Options::PAPER }), None, "{taken:?}");
    }
    // After praise or blame, twice one half is certain.
    let wrong = [
        Hazard { praised: 2.0, ..half },
        Hazard { scolded: 2.0, ..half },
        Hazard { praised: 3.0, scolded: 0.0, ..half },
        Hazard { praised: -0.5, ..half },
        Hazard { scolded: -0.5, ..half },
        Hazard { moved: 1.0, praised: 0.5, scolded: 0.5, ..half },
        Hazard { rested: -0.1, ..half },
        Hazard { resting: f32::NAN, ..half },
    ];
    let error = Some(AgentError::Setting(SettingError::Ending));
    for wrong in wrong {
        assert_eq!(refused(Options { ending: ending(wrong), ..Options::PAPER }), error, "{wrong:?}");
        assert_eq!(refused(Options { ending: swapped(wrong), ..Options::PAPER }), error, "{wrong:?}");
    }
    assert_eq!(refused(Options::DEFAULT.with_ends()), None);
}

#[test]
fn a_language_model_names_the_setting_that_is_none_to_train_with() {
    let mut memory = Memory::new();
    let endless = Settings { rounds: u32::MAX, ..Settings::PAPER };
    assert_eq!(LanguageModel::new(&mut memory.agent, endless).err(), Some(SettingError::Rounds(u32::MAX)));
}
