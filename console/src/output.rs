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

/// Standard input and output, as they are typed.
const STANDARD: &str = "-";

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture (SVG).
    Picture,
    /// A model.
    Model,
    /// A page of Markdown.
    Page,
    /// A micro:bit's file.
    Microbit,
    /// Parameters alone.
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

    /// Whether nothing of someone else's is lost where this is written: there is no file, an empty one, or one of ours.
    pub fn may_replace(self, path: &Path) -> bool {
        // A device or a pipe is written to as it is.
        if path.exists() && !path.is_file() {
            return true;
        }
        let Ok(file) = File::open(path) else { return !path.exists() };
        let mut head = Vec::new();
        if file.take(HEAD).read_to_end(&mut head).is_err() {
            return false;
        }
        head.is_empty()
            || match self {
                Self::Model => head.starts_with(MODEL),
                Self::Microbit => head.starts_with(MICROBIT),
                Self::Parameters => head.starts_with(PARAMETERS) || head.starts_with(PARAMETERS_IN_C.as_bytes()),
                Self::Picture => String::from_utf8_lossy(&head).contains(MARK),
                Self::Page => String::from_utf8_lossy(&head).contains(PAGE_MARK),
            }
    }
}

/// Where something is to be written.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    kind: Kind,
}

/// Whether this path means standard output, or for what is read, standard input.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD
}

impl Output {
    /// A picture, if one is wanted. As [`new`](Self::new).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn picture(path: &Option<PathBuf>, inputs: impl IntoIterator<Item: AsRef<Path>>, force: bool) -> Result<Option<Self>, Failure> {
        path.as_ref().map(|path| Self::new(Kind::Picture, path, inputs, force)).transpose()
    }

    /// Something at this path. `inputs` are the files that are read, and `force` says that a file of someone else's is replaced.
    ///
    /// # Errors
    /// Why it cannot or must not be written: better known before the work than after it.
    pub fn new(kind: Kind, path: &Path, inputs: impl IntoIterator<Item: AsRef<Path>>, force: bool) -> Result<Self, Failure> {
        let output = Self { path: path.to_owned(), kind };
        if is_standard(path) {
            return Ok(output);
        }
        let refused = |message: String| Err(Failure::Input(format!("{}: {message}", path.display())));
        if path.is_dir() || path.file_name().is_none() {
            return refused("is a folder; name a file in it".to_owned());
        }
        if inputs.into_iter().any(|input| !is_standard(input.as_ref()) && are_one(input.as_ref(), path)) {
            return refused("is read here, and would be replaced; write to another file".to_owned());
        }
        if path.exists() && !path.is_file() {
            return Ok(output);
        }
        if !force && !kind.may_replace(path) {
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

    /// Whether it goes to standard output.
    pub fn is_standard(&self) -> bool {
        is_standard(&self.path)
    }

    /// Its name in messages.
    pub fn name(&self) -> String {
        if self.is_standard() { "standard output".to_owned() } else { printable(&self.path.display().to_string()).into_owned() }
    }

    /// Writes a picture, if it could be drawn.
    ///
    /// # Errors
    /// As [`write`](Self::write), and [`Failure::Result`] where it could not be drawn.
    pub fn draw(&self, picture: Result<String, Box<dyn std::error::Error>>) -> Result<(), Failure> {
        let picture = picture.map_err(|error| Failure::Result(format!("cannot draw the picture: {error}")))?;
        self.write(picture.as_bytes())
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
