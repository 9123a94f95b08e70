//! Session logs: any bytes.

use goodbot_formats::session::SessionReader;

/// Reads any bytes as a session log; sessions that can be read are written and read again.
pub fn session(input: &[u8]) {
    for result in SessionReader::new(input) {
        match result {
            Ok(session) => {
                let Ok(lines) = session.to_lines() else { continue };
                let text = lines.join("\n") + "\n";
                let again = SessionReader::new(text.as_bytes()).next().expect("what was written is there").expect("and can be read");
                assert_eq!((again.header, again.learn, again.steps.len()), (session.header, session.learn, session.steps.len()));
            }
            Err(error) => assert!(!error.to_string().chars().any(char::is_control), "{error}"),
        }
    }
}
