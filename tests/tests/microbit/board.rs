//! A micro:bit in the emulator: its serial line, its pins, its flash.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// No answer takes this long.
const LIMIT: Duration = Duration::from_secs(120);

/// The flash address of the slots for the robot's model.
pub const SLOTS: u64 = 0x3_E000;
pub const SLOTS_BYTES: usize = 0x2000;

/// The pins of the buttons.
pub const A: u32 = 17;
pub const B: u32 = 26;

/// The files to run, and the emulator.
#[derive(Clone, Debug)]
pub struct Setup {
    pub emulator: PathBuf,
    pub hex: PathBuf,
    /// The command line, which writes `.hex` files.
    pub goodbot: PathBuf,
    /// The robot among embassy's tasks.
    pub embassy: PathBuf,
}

/// A board that is switched on; it is switched off when dropped.
pub struct Board {
    emulator: Child,
    serial: BufReader<UnixStream>,
    pins: BufReader<UnixStream>,
    folder: PathBuf,
}

impl Board {
    /// Switches on a board whose flash holds the program and, in the slots, these bytes.
    pub fn on(setup: &Setup, slots: Option<&[u8]>) -> Self {
        Self::with_file(setup, &setup.hex, slots)
    }

    /// Switches on a board onto which this file was dragged.
    pub fn with_file(setup: &Setup, hex: &Path, slots: Option<&[u8]>) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("goodbot-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        // It waits for the serial line to be connected, so that no output is lost.
        let socket = |name: &str, wait: &str| format!("unix:{},server=on,wait={wait}", folder.join(name).display());
        let mut emulator = Command::new(&setup.emulator);
        emulator.args(["-M", "microbit", "-display", "none", "-monitor", "none"]);
        emulator.arg("-device").arg(format!("loader,file={}", hex.display()));
        if let Some(slots) = slots {
            let file = folder.join("slots");
            std::fs::write(&file, slots).unwrap();
            emulator.arg("-device").arg(format!("loader,file={},addr={SLOTS:#x},force-raw=on", file.display()));
        }
        emulator.args(["-serial", &socket("serial", "on"), "-qtest", &socket("pins", "off"), "-qtest-log", "/dev/null"]);
        let emulator = emulator.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let (serial, pins) = (connect(&folder, "serial"), connect(&folder, "pins"));
        let mut board = Self { emulator, serial, pins, folder };
        assert!(board.line().starts_with("goodbot on the micro:bit"));
        board
    }

    /// The next line from the board.
    pub fn line(&mut self) -> String {
        let mut line = String::new();
        self.serial.read_line(&mut line).unwrap_or_else(|error| panic!("the board says nothing more: {error}"));
        line.trim_end().to_owned()
    }

    /// The lines up to the one with this beginning.
    pub fn lines_to(&mut self, beginning: &str) -> Vec<String> {
        let mut lines = Vec::new();
        loop {
            lines.push(self.line());
            if lines.last().unwrap().starts_with(beginning) {
                return lines;
            }
        }
    }

    /// Sends a line, without waiting for the answer.
    pub fn say(&mut self, line: &str) {
        self.serial.get_mut().write_all(format!("{line}\n").as_bytes()).unwrap();
    }

    /// Sends a line. Returns the answer's lines before `ok`, or the error.
    pub fn ask(&mut self, line: &str) -> Result<Vec<String>, String> {
        self.say(line);
        let mut lines = Vec::new();
        loop {
            let said = self.line();
            match said.strip_prefix("error: ") {
                Some(problem) => return Err(problem.to_owned()),
                None if said == "ok" => return Ok(lines),
                None => lines.push(said),
            }
        }
    }

    /// The same, without an error.
    pub fn must(&mut self, line: &str) -> Vec<String> {
        self.ask(line).unwrap_or_else(|problem| panic!("`{line}`: {problem}"))
    }

    fn pins(&mut self, request: &str) -> String {
        self.pins.get_mut().write_all(format!("{request}\n").as_bytes()).unwrap();
        let mut answer = String::new();
        self.pins.read_line(&mut answer).unwrap();
        answer.strip_prefix("OK").unwrap_or_else(|| panic!("`{request}`: {answer}")).trim().to_owned()
    }

    /// Presses or releases a button.
    pub fn button(&mut self, pin: u32, down: bool) {
        self.pins(&format!("set_irq_in /machine/nrf51 unnamed-gpio-in {pin} {}", u32::from(!down)));
    }

    /// Presses buttons for a short time on the board's own clock, which may run slowly in an emulator on a busy machine.
    pub fn press(&mut self, buttons: &[u32]) {
        buttons.iter().for_each(|&pin| self.button(pin, true));
        self.wait(60);
        buttons.iter().for_each(|&pin| self.button(pin, false));
        self.wait(60);
    }

    /// Waits for about this many milliseconds on the board's clock, or longer: each row of lights is on for four milliseconds.
    fn wait(&mut self, milliseconds: u32) {
        let mut row = self.row();
        for _ in 0..milliseconds / 4 {
            let before = row;
            while row == before {
                row = self.row();
            }
        }
    }

    /// The pins of the lights.
    fn light_pins(&mut self) -> u64 {
        let answer = self.pins("readl 0x50000504");
        u64::from_str_radix(answer.trim_start_matches("0x"), 16).unwrap()
    }

    fn row(&mut self) -> u64 {
        self.light_pins() >> 13 & 0b111
    }

    /// Waits until the blinking light has changed this many times.
    pub fn wait_blinks(&mut self, times: u32) {
        let mut lit = self.light_pins() >> 4 & 1;
        for _ in 0..times {
            let before = lit;
            while lit == before {
                lit = self.light_pins() >> 4 & 1;
            }
        }
    }

    /// Looks at the pins of the lights this many times.
    pub fn look(&mut self, looks: &mut Looks, times: usize) {
        for _ in 0..times {
            let pins = self.light_pins();
            let shown: Vec<u32> = (13..16).filter(|row| pins >> row & 1 == 1).collect();
            let [row] = shown[..] else { panic!("rows {shown:?} are on at one time") };
            *looks.rows.entry(row).or_default() += 1;
            (4..13).filter(|column| pins >> column & 1 == 0).for_each(|column| *looks.lit.entry((row, column)).or_default() += 1);
        }
    }

    /// The bytes of the slots in the flash.
    pub fn slots(&mut self) -> Vec<u8> {
        let answer = self.pins(&format!("read {SLOTS:#x} {SLOTS_BYTES:#x}"));
        let digits = answer.trim_start_matches("0x");
        (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(&digits[at..at + 2], 16).unwrap()).collect()
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.emulator.kill();
        let _ = self.emulator.wait();
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// How often each row was seen, and how often each of its lights was on.
#[derive(Debug, Default)]
pub struct Looks {
    rows: BTreeMap<u32, u32>,
    lit: BTreeMap<(u32, u32), u32>,
}

impl Looks {
    /// The brightness of each light, from 0 to 16: rows from the top, each from the left. `None` if its row was not seen.
    pub fn lights(&self) -> [[Option<f32>; 5]; 5] {
        /// The row's and the column's pin of each light, as the board is wired.
        const WIRED: [[(u32, u32); 5]; 5] = [
            [(13, 4), (14, 7), (13, 5), (14, 8), (13, 6)],
            [(15, 7), (15, 8), (15, 9), (15, 10), (15, 11)],
            [(14, 5), (13, 12), (14, 6), (15, 12), (14, 4)],
            [(13, 11), (13, 10), (13, 9), (13, 8), (13, 7)],
            [(15, 6), (14, 10), (15, 4), (14, 9), (15, 5)],
        ];
        WIRED.map(|row| row.map(|light| Some(16.0 * self.lit.get(&light).copied().unwrap_or(0) as f32 / *self.rows.get(&light.0)? as f32)))
    }
}

fn connect(folder: &Path, name: &str) -> BufReader<UnixStream> {
    let start = Instant::now();
    loop {
        match UnixStream::connect(folder.join(name)) {
            Ok(stream) => {
                stream.set_read_timeout(Some(LIMIT)).unwrap();
                return BufReader::new(stream);
            }
            Err(error) if start.elapsed() > LIMIT => panic!("{name}: {error}"),
            Err(_) => sleep(Duration::from_millis(20)),
        }
    }
}
