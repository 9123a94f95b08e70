//! The boards that the emulator knows, and the firmware: built for each board and preset, and run in the emulator; programs for one board alone; the file for a micro:bit.

use crate::process::{once, root, shell, within};
use crate::programs::{NODE, QEMU, QEMU_RISCV, npm_packages};
use crate::toolchain;
use crate::toolchain::{CORTEX_M0, CORTEX_M3, CORTEX_M4F, CORTEX_M33F, RISCV, RISCV_C3};
use anyhow::{Context, Result, anyhow, ensure};
use goodbot_formats::microbit::MicrobitFile;
use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Endianness, Object, ObjectSection, ObjectSymbol};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;
use xshell::cmd;

/// The exit code of a firmware stopped by a processor fault.
pub const FAULT: i32 = 102;

/// Parts of the names of symbols that panic.
const PANIC: [&str; 8] = ["panic", "unwind", "unwrap_failed", "expect_failed", "slice_index", "_fail", "const_div", "begin_unwind"];

/// The linker's sections in the flash, and in the RAM.
pub const FLASH: [&str; 7] = [".vector_table", ".text", ".init.rust", ".rodata", ".ARM.exidx", ".eh_frame", ".data"];
pub const STATICS: [&str; 2] = [".data", ".bss"];

/// Arguments for cargo that choose the firmware's workspace and the profile of its programs.
const FIRMWARE: [&str; 5] = ["--quiet", "--locked", "--release", "--manifest-path", "firmware/Cargo.toml"];

/// The binaries of each firmware.
const BINARIES: [&str; 3] = ["course", "tick", "overflow"];

/// Runs a program on the Cortex-M4F.
pub fn run_alone(binary: &Path) -> Result<Report> {
    emulate(AN386.name, binary, 0)
}

/// Builds a part of the firmware. Returns the folder of its binaries.
fn build(target: &str, what: &[&str]) -> Result<PathBuf> {
    let sh = shell()?;
    let cargo = toolchain::cargo(&sh, target, "build")?.args(FIRMWARE);
    // The smallest code has a deeper stack, for which the micro:bit's RAM is too small, and takes longer than is promised for ways and full tables.
    let is_faster = target == CORTEX_M0 || what.iter().any(|&what| ["full", "ways"].contains(&what));
    let cargo = match is_faster {
        true if target == CORTEX_M0 => cargo.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "s"),
        true => cargo.args(toolchain::faster("release", &["goodbot", "goodbot-firmware", "libm"])),
        false => cargo,
    };
    toolchain::in_any_folder(cargo)?.args(what).run()?;
    Ok(toolchain::artifacts(target, "release"))
}

/// The firmware of one board and preset, built.
#[derive(Debug)]
pub struct Image {
    pub board: &'static Board,
    folder: PathBuf,
}

impl Image {
    fn build(board: &'static Board) -> Result<Self> {
        let tiny = if board.preset == "tiny" { ",tiny" } else { "" };
        Ok(Self { board, folder: build(board.target, &["--features", &format!("{}{tiny}", board.feature)])? })
    }

    /// Its name in the output.
    pub fn name(&self) -> String {
        format!("{} {}", self.board.name, self.board.preset)
    }

    /// One of its binaries.
    pub fn binary(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// All of them.
    pub fn binaries(&self) -> [PathBuf; 3] {
        BINARIES.map(|name| self.binary(name))
    }

    fn run(&'static self) -> Result<Trial> {
        let run = |binary, code| emulate(self.board.name, &self.binary(binary), code);
        // Must stop by a fault: a stack overflow that goes unnoticed could change the measured numbers.
        run("overflow", FAULT).context("no fault stops a stack that runs over")?;
        let (course, tick) = (run("course", 0)?, run("tick", 0)?);
        eprintln!("{}: {} of {} tests", self.name(), course.number("passed")?, course.number("tests")?);
        Ok(Trial { image: self, course, tick })
    }
}

/// The reports of one firmware: of the course, and of the loop with a fixed tick.
#[derive(Debug)]
pub struct Trial {
    pub image: &'static Image,
    pub course: Report,
    pub tick: Report,
}

/// The firmware of all boards, or of one for each set of instructions, built.
pub fn images(all_boards: bool) -> Result<&'static [Image]> {
    static DONE: OnceLock<Vec<Image>> = OnceLock::new();
    let boards = BOARDS.iter().filter(|board| all_boards || !board.is_alike);
    Ok(once(&DONE, || boards.map(Image::build).collect::<Result<Vec<_>>>())?)
}

/// The same, built and run, two at a time.
pub fn trials(all_boards: bool) -> Result<&'static [Trial]> {
    static DONE: OnceLock<Vec<Trial>> = OnceLock::new();
    let run_all = || {
        QEMU.path()?;
        QEMU_RISCV.path()?;
        let mut trials = Vec::new();
        for pair in images(all_boards)?.chunks(2) {
            let threads: Vec<_> = pair.iter().map(|image| std::thread::spawn(|| image.run())).collect();
            for thread in threads {
                trials.push(thread.join().unwrap_or_else(|_| Err(anyhow!("a run could not be followed")))?);
            }
        }
        Ok(trials)
    };
    Ok(once(&DONE, run_all)?)
}

/// Programs built for the Cortex-M4F: a robot of one's own, and the first plan for tasks with ways.
pub fn alone() -> Result<[PathBuf; 2]> {
    // Programs with the same features are built once.
    let folder = build(AN386.target, &["--bin", "arm", "--features", "mps2-an386 arm"])?;
    build(AN386.target, &["--bin", "ways", "--features", "mps2-an386 ways"])?;
    Ok(["arm", "ways"].map(|name| folder.join(name)))
}

/// A robot that only obeys, built for the Cortex-M4F.
pub fn obeying() -> Result<PathBuf> {
    Ok(build(AN386.target, &["--bin", "obey", "--no-default-features", "--features", "mps2-an386 obey"])?.join("obey"))
}

/// Every call with full tables, built for the Cortex-M4F with all RAM of its board.
pub fn full() -> Result<PathBuf> {
    Ok(build(AN386.target, &["--bin", "full", "--features", "mps2-an386 full"])?.join("full"))
}

/// The bytes of a binary's sections.
pub fn bytes(binary: &Path, sections: &[&str]) -> Result<u64> {
    let program = std::fs::read(binary)?;
    let program = object::File::parse(&*program)?;
    Ok(program.sections().filter(|section| section.name().is_ok_and(|name| sections.contains(&name))).map(|section| section.size()).sum())
}

/// It is an error if a binary has symbols that panic. The linker keeps only what is called.
pub fn nothing_panics(binaries: &[PathBuf]) -> Result<()> {
    let mut found = Vec::new();
    for binary in binaries {
        let program = std::fs::read(binary)?;
        let program = object::File::parse(&*program)?;
        let names = program.symbols().filter_map(|symbol| symbol.name().ok());
        ensure!(program.symbols().count() > 0, "{} has no symbols", binary.display());
        found.extend(names.filter(|name| is_panic(name)).map(|name| format!("{}: {name}", binary.display())));
    }
    ensure!(found.is_empty(), "these symbols are there to panic:\n{}", found.join("\n"));
    println!("binaries without a symbol that is there to panic: {}", binaries.len());
    Ok(())
}

fn is_panic(symbol: &str) -> bool {
    PANIC.iter().any(|word| symbol.contains(word))
}

/// Builds a program with a package of its own: the micro:bit's, `microbit`; the robot among embassy's tasks, `embassy`; the Raspberry Pi
/// Pico's, `pico`. Returns its path.
pub fn for_cortex_m0(name: &str) -> Result<PathBuf> {
    Ok(build(CORTEX_M0, &["--package", &format!("goodbot-{name}")])?.join(name))
}

/// Checks the ESP32-C3's program without building it, because no available emulator runs it.
pub fn check_esp32c3() -> Result<()> {
    let sh = shell()?;
    Ok(toolchain::cargo(&sh, RISCV_C3, "check")?.args(FIRMWARE).args(["--package", "goodbot-esp32c3"]).run()?)
}

/// Builds the micro:bit's program and writes `dist/goodbot.hex`. Returns the file's path.
pub fn deliver() -> Result<PathBuf> {
    let program = std::fs::read(for_cortex_m0("microbit")?)?;
    let mut parts = in_flash(&program)?;
    let vectors = with_all_faults(&parts)?;
    if let Some((_, part)) = parts.first_mut() {
        *part = &vectors;
    }
    let file = MicrobitFile::of_program(parts)?;
    let path = root().join("dist/goodbot.hex");
    shell()?.write_file(&path, file.to_text())?;
    println!("{}: {} bytes of flash; drag it onto a micro:bit", path.display(), file.len());
    Ok(path)
}

/// The part of a program at address 0, with handlers for three more kinds of fault. A Cortex-M0 has none of them. A Cortex-M4 calls the same handler
/// for them anyway, until it is told otherwise; but DAPLink, which loads programs into a micro:bit V2, refuses one without them as made for the V1.
fn with_all_faults(parts: &[(u32, &[u8])]) -> Result<Vec<u8>> {
    let &(_, part) = parts.first().filter(|(at, part)| *at == 0 && part.len() >= 64).context("the program does not begin at address 0")?;
    let mut part = part.to_vec();
    for vector in 4..7 {
        part.copy_within(12..16, 4 * vector);
    }
    Ok(part)
}

/// Builds the Raspberry Pi Pico's program and writes `dist/goodbot.uf2`. Returns the file's path.
pub fn deliver_pico() -> Result<PathBuf> {
    let program = std::fs::read(for_cortex_m0("pico")?)?;
    let path = root().join("dist/goodbot.uf2");
    shell()?.write_file(&path, uf2(&in_flash(&program)?))?;
    println!("{}: hold the Raspberry Pi Pico's button while you connect it, and drag the file onto it", path.display());
    Ok(path)
}

/// Runs the Raspberry Pi Pico's file in an emulator from npm.
pub fn run_pico() -> Result<Report> {
    let (sh, node, file) = (shell()?, NODE.path()?, deliver_pico()?);
    npm_packages()?;
    sh.change_dir("page");
    let script = include_str!("pico.cjs");
    let (ended, said) = within(LIMIT, cmd!(sh, "{node} --eval {script} {file}"))?;
    ensure!(ended == 0, "the Raspberry Pi Pico ended with {ended}; it said:\n{said}");
    Ok(Report(said))
}

/// A file for the chip's first loader: blocks of 512 bytes, each for 256 bytes of the flash.
fn uf2(parts: &[(u32, &[u8])]) -> Vec<u8> {
    let mut pages = BTreeMap::<u32, [u8; 256]>::new();
    for (byte, at) in parts.iter().flat_map(|(from, bytes)| bytes.iter().zip(*from..)) {
        pages.entry(at / 256 * 256).or_insert([0xff; 256])[at as usize % 256] = *byte;
    }
    let mut file = Vec::with_capacity(512 * pages.len());
    for (number, (at, page)) in pages.iter().enumerate() {
        // The flag 0x2000 says that the last of these numbers is the chip's family.
        let head = [0x0A32_4655, 0x9E5D_5157, 0x2000, *at, 256, number as u32, pages.len() as u32, 0xE48B_FF56];
        file.extend(head.iter().flat_map(|word: &u32| word.to_le_bytes()).chain(*page));
        file.resize(512 * number + 508, 0);
        file.extend(0x0AB1_6F30_u32.to_le_bytes());
    }
    file
}

/// The program's bytes in the flash, with their addresses. Initial values of the RAM are in the flash too, at their physical address.
fn in_flash(program: &[u8]) -> Result<Vec<(u32, &[u8])>> {
    let elf = ElfFile32::<Endianness>::parse(program).context("the linked program cannot be read")?;
    let mut parts = Vec::new();
    for header in elf.elf_program_headers().iter().filter(|header| header.p_type(elf.endian()) == PT_LOAD) {
        let bytes = header.data(elf.endian(), program).ok().context("the linked program is cut off")?;
        parts.push((header.p_paddr(elf.endian()), bytes));
    }
    parts.sort_unstable();
    Ok(parts)
}

/// A binary for another processor would hang. The longest run, with full tables, took a minute and a half beside one compiler, and it takes
/// longer beside the page's browsers.
pub const LIMIT: Duration = Duration::from_secs(900);

/// A board that the emulator knows, and a preset of the library's capacities.
#[derive(Debug)]
pub struct Board {
    pub name: &'static str,
    /// The firmware's feature: this board, or one with the same processor family and memory, whose firmware it runs.
    pub feature: &'static str,
    pub processor: &'static str,
    pub target: &'static str,
    pub preset: &'static str,
    /// Whether another board is so like it that only `--all-boards` runs this one too: the same instructions, or those of two others.
    pub is_alike: bool,
    /// The course's bounds: bytes of RAM with the stack, bytes of flash, and instructions to hear a command and to choose an action once
    /// it is planned.
    pub most: [u64; 3],
}

pub const AN386: Board = Board {
    name: "mps2-an386",
    feature: "mps2-an386",
    processor: "Cortex-M4F",
    target: CORTEX_M4F,
    preset: "small",
    is_alike: false,
    most: [32 * 1024, 96 * 1024, 1_000_000],
};
const UNBOUND: [u64; 3] = [u64::MAX; 3];

/// The emulator's board for RISC-V, which needs an emulator of its own.
const RISCV_BOARD: &str = "virt";

/// The boards whose firmware is built, run and measured: one of each set of instructions, and those that are like one of them. The micro:bit computes floats
/// in software, which takes flash and instructions.
pub const BOARDS: [Board; 6] = [
    AN386,
    Board { name: "mps2-an385", feature: "mps2-an385", processor: "Cortex-M3", target: CORTEX_M3, is_alike: true, most: UNBOUND, ..AN386 },
    Board {
        name: "microbit",
        feature: "microbit",
        processor: "Cortex-M0",
        target: CORTEX_M0,
        preset: "tiny",
        is_alike: false,
        most: [16 * 1024, 100 * 1024, 2_000_000],
    },
    Board {
        name: "mps2-an505",
        feature: "mps2-an505",
        processor: "Cortex-M33F",
        target: CORTEX_M33F,
        is_alike: true,
        most: UNBOUND,
        ..AN386
    },
    Board { name: "mps2-an500", processor: "Cortex-M7F", is_alike: true, most: UNBOUND, ..AN386 },
    Board { name: RISCV_BOARD, feature: RISCV_BOARD, processor: "RISC-V, rv32imac", target: RISCV, most: UNBOUND, ..AN386 },
];

/// A binary's output: among other lines, lines of a name and a number.
#[derive(Clone, Debug)]
pub struct Report(pub String);

impl Report {
    /// All numbers with a name, in order.
    pub fn all(&self, name: &str) -> Vec<u64> {
        self.0.lines().filter_map(|line| line.strip_prefix(name)?.strip_prefix(' ')?.trim().parse().ok()).collect()
    }

    /// The first number with a name.
    pub fn number(&self, name: &str) -> Result<u64> {
        self.all(name).first().copied().with_context(|| format!("the firmware did not report `{name}`"))
    }

    /// Bytes of RAM: statics and the deepest stack.
    pub fn ram(&self) -> Result<u64> {
        Ok(self.number("statics")? + self.number("stack")?)
    }
}

/// Runs a binary in the emulator. Each instruction takes 64 ns of the board's time. It is an error if it ends with another exit code.
pub fn emulate(board: &str, binary: &Path, code: i32) -> Result<Report> {
    let (sh, is_riscv) = (shell()?, board == RISCV_BOARD);
    let qemu = if is_riscv { &QEMU_RISCV } else { &QEMU }.path()?;
    let machine = cmd!(sh, "{qemu} -M {board} -display none -monitor none -serial none -icount shift=6,sleep=off -chardev stdio,id=out");
    let machine = machine.args(["-semihosting-config", "enable=on,target=native,chardev=out"]);
    // As a kernel it would be started at the beginning of the RAM, where the stack is.
    let loaded = if is_riscv {
        machine.args(["-bios", "none", "-device"]).arg(format!("loader,cpu-num=0,file={}", binary.display()))
    } else {
        machine.arg("-kernel").arg(binary)
    };
    let (ended, said) = within(LIMIT, loaded)?;
    ensure!(ended == code, "{} ended with {ended} on {board}, not with {code}; it said:\n{said}", binary.display());
    Ok(Report(said))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uf2_file_has_a_block_for_each_page_that_holds_something() {
        let file = uf2(&[(0x1000_0000, &[1; 256]), (0x1000_01ff, &[2, 3])]);
        let block = |number: usize| &file[512 * number..512 * (number + 1)];
        let word = |number: usize, at: usize| u32::from_le_bytes(*block(number)[at..].first_chunk().unwrap());
        assert_eq!(file.len(), 3 * 512);
        assert_eq!([0, 1, 2].map(|number| word(number, 12)), [0x1000_0000, 0x1000_0100, 0x1000_0200]);
        assert_eq!([0, 1, 2].map(|number| (word(number, 20), word(number, 24))), [(0, 3), (1, 3), (2, 3)]);
        assert_eq!((block(1)[32..34].to_vec(), block(1)[287], block(2)[32]), (vec![0xff, 0xff], 2, 3));
        assert!(file.chunks(512).all(|block| block.starts_with(b"UF2\n") && block.ends_with(&[0x30, 0x6f, 0xb1, 0x0a])));
    }

    #[test]
    fn each_kind_of_fault_of_a_cortex_m4_has_the_handler_of_the_only_one_of_a_cortex_m0() {
        let before: Vec<u8> = (0..64).collect();
        let after = with_all_faults(&[(0, &before), (64, &[1])]).unwrap();
        let same = [12, 13, 14, 15].repeat(3);
        assert_eq!(after, [&before[..16], &same, &before[28..]].concat());
        assert!(with_all_faults(&[(64, &before)]).is_err());
    }

    #[test]
    fn a_program_that_can_panic_is_refused_with_the_symbols_that_do() {
        let error = nothing_panics(&[std::env::current_exe().unwrap()]).unwrap_err();
        assert!(error.to_string().contains("panicking"), "{error}");
    }

    #[test]
    fn a_symbol_that_panics_is_known_by_its_name() {
        assert!(is_panic("_ZN4core9panicking9panic_fmt17h0123456789abcdefE"));
        assert!(is_panic("_RNvNtNtCsX_4core5slice5index16slice_index_fail"));
        assert!(is_panic("_RNvNvNtCsX_4core5slice20copy_from_slice_impl17len_mismatch_fail"));
        assert!(!is_panic("_RNvMsX_NtCsX_7goodbot7sessionINtB2_5Agent4hear"));
    }

    #[test]
    fn a_report_is_names_and_numbers() {
        let report = Report("stack 4268\nplan 1\nplan 2\nerror: no room\n".to_owned());
        assert_eq!(report.number("stack").unwrap(), 4268);
        assert_eq!(report.all("plan"), [1, 2]);
        assert!(report.number("statics").unwrap_err().to_string().contains("statics"));
    }
}
