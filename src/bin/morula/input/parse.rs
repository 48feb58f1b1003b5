//! Numbers and sizes as they are typed.

use morula::shape::read::RawType;

/// Dimensions (x fastest), element type and header bytes of raw voxels.
pub type Raw = ([usize; 3], RawType, usize);

/// A finite number.
pub fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(v) if v.is_finite() => Ok(v),
        _ => Err(format!("{text} is not a finite number")),
    }
}

/// A number greater than 0.
pub fn positive(text: &str) -> Result<f64, String> {
    finite(text).and_then(|v| if v > 0.0 { Ok(v) } else { Err(format!("{text} is not above 0")) })
}

/// A number of at least 0.
pub fn not_negative(text: &str) -> Result<f64, String> {
    finite(text).and_then(|v| if v >= 0.0 { Ok(v) } else { Err(format!("{text} is below 0")) })
}

/// A whole number of at least 0.
pub fn whole<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{text} is not a whole number from 0 on"))
}

/// A whole number of at least 1.
pub fn above_0(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n) if n > 0 => Ok(n),
        _ => Err(format!("{text} is not a whole number from 1 on")),
    }
}

/// As [`triple`], all of them above 0.
pub fn positive_triple(text: &str) -> Result<[f64; 3], String> {
    match triple(text)? {
        v if v.iter().all(|h| *h > 0.0) => Ok(v),
        _ => Err(format!("{text} is not above 0")),
    }
}

/// One number for all three axes, or three with commas.
pub fn triple(text: &str) -> Result<[f64; 3], String> {
    let values = text.split(',').map(finite).collect::<Result<Vec<_>, _>>()?;
    match values[..] {
        [a] => Ok([a; 3]),
        [a, b, c] => Ok([a, b, c]),
        _ => Err(format!("{text} holds {} numbers, not 1 or 3", values.len())),
    }
}

/// N numbers with commas.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let values = text.split(',').map(finite).collect::<Result<Vec<_>, _>>()?;
    let count = values.len();
    values.try_into().map_err(|_| format!("{text} holds {count} numbers, not {N}"))
}

pub fn raw(text: &str) -> Result<Raw, String> {
    let mut parts = text.split(':');
    let dims = parts
        .next()
        .unwrap_or("")
        .split('x')
        .map(|n| n.parse::<usize>().map_err(|_| format!("{n} is not a number of cells")))
        .collect::<Result<Vec<_>, _>>()?;
    let [nx, ny, nz] = dims[..] else {
        return Err(format!("{text} names {} dimensions, not 3", dims.len()));
    };
    let element = match parts.next() {
        None | Some("u8") => RawType::U8,
        Some("u16") => RawType::U16,
        Some("f32") => RawType::F32,
        Some(other) => return Err(format!("{other} is none of u8, u16, f32")),
    };
    let skip = match parts.next() {
        None => 0,
        Some(n) => n.parse().map_err(|_| format!("{n} is not a number of bytes"))?,
    };
    Ok(([nx, ny, nz], element, skip))
}

pub fn bytes(text: &str) -> Result<u64, String> {
    let split = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (digits, unit) = text.split_at(split);
    let shift = match unit {
        "" | "B" => 0,
        "KiB" => 10,
        "MiB" => 20,
        "GiB" => 30,
        _ => return Err(format!("{unit} is none of B, KiB, MiB, GiB")),
    };
    let value = finite(digits)? * f64::from(1u32 << shift);
    if (0.0..1e18).contains(&value) { Ok(value as u64) } else { Err(format!("{text} is no size")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_triples_parse() {
        assert_eq!(bytes("2GiB"), Ok(2 << 30));
        assert_eq!(bytes("1.5KiB"), Ok(1536));
        assert_eq!(bytes("77"), Ok(77));
        assert!(bytes("-1").is_err() && bytes("3 cats").is_err() && bytes("1e30").is_err());
        assert_eq!(triple("2"), Ok([2.0; 3]));
        assert_eq!(triple("1,2.5,-3"), Ok([1.0, 2.5, -3.0]));
        assert!(triple("1,2").is_err() && triple("1,nan,2").is_err());
        assert!(positive_triple("1,0,2").is_err() && positive_triple("-1").is_err());
        assert_eq!(positive_triple("0.5"), Ok([0.5; 3]));
        assert_eq!((whole("7"), above_0("7")), (Ok(7usize), Ok(7)));
        assert!(whole::<usize>("-1").is_err() && whole::<u32>("1.5").is_err());
        assert!(above_0("0").is_err() && above_0("4294967296").is_err());
    }

    #[test]
    fn raw_layouts_parse() {
        assert_eq!(raw("4x5x6"), Ok(([4, 5, 6], RawType::U8, 0)));
        assert_eq!(raw("4x5x6:u16:512"), Ok(([4, 5, 6], RawType::U16, 512)));
        assert!(raw("4x5").is_err() && raw("4x5x6:i8").is_err() && raw("axbxc").is_err());
    }
}
