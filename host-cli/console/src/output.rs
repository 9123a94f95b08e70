//! Writes files on request. Input files are never overwritten, and files that goodbot did not write only with `--force`.

use crate::outcome::Failure;
use crate::printed::{self, Printed, printable, well_formed};
use crate::whole_file::Claim;
use crate::whole_file::{followed, write_whole};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The mark of a picture that goodbot drew.
const MARK: &str = "<!-- drawn by goodbot -->";
/// The first bytes of a model.
const MODEL: &[u8] = b"goodbot\0";
/// The first bytes of a micro:bit file: its first record is at the beginning of the flash.
const MICROBIT: &[u8] = b":020000040000FA";
/// The first bytes of a file of parameters.
const PARAMETERS: &[u8] = &goodbot::snapshot::PARAMETERS_MAGIC;
/// The beginning of a C file with parameters.
pub const PARAMETERS_IN_C: &str = "static const unsigned char parameters[]";
/// The first bytes of a file of weights.
const WEIGHTS: &[u8] = b"acts";
/// The mark must be in the first bytes of a file, at most this many.
const HEAD: u64 = 4_096;

/// Standard input and output on the command line.
const STANDARD: &str = "-";

/// The kind of a written file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture (SVG).
    Picture,
    /// A model.
    Model,
    /// A micro:bit file.
    Microbit,
    /// A file of parameters.
    Parameters,
    /// A file of weights that decide whether a robot acts on what was said.
    Weights,
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Model => "model",
            Self::Microbit => "micro:bit's file",
            Self::Parameters => "file of parameters",
            Self::Weights => "file of weights",
        }
    }

    /// Whether writing here destroys no foreign file: there is no file, an empty one, or one that goodbot wrote.
    pub fn may_replace(self, path: &Path) -> bool {
        // Devices and pipes may be written to.
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
                Self::Weights => head.starts_with(WEIGHTS),
                Self::Picture => String::from_utf8_lossy(&head).contains(MARK),
            }
    }
}

/// A file to write.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    kind: Kind,
    /// A model is not written while somebody teaches it.
    claim: Option<Claim>,
}

/// Whether this path means standard output or, for an input, standard input.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD
}

impl Output {
    /// The file of a picture, if one is wanted. As [`new`](Self::new).
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn picture(path: &Option<PathBuf>, inputs: impl IntoIterator<Item: AsRef<Path>>, force: bool) -> Result<Option<Self>, Failure> {
        path.as_ref().map(|path| Self::new(Kind::Picture, path, inputs, force)).transpose()
    }

    /// The file at this path. `inputs` are the files that are read. With `force`, a foreign file may be replaced.
    ///
    /// # Errors
    /// The reason why it cannot or must not be written, before the work begins.
    pub fn new(kind: Kind, path: &Path, inputs: impl IntoIterator<Item: AsRef<Path>>, force: bool) -> Result<Self, Failure> {
        let mut output = Self { path: path.to_owned(), kind, claim: None };
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
        // The folder of a link's target counts.
        let real = match followed(path) {
            Ok(real) => real,
            Err(error) => return refused(format!("cannot be written: {error}; name another file")),
        };
        let folder = real.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Err(error) = tempfile::tempfile_in(folder.unwrap_or(Path::new("."))) {
            return refused(format!("no file can be written there ({error}); check that the folder is there and may be written to"));
        }
        if kind == Kind::Model {
            match Claim::take(path) {
                Ok(claim) => output.claim = Some(claim),
                Err(error) => return refused(format!("cannot be written to: {error}")),
            }
        }
        Ok(output)
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
    /// The errors of [`write`](Self::write), and [`Failure::Result`] if the picture could not be drawn.
    pub fn draw(&self, picture: Result<String, Box<dyn std::error::Error>>) -> Result<(), Failure> {
        let picture = picture.map_err(|error| Failure::Result(format!("cannot draw the picture: {error}")))?;
        self.write(picture.as_bytes())
    }

    /// Writes the whole file or nothing.
    ///
    /// # Errors
    /// [`Failure::Input`] names the file; [`Failure::Output`] is an error of standard output.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let marked;
        let bytes = match self.kind {
            Kind::Model | Kind::Microbit | Kind::Parameters | Kind::Weights => bytes,
            Kind::Picture => {
                marked = with_mark(&well_formed(bytes));
                marked.as_bytes()
            }
        };
        if self.is_standard() {
            return Ok(printed::data(bytes)?);
        }
        let written = self.claim.as_ref().map_or_else(|| write_whole(&self.path, bytes), |claim| claim.write(bytes));
        written.map_err(|error| Failure::Input(format!("{} cannot be written: {error}", self.path.display())))
    }
}

/// The writer for text: standard output, or standard error if a file goes to standard output.
///
/// # Errors
/// [`Failure::Input`] if two files have the same path.
pub fn text(outputs: &[Option<&Output>]) -> Result<Printed, Failure> {
    let files: Vec<&Output> = outputs.iter().copied().flatten().filter(|output| !output.is_standard()).collect();
    if let [one, other] = files.as_slice()
        && are_one(&one.path, &other.path)
    {
        return Err(Failure::Input(format!("{}: two things cannot both be written there; name two files", other.path.display())));
    }
    let standard = outputs.iter().flatten().filter(|output| output.is_standard()).count();
    match standard {
        0 => Ok(Printed::stdout()),
        1 => Ok(Printed::stderr()),
        _ => Err(Failure::Input("two things cannot both go to standard output (-); name a file for one of them".to_owned())),
    }
}

/// A picture with the mark after its first tag.
fn with_mark(svg: &str) -> String {
    let (tag, rest) = svg.split_at(svg.find('>').map_or(0, |at| at + 1));
    [tag, "\n", MARK, rest].concat()
}

/// Whether two paths lead to one file, through symbolic or hard links. The files need not exist.
pub fn are_one(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| {
        let path = &followed(path).ok()?;
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
