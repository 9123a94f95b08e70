//! The screen: the home, the robot's beliefs, the support of each word, and the keys; and the pages that cover it.
//!
//! - [`plan`]: the home, or another world; [`thoughts`]: beliefs and words.

mod plan;
#[cfg(test)]
mod tests;
mod thoughts;

use super::keys::Focus;
use super::palette::Palette;
use super::site::Shown;
use super::visit::{Page, Phase, Visit};
use goodbot_console::counted;
use goodbot_console::printed::printable;
use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Position, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Clear, Paragraph, Widget, Wrap};
use std::borrow::Cow;
use thoughts::all_ideas;

/// The smallest usable screen: columns and rows.
const LEAST: (u16, u16) = (24, 8);
/// The rows of the likeliest tasks below a home, with their heading.
const GUESSES: u16 = 5;
/// From this number of columns on, beliefs are beside the home.
const BESIDE: u16 = 60;

/// Draws the screen.
pub fn draw(frame: &mut Frame<'_>, visit: &Visit, palette: Palette) {
    let area = frame.area();
    if area.width < LEAST.0 || area.height < LEAST.1 {
        frame.render_widget(Paragraph::new("Please make the window larger.").wrap(Wrap { trim: true }), area);
        return;
    }
    let [title, middle, message, prompt, keys] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Min(3),
        Constraint::Length(if area.width < 100 { 3 } else { 2 }),
        Constraint::Length(1),
        Constraint::Length(1),
    ])
    .areas(area);
    draw_title(frame, title, visit, palette);
    draw_middle(frame, middle, visit, palette);
    draw_message(frame, message, visit, palette);
    draw_prompt(frame, prompt, visit, palette);
    draw_keys(frame, keys, visit, palette);
    if let Some((shown, first)) = visit.page {
        draw_page(frame, area, visit, shown, first, palette);
    }
    // What the names and words of a stranger's file would do to the terminal is not drawn.
    for cell in &mut frame.buffer_mut().content {
        if let Cow::Owned(_) = printable(cell.symbol()) {
            cell.set_char(char::REPLACEMENT_CHARACTER);
        }
    }
}

/// Draws the robot's last action, and the message. Where they do not fit both, the message comes first: it may be a question.
fn draw_message(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let told = Line::styled(visit.told(), palette.quiet());
    let message = Line::styled(visit.message.as_str(), palette.strong());
    let mut lines: Vec<Line<'_>> = [told, message].into_iter().filter(|line| line.width() > 0).collect();
    let rows: usize = lines.iter().map(|line| line.width().div_ceil(area.width.into())).sum();
    if rows > area.height.into() {
        lines.reverse();
    }
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), area);
}

fn draw_title(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let place = match visit.stop() {
        Some(stop) => stop.title(),
        None if visit.classroom.tour.is_some() => "The tour is over".to_owned(),
        None => "Free play".to_owned(),
    };
    let learned = counted(visit.classroom.pupil.lessons_learned(), "session");
    let left = format!(" goodbot · {place}");
    let right = format!("learned from {learned} · speed: {} ", visit.pace.name());
    let gap = usize::from(area.width).saturating_sub(left.chars().count() + right.chars().count());
    let line = if gap > 0 { format!("{left}{}{right}", " ".repeat(gap)) } else { left };
    frame.render_widget(Paragraph::new(line).style(palette.title()), area);
}

fn draw_middle(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let Some(place) = visit.classroom.pupil.shown() else { return };
    let (columns, rows) = match &place {
        Shown::Floor(scene) => plan::wanted(scene),
        Shown::Other(table) => plan::wanted_by_table(table),
    };
    if area.width < BESIDE {
        let for_guesses = GUESSES.min(area.height / 2);
        let [home, rest] = Layout::vertical([Constraint::Max(rows + 1), Constraint::Min(for_guesses)]).areas(area);
        draw_place(frame, home, &place, visit, palette);
        thoughts::draw_beliefs(frame, rest, visit, palette);
        return;
    }
    let words = thoughts::wanted(visit);
    let [above, below] = Layout::vertical([Constraint::Fill(1), Constraint::Length(words.min(area.height.saturating_sub(8)))]).areas(area);
    let most = area.width / 2;
    let [home, rest] = Layout::horizontal([Constraint::Length(columns.min(most)), Constraint::Fill(1)]).spacing(2).areas(above);
    draw_place(frame, home, &place, visit, palette);
    thoughts::draw_beliefs(frame, rest, visit, palette);
    thoughts::draw_words(frame, below, visit, palette);
}

/// Draws the place of the robot.
fn draw_place(frame: &mut Frame<'_>, area: Rect, place: &Shown, visit: &Visit, palette: Palette) {
    let block = match place {
        Shown::Floor(_) => framed("Home", palette),
        Shown::Other(table) => framed(&table.name, palette),
    };
    let inner = block.inner(area);
    frame.render_widget(block, area);
    match place {
        Shown::Floor(scene) => {
            let moved = visit.acted().map_or("", |acted| acted.action.as_str());
            plan::draw(frame, inner, scene, moved, palette);
        }
        Shown::Other(table) => plan::draw_table(frame, inner, table, palette),
    }
}

/// A block with a heading on a line above it.
fn framed(heading: &str, palette: Palette) -> Block<'_> {
    Block::new()
        .borders(Borders::TOP)
        .border_style(palette.quiet())
        .title(Span::styled(format!("{heading} "), Style::new().add_modifier(Modifier::BOLD)))
}

fn draw_prompt(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let writing = visit.focus() == Focus::Command;
    let command = visit.classroom.pupil.lesson.command().filter(|_| !writing);
    let text = match command {
        Some(command) => command.to_owned(),
        None => visit.prompt.text(),
    };
    let lead = if command.is_some() { "Command: " } else { "Tell it: " };
    // If the text is longer than the line, the part before the cursor is shown.
    let room = usize::from(area.width).saturating_sub(lead.len() + 1);
    let before = if command.is_some() { text.chars().count() } else { visit.prompt.before().chars().count() };
    let skipped = if command.is_some() { 0 } else { before.saturating_sub(room) };
    let shown: String = text.chars().skip(skipped).take(room).collect();
    let hint = if !writing && command.is_none() { palette.quiet() } else { Style::new().add_modifier(Modifier::BOLD) };
    frame.render_widget(Paragraph::new(Line::from(vec![Span::raw(lead), Span::styled(shown, hint)])), area);
    if writing {
        let column = u16::try_from(lead.len() + before - skipped).unwrap_or(u16::MAX);
        frame.set_cursor_position(Position::new(area.x.saturating_add(column), area.y));
    }
}

/// The key of the explanation, also where `?` is a letter.
const HELP: &str = "F1";

/// The keys that can be pressed now, the most important ones first.
fn keys(visit: &Visit) -> Vec<(&'static str, &'static str)> {
    match (visit.focus(), visit.phase()) {
        (Focus::Page, _) => vec![("any key", "back"), ("↑ ↓", "move")],
        (Focus::Command, _) => {
            let mut keys = vec![("enter", "say it")];
            let is_idle = visit.phase() == Phase::Idle;
            keys.extend((is_idle && visit.stop().is_none()).then_some(("tab", "what next")));
            // In a written command, a question mark is a letter.
            keys.extend([(if visit.prompt.text().is_empty() { "?" } else { HELP }, "explain"), ("esc", "keys"), ("ctrl-c", "leave")]);
            keys
        }
        (Focus::Keys, Phase::Idle) => {
            let mut keys = vec![("enter", "write"), ("u", "undo"), ("w", "words"), ("r", "put back")];
            keys.extend((visit.stop().is_none()).then_some([("h", "home"), ("tab", "what next")]).into_iter().flatten());
            keys.extend([("s", "speed"), ("?", "explain"), ("q", "leave")]);
            keys
        }
        (Focus::Keys, Phase::Learning) => vec![("q", "leave")],
        (Focus::Keys, _) if visit.tested().is_some() => vec![("enter", "next"), ("s", "speed"), ("?", "explain"), ("q", "leave")],
        (Focus::Keys, _) => {
            let mut keys =
                vec![("g", "good"), ("b", "bad"), ("f", "finish"), ("p", if visit.paused { "go on" } else { "pause" }), ("o", "step")];
            keys.extend([("u", "undo"), ("d", "drop")]);
            keys.extend(visit.stop().map(|_| ("a", "auto")));
            keys.extend([("?", "explain"), ("q", "leave")]);
            keys
        }
    }
}

/// Draws the keys that fit, with that of the explanation, which has the others.
fn draw_keys(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let mut keys = keys(visit);
    // A space parts a key from its name, and one from the next key.
    let columns = |keys: &[(&str, &str)]| keys.iter().map(|(key, what)| key.chars().count() + what.len() + 2).sum::<usize>();
    while columns(&keys) > usize::from(area.width) + 1
        && let Some(last) = keys.iter().rposition(|(key, _)| !matches!(*key, "?" | HELP))
    {
        keys.remove(last);
    }
    let mut spans = Vec::new();
    for (key, what) in keys {
        spans.push(Span::styled(key, Style::new().add_modifier(Modifier::REVERSED)));
        spans.push(Span::styled(format!(" {what} "), palette.quiet()));
    }
    frame.render_widget(Paragraph::new(Line::from(spans)), area);
}

/// The most rows of a page.
const MOST_ROWS: usize = 2_000;

const KEYS: [(&str, &str); 17] = [
    ("g → ↑", "good: its last step was right"),
    ("b ←", "bad: its last step was wrong"),
    ("space ↓", "neither; go on"),
    ("p", "pause, and go on"),
    ("o", "one step; in a test: the next one"),
    ("y, n, 1-3", "answer its question: yes, no, or by number"),
    ("m", "note in the log that its best guess is what you mean"),
    ("f", "finish, and learn from this session"),
    ("d", "drop: finish, and do not learn from it"),
    ("u", "undo the last step; between sessions, what the last one taught"),
    ("a", "auto: a simulated trainer judges (in the tour, and after m)"),
    ("s", "speed: step by step, slow, normal, fast, at once, by confidence"),
    ("w", "words: what it calls things"),
    ("h, r", "between sessions: another home; put everything back"),
    ("tab", "between sessions: what to teach next, and why"),
    ("enter, esc", "write; stop writing. On its way it takes words too: good, no, stop, undo, no the blue one"),
    ("q, ctrl-c", "leave; all that was learned is kept"),
];

/// Draws a page from a line on.
fn draw_page(frame: &mut Frame<'_>, area: Rect, visit: &Visit, page: Page, first: u16, palette: Palette) {
    let (heading, lines) = match page {
        Page::Explanation => ("Explanation (any key: back)", explanation(visit, palette)),
        Page::Words => ("What it calls things (any key: back)", all_ideas(visit, palette)),
    };
    let block = framed(heading, palette);
    let inner = block.inner(area);
    let last = rows_of(&lines, inner.width).saturating_sub(inner.height);
    frame.render_widget(Clear, area);
    frame.render_widget(Paragraph::new(lines).block(block).wrap(Wrap { trim: false }).scroll((first.min(last), 0)), area);
}

/// The rows that lines take if words are not cut. To find them, the lines are drawn on a screen that is high enough.
fn rows_of(lines: &[Line<'_>], width: u16) -> u16 {
    let most = lines.iter().map(|line| 1 + line.width() * 2 / usize::from(width.max(1))).sum::<usize>().min(MOST_ROWS);
    let area = Rect::new(0, 0, width, u16::try_from(most).unwrap_or(u16::MAX));
    let mut drawn = Buffer::empty(area);
    Paragraph::new(lines.to_vec()).wrap(Wrap { trim: false }).render(area, &mut drawn);
    let is_blank = |row: &u16| (0..width).all(|column| drawn.cell((column, *row)).is_none_or(|cell| cell.symbol() == " "));
    area.height.saturating_sub((0..area.height).rev().take_while(is_blank).count() as u16)
}

fn explanation<'a>(visit: &Visit, palette: Palette) -> Vec<Line<'a>> {
    let mut lines = vec![Line::raw(
        "You say what to do; the robot guesses which of all tasks that are possible here you mean, goes for the likeliest, and changes its mind \
         as you say good or bad. A word of yours counts for each guess by whether the step was right for it: ▲ for it, ▼ against it. Silence \
         tells it little. When you finish, it learns what your words mean.",
    )];
    if let Some(best) = visit.classroom.pupil.meanings().first() {
        lines.push(Line::styled(format!("Now: {} Its best guess is \"{}\".", visit.told(), best.words), palette.strong()));
    }
    for (key, what) in KEYS {
        lines.push(Line::from(vec![Span::styled(format!("{key:>11}  "), Style::new().add_modifier(Modifier::BOLD)), Span::raw(what)]));
    }
    if let Some(kept) = &visit.classroom.kept {
        lines.push(Line::styled(
            format!("Kept in {}, sessions in {}.", kept.files().model.display(), kept.files().log.display()),
            palette.quiet(),
        ));
    }
    lines
}
