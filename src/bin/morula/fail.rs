//! Why the program ends: usage, a failure of the library, or a closed pipe.

use morula::Error;
use morula::error::count;
use std::fmt;
use std::path::Path;

/// What every subcommand returns.
pub type Done<T = ()> = Result<T, Fail>;

/// Why the program ends early.
pub enum Fail {
    /// The command line asks for something that does not fit together.
    Usage(String),
    /// The library refused; `about` is the file concerned.
    Library { error: Error, about: String },
    /// So many cases of the self-test missed their bounds.
    Missed(usize),
    /// The reader of our output went away: not an error.
    Pipe,
}

impl Fail {
    pub fn exit_code(&self) -> u8 {
        match self {
            Fail::Usage(_) => 2,
            Fail::Library { .. } | Fail::Missed(_) => 1,
            Fail::Pipe => 0,
        }
    }

    /// A failure to write to stdout.
    pub fn stdout(e: std::io::Error) -> Fail {
        if e.kind() == std::io::ErrorKind::BrokenPipe {
            return Fail::Pipe;
        }
        Fail::Library { error: Error::Io(e.to_string()), about: "stdout".into() }
    }

    /// A failure to write to a file.
    pub fn file(path: &Path, e: std::io::Error) -> Fail {
        Fail::Library { error: Error::Io(e.to_string()), about: path.display().to_string() }
    }
}

/// Names the file that an error of the library is about.
pub trait About<T> {
    fn about(self, what: &str) -> Done<T>;
}

impl<T> About<T> for morula::Result<T> {
    fn about(self, what: &str) -> Done<T> {
        self.map_err(|error| Fail::Library { error, about: what.into() })
    }
}

impl fmt::Display for Fail {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fail::Usage(sentence) => write!(f, "{sentence} (try --help)"),
            Fail::Library { error, about } => {
                let text = error.to_string();
                // Line breaks of a foreign message would make it more than one sentence.
                let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
                if !about.is_empty() && !text.contains(about.as_str()) {
                    write!(f, "{about}: ")?;
                }
                write!(f, "{text} [{}]", status_name(error))
            }
            Fail::Missed(n) => write!(f, "{} missed", count(*n as u64, "case")),
            Fail::Pipe => Ok(()),
        }
    }
}

/// The status name of the C ABI, without its prefix.
fn status_name(error: &Error) -> &'static str {
    match error {
        Error::NullPointer(_) => "NULL_POINTER",
        Error::InvalidArgument(_) => "INVALID_ARGUMENT",
        Error::NotFinite(_) => "NOT_FINITE",
        Error::IndexOutOfRange(_) => "INDEX_OUT_OF_RANGE",
        Error::Empty(_) => "EMPTY",
        Error::ZeroVolume(_) => "ZERO_VOLUME",
        Error::OpenSurface(_) => "OPEN_SURFACE",
        Error::SeveralBodies(_) => "SEVERAL_BODIES",
        Error::Format(_) => "FORMAT",
        Error::Unsupported(_) => "UNSUPPORTED",
        Error::Io(_) => "IO",
        Error::MemoryLimit(_) => "MEMORY_LIMIT",
        Error::OutOfMemory(_) => "OUT_OF_MEMORY",
        Error::BufferTooSmall(_) => "BUFFER_TOO_SMALL",
        Error::Cancelled(_) => "CANCELLED",
        Error::StructSize(_) => "STRUCT_SIZE",
        Error::TooLarge(_) => "TOO_LARGE",
        Error::NotWanted(_) => "NOT_WANTED",
        Error::NoSpheres(_) => "NO_SPHERES",
        Error::NoMasses(_) => "NO_MASSES",
        _ => "INTERNAL",
    }
}
