//! Test sessions that were trained on nevertheless: with the same id, or with the same content under another id.

use goodbot_console::training_data::Lesson;
use std::collections::HashMap;

/// The keys of a session: its id and its content.
struct Keys<'l> {
    id: Option<&'l str>,
    content: String,
}

impl<'l> Keys<'l> {
    fn of(lesson: &'l Lesson) -> Self {
        let header = &lesson.header;
        let meant = lesson.intended.and_then(|task| lesson.readings.get(task)).map(|reading| reading.name.to_string());
        let parts = [lesson.place(), header.command.clone(), lesson.walk.clone(), meant.unwrap_or_default()];
        Self { id: header.id.as_deref(), content: parts.join("\n") }
    }
}

/// For each test lesson, a training lesson of which it is a copy, if there is one. `rounds` are the positions that are left out of
/// training, and those that are asked. `itself` says that both lists are the same.
pub fn find<'l>(taught: &'l [Lesson], asked: &'l [Lesson], rounds: &[(Vec<usize>, Vec<usize>)], itself: bool) -> Vec<Option<&'l Lesson>> {
    let mut ids: HashMap<&str, Vec<usize>> = HashMap::new();
    let mut contents: HashMap<String, Vec<usize>> = HashMap::new();
    for (position, lesson) in taught.iter().enumerate().filter(|(_, lesson)| lesson.learn) {
        let keys = Keys::of(lesson);
        if let Some(id) = keys.id {
            ids.entry(id).or_default().push(position);
        }
        contents.entry(keys.content).or_default().push(position);
    }
    let mut found = vec![None; asked.len()];
    for (left_out, part) in rounds {
        let left_out: std::collections::HashSet<usize> = left_out.iter().copied().collect();
        for &position in part {
            let Some(lesson) = asked.get(position) else { continue };
            let keys = Keys::of(lesson);
            let alike = keys.id.and_then(|id| ids.get(id)).into_iter().chain(contents.get(&keys.content)).flatten();
            let copy = alike.copied().find(|&other| !(left_out.contains(&other) || itself && other == position));
            if let Some(slot) = found.get_mut(position) {
                *slot = copy.and_then(|copy| taught.get(copy));
            }
        }
    }
    found
}
