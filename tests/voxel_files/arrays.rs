//! NumPy arrays: types, orders, versions, faults.

use super::*;

/// An npy file with this header text, version 1 to 3.
pub fn npy_text(version: u8, text: &str, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    let length = text.len() as u32;
    bytes.extend(&length.to_le_bytes()[..if version == 1 { 2 } else { 4 }]);
    bytes.extend(text.as_bytes());
    bytes.extend(data);
    bytes
}

pub fn npy(descr: &str, fortran: bool, shape: [usize; 3], data: &[u8]) -> Vec<u8> {
    let [a, b, c] = shape;
    let order = if fortran { "True" } else { "False" };
    let text = format!(
        "{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({a}, {b}, {c}), }}   \n"
    );
    npy_text(1, &text, data)
}

/// The bytes of BODY with each value encoded, in the order of a file whose
/// first axis is x (slowest last) or z.
pub fn encoded(x_fastest: bool, number: &dyn Fn(u8) -> Vec<u8>) -> Vec<u8> {
    let mut out = Vec::new();
    if x_fastest {
        BODY.iter().for_each(|&v| out.extend(number(v)));
    } else {
        for i in 0..4 {
            for j in 0..3 {
                for k in 0..2 {
                    out.extend(number(BODY[i + 4 * (j + 3 * k)]));
                }
            }
        }
    }
    out
}

#[test]
fn every_npy_type_and_order_gives_the_same_cells() {
    type Number = Box<dyn Fn(u8) -> Vec<u8>>;
    let types: Vec<(&str, Number)> = vec![
        ("|b1", Box::new(|v| vec![v])),
        ("|u1", Box::new(|v| vec![v * 255])),
        ("|i1", Box::new(|v| vec![v])),
        ("<u2", Box::new(|v| (u16::from(v) * 256).to_le_bytes().into())),
        (">u2", Box::new(|v| (u16::from(v) * 256).to_be_bytes().into())),
        ("<i2", Box::new(|v| (i16::from(v) * -300).to_le_bytes().into())),
        (">i2", Box::new(|v| (i16::from(v) * 3).to_be_bytes().into())),
        ("<u4", Box::new(|v| (u32::from(v) << 24).to_le_bytes().into())),
        (">u4", Box::new(|v| (u32::from(v) << 24).to_be_bytes().into())),
        ("<i4", Box::new(|v| (i32::from(v) * -70000).to_le_bytes().into())),
        ("<i8", Box::new(|v| i64::from(v).to_le_bytes().into())),
        (">u8", Box::new(|v| u64::from(v).to_be_bytes().into())),
        ("<f4", Box::new(|v| (f32::from(v) * 0.3).to_le_bytes().into())),
        (">f4", Box::new(|v| (f32::from(v) * 0.3).to_be_bytes().into())),
        ("<f8", Box::new(|v| (f64::from(v) * 0.3).to_le_bytes().into())),
        (">f8", Box::new(|v| (f64::from(v) * 0.3).to_be_bytes().into())),
    ];
    for (descr, number) in &types {
        for npy_xyz in [false, true] {
            for fortran in [false, true] {
                // Fortran order of (x, y, z) and C order of (z, y, x) have x fastest.
                let data = encoded(fortran == npy_xyz, number);
                let shape = if npy_xyz { [4, 3, 2] } else { [2, 3, 4] };
                let bytes = npy(descr, fortran, shape, &data);
                let o = FileOptions { npy_xyz, ..options() };
                let shape = read(&bytes, "x.npy", &o).unwrap();
                assert_eq!(
                    cells(&shape),
                    ([4, 3, 2], BODY.to_vec()),
                    "{descr} {npy_xyz} {fortran}"
                );
                let rounded = shape.report.notes.iter().any(|n| n.contains("double"));
                assert_eq!(rounded, descr.ends_with("f8"));
            }
        }
    }
}

#[test]
fn npy_versions_and_spellings() {
    let data = encoded(true, &|v| vec![v]);
    for (version, text) in [
        (1, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 4)}"),
        (2, "{\"shape\":(2,3,4),\"descr\":\"u1\",\"fortran_order\":False}\n"),
        (3, "  {'fortran_order': False, 'shape': (2, 3, 4,), 'descr': '|b1', }     "),
    ] {
        let shape = read(&npy_text(version, text, &data), "", &options()).unwrap();
        assert_eq!(cells(&shape).1, BODY);
    }
}

#[test]
fn malformed_npy_is_refused_by_byte() {
    let good = npy("|u1", false, [2, 3, 4], &BODY);
    for end in 1..good.len() {
        let e = read(&good[..end], "x.npy", &options()).unwrap_err();
        assert!(matches!(e, Error::Format(_) | Error::Unsupported(_)), "{end}: {e}");
        if end > 6 {
            assert!(e.to_string().contains(&format!("byte {end}")), "{end}: {e}");
        }
    }
    let mut longer = good.clone();
    longer.push(0);
    assert!(matches!(read(&longer, "x.npy", &options()), Err(Error::Format(_))));

    let tests = [
        ("{'descr': '|u1', 'fortran_order': False, 'shape': (8, 8)}", 10, "2 axes"),
        ("{'descr': '|u1', 'fortran_order': False, 'shape': ()}", 10, "0 axes"),
        ("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 999999999)}", 9, "byte"),
        (
            "{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296, 9)}",
            17,
            "counted",
        ),
        (
            "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999, 1, 1)}",
            9,
            "counted",
        ),
        ("{'descr': '<c8', 'fortran_order': False, 'shape': (2, 3, 4)}", 10, "<c8"),
        ("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 3, 4)}", 10, "structured"),
        ("{'descr': '|u1', 'fortran_order': false, 'shape': (2, 3, 4)}", 9, "byte 44"),
        ("{'descr': '|u1', 'fortran_order': False, 'shape': (2, -3, 4)}", 9, "byte 64"),
        ("{'descr': '|u1', 'fortran_order': False}", 9, "lacks"),
        ("{'descr': '|u1', 'descr': '|u1', 'shape': (2, 3, 4)}", 9, "each once"),
        ("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 4), 'x': 1}", 9, "each once"),
        ("{'descr': '|u1", 9, "a string that ends"),
        ("os.system('rm')", 9, "byte 10"),
    ];
    for (text, status, part) in tests {
        let e = read(&npy_text(1, text, &BODY), "x.npy", &options()).unwrap_err();
        assert_eq!(e.status(), status, "{text}: {e}");
        assert!(e.to_string().contains(part), "{text}: {e}");
    }
    let e = read(&npy_text(9, "", &[]), "x.npy", &options()).unwrap_err();
    assert!(e.to_string().contains("version 9"), "{e}");
    let empty = read(&npy("|u1", false, [0, 4, 4], &[]), "x.npy", &options()).unwrap_err();
    assert!(matches!(empty, Error::Empty(_)), "{empty}");
    // No loop over the axes that are not empty.
    let text = "{'descr': '|u1', 'fortran_order': True, 'shape': (1, 1152921504606846976, 0), }";
    let huge = read(&npy_text(1, text, &[]), "x.npy", &options()).unwrap_err();
    assert!(matches!(huge, Error::Empty(_)), "{huge}");
    let nan: Vec<u8> = [0.0f64, 1.0, f64::NAN, 0.0].iter().flat_map(|v| v.to_le_bytes()).collect();
    let e = read(&npy("<f8", false, [1, 1, 4], &nan), "x.npy", &options()).unwrap_err();
    assert_eq!(e, Error::NotFinite("voxel 2 is NaN".into()));
    let mut small = options();
    small.import.memory_limit = 23;
    let e = read(&good, "x.npy", &small).unwrap_err();
    assert!(matches!(e, Error::MemoryLimit(_)), "{e}");
}
