//! The robot's beliefs and words: the tasks as bars, the support of each word, and the words for each machine token.

use super::super::palette::Palette;
use super::super::pupil::{Idea, Meaning};
use super::super::visit::Visit;
use super::framed;
use crate::words::percent;
use goodbot::feedback::Feedback;
use goodbot::planning::Judgement;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

/// The tasks in the table of words, the likeliest first. They have letters, since the choices of a question have numbers.
const TABLED: [char; 3] = ['A', 'B', 'C'];
/// The most steps with a mark beside a task.
const MARKS: usize = 8;
/// A word supports a task if the task's share is this many times an even share.
const SPEAKS: f32 = 1.25;
/// A word belongs to a machine token if its probability there exceeds its mean over all tokens by more than this.
const STANDS_OUT: f32 = 0.05;
/// The least columns of a bar.
const LEAST_BAR: usize = 5;

/// The rows of the table of words.
pub fn wanted(visit: &Visit) -> u16 {
    let tasks = visit.classroom.pupil.meanings().len().min(TABLED.len());
    u16::try_from(tasks.max(2)).unwrap_or(2) + 2
}

/// Draws the probability of each task.
pub fn draw_beliefs(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let block = framed("What it thinks you mean", palette);
    let inner = block.inner(area);
    frame.render_widget(block, area);
    let meanings = visit.classroom.pupil.meanings();
    if meanings.is_empty() {
        frame.render_widget(Paragraph::new(introduction(visit)).style(palette.quiet()).wrap(ratatui::widgets::Wrap { trim: true }), inner);
        return;
    }
    let (width, height) = (usize::from(inner.width), usize::from(inner.height));
    let shown = if meanings.len() > height { height.saturating_sub(1) } else { meanings.len() };
    let mut lines: Vec<Line<'_>> = Vec::new();
    let longest = meanings.iter().take(shown).map(|meaning| meaning.words.chars().count()).max().unwrap_or(0);
    let words = longest.min(width.saturating_sub(9 + LEAST_BAR));
    let steps: Vec<_> = visit.done().collect();
    let marks = steps.len().min(MARKS);
    let rest = width.saturating_sub(words + 9);
    let marks = if rest > LEAST_BAR + marks { marks } else { 0 };
    let bar_width = rest.saturating_sub(if marks > 0 { marks + 1 } else { 0 }).min(24);
    for (rank, meaning) in meanings.iter().take(shown).enumerate() {
        lines.push(belief(rank, meaning, [words, bar_width, marks], &steps, palette));
    }
    if shown < meanings.len() {
        let left: f32 = meanings.iter().skip(shown).map(|meaning| meaning.probability).sum();
        lines.push(Line::styled(format!("and {} more, together {}", meanings.len() - shown, percent(left)), palette.quiet()));
    }
    frame.render_widget(Paragraph::new(lines), inner);
}

fn belief<'a>(
    rank: usize,
    meaning: &Meaning,
    [words, bar_width, marks]: [usize; 3],
    steps: &[(Feedback, &[Judgement])],
    palette: Palette,
) -> Line<'a> {
    let best = if rank == 0 { Style::new().add_modifier(Modifier::BOLD) } else { Style::new() };
    let letter = TABLED.get(rank).unwrap_or(&' ');
    let mut spans = vec![
        Span::styled(format!("{letter} {:<words$} {:>5} ", cut(&meaning.words, words), percent(meaning.probability)), best),
        Span::styled(
            format!("{:<bar_width$}", bar(meaning.probability, bar_width)),
            if rank == 0 { palette.strong() } else { palette.quiet() },
        ),
    ];
    if marks > 0 {
        spans.push(Span::raw(" "));
        spans.extend(steps.iter().rev().take(marks).rev().map(|step| mark(*step, meaning.position, palette)));
    }
    Line::from(spans)
}

/// The mark of a step beside a task: support, counter-evidence or neither.
fn mark<'a>((feedback, judgements): (Feedback, &[Judgement]), task: usize, palette: Palette) -> Span<'a> {
    match (feedback, judgements.get(task)) {
        (Feedback::Reward, Some(Judgement::Correct)) | (Feedback::Punish, Some(Judgement::Incorrect)) => Span::styled("▲", palette.good()),
        (Feedback::Reward, Some(Judgement::Incorrect)) | (Feedback::Punish, Some(Judgement::Correct)) => Span::styled("▼", palette.bad()),
        _ => Span::styled("·", palette.quiet()),
    }
}

/// A bar, with a resolution of an eighth of a column.
fn bar(share: f32, width: usize) -> String {
    let eighths = (share.clamp(0.0, 1.0) * width as f32 * 8.0).round() as usize;
    let part = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"].get(eighths % 8).copied().unwrap_or("");
    "█".repeat(eighths / 8) + part
}

fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width { text.to_owned() } else { text.chars().take(width.saturating_sub(1)).chain(['…']).collect() }
}

fn introduction(visit: &Visit) -> &'static str {
    if visit.classroom.pupil.lessons_learned() == 0 {
        "Tell it what to do, in your own words. It knows none of them yet: it takes a guess and goes. Say good when it goes the right way, and \
         bad when it does not. When it is there, finish: then it learns what your words mean.\n\nIts guesses appear here, the likeliest first."
    } else {
        "Tell it what to do, in your own words. Its guesses appear here, the likeliest first."
    }
}

/// Draws the support of each word for the likeliest tasks; between sessions, the words for each machine token.
pub fn draw_words(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let meanings = visit.classroom.pupil.meanings();
    if meanings.is_empty() {
        draw_ideas(frame, area, visit, palette);
        return;
    }
    let untrained = visit.support.iter().all(|word| !word.known);
    let block = framed("Which word spoke for what: each word shares 100 points among the guesses", palette);
    let inner = block.inner(area);
    frame.render_widget(block, area);
    if untrained {
        frame.render_widget(
            Paragraph::new("It has learned none of these words yet, so no word speaks for any guess.").style(palette.quiet()),
            inner,
        );
        return;
    }
    let width = usize::from(inner.width);
    let (mut used, mut head) = (2, vec![Span::raw("  ")]);
    let mut rows: Vec<Vec<Span<'_>>> = meanings.iter().zip(TABLED).map(|(_, letter)| vec![Span::raw(format!("{letter} "))]).collect();
    for word in &visit.support {
        let column = word.word.chars().count().clamp(3, 12) + 2;
        used += column;
        if used > width {
            break;
        }
        head.push(Span::styled(format!("{:>column$}", cut(&word.word, 12)), if word.known { Style::new() } else { palette.quiet() }));
        let even = 1.0 / word.shares.len().max(1) as f32;
        for (row, meaning) in rows.iter_mut().zip(&meanings) {
            let share = word.shares.get(meaning.position).copied().unwrap_or(0.0);
            let speaks = word.known && share >= even * SPEAKS;
            let text = if word.known { format!("{}{:.0}", if speaks { "*" } else { "" }, share * 100.0) } else { "new".to_owned() };
            row.push(Span::styled(format!("{text:>column$}"), if speaks { palette.strong() } else { palette.quiet() }));
        }
    }
    let lines: Vec<Line<'_>> = std::iter::once(head).chain(rows).map(Line::from).collect();
    frame.render_widget(Paragraph::new(lines), inner);
}

/// The word with the largest excess over its mean for all machine tokens, with its probability; `None` if no excess is large enough.
fn own_word<'a>(idea: &'a Idea, all: &[Idea]) -> Option<(&'a Idea, &'a str, f32)> {
    let elsewhere = |word: &str| {
        let shares = all.iter().flat_map(|idea| &idea.called).filter(|(known, _)| known == word).map(|(_, share)| share);
        shares.sum::<f32>() / all.len().max(1) as f32
    };
    let (word, share, more) =
        idea.called.iter().map(|(word, share)| (word, *share, share - elsewhere(word))).max_by(|(.., a), (.., b)| a.total_cmp(b))?;
    (more > STANDS_OUT).then_some((idea, word, share))
}

fn draw_ideas(frame: &mut Frame<'_>, area: Rect, visit: &Visit, palette: Palette) {
    let block = framed("What it calls things (w: all of it)", palette);
    let inner = block.inner(area);
    frame.render_widget(block, area);
    let ideas = visit.classroom.pupil.ideas();
    let entry =
        |(idea, word, share): (&Idea, &str, f32)| format!("{} \"{}\" {}", idea.words, visit.classroom.words.of(word), percent(share));
    let entries: Vec<String> = ideas.iter().filter_map(|idea| own_word(idea, &ideas)).map(entry).collect();
    if entries.is_empty() {
        let nothing = if ideas.is_empty() {
            "Nothing yet: it has learned no word."
        } else {
            "It cannot tell its words apart yet. Teach it another command."
        };
        frame.render_widget(Paragraph::new(nothing).style(palette.quiet()), inner);
        return;
    }
    let column = entries.iter().map(|entry| entry.chars().count()).max().unwrap_or(0) + 2;
    let columns = (usize::from(inner.width) / column).max(1);
    let lines = entries.chunks(columns).map(|row| Line::raw(row.iter().map(|entry| format!("{entry:<column$}")).collect::<String>()));
    frame.render_widget(Paragraph::new(lines.collect::<Vec<_>>()), inner);
}

/// The words for each machine token, one token on a line.
pub fn all_ideas<'a>(visit: &Visit, palette: Palette) -> Vec<Line<'a>> {
    let ideas = visit.classroom.pupil.ideas();
    if ideas.is_empty() {
        return vec![Line::raw("It has learned no word yet. Teach it something, and finish.")];
    }
    let width = ideas.iter().map(|idea| idea.words.chars().count()).max().unwrap_or(0) + 2;
    let called = |idea: &Idea| {
        let words = idea.called.iter().take(4).map(|(word, share)| format!("{} {}", visit.classroom.words.of(word), percent(*share)));
        words.collect::<Vec<_>>().join("   ")
    };
    let line = |idea: &Idea| Line::from(vec![Span::styled(format!("{:<width$}", idea.words), palette.strong()), Span::raw(called(idea))]);
    ideas.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_idea_is_called_what_others_are_not() {
        let idea = |token: &str, called: &[(&str, f32)]| Idea {
            token: token.to_owned(),
            words: token.to_owned(),
            called: called.iter().map(|(word, share)| ((*word).to_owned(), *share)).collect(),
        };
        let all = [idea("roomIsRed", &[("the", 0.6), ("red", 0.4)]), idea("roomIsBlue", &[("the", 0.6), ("red", 0.0)])];
        assert_eq!(own_word(&all[0], &all).map(|(_, word, _)| word), Some("red"));
        assert_eq!(own_word(&all[1], &all), None);
    }

    #[test]
    fn a_bar_is_as_long_as_its_share() {
        assert_eq!([bar(0.0, 8), bar(0.5, 8), bar(1.0, 4), bar(0.05, 10)], ["", "████", "████", "▌"]);
    }

    #[test]
    fn what_is_too_long_is_cut_with_dots() {
        assert_eq!([cut("go to the red room", 8), cut("go", 8)], ["go to t…", "go"]);
    }
}
