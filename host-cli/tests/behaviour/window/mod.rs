//! A window with a program in it: a pseudo-terminal with keys and a screen.

use portable_pty::{Child, CommandBuilder, ExitStatus, MasterPty, PtySize, native_pty_system};
use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// The longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// A running program. It ends with the test, however the test ends.
struct Program(Box<dyn Child + Send + Sync>);

impl Program {
    fn ended(&mut self) -> Option<ExitStatus> {
        self.0.try_wait().expect("a program")
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        if let Ok(None) = self.0.try_wait() {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }
}

/// A window with a program in it.
pub struct Window {
    child: Program,
    master: Box<dyn MasterPty + Send>,
    keys: Box<dyn Write + Send>,
    seen: Arc<Mutex<Seen>>,
    closed: Arc<AtomicBool>,
}

fn cells(number: u16) -> NonZeroU16 {
    NonZeroU16::new(number).expect("a window has cells")
}

struct Seen {
    screen: vt100::Parser,
    bytes: Vec<u8>,
}

#[allow(dead_code, reason = "each test file uses what it needs")]
impl Window {
    /// Opens a window of this size, and starts the program in it.
    pub fn open(program: CommandBuilder, columns: u16, rows: u16) -> Self {
        let size = PtySize { rows, cols: columns, pixel_width: 0, pixel_height: 0 };
        let pty = native_pty_system().openpty(size).expect("a pseudo-terminal");
        let child = Program(pty.slave.spawn_command(program).expect("the program starts"));
        let keys = pty.master.take_writer().expect("a keyboard");
        let mut output = pty.master.try_clone_reader().expect("a screen");
        let seen = Arc::new(Mutex::new(Seen { screen: vt100::Parser::new(cells(rows), cells(columns), 0), bytes: Vec::new() }));
        let screen = Arc::clone(&seen);
        let closed = Arc::new(AtomicBool::new(false));
        let nobody_looks = Arc::clone(&closed);
        std::thread::spawn(move || {
            let mut buffer = [0; 4_096];
            while let Ok(length @ 1..) = output.read(&mut buffer) {
                let mut screen = screen.lock().expect("a screen");
                screen.screen.process(&buffer[..length]);
                screen.bytes.extend_from_slice(&buffer[..length]);
                if nobody_looks.load(Ordering::Relaxed) {
                    break;
                }
            }
        });
        Self { child, master: pty.master, keys, seen, closed }
    }

    /// Presses keys.
    pub fn press(&mut self, keys: &str) {
        self.keys.write_all(keys.as_bytes()).and_then(|()| self.keys.flush()).expect("the keyboard works");
    }

    /// The screen's text.
    pub fn text(&self) -> String {
        self.seen.lock().expect("a screen").screen.screen().contents()
    }

    /// Everything that was ever written to the screen.
    pub fn bytes(&self) -> Vec<u8> {
        self.seen.lock().expect("a screen").bytes.clone()
    }

    /// Waits until a condition holds.
    pub fn wait(&self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let begun = Instant::now();
        while !is_so(self) {
            assert!(begun.elapsed() < PATIENCE, "waited for {what}; the screen is\n{}", self.text());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits until a text is on the screen.
    pub fn see(&self, text: &str) {
        self.wait(text, |window| window.text().contains(text));
    }

    /// Makes the window larger or smaller.
    pub fn resize(&self, columns: u16, rows: u16) {
        self.seen.lock().expect("a screen").screen.screen_mut().set_size(cells(rows), cells(columns));
        self.master.resize(PtySize { rows, cols: columns, pixel_width: 0, pixel_height: 0 }).expect("the window changes");
    }

    /// Whether the terminal is as a shell left it: the shell's screen, a cursor, and keys that are echoed line by line.
    pub fn is_as_found(&self) -> bool {
        let termios = format!("{:?}", self.master.get_termios().expect("a terminal").local_flags);
        let seen = self.seen.lock().expect("a screen");
        let screen = seen.screen.screen();
        let flags = ["ECHO", "ICANON", "ISIG"].iter().all(|flag| termios.contains(flag));
        flags && !screen.alternate_screen() && !screen.hide_cursor() && !screen.bracketed_paste()
    }

    /// Whether the program has taken the terminal over.
    pub fn is_taken_over(&self) -> bool {
        self.seen.lock().expect("a screen").screen.screen().alternate_screen()
    }

    /// The program's process id.
    pub fn number(&self) -> u32 {
        self.child.0.process_id().expect("a program")
    }

    /// Sends a signal to the program, by the signal's name.
    pub fn signal(&self, name: &str) {
        let sent = std::process::Command::new("kill").args([format!("-{name}"), self.number().to_string()]).status();
        assert!(sent.expect("kill runs").success());
    }

    /// Waits for the program's end.
    pub fn end(&mut self) -> ExitStatus {
        let begun = Instant::now();
        loop {
            if let Some(status) = self.child.ended() {
                return status;
            }
            assert!(begun.elapsed() < PATIENCE, "the program does not end; the screen is\n{}", self.text());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Closes the window while the program runs, and waits for the program's end.
    pub fn close(self) {
        let Self { mut child, master, keys, closed, .. } = self;
        closed.store(true, Ordering::Relaxed);
        // The program draws once more when the window closes. If a terminal does not answer, the program assumes this size: so nothing
        // changes then, and nothing is drawn.
        master.resize(PtySize { rows: 24, cols: 80, pixel_width: 0, pixel_height: 0 }).expect("the window changes");
        drop((master, keys));
        let begun = Instant::now();
        while child.ended().is_none() {
            assert!(begun.elapsed() < PATIENCE, "the program goes on without its window");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}
