//! The paper's course, and which lesson is next.

mod any_tongue;
mod exact_trainer;
mod layouts;
mod lessons;
mod next_lesson;
