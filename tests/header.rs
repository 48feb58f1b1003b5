//! The committed header is what the code gives. `MORULA_WRITE_HEADER=1` rewrites it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The header's order of reading.
const FILES: [&str; 27] = [
    "status",
    "callbacks",
    "choices",
    "structs",
    "mass_structs",
    "fragment_structs",
    "cost_structs",
    "shape",
    "file",
    "voxels",
    "silhouettes",
    "primitive",
    "solid",
    "clump",
    "clump_read",
    "warnings",
    "clumps",
    "cost",
    "sweep",
    "body",
    "body_read",
    "export",
    "parent",
    "fragment",
    "reshape",
    "fragment_read",
    "serial",
];

fn generate() -> String {
    let mut config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    let part = |name: &str, value: &str| format!("#define MORULA_VERSION_{name} {value}\n");
    config.after_includes = Some(format!(
        "\n/* The version of this header; morula_version() is that of the library. */\n{}{}{}{}{}",
        part("MAJOR", env!("CARGO_PKG_VERSION_MAJOR")),
        part("MINOR", env!("CARGO_PKG_VERSION_MINOR")),
        part("PATCH", env!("CARGO_PKG_VERSION_PATCH")),
        format_args!("#define MORULA_VERSION_STRING \"{}\"\n", env!("CARGO_PKG_VERSION")),
        "#define MORULA_VERSION \\\n  (1000000u * MORULA_VERSION_MAJOR + 1000u * MORULA_VERSION_MINOR + MORULA_VERSION_PATCH)",
    ));
    let mut builder = cbindgen::Builder::new().with_config(config);
    for name in FILES {
        builder = builder.with_src(root().join(format!("src/ffi/{name}.rs")));
    }
    let mut out = Vec::new();
    builder.generate().unwrap().write(&mut out);
    String::from_utf8(out).unwrap()
}

#[test]
fn the_committed_header_is_current() {
    let path = root().join("include/morula.h");
    let fresh = generate();
    if std::env::var_os("MORULA_WRITE_HEADER").is_some() {
        std::fs::write(&path, &fresh).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    let differs = fresh.lines().zip(committed.lines()).position(|(a, b)| a != b);
    assert!(
        fresh == committed,
        "include/morula.h differs from the code from line {} on: run MORULA_WRITE_HEADER=1 cargo test --test header",
        differs.map_or(fresh.lines().count().min(committed.lines().count()), |l| l) + 1
    );
}

#[test]
fn every_file_of_the_room_that_exports_is_in_the_header() {
    let of = |folder: &str| std::fs::read_dir(root().join(folder)).unwrap();
    // Below the room itself there are only tests.
    for entry in of("src/ffi").chain(of("src/ffi/roads")) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            assert!(path.ends_with("roads"), "{}", path.display());
            continue;
        }
        let exports = std::fs::read_to_string(&path).unwrap().contains("no_mangle");
        let name = path.file_stem().and_then(|s| s.to_str()).unwrap().to_owned();
        assert!(!exports || FILES.contains(&name.as_str()), "{name}");
    }
}

#[test]
fn structs_have_no_padding_and_the_size_that_the_library_says() {
    let header = std::fs::read_to_string(root().join("include/morula.h")).unwrap();
    let mut seen = 0;
    for which in 1.. {
        let size = morula::ffi::morula_sizeof(which);
        if size == 0 {
            break;
        }
        seen += 1;
        let name = header
            .lines()
            .filter_map(|l| l.strip_prefix("#define MORULA_STRUCT_"))
            .find_map(|l| l.strip_suffix(&format!(" {which}")))
            .unwrap_or_else(|| panic!("MORULA_STRUCT_* {which} is not in the header"));
        let name = format!("morula_{}", name.to_lowercase());
        assert_eq!(sum_of_fields(&header, &name), size, "{name} has padding");
    }
    // Beside the ten handles.
    assert_eq!(seen + 10, header.matches("\ntypedef struct morula_").count());
}

/// Adds up the sizes of a struct's fields as the header declares them.
fn sum_of_fields(header: &str, name: &str) -> usize {
    let body = header
        .split(&format!("typedef struct {name} {{"))
        .nth(1)
        .and_then(|rest| rest.split('}').next())
        .unwrap_or_else(|| panic!("{name} is not in the header"));
    let mut sum = 0;
    for line in body.lines().map(str::trim).filter(|l| l.ends_with(';') && !l.starts_with('/')) {
        let declaration = line.trim_end_matches(';');
        let each = match declaration {
            d if d.contains('*') || d.starts_with("size_t") || d.starts_with("morula_") => {
                size_of::<usize>()
            }
            d if d.starts_with("double") || d.starts_with("uint64_t") => 8,
            d if d.starts_with("int32_t") || d.starts_with("uint32_t") => 4,
            d => panic!("{name}: unknown field {d}"),
        };
        let count = declaration
            .split_once('[')
            .map_or(1, |(_, n)| n.trim_end_matches(']').parse::<usize>().unwrap());
        sum += each * count;
    }
    sum
}

#[test]
fn the_header_compiles_alone_as_c_and_cpp() {
    let header = root().join("include/morula.h");
    for standard in ["c99", "c11", "c17"] {
        compile(&["cc", "gcc", "clang"], &["-x", "c", "-Wstrict-prototypes"], standard, &header);
    }
    for standard in ["c++17", "c++20"] {
        compile(&["c++", "g++", "clang++"], &["-x", "c++"], standard, &header);
    }
}

/// Accepted by each compiler that is here, alone in its file and without a word.
fn compile(tools: &[&str], flags: &[&str], standard: &str, file: &Path) {
    for tool in tools {
        let out = std::process::Command::new(tool)
            .args(["-fsyntax-only", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror"])
            .arg(format!("-std={standard}"))
            .args(flags)
            .arg(file)
            .output();
        match out {
            Err(_) => println!("skipped: {tool} is not installed"),
            Ok(o) => {
                let said = String::from_utf8_lossy(&o.stderr);
                assert!(o.status.success(), "{tool} -std={standard}: {said}");
            }
        }
    }
}
