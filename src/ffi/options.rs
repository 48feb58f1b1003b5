//! How structs cross the border and may grow.
//!
//! Every struct begins with `struct_size`, which the caller sets to its own
//! `sizeof`. Fields are only ever appended, so that a size tells which fields
//! the caller knows. A shorter struct from an older header works for ever; a
//! longer one from a newer header is taken while the bytes that this library
//! does not know are zero.

use super::choices::*;
use super::cost_structs::*;
use super::fragment_structs::*;
use super::mass_structs::*;
use super::structs::*;
use crate::error::{Error, Result};

/// No struct is larger; a greater `struct_size` is a forgotten one.
const MOST: usize = 4096;

/// A struct with `struct_size`.
///
/// # Safety
/// `repr(C)`; a `usize` that is the struct's size comes first; no padding; all
/// bit patterns of the other fields are valid (numbers, nullable pointers).
pub(super) unsafe trait Versioned: Copy {
    /// Name in the header.
    const NAME: &'static str;
    /// Size in the first release: shorter ones never existed.
    const FIRST: usize;
    /// Ends of the fields appended since, ascending.
    const ADDED: &'static [usize] = &[];
    /// The defaults (options) or zeros (what the library fills).
    fn defaults() -> Self;
}

/// How many bytes of a struct of `size` hold whole fields that are known here.
fn known<T: Versioned>(size: usize) -> Result<usize> {
    if !(T::FIRST..=MOST).contains(&size) {
        return Err(Error::StructSize(format!(
            "struct_size of {} is {size}, not between {} and {MOST}: set it to sizeof({})",
            T::NAME,
            T::FIRST,
            T::NAME
        )));
    }
    let added = T::ADDED.iter().rev().find(|&&end| end <= size);
    Ok(added.copied().unwrap_or(T::FIRST).min(size_of::<T>()))
}

/// The caller's options; NULL means the defaults.
pub(super) unsafe fn read<T: Versioned>(pointer: *const T) -> Result<T> {
    let mut value = T::defaults();
    if pointer.is_null() {
        return Ok(value);
    }
    super::guard::require(pointer, T::NAME)?;
    let size = unsafe { pointer.cast::<usize>().read() };
    let fits = known::<T>(size)?;
    let bytes = pointer.cast::<u8>();
    for i in size_of::<T>()..size {
        if unsafe { bytes.add(i).read() } != 0 {
            return Err(Error::StructSize(format!(
                "byte {i} of {} is not zero, but version {} of the library knows only {} bytes of it",
                T::NAME,
                env!("CARGO_PKG_VERSION"),
                size_of::<T>()
            )));
        }
    }
    unsafe { std::ptr::copy_nonoverlapping(bytes, (&raw mut value).cast::<u8>(), fits) };
    Ok(value)
}

/// An array of the caller's, whose structs stand one after another, all as large as the first.
pub(super) unsafe fn read_all<T: Versioned>(pointer: *const T, count: usize) -> Result<Vec<T>> {
    let mut all = crate::error::reserve(T::NAME, count)?;
    if count == 0 {
        return Ok(all);
    }
    super::guard::require(pointer, T::NAME)?;
    let size = unsafe { pointer.cast::<usize>().read() };
    known::<T>(size)?;
    for i in 0..count {
        let one = unsafe { pointer.cast::<u8>().add(i * size).cast::<T>() };
        super::guard::require(one, T::NAME)?;
        let own = unsafe { one.cast::<usize>().read() };
        if own != size {
            return Err(Error::StructSize(format!(
                "struct_size of {} {i} is {own}, but {size} of the first",
                T::NAME
            )));
        }
        all.push(unsafe { read(one)? });
    }
    Ok(all)
}

/// Checks a struct that the library is to fill, before the work is done.
pub(super) unsafe fn check<T: Versioned>(pointer: *mut T) -> Result<()> {
    super::guard::require(pointer, T::NAME)?;
    known::<T>(unsafe { pointer.cast::<usize>().read() }).map(|_| ())
}

/// Fills the caller's struct as far as the caller knows it; what the library
/// does not know becomes zero; `struct_size` stays.
pub(super) unsafe fn fill<T: Versioned>(pointer: *mut T, value: &T) -> Result<()> {
    unsafe { check(pointer)? };
    let size = unsafe { pointer.cast::<usize>().read() };
    unsafe { put(pointer, size, value) }
}

/// Fills an options struct of `size` bytes with the defaults.
pub(super) unsafe fn init<T: Versioned>(pointer: *mut T, size: usize) -> Result<()> {
    super::guard::require(pointer, T::NAME)?;
    known::<T>(size)?;
    unsafe { put(pointer, size, &T::defaults()) }
}

unsafe fn put<T: Versioned>(pointer: *mut T, size: usize, value: &T) -> Result<()> {
    let fits = known::<T>(size)?;
    let bytes = pointer.cast::<u8>();
    unsafe {
        std::ptr::copy_nonoverlapping((value as *const T).cast::<u8>(), bytes, fits);
        std::ptr::write_bytes(bytes.add(fits), 0, size - fits);
        pointer.cast::<usize>().write(size);
    }
    Ok(())
}

/// The size of a struct by its MORULA_STRUCT_* number; 0: no such struct.
pub(super) fn size_of_struct(which: i32) -> usize {
    match which {
        MORULA_STRUCT_IMPORT_OPTIONS => size_of::<morula_import_options>(),
        MORULA_STRUCT_FILE_OPTIONS => size_of::<morula_file_options>(),
        MORULA_STRUCT_SOLID_OPTIONS => size_of::<morula_solid_options>(),
        MORULA_STRUCT_CLUMP_OPTIONS => size_of::<morula_clump_options>(),
        MORULA_STRUCT_REPORT => size_of::<morula_report>(),
        MORULA_STRUCT_MOMENTS => size_of::<morula_moments>(),
        MORULA_STRUCT_OVERLAP => size_of::<morula_overlap>(),
        MORULA_STRUCT_SURFACE => size_of::<morula_surface>(),
        MORULA_STRUCT_COUNTERS => size_of::<morula_counters>(),
        MORULA_STRUCT_MASS_OPTIONS => size_of::<morula_mass_options>(),
        MORULA_STRUCT_MASSES => size_of::<morula_masses>(),
        MORULA_STRUCT_CONTACT_OPTIONS => size_of::<morula_contact_options>(),
        MORULA_STRUCT_TIMESTEP => size_of::<morula_timestep>(),
        MORULA_STRUCT_EXPORT_OPTIONS => size_of::<morula_export_options>(),
        MORULA_STRUCT_BREAK_OPTIONS => size_of::<morula_break_options>(),
        MORULA_STRUCT_HELD => size_of::<morula_held>(),
        MORULA_STRUCT_FRAGMENT => size_of::<morula_fragment>(),
        MORULA_STRUCT_BREAK_TOTALS => size_of::<morula_break_totals>(),
        MORULA_STRUCT_CACHE_COUNTS => size_of::<morula_cache_counts>(),
        MORULA_STRUCT_COST_OPTIONS => size_of::<morula_cost_options>(),
        MORULA_STRUCT_COST_POINT => size_of::<morula_cost_point>(),
        MORULA_STRUCT_COST_BOUNDS => size_of::<morula_cost_bounds>(),
        MORULA_STRUCT_SWEEP_OPTIONS => size_of::<morula_sweep_options>(),
        MORULA_STRUCT_SWEPT => size_of::<morula_swept>(),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A struct as a later release has it: `b` was appended, then `c`.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Later {
        struct_size: usize,
        a: f64,
        b: f64,
        c: f64,
    }
    unsafe impl Versioned for Later {
        const NAME: &'static str = "later";
        const FIRST: usize = 16;
        const ADDED: &'static [usize] = &[24, 32];
        fn defaults() -> Self {
            Later { struct_size: 32, a: 1.0, b: 2.0, c: 3.0 }
        }
    }

    fn at(size: usize) -> Later {
        Later { struct_size: size, a: 7.0, b: 8.0, c: 9.0 }
    }

    #[test]
    fn an_older_struct_gives_its_own_fields_and_defaults_for_the_rest() {
        let got = |size| unsafe { read(&raw const *Box::new(at(size))) }.map(|l| (l.a, l.b, l.c));
        assert_eq!(got(16), Ok((7.0, 2.0, 3.0)));
        assert_eq!(got(24), Ok((7.0, 8.0, 3.0)));
        assert_eq!(got(28), Ok((7.0, 8.0, 3.0)));
        assert_eq!(got(32), Ok((7.0, 8.0, 9.0)));
        for bad in [0, 8, 15, MOST + 1, usize::MAX] {
            assert!(matches!(got(bad), Err(Error::StructSize(_))), "{bad}");
        }
    }

    #[test]
    fn a_newer_struct_is_taken_while_its_unknown_bytes_are_zero() {
        let mut bytes = [at(48), Later { struct_size: 0, a: 0.0, b: 4.0, c: 0.0 }];
        assert!(unsafe { read(bytes.as_ptr()) }.is_ok());
        bytes[1].a = 1.0;
        let error = unsafe { read(bytes.as_ptr()) }.unwrap_err();
        assert!(matches!(error, Error::StructSize(_)), "{error}");
    }

    #[test]
    fn filling_writes_only_what_the_caller_knows() {
        let mut old = at(16);
        unsafe { fill(&mut old, &Later::defaults()) }.unwrap();
        assert_eq!(old, Later { struct_size: 16, a: 1.0, b: 8.0, c: 9.0 });
        let mut new = [at(40), at(5)];
        unsafe { fill(new.as_mut_ptr(), &Later::defaults()) }.unwrap();
        assert_eq!(new[0], Later { struct_size: 40, ..Later::defaults() });
        assert_eq!(new[1], Later { struct_size: 0, ..at(0) });
        let mut short = at(15);
        assert!(unsafe { fill(&mut short, &Later::defaults()) }.is_err());
        assert_eq!(short, at(15));
    }
}
