//! The paper's course, and which lesson is next.

mod layouts;
mod lessons;
mod next_lesson;
