//! Files are read, written and refused as the documents say.

mod environments;
mod hostile_input;
mod posteriors;
mod session_lines;
mod session_logs;
mod task_texts;
