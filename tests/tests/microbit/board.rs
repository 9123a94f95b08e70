//! A micro:bit in an emulator: its serial line, its pins, its flash.

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

/// The buttons.
pub const A: usize = 0;
pub const B: usize = 1;

/// A version of the board: the pins of its buttons, and of each light's row and column. Pins of the second port are counted on from 32.
#[derive(Debug)]
pub struct Version {
    buttons: [u32; 2],
    lights: [[(u32, u32); 5]; 5],
    emulator: fn(&Setup, &Path, &Path) -> Command,
}

/// QEMU has the first one.
pub static V1: Version = Version {
    buttons: [17, 26],
    lights: [
        [(13, 4), (14, 7), (13, 5), (14, 8), (13, 6)],
        [(15, 7), (15, 8), (15, 9), (15, 10), (15, 11)],
        [(14, 5), (13, 12), (14, 6), (15, 12), (14, 4)],
        [(13, 11), (13, 10), (13, 9), (13, 8), (13, 7)],
        [(15, 6), (14, 10), (15, 4), (14, 9), (15, 5)],
    ],
    emulator: |setup, hex, folder| {
        let file = |name: &str| folder.join(name).display().to_string();
        let mut emulator = Command::new(&setup.emulator);
        emulator.args(["-M", "microbit", "-display", "none", "-monitor", "none"]);
        emulator.arg("-device").arg(format!("loader,file={}", hex.display()));
        if folder.join("slots").exists() {
            emulator.arg("-device").arg(format!("loader,file={},addr={SLOTS:#x},force-raw=on", file("slots")));
        }
        // It waits for the serial line to be connected, so that no output is lost.
        emulator.arg("-serial").arg(format!("unix:{},server=on,wait=on", file("serial")));
        emulator.arg("-qtest").arg(format!("unix:{},server=on,wait=off", file("pins"))).args(["-qtest-log", "/dev/null"]);
        emulator.stderr(Stdio::null());
        emulator
    },
};

/// For the second one, a script and unicorn.
pub static V2: Version = Version {
    buttons: [14, 23],
    lights: [
        [(21, 28), (21, 11), (21, 31), (21, 37), (21, 30)],
        [(22, 28), (22, 11), (22, 31), (22, 37), (22, 30)],
        [(15, 28), (15, 11), (15, 31), (15, 37), (15, 30)],
        [(24, 28), (24, 11), (24, 31), (24, 37), (24, 30)],
        [(19, 28), (19, 11), (19, 31), (19, 37), (19, 30)],
    ],
    emulator: |setup, hex, folder| {
        let mut emulator = Command::new(&setup.emulator);
        emulator.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/microbit/v2.py")).args([hex, folder]);
        emulator
    },
};

/// The files to run, and the emulators.
#[derive(Clone, Debug)]
pub struct Setup {
    pub version: &'static Version,
    /// QEMU for V1; for V2, a Python that has unicorn.
    pub emulator: PathBuf,
    pub hex: PathBuf,
    /// The command line, which writes `.hex` files.
    pub goodbot: PathBuf,
    /// The robot among embassy's tasks, if it was built.
    pub embassy: Option<PathBuf>,
}

/// A board that is switched on; it is switched off when dropped.
pub struct Board {
    version: &'static Version,
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
        let (version, folder) = (setup.version, folder());
        if let Some(slots) = slots {
            std::fs::write(folder.join("slots"), slots).unwrap();
        }
        let emulator = (version.emulator)(setup, hex, &folder).stdin(Stdio::null()).stdout(Stdio::null()).spawn().unwrap();
        let (serial, pins) = (connect(&folder, "serial"), connect(&folder, "pins"));
        let mut board = Self { version, emulator, serial, pins, folder };
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
    pub fn button(&mut self, button: usize, down: bool) {
        let pin = self.version.buttons[button];
        self.pins(&format!("set_irq_in /machine/nrf51 unnamed-gpio-in {pin} {}", u32::from(!down)));
    }

    /// Presses buttons for a short time on the board's own clock, which may run slowly in an emulator on a busy machine.
    pub fn press(&mut self, buttons: &[usize]) {
        buttons.iter().for_each(|&button| self.button(button, true));
        self.wait(60);
        buttons.iter().for_each(|&button| self.button(button, false));
        self.wait(60);
    }

    /// Waits for about this many milliseconds on the board's clock, or longer: each row of lights is on for four milliseconds.
    fn wait(&mut self, milliseconds: u32) {
        let (_, mut row) = self.row();
        for _ in 0..milliseconds / 4 {
            let before = row;
            while row == before {
                (_, row) = self.row();
            }
        }
    }

    /// The pins of the lights.
    fn light_pins(&mut self) -> u64 {
        let answer = self.pins("readl 0x50000504");
        u64::from_str_radix(answer.trim_start_matches("0x"), 16).unwrap()
    }

    /// The pins of the lights, and the only row among them that is on.
    fn row(&mut self) -> (u64, u32) {
        let pins = self.light_pins();
        let rows = pins & self.version.lights.iter().flatten().fold(0, |rows, (row, _)| rows | 1 << row);
        assert!(rows.is_power_of_two(), "the rows at the pins {rows:#b} are on at one time");
        (pins, rows.ilog2())
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
            let (pins, shown) = self.row();
            let lights = self.version.lights.iter().flatten().zip(looks.0.iter_mut().flatten());
            for ((_, column), (on, lit)) in lights.filter(|((row, _), _)| *row == shown) {
                *on += 1;
                *lit += u32::from(pins >> column & 1 == 0);
            }
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

/// How often each light's row was on, and how often the light itself: rows from the top, each from the left.
#[derive(Debug, Default)]
pub struct Looks([[(u32, u32); 5]; 5]);

impl Looks {
    /// The brightness of each light, from 0 to 16. `None` if its row was not seen.
    pub fn lights(&self) -> [[Option<f32>; 5]; 5] {
        self.0.map(|row| row.map(|(on, lit)| (on > 0).then(|| 16.0 * lit as f32 / on as f32)))
    }
}

/// A new folder for files.
pub fn folder() -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let name = format!("goodbot-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let folder = std::env::temp_dir().join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
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
