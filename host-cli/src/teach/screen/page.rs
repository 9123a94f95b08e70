//! Pages that cover the screen: the explanation, and all words.

use super::super::palette::Palette;
use super::super::visit::{Page, Visit};
use super::framed;
use super::thoughts::all_ideas;
use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Clear, Paragraph, Widget, Wrap};

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
pub fn draw(frame: &mut Frame<'_>, area: Rect, visit: &Visit, page: Page, first: u16, palette: Palette) {
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
