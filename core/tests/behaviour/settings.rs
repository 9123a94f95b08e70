//! Options that nothing can be learned with are refused by the name of the field.

use goodbot::home::paper_tasks;
use goodbot::language::{LanguageModel, SettingError, Settings};
use goodbot::{Agent, AgentError, Capacities, Options};

goodbot::memory! {
    struct Memory = Capacities::SMALL;
}

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
    assert_eq!(refused(Options { least_weight: 1.0, ..Options::PAPER }), Some(AgentError::Setting(SettingError::LeastWeight(1.0))));
    assert_eq!((refused(Options::PAPER), refused(Options::DEFAULT)), (None, None));
}

#[test]
fn a_language_model_names_the_setting_that_is_none_to_train_with() {
    let mut memory = Memory::new();
    let endless = Settings { rounds: u32::MAX, ..Settings::PAPER };
    assert_eq!(LanguageModel::new(&mut memory.agent, endless).err(), Some(SettingError::Rounds(u32::MAX)));
}
