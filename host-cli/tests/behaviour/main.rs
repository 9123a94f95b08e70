//! The program `goodbot`, run as its users run it.

mod program;
#[cfg(unix)]
mod window;

mod ask;
mod check;
mod conversation;
#[cfg(unix)]
mod cookbook;
mod evaluate;
mod examples;
mod first_hour;
mod flat;
#[cfg(unix)]
mod fuzz_smoke;
mod help;
#[cfg(unix)]
mod hostile_texts;
#[cfg(unix)]
mod hostile_worlds;
mod kept_kinds;
mod kills;
mod language;
mod long_commands;
mod merge;
mod microbit;
mod models_apart;
mod moving_picture;
mod nothing_lost;
mod one_door;
mod one_lesson;
mod paper;
mod parameters;
mod replay;
mod robot;
mod size;
#[cfg(unix)]
mod snippets;
mod starter;
mod study;
mod table;
mod talk;
mod taught_worlds;
mod teach;
#[cfg(unix)]
mod teach_screen;
mod trainers_and_questions;
mod two_teachers;
mod what_people_say;
mod worlds;
