//! The pictures of the screen in docs/teach.md, as SVG. `GOODBOT_PICTURES=1 cargo test -p goodbot-cli pictures_of_the_screen` draws them anew.

use super::*;
use ratatui::buffer::Cell;
use std::fmt::Write;

/// A lesson that a simulated trainer has judged for three steps: the tour's fifth, or one with this command and meaning.
fn lesson(pupil: Pupil, own: Option<(&str, &str)>) -> Visit {
    let tour = own.is_none().then(|| Tour::new(None, std::iter::empty()));
    let mut visit = Visit::new(Classroom::new(pupil, None, tour).unwrap(), Pace::Normal, 1);
    let mut now = Duration::ZERO;
    loop {
        let is_shown = visit.stop().is_none_or(|stop| stop.number == 5);
        match visit.phase() {
            Phase::Idle => {
                if let Some((command, _)) = own {
                    visit.prompt.set(command);
                }
                visit.take(Intent::Say, now);
                if let Some((_, meant)) = own {
                    visit.classroom.mean(Some(meant)).unwrap();
                }
                visit.take(Intent::Auto, now);
            }
            Phase::Waiting(_) if is_shown && visit.done().len() >= 3 => return visit,
            _ => {}
        }
        now += Duration::from_millis(100);
        visit.tick(now);
    }
}

#[test]
fn the_pictures_of_the_screen_in_the_documentation_are_those_of_today() {
    const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs");
    let world = goodbot_formats::world::WorldFile::parse(include_str!("../../../../../docs/examples/worlds/vacuum.json")).unwrap();
    let settings = [
        ("teach", Setting::Floor(first_home().unwrap()), None),
        ("vacuum", Setting::Other(std::sync::Arc::new(world)), Some(("clean the kitchen", "roomClean(room1)"))),
    ];
    for (name, setting, own) in settings {
        let drawn = svg(&lesson(pupil(&setting), own), 80, 24);
        let file = format!("{DOCS}/{name}.svg");
        if std::env::var_os("GOODBOT_PICTURES").is_some() {
            std::fs::write(&file, &drawn).unwrap();
        }
        assert!(std::fs::read_to_string(&file).unwrap() == drawn, "draw {file} anew");
    }
}

/// The width of a column and the height of a row, in units of the picture.
const CELL: (usize, usize) = (9, 18);
const MARGIN: usize = 12;
const PAPER: &str = "#16161c";
const INK: &str = "#dcdce4";

/// The screen of a visit at this size, as SVG.
fn svg(visit: &Visit, columns: u16, rows: u16) -> String {
    let Ok(mut terminal) = Terminal::new(TestBackend::new(columns, rows));
    let Ok(_) = terminal.draw(|frame| super::draw(frame, visit, Palette::Many));
    of_buffer(terminal.backend().buffer())
}

fn of_buffer(buffer: &Buffer) -> String {
    let (columns, rows) = (usize::from(buffer.area.width), usize::from(buffer.area.height));
    let (width, height) = (columns * CELL.0 + 2 * MARGIN, rows * CELL.1 + 2 * MARGIN);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" \
         font-size=\"15\">\n<rect width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"{PAPER}\"/>\n"
    );
    for row in 0..rows {
        let cells = buffer.content.iter().skip(row * columns).take(columns);
        let mut runs: Vec<(usize, Look, String)> = Vec::new();
        for (column, cell) in cells.enumerate() {
            let look = Look::of(cell);
            match runs.last_mut() {
                Some((_, last, text)) if *last == look => text.push_str(cell.symbol()),
                _ => runs.push((column, look, cell.symbol().to_owned())),
            }
        }
        runs.iter().for_each(|(column, look, text)| draw(&mut svg, *column, row, look, text));
    }
    svg.push_str("</svg>\n");
    svg
}

#[derive(PartialEq)]
struct Look {
    ink: String,
    paper: Option<String>,
    bold: bool,
    line: bool,
}

impl Look {
    fn of(cell: &Cell) -> Self {
        let (mut ink, mut paper) = (hex(cell.fg), hex(cell.bg));
        if cell.modifier.contains(Modifier::REVERSED) {
            (ink, paper) = (Some(paper.unwrap_or_else(|| PAPER.to_owned())), Some(ink.unwrap_or_else(|| INK.to_owned())));
        }
        let (bold, line) = (cell.modifier.contains(Modifier::BOLD), cell.modifier.contains(Modifier::UNDERLINED));
        Self { ink: ink.unwrap_or_else(|| INK.to_owned()), paper, bold, line }
    }
}

fn draw(svg: &mut String, column: usize, row: usize, look: &Look, text: &str) {
    let (x, y) = (MARGIN + column * CELL.0, MARGIN + row * CELL.1);
    let length = text.chars().count();
    if let Some(paper) = &look.paper {
        let _ = writeln!(svg, "<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" fill=\"{paper}\"/>", length * CELL.0, CELL.1);
    }
    let mut word = String::new();
    for (at, letter) in text.chars().chain([' ']).enumerate() {
        let left = x + at * CELL.0;
        // Blocks are drawn as areas and lines as lines, because letters would leave gaps.
        let eighths = ['▏', '▎', '▍', '▌', '▋', '▊', '▉', '█'].iter().position(|block| *block == letter);
        if let Some(eighths) = eighths {
            let width = (CELL.0 * (eighths + 1)) as f32 / 8.0 + 0.3;
            let _ = writeln!(svg, "<rect x=\"{left}\" y=\"{y}\" width=\"{width}\" height=\"{}.3\" fill=\"{}\"/>", CELL.1, look.ink);
        }
        if letter == '─' {
            let _ =
                writeln!(svg, "<rect x=\"{left}\" y=\"{}\" width=\"{}.3\" height=\"1\" fill=\"{}\"/>", y + CELL.1 / 2, CELL.0, look.ink);
        }
        if letter != ' ' && letter != '─' && eighths.is_none() {
            word.push(letter);
            continue;
        }
        // Each word has its own position, because some viewers drop blanks.
        let length = word.chars().count();
        if length > 0 {
            let _ = writeln!(
                svg,
                "<text x=\"{}\" y=\"{}\" textLength=\"{}\" fill=\"{}\"{}{}>{}</text>",
                left - length * CELL.0,
                y + 14,
                length * CELL.0,
                look.ink,
                if look.bold { " font-weight=\"bold\"" } else { "" },
                if look.line { " text-decoration=\"underline\"" } else { "" },
                word.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;"),
            );
            word.clear();
        }
    }
}

/// A colour of the palette; `None` for the terminal's own.
fn hex(color: Color) -> Option<String> {
    let Color::Indexed(index) = color else { return None };
    let [red, green, blue] = match index {
        16..=231 => {
            let level = |part: u8| if part == 0 { 0 } else { 55 + part * 40 };
            let cube = index - 16;
            [level(cube / 36), level(cube / 6 % 6), level(cube % 6)]
        }
        232.. => [8 + (index - 232) * 10; 3],
        _ => return None,
    };
    Some(format!("#{red:02x}{green:02x}{blue:02x}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_the_256() {
        assert_eq!([16, 231, 203, 244].map(|index| hex(Color::Indexed(index)).unwrap()), ["#000000", "#ffffff", "#ff5f5f", "#808080"]);
        assert_eq!(hex(Color::Reset), None);
    }
}
