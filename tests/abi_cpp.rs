//! `include/morula.hpp` against `include/morula.h`: it reaches every function and defaults every
//! options struct, and compilers take it without a word.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod common;

use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn face() -> String {
    std::fs::read_to_string(format!("{ROOT}/include/morula.hpp")).unwrap()
}

/// Whether a text has a name as a word of its own.
fn names(text: &str, name: &str) -> bool {
    let of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.match_indices(name).any(|(at, _)| {
        !text[at + name.len()..].starts_with(of_word) && !text[..at].ends_with(of_word)
    })
}

#[test]
fn the_face_reaches_every_function() {
    let face = face();
    for name in common::c_header::read().functions.keys() {
        // The sizes of structs are the compiler's here.
        assert!(names(&face, name) || name == "morula_sizeof", "morula.hpp never calls {name}");
    }
}

#[test]
fn every_options_struct_gets_its_defaults() {
    let face = face();
    let header = common::c_header::read();
    let mut seen = 0;
    for name in header.functions.keys().filter_map(|n| n.strip_suffix("_init")) {
        seen += 1;
        assert!(face.contains(&format!("detail::defaults({name}_init)")), "{name} is never filled");
    }
    assert!(seen > 10, "only {seen} options structs");
}

#[test]
fn compilers_take_it_alone_in_every_standard() {
    for tool in ["g++", "clang++"] {
        for standard in ["-std=c++17", "-std=c++20", "-std=c++2b"] {
            let out = Command::new(tool)
                .args([
                    "-fsyntax-only",
                    "-Wall",
                    "-Wextra",
                    "-Wpedantic",
                    "-Wconversion",
                    "-Werror",
                ])
                .args([standard, "-x", "c++"])
                .arg(format!("{ROOT}/include/morula.hpp"))
                .output();
            match out {
                Err(_) => println!("skipped: {tool} is not installed"),
                Ok(o) => {
                    let said = String::from_utf8_lossy(&o.stderr);
                    assert!(o.status.success(), "{tool} {standard}: {said}");
                }
            }
        }
    }
}
