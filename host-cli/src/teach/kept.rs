//! The files of a robot: its model, and its sessions as a log.
//!
//! Both are written as soon as a session is over. The log is appended to; the model is replaced as a whole. A foreign file is never written
//! to. While a robot is taught, both files are [claimed](Claim), each for itself, because two robots may share a log, and two logs a robot.
//! [`torn`]: the end of a log whose writing was interrupted.

mod torn;

use super::site::{self, Recorded};
use etcetera::BaseStrategy;
use goodbot::snapshot::Contents;
use goodbot_console::output::are_one;
use goodbot_console::whole_file::{Claim, remove_torn};
use goodbot_console::{Failure, counted, read_model, say};
use goodbot_formats::FormatError;
use goodbot_formats::session::{RecordedSession, SessionReader};
use goodbot_formats::world::{Line, WorldFile, WorldReader};
use goodbot_lesson::Fault;
use goodbot_lesson::first_words::words_read;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The paths of a robot's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotFiles {
    /// The model.
    pub model: PathBuf,
    /// The sessions.
    pub log: PathBuf,
}

impl RobotFiles {
    /// The files of a named robot, in the platform's folder for a program's data.
    ///
    /// # Errors
    /// A [`Failure`] if the platform has no such folder, or the name cannot be a file's.
    pub fn of_robot(name: &str) -> Result<Self, Failure> {
        let plain = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_');
        if name.is_empty() || name.len() > 64 || !name.chars().all(plain) {
            return Err(Failure::Input(format!("{name:?} is no name for a robot; use letters, digits, - and _, at most 64")));
        }
        let folder = Self::folder()?;
        std::fs::create_dir_all(&folder)
            .map_err(|error| Failure::Input(format!("{} cannot be made ({error}); name another file with --model", folder.display())))?;
        Ok(Self { model: folder.join(format!("{name}.goodbot")), log: folder.join(format!("{name}.jsonl")) })
    }

    /// The folder of robots that are kept by name.
    ///
    /// # Errors
    /// A [`Failure`] if the platform has no such folder.
    pub fn folder() -> Result<PathBuf, Failure> {
        let folders = etcetera::base_strategy::choose_native_strategy()
            .map_err(|_| Failure::Input("there is no home folder to keep the robot in; name a file with --model".to_owned()))?;
        Ok(folders.data_dir().join("goodbot"))
    }

    /// A model file, with the log beside it unless another is named.
    pub fn beside(model: &Path, log: Option<&Path>) -> Self {
        Self { model: model.to_owned(), log: log.map_or_else(|| model.with_extension("jsonl"), Path::to_owned) }
    }
}

/// The contents of a robot's files when they were opened.
#[derive(Debug, Default)]
pub struct Past {
    /// The model; `None` for a robot that has learned nothing.
    pub model: Option<Vec<u8>>,
    /// The commands of the log.
    pub commands: Vec<String>,
    /// The ids of the sessions that were learned from.
    pub learned: Vec<String>,
    /// How many sessions the log has.
    pub sessions: usize,
    /// How many of them were learned from.
    pub taught: usize,
}

impl Past {
    fn add(&mut self, session: RecordedSession) {
        self.sessions += 1;
        self.taught += usize::from(session.learn);
        self.learned.extend(session.header.id.filter(|_| session.learn));
        self.commands.push(words_read(&session.header.command).to_owned());
    }
}

/// A session in the log that can be taken out again.
#[derive(Debug)]
struct Written {
    start: u64,
    text: String,
    /// The part of the text before the session.
    introduction: Option<String>,
    /// The model before the session.
    model: Option<Vec<u8>>,
}

/// A log, opened for appending.
#[derive(Debug)]
struct Log {
    path: PathBuf,
    file: File,
    claim: Claim,
}

/// A robot's files.
#[derive(Debug)]
pub struct Kept {
    files: RobotFiles,
    log: Log,
    claim: Claim,
    /// The model in the file.
    model: Option<Vec<u8>>,
    written: Vec<Written>,
    /// Sessions that are still to be written to the log, because a write failed; and the model likewise.
    unwritten: String,
    newest: Option<Vec<u8>>,
    /// Text that the log needs before its next session: the end of its last line, the line of the world.
    introduction: Option<String>,
}

/// Removes the log if it is empty.
impl Drop for Log {
    fn drop(&mut self) {
        if self.file.metadata().is_ok_and(|log| log.is_file() && log.len() == 0) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

fn cannot(path: &Path, what: &str, error: impl std::fmt::Display) -> Failure {
    Failure::Input(format!("{}: cannot be {what} ({error}); name other files with --model and --log", path.display()))
}

fn claim(path: &Path) -> Result<Claim, Failure> {
    Claim::take(path).map_err(|error| match error.kind() {
        ErrorKind::ResourceBusy => Failure::Input(format!(
            "{}: this robot is being taught or learned in another window; leave that one first, or teach another robot with --robot NAME",
            path.display()
        )),
        _ => cannot(path, "written to", error),
    })
}

fn open_to_append(path: &Path) -> Result<File, Failure> {
    OpenOptions::new().read(true).append(true).create(true).open(path).map_err(|error| cannot(path, "written to", error))
}

/// The line end that a log lacks if another program left its last line incomplete.
fn missing_line_end(mut log: &File) -> std::io::Result<&'static str> {
    let mut last = *b"\n";
    if log.seek(SeekFrom::End(0))? > 0 {
        log.seek(SeekFrom::End(-1))?;
        log.read_exact(&mut last)?;
    }
    log.rewind()?;
    Ok(if last == *b"\n" { "" } else { "\n" })
}

/// The sessions of a log, and the last world of that name in it.
fn read_log(log: impl BufRead, world: Option<&Arc<WorldFile>>) -> Result<(Past, Option<Arc<WorldFile>>), FormatError> {
    let (mut past, mut known) = (Past::default(), None);
    let Some(world) = world else {
        for session in SessionReader::new(log) {
            past.add(session?);
        }
        return Ok((past, known));
    };
    for line in WorldReader::new(log) {
        match line? {
            Line::World(named) if named.name == world.name => known = Some(named),
            Line::World(_) | Line::Command(_) => {}
            Line::Session(session) => past.add(session.session),
        }
    }
    Ok((past, known))
}

impl Log {
    fn open(path: &Path) -> Result<Self, Failure> {
        Ok(Self { claim: claim(path)?, file: open_to_append(path)?, path: path.to_owned() })
    }

    /// Reads the log. If the writing of its last session was interrupted, that session is first moved to a file beside the log.
    fn read(&self, world: Option<&Arc<WorldFile>>) -> Result<(Past, Option<Arc<WorldFile>>), Failure> {
        let name = self.path.display();
        let error = match read_log(BufReader::new(&self.file), world) {
            Ok(read) => return Ok(read),
            Err(error) => error,
        };
        let unreadable = |error| cannot(&self.path, "read", error);
        let log = if self.path.is_file() { std::fs::read(&self.path).map_err(unreadable)? } else { Vec::new() };
        let Some(begins) = torn::begins_at(&log, |text| read_log(text, world).is_ok()) else {
            let fault = Fault::from_format(&name.to_string(), error);
            return Err(Failure::Input(format!("{fault}\nthis log is not written to; mend it, or name another with --log")));
        };
        let (whole, end) = log.split_at(begins);
        let changed = |error| cannot(&self.path, "mended", error);
        let beside = torn::keep_beside(&self.path, end).map_err(changed)?;
        self.file.set_len(begins as u64).and_then(|()| self.file.sync_all()).map_err(changed)?;
        say!(
            "{name}: the program was stopped while it wrote line {} and what follows; the log ends before that now, and {} are in {}",
            whole.iter().filter(|&&byte| byte == b'\n').count() + 1,
            counted(end.len(), "cut-off byte"),
            beside.display()
        );
        read_log(whole, world).map_err(|error| Fault::from_format(&name.to_string(), error).into())
    }
}

impl Kept {
    /// Opens a robot's files, and creates the log if it is missing. `world` is the world from a file in which the robot is taught; `None`
    /// in a home.
    ///
    /// # Errors
    /// A [`Failure`] if another program teaches the robot, or if one of the files is foreign, or cannot be written to.
    pub fn open(files: RobotFiles, world: Option<&Arc<WorldFile>>) -> Result<(Self, Past), Failure> {
        let log = Log::open(&files.log)?;
        // The log exists now, so this finds two names of one file.
        if are_one(&files.model, &files.log) {
            return Err(Failure::Input(format!("{}: is both the model and the log; name two files", files.log.display())));
        }
        let claim = claim(&files.model)?;
        // Nobody else writes these files from here on.
        let torn = [&files.model, &files.log].map(|path| remove_torn(path, Duration::ZERO)).iter().sum();
        if torn > 0 {
            say!("{}: the program was stopped while it wrote; {} removed", files.model.display(), counted(torn, "unfinished file"));
        }
        let model = if files.model.exists() { Some(read_model(&files.model)?) } else { None };
        let (past, known) = log.read(world)?;
        let line_end = missing_line_end(&log.file).map_err(|error| cannot(&files.log, "read", error))?;
        let introduction = match world.filter(|world| known.as_ref() != Some(world)) {
            Some(world) => {
                let line = world.to_json_line().map_err(|error| Fault::from_format(&files.log.display().to_string(), error))?;
                Some(format!("{line_end}{line}\n"))
            }
            None => Some(line_end).filter(|end| !end.is_empty()).map(str::to_owned),
        };
        let past = Past { model: model.clone(), ..past };
        let kept = Self { files, log, claim, model, written: Vec::new(), unwritten: String::new(), newest: None, introduction };
        Ok((kept, past))
    }

    /// The paths of the files.
    pub fn files(&self) -> &RobotFiles {
        &self.files
    }

    /// The number of sessions in the model's file.
    pub fn sessions(&self) -> usize {
        self.model.as_deref().and_then(|model| Contents::read(model).ok()).map_or(0, |contents| contents.sessions.len())
    }

    /// Writes a session to the log, and the new model if it was learned from.
    ///
    /// # Errors
    /// A [`Failure`] that names the file. A failed write is tried again with the next session, and by
    /// [`write_what_is_left`](Self::write_what_is_left).
    pub fn keep(&mut self, session: &Recorded, model: Option<Vec<u8>>) -> Result<(), Failure> {
        let lines = site::lines(session).map_err(|error| cannot(&self.files.log, "written to", error))?;
        let introduction = self.introduction.take();
        let text = format!("{}{}\n", introduction.as_deref().unwrap_or_default(), lines.join("\n"));
        let was_behind = self.is_behind();
        if was_behind {
            // This write covers several sessions, so they cannot be taken back one by one.
            self.written.clear();
        }
        self.unwritten.push_str(&text);
        let has_taught = model.is_some();
        self.newest = model.or(self.newest.take());
        let before = self.model.clone();
        let end = self.write_what_is_left()?;
        if has_taught && !was_behind {
            self.written.push(Written { start: end.saturating_sub(text.len() as u64), text, introduction, model: before });
        }
        Ok(())
    }

    /// Whether a write failed and is still to be repeated.
    const fn is_behind(&self) -> bool {
        !self.unwritten.is_empty() || self.newest.is_some()
    }

    /// Repeats failed writes. Returns the length of the log.
    ///
    /// # Errors
    /// A [`Failure`] that names the file.
    pub fn write_what_is_left(&mut self) -> Result<u64, Failure> {
        let RobotFiles { model: model_path, log: log_path } = &self.files;
        let log = &mut self.log.file;
        let start = log.seek(SeekFrom::End(0)).map_err(|error| cannot(log_path, "written to", error))?;
        if !self.unwritten.is_empty() {
            let appended = log.write_all(self.unwritten.as_bytes()).and_then(|()| log.sync_data());
            appended.map_err(|error| {
                // A partial session would make the log unreadable, so it is cut off.
                let _ = log.set_len(start);
                cannot(log_path, "written to", error)
            })?;
        }
        let end = start.saturating_add(std::mem::take(&mut self.unwritten).len() as u64);
        if let Some(model) = self.newest.take() {
            let written = self.claim.write(&model);
            *if written.is_ok() { &mut self.model } else { &mut self.newest } = Some(model);
            written.map_err(|error| cannot(model_path, "written to", error))?;
        }
        Ok(end)
    }

    /// Takes the last session that was learned from, since the files were opened, out of both files. Returns the model before it:
    /// `Some(None)` if the robot had not learned anything before, and `None` if there is nothing to take back.
    ///
    /// # Errors
    /// A [`Failure`] that names the file. A file that was written before the error stays written.
    pub fn take_back(&mut self) -> Result<Option<Option<Vec<u8>>>, Failure> {
        let RobotFiles { model: model_path, log: log_path } = &self.files;
        if self.is_behind() {
            return Err(cannot(model_path, "changed", "the last session could not be written yet"));
        }
        let Some(last) = self.written.last() else { return Ok(None) };
        let mut log = std::fs::read(log_path).map_err(|error| cannot(log_path, "read", error))?;
        let start = usize::try_from(last.start).unwrap_or(usize::MAX);
        let range = start..start.saturating_add(last.text.len());
        if log.get(range.clone()) != Some(last.text.as_bytes()) {
            return Err(Failure::Input(format!("{}: another program has changed it, so nothing is taken out", log_path.display())));
        }
        log.drain(range);
        match &last.model {
            Some(model) => self.claim.write(model).map_err(|error| cannot(model_path, "written to", error))?,
            None => std::fs::remove_file(model_path).map_err(|error| cannot(model_path, "removed", error))?,
        }
        self.log.claim.write(&log).map_err(|error| cannot(log_path, "written to", error))?;
        self.log.file = open_to_append(log_path)?;
        let before = self.written.pop().and_then(|written| {
            self.introduction = written.introduction.or(self.introduction.take());
            written.model
        });
        self.model.clone_from(&before);
        Ok(Some(before))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SESSION: &str = concat!(
        r#"{"type":"session","version":1,"id":"said-1","kind":"feedback","environment":{"version":1,"objects":[{"class":"agent","name":"agent0","x":4,"y":2}]},"command":"go"}"#,
        "\n",
        r#"{"type":"step","action":"north","feedback":"reward"}"#,
        "\n",
        r#"{"type":"end","learn":true}"#,
        "\n"
    );

    fn session() -> Recorded {
        Recorded::Floor(SessionReader::new(SESSION.as_bytes()).next().unwrap().unwrap())
    }

    fn files(folder: &tempfile::TempDir) -> RobotFiles {
        RobotFiles::beside(&folder.path().join("robot.goodbot"), None)
    }

    #[test]
    fn what_is_kept_is_there_again() {
        let folder = tempfile::tempdir().unwrap();
        let (mut kept, past) = Kept::open(files(&folder), None).unwrap();
        assert_eq!((past.sessions, past.model), (0, None));
        kept.keep(&session(), Some(b"model".to_vec())).unwrap();
        drop(kept);
        let (_, past) = Kept::open(files(&folder), None).unwrap();
        assert_eq!((past.sessions, past.model.as_deref()), (1, Some(&b"model"[..])));
        assert_eq!((past.commands, past.learned), (vec!["go".to_owned()], vec!["said-1".to_owned()]));
    }

    #[test]
    fn a_session_begins_on_a_line_of_its_own_though_the_log_was_left_in_the_middle_of_one() {
        let folder = tempfile::tempdir().unwrap();
        let files = files(&folder);
        std::fs::write(&files.log, SESSION.trim_end()).unwrap();
        let (mut kept, _) = Kept::open(files.clone(), None).unwrap();
        kept.keep(&session(), Some(b"model".to_vec())).unwrap();
        assert_eq!(std::fs::read_to_string(&files.log).unwrap(), SESSION.repeat(2));
        kept.take_back().unwrap();
        assert_eq!(std::fs::read_to_string(&files.log).unwrap(), SESSION.trim_end());
    }

    /// A log as a power cut leaves it, and what the program makes of it: the log then, the cut-off bytes, and the number of sessions.
    fn mended(log: &[u8], world: Option<&Arc<WorldFile>>) -> (Vec<u8>, Option<Vec<u8>>, usize) {
        let folder = tempfile::tempdir().unwrap();
        let files = files(&folder);
        std::fs::write(&files.log, log).unwrap();
        let (kept, past) = Kept::open(files.clone(), world).unwrap_or_else(|refused| panic!("{} bytes: {refused}", log.len()));
        let left = std::fs::read(&files.log).unwrap();
        drop(kept);
        (left, std::fs::read(folder.path().join("robot.jsonl.end1")).ok(), past.sessions)
    }

    #[test]
    fn a_log_that_was_cut_off_anywhere_goes_on_after_its_last_whole_session_and_the_rest_is_kept_beside_it() {
        let first = SESSION.replace("go", "räum auf");
        let log = [first.as_str(), &SESSION.replace("said-1", "said-2")].concat();
        for cut in 0..log.len() {
            // A session whose last line lacks only the end of the line is whole.
            let end_of = |session: usize| session - usize::from(cut == session - 1);
            let whole = if cut >= end_of(log.len()) {
                log.len()
            } else if cut >= end_of(first.len()) {
                first.len()
            } else {
                0
            };
            let (left, beside, sessions) = mended(&log.as_bytes()[..cut], None);
            assert_eq!(left, log.as_bytes()[..whole.min(cut)], "cut at {cut}");
            let end = &log.as_bytes()[whole.min(cut)..cut];
            assert_eq!(beside.unwrap_or_default(), end, "cut at {cut}");
            assert_eq!(sessions, usize::from(whole > 0) + usize::from(whole == log.len()), "cut at {cut}");
        }
        println!("a log of two sessions, cut off at each of {} places: each goes on", log.len());
        // A file system that had noted the length only.
        let zeros = [first.as_bytes(), &[0; 300]].concat();
        assert_eq!(mended(&zeros, None), (first.clone().into_bytes(), Some(vec![0; 300]), 1));
        let after = [first.as_bytes(), &SESSION.as_bytes()[..40], &[0; 300]].concat();
        assert_eq!(mended(&after, None).0, first.into_bytes());
    }

    #[test]
    fn a_log_of_a_world_that_was_cut_off_goes_on_too() {
        const WORLD: &str = concat!(
            r#"{"type":"world","name":"lamps","classes":["lamp"],"attributes":{},"propositions":{"lampOn":["lamp"]},"#,
            r#""objects":[{"name":"l","class":"lamp","attributes":{}}],"task_kinds":["lampOn(?l)"]}"#,
            "\n"
        );
        const LESSON: &str = concat!(
            r#"{"type":"session","version":1,"world":"lamps","kind":"feedback","facts":[],"command":"light"}"#,
            "\n",
            r#"{"type":"end","learn":true}"#,
            "\n"
        );
        let world = Arc::new(WorldFile::parse(WORLD).unwrap());
        let log = [WORLD, LESSON, LESSON].concat();
        assert_eq!(mended(log.as_bytes(), Some(&world)), (log.clone().into_bytes(), None, 2));
        for cut in 1..log.len() - 1 {
            let (left, beside, sessions) = mended(&log.as_bytes()[..cut], Some(&world));
            assert_eq!([left.clone(), beside.unwrap_or_default()].concat(), log.as_bytes()[..cut], "cut at {cut}");
            let whole = [WORLD.len() + LESSON.len() - 1, WORLD.len() - 1].into_iter().find(|&whole| cut >= whole).unwrap_or(0);
            assert!(left.len() >= whole && sessions == usize::from(cut >= WORLD.len() + LESSON.len() - 1), "cut at {cut}");
        }
    }

    #[test]
    fn a_log_that_somebody_changed_in_the_middle_is_refused_and_stays() {
        let broken = SESSION.replace("reward", "rewrd");
        let (line, rest) = SESSION.split_once('\n').unwrap();
        for log in [
            broken.clone() + SESSION,
            SESSION.to_owned() + &broken,
            broken.replace(r#"{"type":"end","learn":true}"#, ""),
            format!("{line}\nnonsense\n"),
            format!("{SESSION}my diary"),
            format!("{rest}{{\"type\":\"se"),
            "my diary".to_owned(),
            "\0\0\0".to_owned(),
        ] {
            let folder = tempfile::tempdir().unwrap();
            let files = files(&folder);
            std::fs::write(&files.log, &log).unwrap();
            let refused = Kept::open(files.clone(), None).map(|_| ()).unwrap_err().to_string();
            assert!(refused.contains("this log is not written to"), "{log}: {refused}");
            assert_eq!(std::fs::read_to_string(&files.log).unwrap(), log);
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "{log}");
        }
    }

    #[test]
    fn the_ends_of_one_log_are_all_kept() {
        let folder = tempfile::tempdir().unwrap();
        let files = files(&folder);
        for end in 1..=3 {
            std::fs::write(&files.log, &SESSION.as_bytes()[..SESSION.len() - 10 - end]).unwrap();
            drop(Kept::open(files.clone(), None).unwrap());
            let kept = std::fs::read(folder.path().join(format!("robot.jsonl.end{end}"))).unwrap();
            assert_eq!(kept, SESSION.as_bytes()[..SESSION.len() - 10 - end]);
        }
    }

    #[test]
    fn the_last_session_that_was_learned_from_is_taken_out_and_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let (mut kept, _) = Kept::open(files(&folder), None).unwrap();
        let mut unlearned = session();
        site::session_mut(&mut unlearned).learn = false;
        kept.keep(&session(), Some(b"first".to_vec())).unwrap();
        kept.keep(&session(), Some(b"second".to_vec())).unwrap();
        kept.keep(&unlearned, None).unwrap();
        assert_eq!(kept.take_back().unwrap(), Some(Some(b"first".to_vec())));
        assert_eq!(std::fs::read_to_string(&kept.files.log).unwrap(), SESSION.to_owned() + &SESSION.replace("true", "false"));
        assert_eq!(std::fs::read(&kept.files.model).unwrap(), b"first");
        assert_eq!(kept.take_back().unwrap(), Some(None));
        assert!(!kept.files.model.exists());
        assert_eq!(kept.take_back().unwrap(), None);
    }

    #[test]
    fn what_had_no_room_on_the_disk_is_written_when_there_is_room_again() {
        let folder = tempfile::tempdir().unwrap();
        let (mut kept, _) = Kept::open(files(&folder), None).unwrap();
        kept.keep(&session(), Some(b"first".to_vec())).unwrap();
        // A folder in place of the model cannot be overwritten.
        std::fs::remove_file(&kept.files.model).unwrap();
        std::fs::create_dir_all(kept.files.model.join("full")).unwrap();
        assert!(kept.keep(&session(), Some(b"second".to_vec())).is_err());
        assert!(kept.take_back().unwrap_err().to_string().contains("could not be written yet"));
        std::fs::remove_dir_all(&kept.files.model).unwrap();
        kept.write_what_is_left().unwrap();
        assert_eq!(std::fs::read(&kept.files.model).unwrap(), b"second");
        assert_eq!(std::fs::read_to_string(&kept.files.log).unwrap(), SESSION.repeat(2));
    }

    #[test]
    fn what_a_stopped_program_left_unfinished_is_removed_at_the_next_start() {
        let folder = tempfile::tempdir().unwrap();
        let names = || std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        for name in [".robot.goodbot.Ab3dEf.part", ".robot.jsonl.x.part", ".other.goodbot.x.part", "robot.goodbot.part"] {
            std::fs::write(folder.path().join(name), b"half").unwrap();
        }
        drop(Kept::open(files(&folder), None).unwrap());
        let mut left: Vec<String> = names().collect();
        left.sort();
        assert_eq!(left, [".other.goodbot.x.part", "robot.goodbot.part"]);
    }

    #[test]
    fn a_model_and_a_log_that_are_one_file_are_refused_whatever_they_are_called() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let mut names = vec![("one", path("one")), ("one", folder.path().join(".").join("one"))];
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("one", path("link")).unwrap();
            names.push(("one", path("link")));
        }
        for (log, model) in names {
            let refused = Kept::open(RobotFiles::beside(&model, Some(&path(log))), None).unwrap_err();
            assert!(refused.to_string().contains("is both the model and the log"), "{refused}");
            assert!(!path("one").exists());
        }
    }

    #[test]
    fn a_robot_is_taught_in_one_place_at_a_time_and_no_foreign_file_is_written_to() {
        let folder = tempfile::tempdir().unwrap();
        let (kept, _) = Kept::open(files(&folder), None).unwrap();
        let taught = |files: RobotFiles| Kept::open(files, None).map(drop).unwrap_err().to_string();
        let (model, log) = (folder.path().join("robot.goodbot"), folder.path().join("robot.jsonl"));
        assert!(taught(files(&folder)).contains("robot.jsonl: this robot is being taught or learned in another window"));
        // The model is the robot, whatever its log is called; and two robots do not write one log at once.
        let other = RobotFiles::beside(&model, Some(&folder.path().join("other.jsonl")));
        assert!(taught(other).contains("robot.goodbot: this robot is being taught"));
        assert!(!folder.path().join("other.jsonl").exists());
        let other = RobotFiles::beside(&folder.path().join("other.goodbot"), Some(&log));
        assert!(taught(other).contains("robot.jsonl: this robot is being taught"));
        drop(kept);
        std::fs::write(folder.path().join("robot.jsonl"), "my diary\n").unwrap();
        assert!(Kept::open(files(&folder), None).unwrap_err().to_string().contains("this log is not written to"));
        assert_eq!(std::fs::read_to_string(folder.path().join("robot.jsonl")).unwrap(), "my diary\n");
        assert!(RobotFiles::of_robot("../up").unwrap_err().to_string().contains("is no name"));
    }
}
