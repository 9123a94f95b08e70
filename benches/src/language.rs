//! A bitext as training data, and models trained on it.

use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentMemory;
use goodbot::planning::Progress;

/// One sentence pair: machine tokens and English words, in which no word occurs twice.
pub type Pair = (Vec<String>, Vec<String>);

/// Sessions whose commands are to go to rooms and to take things there, each with several machine commands of decreasing weight.
pub fn sessions(count: usize) -> Vec<(Vec<String>, Vec<Vec<String>>)> {
    const COLOURS: [&str; 6] = ["red", "green", "blue", "yellow", "purple", "orange"];
    const SHAPES: [&str; 4] = ["chair", "bag", "backpack", "basket"];
    const VERBS: [&str; 4] = ["go", "move", "walk", "please"];
    let words = |text: String| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let capital = |text: &str| text.chars().next().map(|first| first.to_uppercase().to_string() + &text[1..]).unwrap_or_default();
    (0..count)
        .map(|session| {
            let colour = COLOURS[session % 6];
            let room = capital(colour);
            let (thing, own) = (SHAPES[session / 3 % 4], COLOURS[session / 2 % 6]);
            if session % 2 == 0 {
                let english = format!("{} to the {colour} room", VERBS[session / 2 % 4]);
                let machine = [format!("agentInRoom agent room roomIs{room} room"), "agentInRoom agent room".into()];
                (words(english), machine.map(words).to_vec())
            } else {
                let english = format!("take that {thing} over to the {colour} room");
                let task = "blockInRoom block room";
                let (shape, is) = (format!("shape{} block", capital(thing)), format!("blockIs{} block", capital(own)));
                let machine = [
                    task.to_owned(),
                    format!("{task} {shape}"),
                    format!("{task} roomIs{room} room"),
                    format!("{task} roomIs{room} room {shape}"),
                    format!("{task} {is} roomIs{room} room {shape}"),
                ];
                (words(english), machine.map(words).to_vec())
            }
        })
        .collect()
}

/// An untrained model with these sessions, each machine command with this weight.
pub fn model<M: AgentMemory>(memory: M, data: &[(Vec<String>, Vec<Vec<String>>)], settings: Settings, weight: f32) -> LanguageModel<M> {
    let mut model = LanguageModel::new(memory, settings).expect("settings to train with");
    for (english, machine) in data {
        let sentence = model.lend().hear(&english.join(" ")).expect("a command");
        let commands: Vec<Vec<_>> = machine
            .iter()
            .map(|tokens| tokens.iter().map(|token| model.lend().tokens_mut().intern(token).expect("room for the token")).collect())
            .collect();
        model.lend().add_session(&sentence, commands.iter().map(|command| (&command[..], weight))).expect("room for the session");
    }
    model
}

/// Trains completely, from uniform tables.
pub fn train(model: &mut LanguageModel<impl AgentMemory>) {
    model.lend().begin_training();
    while model.lend().train(u32::MAX) == Progress::Working {}
}
