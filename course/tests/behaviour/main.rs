//! The paper's course, and the choice of the next lesson.

mod any_tongue;
mod exact_trainer;
mod layouts;
mod lessons;
mod next_lesson;
