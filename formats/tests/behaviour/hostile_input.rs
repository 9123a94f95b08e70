//! Hostile input gets an error, and does nothing else.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{MAX_LINE_BYTES, Record, SessionReader};
use goodbot_formats::{FormatError, NOT_UTF8};

const LOG: &str = r#"{"type":"session","version":1,"id":"é","kind":"feedback","environment":{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":0,"right":8,"top":4,"color":"red"},{"class":"block","name":"block0","x":2,"y":2,"color":"yellow","shape":"chair"}]},"command":"go","intended":["blockInRoom(block0,room0)"],"actions":["north"],"prior":{"blockInRoom(block0,room0)":1e0},"strategies":[{"name":"b","mu_plus":0.7,"mu_minus":0.7,"epsilon":0.1,"prior":1}]}
{"type":"step","action":"north","feedback":"reward"}
{"type":"end","learn":true}
"#;

fn first_error(input: impl BufRead) -> FormatError {
    SessionReader::new(input).find_map(Result::err).expect("is refused")
}

/// Reads the text in every format.
fn read_as_all(bytes: &[u8]) {
    let errors: Vec<_> = SessionReader::new(bytes).filter_map(Result::err).collect();
    for error in errors {
        assert!(error.line >= 1 && !error.to_string().chars().any(char::is_control), "{error}");
    }
    let text = String::from_utf8_lossy(bytes);
    let others = [EnvironmentFile::parse(&text).err(), Record::parse(&text, 1).err(), PosteriorLine::parse(&text, 1).err()];
    for error in others.into_iter().flatten() {
        assert!(!error.to_string().chars().any(char::is_control), "{error}");
    }
}

#[test]
fn deep_nesting_is_refused_without_exhausting_the_stack() {
    for open in ["[", "{\"a\":", "{\"version\":1,\"objects\":[", "{\"type\":["] {
        read_as_all(open.repeat(1_000_000).as_bytes());
    }
    let closed = format!("{}{}", "[".repeat(1_000_000), "]".repeat(1_000_000));
    read_as_all(closed.as_bytes());
    let inside = LOG.replace("\"go\"", &closed);
    assert_eq!(first_error(inside.as_bytes()).field.as_deref(), Some("command"));
    let unknown = LOG.replace("\"command\"", &format!("\"deep\":{closed},\"command\""));
    assert_eq!(first_error(unknown.as_bytes()).field.as_deref(), Some("deep"));
}

#[test]
fn every_cut_of_a_log_is_refused_or_read() {
    for end in 0..=LOG.len() {
        read_as_all(&LOG.as_bytes()[..end]);
    }
}

#[test]
fn every_byte_replaced_is_refused_or_read() {
    for place in 0..LOG.len() {
        for byte in [0, b'"', b'\\', b'{', b'}', b',', b'9', b'-', b'\n', 0x9b, 0xff] {
            let mut bytes = LOG.as_bytes().to_vec();
            bytes[place] = byte;
            read_as_all(&bytes);
        }
    }
}

#[test]
fn every_value_replaced_by_another_kind_is_refused_or_read() {
    let lines: Vec<&str> = LOG.lines().collect();
    let others = ["null", "NaN", "1e400", "-1e-400", "[[]]", "{\"\":{}}", "\"\\ud800\"", "\"\\u009b\""];
    for (start, _) in lines[0].match_indices(':') {
        let rest = &lines[0][start + 1..];
        let mut values = serde_json::Deserializer::from_str(rest).into_iter::<serde_json::Value>();
        if !matches!(values.next(), Some(Ok(_))) {
            continue;
        }
        let after = &rest[values.byte_offset()..];
        for other in others {
            let line = format!("{}{other}{after}", &lines[0][..=start]);
            read_as_all(format!("{line}\n{}\n{}", lines[1], lines[2]).as_bytes());
        }
    }
}

#[test]
fn half_a_surrogate_pair_is_refused_in_values_and_names() {
    for text in [r#"{"type":"step","action":"\ud800"}"#, r#"{"type":"step","\ud800":1}"#] {
        let error = Record::parse(text, 1).unwrap_err();
        assert!(error.problem.contains("is not JSON"), "{error}");
    }
}

#[test]
fn what_is_not_utf_8_is_told_with_its_line_and_column() {
    let mut bytes = LOG.as_bytes().to_vec();
    let place = LOG.find("reward").unwrap();
    bytes[place] = 0xC3;
    let error = first_error(&bytes[..]);
    assert_eq!((error.line, error.problem.as_str()), (2, NOT_UTF8));
    let column = place - LOG.find('\n').unwrap();
    assert_eq!(error.column, Some(column));
    // The rest of the log is read.
    bytes.extend_from_slice(LOG.as_bytes());
    let results: Vec<_> = SessionReader::new(&bytes[..]).collect();
    assert!(results.len() == 2 && results[1].is_ok());
}

#[test]
fn an_overlong_line_is_refused_and_the_next_session_is_read() {
    let long = io::repeat(b'x').take(4 * MAX_LINE_BYTES as u64);
    let input = long.chain(Cursor::new(format!("\n{LOG}")));
    let results: Vec<_> = SessionReader::new(BufReader::new(input)).collect();
    let error = results[0].as_ref().unwrap_err();
    let limit = MAX_LINE_BYTES;
    assert!(error.line == 1 && error.problem.contains(&format!("more than {limit} bytes")), "{error}");
    assert_eq!(results[1].as_ref().unwrap().header_line, 2);
}

#[test]
fn what_has_no_lines_and_no_end_is_not_read_for_ever() {
    let mut reader = SessionReader::new(BufReader::new(io::repeat(0)));
    assert!(reader.next().unwrap().unwrap_err().problem.contains("bytes; put each record"));
    assert!(reader.next().is_none());
}

#[test]
fn lines_that_are_no_sessions_are_not_passed_over_for_ever() {
    let input = "x\n".repeat(300_000);
    let problems: Vec<String> = SessionReader::new(input.as_bytes()).map(|session| session.unwrap_err().problem).collect();
    assert_eq!(problems.len(), 2);
    assert!(problems[1].contains("no session begins in 100000 lines"));
}

#[test]
fn the_longest_line_is_read_with_either_line_end() {
    for end in ["\n", "\r\n"] {
        for (excess, fits) in [(0, true), (1, false)] {
            let blanks = " ".repeat(MAX_LINE_BYTES - LOG.lines().next().unwrap().len() + excess);
            let log = LOG.replacen('\n', &format!("{blanks}\n"), 1).replace('\n', end);
            let read = SessionReader::new(log.as_bytes()).next().unwrap();
            assert_eq!(read.is_ok(), fits);
        }
    }
}

#[test]
fn too_many_entries_are_refused() {
    let many = vec!["0"; 100_000].join(",");
    let error = EnvironmentFile::parse(&format!("{{\"version\":1,\"objects\":[{many}]}}"));
    assert!(error.unwrap_err().problem.contains("has more than 65536 entries"));
    let many: Vec<_> = (0..100_000).map(|i| format!("\"{i}\":0")).collect();
    let error = EnvironmentFile::parse(&format!("{{{}}}", many.join(",")));
    assert!(error.unwrap_err().problem.contains("has more than"));
}

#[test]
fn a_failing_disk_ends_the_reading() {
    struct Failing;
    impl Read for Failing {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("the disk is gone"))
        }
    }
    let first_line = LOG.lines().next().unwrap();
    let input = BufReader::new(Cursor::new(format!("{first_line}\n")).chain(Failing));
    let mut reader = SessionReader::new(input);
    let error = reader.next().unwrap().unwrap_err().with_file("log.jsonl");
    assert_eq!(error.to_string(), "log.jsonl:2: could not be read (the disk is gone); check the file and its disk");
    assert!(reader.next().is_none());
}
