//! Draws the cost of a plan against the number of states, of tasks, of blocks and of rooms: `plot FILE.svg`.

use std::process::ExitCode;

use goodbot::oomdp::Domain;
use goodbot_benches::homes::{Scene, Tasks, named, size};
use goodbot_benches::timing::{ROUNDS, median, time};
use plotters::prelude::*;

/// Points: x, y, and a label.
type Points = Vec<(f64, f64, String)>;
type Failure = Box<dyn std::error::Error>;

/// The cost of the last point, as text.
fn cost(points: &Points) -> String {
    points.last().map_or_else(String::new, |(_, milliseconds, _)| format!("{milliseconds:.3} ms"))
}

fn main() -> ExitCode {
    let Some(file) = std::env::args().nth(1) else {
        eprintln!("error: name the SVG file to draw");
        return ExitCode::from(2);
    };
    match draw(&file) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {file} could not be drawn: {error}");
            ExitCode::FAILURE
        }
    }
}

fn milliseconds<R>(mut work: impl FnMut() -> R) -> f64 {
    median((0..ROUNDS).map(|_| time(&mut work)).collect()).as_secs_f64() * 1e3
}

/// The cost of a search and of a sweep in each scene, which comes with its place on the axis, its label and what to print of it.
fn searches_and_sweeps(scenes: impl Iterator<Item = (Scene, f64, String, String)>) -> (Points, Points) {
    let (mut searches, mut sweeps) = (Vec::new(), Vec::new());
    for (mut scene, across, label, name) in scenes {
        searches.push((across, milliseconds(|| scene.plan().expansions()), label));
        sweeps.push((across, milliseconds(|| scene.sweep()), String::new()));
        eprintln!("{name}: search {}, sweep {}", cost(&searches), cost(&sweeps));
    }
    (searches, sweeps)
}

/// The cost of a search and of a sweep, by the number of states.
fn by_states() -> (Points, Points) {
    searches_and_sweeps([(3, 1), (6, 1), (12, 1), (3, 2), (6, 2), (3, 3)].into_iter().map(|(rooms, blocks)| {
        let scene = Scene::roomy(size(rooms, blocks), Tasks::Paper);
        let (states, home) = (scene.home.state_count() as f64, named(rooms, blocks));
        (scene, states, home.clone(), format!("{home}, {states} states"))
    }))
}

/// The same for one home, by the number of tasks.
fn by_tasks() -> (Points, Points) {
    searches_and_sweeps([1, 2, 4, 8, 16, 32, 64, 128, 256].into_iter().map(|count| {
        let scene = Scene::roomy(size(12, 1), Tasks::Count(count));
        (scene, count as f64, String::new(), format!("{count} tasks"))
    }))
}

/// The cost of plans in homes of these rooms and blocks, by one of the two numbers: with all tasks equally likely, and with ten likely ones.
fn by_size(homes: &[(i32, i32)], axis: fn(&(i32, i32)) -> i32) -> (Points, Points) {
    let (mut alike, mut likely) = (Vec::new(), Vec::new());
    for home @ &(rooms, blocks) in homes {
        let mut scene = Scene::bounded(size(rooms, blocks));
        for (points, likely) in [(&mut alike, scene.planner.all()), (&mut likely, scene.ten())] {
            let time = milliseconds(|| scene.plan_expecting(likely).expansions());
            points.push((f64::from(axis(home)), time, String::new()));
        }
        let tasks = scene.tasks.len();
        eprintln!("{rooms} rooms, {blocks} blocks, {tasks} tasks: {}; with ten likely tasks {}", cost(&alike), cost(&likely));
    }
    (alike, likely)
}

const ALIKE_AND_LIKELY: [&str; 2] = ["all tasks likely", "ten tasks likely"];
const SEARCH_AND_SWEEP: [&str; 2] = ["one search, all tasks", "one sweep, all tasks and states"];

fn draw(file: &str) -> Result<(), Failure> {
    let area = SVGBackend::new(file, (2_000, 420)).into_drawing_area();
    area.fill(&WHITE)?;
    let (left, rest) = area.split_horizontally(500);
    let (middle, rest) = rest.split_horizontally(500);
    let (right, last) = rest.split_horizontally(500);
    chart(&left, "cost against joint states, one home a point", "states", by_states(), SEARCH_AND_SWEEP, false)?;
    chart(&middle, "cost against tasks: 12 rooms, 1 block", "tasks", by_tasks(), SEARCH_AND_SWEEP, true)?;
    let blocks = by_size(&[1, 2, 4, 6, 8, 10, 12, 16, 20].map(|blocks| (10, blocks)), |home| home.1);
    chart(&right, "cost against blocks: 10 rooms", "blocks", blocks, ALIKE_AND_LIKELY, true)?;
    let rooms = by_size(&[2, 3, 4, 6, 8, 10, 12].map(|rooms| (rooms, 8)), |home| home.0);
    chart(&last, "cost against rooms: 8 blocks", "rooms", rooms, ALIKE_AND_LIKELY, true)?;
    area.present()?;
    Ok(())
}

fn chart(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    caption: &str,
    across: &str,
    lines: (Points, Points),
    names: [&str; 2],
    joined: bool,
) -> Result<(), Failure> {
    let all = || lines.0.iter().chain(&lines.1);
    let range = |pick: fn(&(f64, f64, String)) -> f64| {
        let values = || all().map(pick);
        values().fold(f64::MAX, f64::min) * 0.5..values().fold(f64::MIN, f64::max) * 4.0
    };
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(60)
        .build_cartesian_2d(range(|point| point.0).log_scale(), range(|point| point.1).log_scale())?;
    let plain = |value: &f64| if *value >= 1e6 { format!("{} million", value / 1e6) } else { format!("{value}") };
    chart.configure_mesh().x_desc(across).y_desc("milliseconds").x_label_formatter(&plain).y_label_formatter(&plain).draw()?;
    for (points, colour, name) in [(&lines.0, &BLUE, names[0]), (&lines.1, &RED, names[1])] {
        if joined {
            chart.draw_series(LineSeries::new(points.iter().map(|&(x, y, _)| (x, y)), colour))?;
        }
        let beside = |(x, y, home): &(f64, f64, String)| EmptyElement::at((*x, *y)) + Text::new(home.clone(), (-40, 8), ("sans-serif", 11));
        chart.draw_series(points.iter().map(beside))?;
        chart
            .draw_series(points.iter().map(|&(x, y, _)| Circle::new((x, y), 3, colour.filled())))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour));
    }
    chart.configure_series_labels().position(SeriesLabelPosition::UpperLeft).background_style(WHITE).border_style(BLACK).draw()?;
    Ok(())
}
