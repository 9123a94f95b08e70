//! A session as the lines of a log. The writer of goodbot's formats reads every line again, which is large; this one does not, and a test
//! has its lines read.

use goodbot_formats::session::RecordedSession;
use serde::Serialize;

#[derive(Serialize)]
struct End {
    learn: bool,
}

/// The session as lines, each with its end.
pub fn lines(session: &RecordedSession) -> Result<String, serde_json::Error> {
    let mut lines = line("session\",\"version\":1,\"", &session.header)?;
    for done in 0..=session.steps.len() {
        for answered in session.answers_after(done) {
            lines += &line("answer\",\"", &answered.answer)?;
        }
        if let Some((_, step)) = session.steps.get(done) {
            lines += &line("step\",\"", step)?;
        }
    }
    Ok(lines + &line("end\",\"", &End { learn: session.learn })?)
}

/// A record as a line that begins with its type.
fn line(beginning: &str, record: &impl Serialize) -> Result<String, serde_json::Error> {
    let fields = serde_json::to_string(record)?;
    Ok(format!("{{\"type\":\"{beginning}{}\n", fields.trim_start_matches("{\"")))
}
