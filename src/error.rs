//! The one error type: each arm is one status of the C ABI.

#[cfg(test)]
pub(crate) mod faults;

/// What every fallible function of the library returns.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a call failed. Every message is one sentence that names the value and
/// the index at fault.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A pointer that must not be NULL is NULL (C ABI only).
    #[error("{0}")]
    NullPointer(String),
    /// An option or argument lies outside its range.
    #[error("{0}")]
    InvalidArgument(String),
    /// A coordinate or value is NaN or infinite.
    #[error("{0}")]
    NotFinite(String),
    /// A triangle, label or sphere index does not exist.
    #[error("{0}")]
    IndexOutOfRange(String),
    /// There is nothing to work on: no face, no solid cell.
    #[error("{0}")]
    Empty(String),
    /// The shape has no volume.
    #[error("{0}")]
    ZeroVolume(String),
    /// The surface is so open that its inside is not defined.
    #[error("{0}")]
    OpenSurface(String),
    /// The shape is several disconnected bodies and the choice was to refuse.
    #[error("{0}")]
    SeveralBodies(String),
    /// A file is malformed or truncated, or its header lies.
    #[error("{0}")]
    Format(String),
    /// A file or request of a kind that this build does not handle.
    #[error("{0}")]
    Unsupported(String),
    /// The operating system refused to read or write.
    #[error("{0}")]
    Io(String),
    /// The work would take more memory than the option allows.
    #[error("{0}")]
    MemoryLimit(String),
    /// The system has no memory left for a reservation.
    #[error("{0}")]
    OutOfMemory(String),
    /// The caller's array is too short (C ABI only).
    #[error("{0}")]
    BufferTooSmall(String),
    /// The progress callback asked to stop before there was a result.
    #[error("{0}")]
    Cancelled(String),
    /// A struct's `struct_size` is one that this library does not know (C ABI only).
    #[error("{0}")]
    StructSize(String),
    /// A count does not fit: the input is larger than the library can index.
    #[error("{0}")]
    TooLarge(String),
    /// The value asked for was not among the call's `wants`.
    #[error("{0}")]
    NotWanted(String),
    /// No sphere satisfies the constraints.
    #[error("{0}")]
    NoSpheres(String),
    /// No masses of the spheres satisfy the constraints.
    #[error("{0}")]
    NoMasses(String),
    /// A defect of the library itself: please report it.
    #[error("{0}")]
    Internal(String),
}

impl Error {
    /// The number of this error in the C ABI. 0 is success; numbers are never reused.
    pub fn status(&self) -> i32 {
        match self {
            Error::NullPointer(_) => 1,
            Error::InvalidArgument(_) => 2,
            Error::NotFinite(_) => 3,
            Error::IndexOutOfRange(_) => 4,
            Error::Empty(_) => 5,
            Error::ZeroVolume(_) => 6,
            Error::OpenSurface(_) => 7,
            Error::SeveralBodies(_) => 8,
            Error::Format(_) => 9,
            Error::Unsupported(_) => 10,
            Error::Io(_) => 11,
            Error::MemoryLimit(_) => 12,
            Error::OutOfMemory(_) => 13,
            Error::BufferTooSmall(_) => 14,
            Error::Cancelled(_) => 15,
            Error::StructSize(_) => 16,
            Error::TooLarge(_) => 17,
            Error::NotWanted(_) => 18,
            Error::NoSpheres(_) => 19,
            Error::Internal(_) => 20,
            Error::NoMasses(_) => 21,
        }
    }
}

impl Error {
    /// The same error with words before its sentence, such as the one of many at fault.
    pub fn about(&self, what: &str) -> Error {
        use Error::*;
        let mut error = self.clone();
        match &mut error {
            NullPointer(text)
            | InvalidArgument(text)
            | NotFinite(text)
            | IndexOutOfRange(text)
            | Empty(text)
            | ZeroVolume(text)
            | OpenSurface(text)
            | SeveralBodies(text)
            | Format(text)
            | Unsupported(text)
            | Io(text)
            | MemoryLimit(text)
            | OutOfMemory(text)
            | BufferTooSmall(text)
            | Cancelled(text)
            | StructSize(text)
            | TooLarge(text)
            | NotWanted(text)
            | NoSpheres(text)
            | NoMasses(text)
            | Internal(text) => {
                *text = format!("{what}: {text}");
            }
        }
        error
    }
}

/// Refuses what may take more bytes than are `left` of the memory limit.
pub fn fits(what: std::fmt::Arguments, bytes: u64, left: u64) -> Result<()> {
    if bytes <= left {
        return Ok(());
    }
    Err(Error::MemoryLimit(format!(
        "{what} may take {bytes} bytes, more than the {left} that are left of the limit"
    )))
}

/// Reserves `len` elements without aborting the process when memory is short.
/// Every reservation whose size depends on the input goes through here.
pub fn reserve<T>(what: &str, len: usize) -> Result<Vec<T>> {
    let mut v = Vec::new();
    let refused = refused();
    v.try_reserve_exact(if refused { usize::MAX } else { len }).map_err(|_| {
        Error::OutOfMemory(format!(
            "no memory for {what}: {len} elements of {} bytes",
            std::mem::size_of::<T>()
        ))
    })?;
    Ok(v)
}

/// As [`reserve`], filled with `value`.
pub fn filled<T: Clone>(what: &str, len: usize, value: T) -> Result<Vec<T>> {
    let mut v = reserve(what, len)?;
    v.resize(len, value);
    Ok(v)
}

/// Collects `items`, without aborting the process when memory is short.
pub fn collected<T>(what: &str, items: impl IntoIterator<Item = T>) -> Result<Vec<T>> {
    let items = items.into_iter();
    let mut v = reserve(what, items.size_hint().0)?;
    for item in items {
        push(what, &mut v, item)?;
    }
    Ok(v)
}

/// Pushes `value`, without aborting the process when memory is short. For arrays
/// that grow with the input where their length is not known before.
pub fn push<T>(what: &str, v: &mut Vec<T>, value: T) -> Result<()> {
    if v.len() == v.capacity() {
        let refused = refused();
        v.try_reserve(if refused { usize::MAX } else { 1 }).map_err(|_| {
            Error::OutOfMemory(format!(
                "no memory for {what}: more than {} elements of {} bytes",
                v.len(),
                std::mem::size_of::<T>()
            ))
        })?;
    }
    v.push(value);
    Ok(())
}

/// Whether a test has this reservation fail.
#[cfg(test)]
fn refused() -> bool {
    faults::step();
    faults::turn(faults::Kind::Memory)
}
#[cfg(not(test))]
const fn refused() -> bool {
    false
}

/// A number as a sentence quotes it: with an exponent where it would be a long row of zeros.
pub fn figure(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || (1e-5..1e16).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// "1 face", "2 faces".
pub fn count(n: u64, noun: &str) -> String {
    match (n, noun) {
        (1, _) => format!("1 {noun}"),
        (_, "vertex") => format!("{n} vertices"),
        (_, "body") => format!("{n} bodies"),
        _ => format!("{n} {noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_an_error() {
        let n = usize::MAX;
        for e in [
            reserve::<u64>("numbers", n).err(),
            filled("numbers", n, 0u64).err(),
            collected("numbers", 0..n).err(),
        ] {
            let text = format!("no memory for numbers: {n} elements of 8 bytes");
            assert_eq!(e, Some(Error::OutOfMemory(text)));
        }
        assert_eq!(collected("numbers", (0..9).filter(|n| n % 2 == 0)), Ok(vec![0, 2, 4, 6, 8]));
        assert_eq!(fits(format_args!("a tree"), 7, 7), Ok(()));
        let e = fits(format_args!("a tree"), 8, 7).unwrap_err();
        let text = "a tree may take 8 bytes, more than the 7 that are left of the limit";
        assert_eq!(e, Error::MemoryLimit(text.into()));
    }

    #[test]
    fn words_come_before_the_sentence() {
        let e = Error::Empty("no cell".into()).about("shape 3");
        assert_eq!(e, Error::Empty("shape 3: no cell".into()));
    }

    #[test]
    fn numbers_and_counts_read_well() {
        for (x, text) in [(0.001, "0.001"), (-2.0, "-2"), (0.0, "0"), (1e-200, "1e-200")] {
            assert_eq!(figure(x), text);
        }
        assert_eq!((figure(-2.5e300), figure(f64::NAN)), ("-2.5e300".into(), "NaN".into()));
        assert_eq!(
            (count(1, "vertex"), count(0, "vertex")),
            ("1 vertex".into(), "0 vertices".into())
        );
        assert_eq!((count(2, "face"), count(1, "face")), ("2 faces".into(), "1 face".into()));
    }
}
