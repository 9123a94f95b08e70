//! The paper's course, and which lesson is next.

mod exact_trainer;
mod layouts;
mod lessons;
mod next_lesson;
