//! Files written on request: never over an input, and over files that goodbot did not write only with `--force`.

use crate::messages::printable;
use crate::outcome::Failure;
use crate::whole_file::write_whole;
use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// What marks a picture as drawn here.
const MARK: &str = "<!-- drawn by goodbot -->";
/// What marks a page as written here.
const PAGE_MARK: &str = "<!-- written by goodbot -->";
/// The first bytes of a model.
const MODEL: &[u8] = b"goodbot\0";
/// The first bytes of a micro:bit's file: its first record is at the flash's beginning.
const MICROBIT: &[u8] = b":020000040000FA";
/// The first bytes of parameters alone.
const PARAMETERS: &[u8] = &goodbot::snapshot::PARAMETERS_MAGIC;
/// How an array of them begins.
pub const PARAMETERS_IN_C: &str = "static const unsigned char parameters[]";
/// How far into a file the mark is looked for.
const HEAD: u64 = 4_096;

/// Standard output, as it is typed.
const STANDARD_OUTPUT: &str = "-";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Picture,
    Model,
    Page,
    Microbit,
    Parameters,
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Model => "model",
            Self::Page => "page",
            Self::Microbit => "micro:bit's file",
            Self::Parameters => "file of parameters",
        }
    }
}

/// Where something is to be written.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    kind: Kind,
}

/// Whether this path means standard output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD_OUTPUT
}

impl Output {
    /// A picture at this path. `inputs` are the files that are read.
    ///
    /// # Errors
    /// Why it cannot or must not be written: better known before the work than after it.
    pub fn picture<'a>(path: &Path, inputs: impl Iterator<Item = &'a str>, force: bool) -> Result<Self, Failure> {
        Self::new(path, Kind::Picture, inputs, force)
    }

    /// A model at this path. `inputs` are the files that are read.
    ///
    /// # Errors
    /// As [`picture`](Self::picture).
    pub fn model<'a>(path: &Path, inputs: impl Iterator<Item = &'a str>, force: bool) -> Result<Self, Failure> {
        Self::new(path, Kind::Model, inputs, force)
    }

    /// A page of Markdown at this path. `inputs` are the files that are read.
    ///
    /// # Errors
    /// As [`picture`](Self::picture).
    pub fn page<'a>(path: &Path, inputs: impl Iterator<Item = &'a str>, force: bool) -> Result<Self, Failure> {
        Self::new(path, Kind::Page, inputs, force)
    }

    /// A micro:bit's file at this path. `inputs` are the files that are read.
    ///
    /// # Errors
    /// As [`picture`](Self::picture).
    pub fn microbit<'a>(path: &Path, inputs: impl Iterator<Item = &'a str>, force: bool) -> Result<Self, Failure> {
        Self::new(path, Kind::Microbit, inputs, force)
    }

    /// Parameters alone at this path. `inputs` are the files that are read.
    ///
    /// # Errors
    /// As [`picture`](Self::picture).
    pub fn parameters<'a>(path: &Path, inputs: impl Iterator<Item = &'a str>, force: bool) -> Result<Self, Failure> {
        Self::new(path, Kind::Parameters, inputs, force)
    }

    fn new<'a>(path: &Path, kind: Kind, mut inputs: impl Iterator<Item = &'a str>, force: bool) -> Result<Self, Failure> {
        let output = Self { path: path.to_owned(), kind };
        if is_standard(path) {
            return Ok(output);
        }
        let refused = |message: String| Err(Failure::Input(format!("{}: {message}", path.display())));
        if path.is_dir() || path.file_name().is_none() {
            return refused("is a folder; name a file in it".to_owned());
        }
        if inputs.any(|input| input != STANDARD_OUTPUT && are_one(Path::new(input), path)) {
            return refused("is read here, and would be replaced; write to another file".to_owned());
        }
        if path.exists() && !path.is_file() {
            return Ok(output);
        }
        if !force && !output.may_be_replaced() {
            let what = kind.name();
            return refused(format!("is there already and is no {what} of goodbot's; name another file, or replace it with --force"));
        }
        // A link's folder is that of the file it leads to.
        let real = std::fs::canonicalize(path);
        let folder = real.as_deref().unwrap_or(path).parent().filter(|folder| !folder.as_os_str().is_empty());
        match tempfile::tempfile_in(folder.unwrap_or(Path::new("."))) {
            Ok(_) => Ok(output),
            Err(error) => refused(format!("no file can be written there ({error}); check that the folder is there and may be written to")),
        }
    }

    /// Whether nothing of someone else's is lost: there is no file, an empty one, or one of ours.
    fn may_be_replaced(&self) -> bool {
        let Ok(file) = File::open(&self.path) else { return !self.path.exists() };
        let mut head = Vec::new();
        if file.take(HEAD).read_to_end(&mut head).is_err() {
            return false;
        }
        head.is_empty()
            || match self.kind {
                Kind::Model => head.starts_with(MODEL),
                Kind::Microbit => head.starts_with(MICROBIT),
                Kind::Parameters => head.starts_with(PARAMETERS) || head.starts_with(PARAMETERS_IN_C.as_bytes()),
                Kind::Picture => String::from_utf8_lossy(&head).contains(MARK),
                Kind::Page => String::from_utf8_lossy(&head).contains(PAGE_MARK),
            }
    }

    /// Whether it goes to standard output.
    pub fn is_standard(&self) -> bool {
        is_standard(&self.path)
    }

    /// Its name in messages.
    pub fn name(&self) -> String {
        if self.is_standard() { "standard output".to_owned() } else { printable(&self.path.display().to_string()).into_owned() }
    }

    /// Writes it, whole or not at all.
    ///
    /// # Errors
    /// [`Failure::Input`] names the file, [`Failure::Output`] is of standard output.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let marked;
        let bytes = match self.kind {
            Kind::Model | Kind::Microbit | Kind::Parameters => bytes,
            Kind::Page => {
                marked = [PAGE_MARK.as_bytes(), b"\n", bytes].concat();
                &marked
            }
            Kind::Picture => {
                marked = with_mark(bytes);
                &marked
            }
        };
        if self.is_standard() {
            let mut out = io::stdout().lock();
            out.write_all(bytes)?;
            return Ok(out.flush()?);
        }
        write_whole(&self.path, bytes).map_err(|error| Failure::Input(format!("{} cannot be written: {error}", self.path.display())))
    }
}

/// Where the text goes: standard output, or standard error where something else goes to standard output.
///
/// # Errors
/// [`Failure::Input`] where two things would go to one place.
pub fn text(outputs: &[Option<&Output>]) -> Result<BufWriter<Box<dyn Write>>, Failure> {
    let files: Vec<&Output> = outputs.iter().copied().flatten().filter(|output| !output.is_standard()).collect();
    if let [one, other] = files.as_slice()
        && are_one(&one.path, &other.path)
    {
        return Err(Failure::Input(format!("{}: two things cannot both be written there; name two files", other.path.display())));
    }
    let standard = outputs.iter().flatten().filter(|output| output.is_standard()).count();
    match standard {
        0 => Ok(BufWriter::new(Box::new(io::stdout()))),
        1 => Ok(BufWriter::new(Box::new(io::stderr()))),
        _ => Err(Failure::Input("two things cannot both go to standard output (-); name a file for one of them".to_owned())),
    }
}

/// A picture with the mark after its first tag.
fn with_mark(svg: &[u8]) -> Vec<u8> {
    let end = svg.iter().position(|&byte| byte == b'>').map_or(0, |at| at + 1);
    [&svg[..end], b"\n", MARK.as_bytes(), &svg[end..]].concat()
}

/// Whether two names lead to one file, through links of both kinds; also where it is not there yet.
pub fn are_one(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let new = || Some(std::fs::canonicalize(folder).ok()?.join(path.file_name()?));
        std::fs::canonicalize(path).ok().or_else(new)
    };
    let (Some(a_real), Some(b_real)) = (real(a), real(b)) else { return false };
    if a_real == b_real {
        return true;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let number = |path: &Path| std::fs::metadata(path).ok().map(|it| (it.dev(), it.ino()));
        if let (Some(a), Some(b)) = (number(&a_real), number(&b_real)) {
            return a == b;
        }
    }
    false
}
