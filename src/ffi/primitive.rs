//! The built-in analytic particles by name.

use super::guard::{copy_text, guard, require, slice, text};
use super::shape::{make, morula_shape, put};
use super::structs::morula_import_options;
use crate::error::Error;
use crate::run::Run;
use crate::shape::{ImportOptions, Primitive, Shape};
use std::ffi::{CStr, c_char};

const NAMES: [&CStr; Primitive::NAMES.len()] = [
    c"sphere",
    c"ellipsoid",
    c"superellipsoid",
    c"box",
    c"cylinder",
    c"capsule",
    c"torus",
    c"cone",
    c"tablet",
    c"mandm",
    c"stone",
];

/// The name of the built-in analytic particle number `index`, counted from 0.
///
/// Returns: static text; NULL when there are no more. Do not free it.
/// Threads: any thread at any time.
#[unsafe(no_mangle)]
pub extern "C" fn morula_primitive_name(index: usize) -> *const c_char {
    NAMES.get(index).map_or(std::ptr::null(), |n| n.as_ptr())
}

/// How many parameters a built-in particle has.
///
/// Parameters: `name` is one of morula_primitive_name().
/// Returns: MORULA_STATUS_OK; NULL_POINTER; UNSUPPORTED (no such name).
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_primitive_parameter_count(
    name: *const c_char,
    count: *mut usize,
) -> i32 {
    guard(|| {
        let primitive = Primitive::from_name(unsafe { text(name, "name")? })?;
        unsafe { put(count, primitive.parameters().len(), "count") }
    })
}

/// Copies the key of parameter `index` (from 0) with its closing NUL, and its default.
///
/// Parameters: `key` has room for `capacity` bytes; `length` (may be NULL)
/// becomes the length without the NUL; with `key` NULL and `capacity` 0 the key
/// is not copied. `value` (may be NULL) becomes the default.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; UNSUPPORTED (no such name);
/// INDEX_OUT_OF_RANGE; BUFFER_TOO_SMALL (nothing is written).
/// Threads: any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_primitive_copy_parameter(
    name: *const c_char,
    index: usize,
    capacity: usize,
    key: *mut c_char,
    length: *mut usize,
    value: *mut f64,
) -> i32 {
    guard(|| {
        let all = Primitive::from_name(unsafe { text(name, "name")? })?.parameters();
        let parameter = all.get(index).ok_or_else(|| {
            Error::IndexOutOfRange(format!(
                "parameter {index} does not exist, there are {}",
                all.len()
            ))
        })?;
        if !value.is_null() {
            require(value, "value")?;
        }
        // Nothing of the key may be asked for.
        if capacity > 0 || !key.is_null() || !length.is_null() {
            unsafe { copy_text(parameter.key, capacity, key, length)? };
        }
        if !value.is_null() {
            unsafe { put(value, parameter.value, "value")? };
        }
        Ok(())
    })
}

/// Makes a shape of a built-in analytic particle, centred on the origin, its
/// axis of revolution along z. Their names, parameters and defaults (lengths in
/// the caller's unit; a tablet and an M&M of millimetres):
///
///   sphere          radius = 1.0            radius
///   ellipsoid       a = 1.0                 semi-axis along x
///                   b = 0.75                semi-axis along y
///                   c = 0.5                 semi-axis along z
///   superellipsoid  a = 1.0                 semi-axis along x
///                   b = 0.75                semi-axis along y
///                   c = 0.5                 semi-axis along z
///                   e1 = 0.5                exponent along z, 0.1 to 2.5; 1 is round, less boxier
///                   e2 = 0.5                exponent in the xy plane, likewise
///   box             a = 1.0                 edge along x
///                   b = 1.0                 edge along y
///                   c = 1.0                 edge along z
///   cylinder        radius = 0.5            radius
///                   height = 1.0            height along z
///   capsule         radius = 0.5            radius, also of the caps
///                   height = 1.0            height along z of the cylinder, without the caps
///   torus           major = 1.0             radius of the centre line, about z
///                   minor = 0.4             radius of the tube, less than major
///   cone            radius = 1.0            radius of the base, which is below
///                   height = 2.0            height along z; the centroid is at the origin
///   tablet          band_radius = 5.675     radius of the band
///                   band_height = 4.0       height of the band along z
///                   cap_height = 1.23       height of each cap, at most band_radius
///   mandm           radius = 6.7            equatorial radius
///                   flatness = 6.93/13.4    short axis (along z) over the long one, at most 1
///   stone           seed = 1.0              which stone, a whole number from 0 to 2^53
///                   diameter = 1.0          diameter of the sphere of equal volume
///                   roughness = 0.5         size of the facets and roughness, 0 to 1
///
/// A superellipsoid is the body (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) <= 1.
///
/// Parameters: `name` is one of morula_primitive_name(); `keys` and `values`
/// set `count` of its parameters (the keys of the table, which
/// morula_primitive_copy_parameter() gives as well; NULL with a count of 0 keeps
/// the defaults); `segments` is about the number of edges around the body (0:
/// 64); `seed` is that of a stone unless a key sets it, and is not read by the
/// others; `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; UNSUPPORTED (no such name);
/// INVALID_ARGUMENT (a key, a value or an option); STRUCT_SIZE; NOT_FINITE;
/// TOO_LARGE; MEMORY_LIMIT; OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: strings and arrays are copied; free *shape with
/// morula_shape_free(). *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_primitive(
    name: *const c_char,
    keys: *const *const c_char,
    values: *const f64,
    count: usize,
    segments: u32,
    seed: u64,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let from = |import: &ImportOptions, run: &Run| {
        let mut primitive = Primitive::from_name(unsafe { text(name, "name")? })?;
        if let Primitive::Stone { seed: which, .. } = &mut primitive {
            *which = seed;
        }
        let (keys, values) =
            unsafe { (slice(keys, count, "keys")?, slice(values, count, "values")?) };
        for (key, value) in keys.iter().zip(values) {
            let key = unsafe { text(*key, "one of the keys")? };
            if !value.is_finite() {
                return Err(Error::NotFinite(format!("the value of {key} is {value}")));
            }
            primitive.set(key, *value)?;
        }
        let segments = if segments == 0 { 64 } else { segments as usize };
        Shape::from_primitive(&primitive, segments, import, run)
    };
    unsafe { make(options, shape, from) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_the_librarys() {
        for (ours, theirs) in NAMES.iter().zip(Primitive::NAMES) {
            assert_eq!(ours.to_str(), Ok(theirs));
        }
        assert!(morula_primitive_name(NAMES.len()).is_null());
    }

    #[test]
    fn the_table_of_the_comment_is_the_librarys() {
        let mut table = String::new();
        for name in Primitive::NAMES {
            let mut first = name;
            for p in Primitive::from_name(name).unwrap().parameters() {
                let value = format!("{:?}", p.value).replace("0.5171641791044775", "6.93/13.4");
                let set = format!("{} = {value}", p.key);
                table += &format!("///   {first:<16}{set:<24}{}\n", p.meaning);
                first = "";
            }
        }
        assert!(include_str!("primitive.rs").contains(&table), "it should be\n{table}");
    }
}
