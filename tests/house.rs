//! The rules of the house that no compiler checks.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// Every Rust file of the library and the command line, relative to `src`.
fn sources() -> Vec<(String, String)> {
    rust_files("src")
}

/// Every Rust file below a folder, relative to it.
fn rust_files(folder: &str) -> Vec<(String, String)> {
    fn walk(folder: &Path, out: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, out);
            } else if path.extension().is_some_and(|e| e == "rs") {
                out.push(path);
            }
        }
    }
    let src = root().join(folder);
    let mut paths = Vec::new();
    walk(&src, &mut paths);
    paths.sort();
    paths
        .into_iter()
        .map(|p| {
            let name = p.strip_prefix(&src).unwrap().to_string_lossy().replace('\\', "/");
            (name, std::fs::read_to_string(&p).unwrap())
        })
        .collect()
}

fn version(text: &str) -> Vec<u32> {
    let mut v: Vec<u32> = text.split('.').map(|n| n.parse().unwrap_or(0)).collect();
    v.resize(3, 0);
    v
}

/// The packages of the lock file as cargo knows them without a network: all of
/// them, or those of this platform when others were never downloaded.
fn metadata() -> Value {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let about = Command::new(rustc).arg("-vV").output().unwrap();
    let about = String::from_utf8(about.stdout).unwrap();
    let host = about.lines().find_map(|l| l.strip_prefix("host: ")).unwrap().to_string();
    let mut last = String::new();
    for platform in [None, Some(host)] {
        let mut command = Command::new(&cargo);
        command.current_dir(root());
        command.args(["metadata", "--locked", "--offline", "--format-version", "1"]);
        if let Some(host) = &platform {
            command.args(["--filter-platform", host]);
        }
        let output = command.output().unwrap();
        if output.status.success() {
            return serde_json::from_slice(&output.stdout).unwrap();
        }
        last = String::from_utf8_lossy(&output.stderr).into_owned();
    }
    panic!("cargo metadata failed: {last}");
}

#[test]
fn rust_version_is_at_least_the_greatest_in_the_lock_file() {
    let metadata = metadata();
    let packages = metadata["packages"].as_array().unwrap();
    let of = |p: &Value| p["rust_version"].as_str().map(version);
    let ours = packages.iter().find(|p| p["name"] == "morula").and_then(of).unwrap();
    assert!(packages.len() > 10, "only {} packages", packages.len());
    for p in packages {
        if let Some(theirs) = of(p) {
            assert!(ours >= theirs, "{} needs Rust {theirs:?}, ours is {ours:?}", p["name"]);
        }
    }
}

#[test]
fn panics_unwind_and_no_profile_uses_fat_lto() {
    let cargo = read("Cargo.toml");
    let mut section = String::new();
    let mut unwinding = Vec::new();
    for line in cargo.lines().map(str::trim) {
        if line.starts_with('[') {
            section = line.to_string();
        }
        let Some((key, value)) = line.split_once('=').map(|(k, v)| (k.trim(), v.trim())) else {
            continue;
        };
        if section.starts_with("[profile") && key == "panic" {
            assert_eq!(value, "\"unwind\"", "{section}");
            unwinding.push(section.clone());
        }
        if key == "lto" {
            assert!(value != "\"fat\"" && value != "true", "{section}: lto = {value}");
        }
    }
    for profile in ["[profile.dev]", "[profile.release]"] {
        assert!(unwinding.iter().any(|s| s == profile), "{profile} does not say panic");
    }
}

#[test]
fn the_shared_library_has_its_soname() {
    assert!(read("build.rs").contains("-soname,libmorula.so.0"));
}

#[test]
fn unsafe_lives_in_the_c_border_alone() {
    let cargo = read("Cargo.toml");
    assert!(cargo.contains("unsafe_code = \"deny\""));
    for (name, text) in sources() {
        if name.starts_with("ffi/") {
            continue;
        }
        for (i, line) in text.lines().enumerate() {
            let code = line.split("//").next().unwrap_or("");
            let word = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            for w in word {
                assert!(w != "unsafe" && w != "unsafe_code", "src/{name}:{}: {line}", i + 1);
            }
        }
    }
}

/// The rooms in the order of the data, each with what stands above it.
const ROOMS: [(&str, &[&str]); 13] = [
    ("error", &[]),
    ("math", &["error"]),
    ("run", &["error", "math"]),
    ("shape", &["error", "math", "run"]),
    ("solid", &["error", "math", "run", "shape"]),
    ("measure", &["error", "math", "run", "shape", "solid"]),
    ("clump", &["error", "math", "run", "shape", "solid", "measure"]),
    ("generate", &["error", "math", "run", "shape", "solid", "measure", "clump"]),
    ("mass", &["error", "math", "run", "shape", "solid", "measure", "clump"]),
    ("cost", &["error", "math", "run", "shape", "solid", "measure", "clump", "generate", "mass"]),
    (
        "fragment",
        &["error", "math", "run", "shape", "solid", "measure", "clump", "generate", "mass"],
    ),
    ("export", &["error", "math", "run", "shape", "solid", "measure", "clump", "mass"]),
    (
        "dem",
        &[
            "error", "math", "run", "shape", "solid", "measure", "clump", "generate", "mass",
            "fragment", "export", "serial",
        ],
    ),
];

/// The room of a source file: its first folder, or the file itself.
fn room(name: &str) -> &str {
    name.split('/').next().unwrap_or(name).trim_end_matches(".rs")
}

/// The rooms that a source names after `crate::`, with the line.
fn named_rooms(text: &str) -> Vec<(usize, String)> {
    let code: Vec<&str> = text.lines().map(|l| l.split("//").next().unwrap_or("")).collect();
    let code = code.join("\n");
    let mut out = Vec::new();
    for (at, mark) in code.match_indices("crate::") {
        let line = 1 + code[..at].matches('\n').count();
        let rest = &code[at + mark.len()..];
        // A group counts each of its members; what a member holds in turn does not matter.
        let mut depth = 0;
        let mut fresh = true;
        let mut word = String::new();
        for c in rest.chars() {
            if fresh && depth <= 1 && (c.is_alphanumeric() || c == '_') {
                word.push(c);
                continue;
            }
            if !word.is_empty() {
                out.push((line, std::mem::take(&mut word)));
                fresh = false;
            }
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 1 => fresh = true,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
    }
    out
}

#[test]
fn named_rooms_are_found_in_groups() {
    let text = "use crate::{\n    math::{Vec3, Sphere}, // crate::no\n    Run,\n};\nlet x = crate::solid::Grid;";
    let found: Vec<String> = named_rooms(text).into_iter().map(|(_, w)| w).collect();
    assert_eq!(found, ["math", "Run", "solid"]);
}

#[test]
fn rooms_import_only_from_rooms_above_them() {
    // The re-exports at the root of the crate, and the rooms where they live.
    let homes = [
        ("Clump", "clump"),
        ("Error", "error"),
        ("Result", "error"),
        ("Sphere", "math"),
        ("Run", "run"),
        ("Shape", "shape"),
        ("Solid", "solid"),
    ];
    let mut seen = 0;
    for (name, text) in sources() {
        let here = room(&name);
        let Some((_, above)) = ROOMS.iter().find(|(r, _)| *r == here) else {
            continue;
        };
        for (line, word) in named_rooms(&text) {
            let there = homes.iter().find(|(w, _)| *w == word).map_or(word.as_str(), |(_, r)| *r);
            seen += 1;
            assert!(
                there == here || above.contains(&there),
                "src/{name}:{line}: the room {here} may not import from {there}"
            );
        }
    }
    assert!(seen > 20, "only {seen} imports found");
}

#[test]
fn the_command_line_does_without_the_c_border() {
    for (name, text) in sources() {
        if name.starts_with("bin/") {
            assert!(!text.contains("morula::ffi"), "src/{name}");
        }
    }
}

#[test]
fn one_file_names_each_borrowed_engine() {
    for (krate, home) in [("parry3d", "solid/nearest"), ("rayon", "run"), ("clarabel", "mass/cone")]
    {
        for (name, text) in sources() {
            if !name.starts_with(home) {
                let used = text.lines().any(|l| {
                    let code = l.split("//").next().unwrap_or("");
                    code.contains(&format!("{krate}::"))
                });
                assert!(!used, "src/{name} names {krate}");
            }
        }
    }
}

#[test]
fn tests_are_never_ignored() {
    for folder in ["src", "tests"] {
        for (name, text) in rust_files(folder) {
            assert!(!text.contains(concat!("#[", "ignore")), "{folder}/{name}");
        }
    }
}

/// Whether a licence expression of the packages' kind is met by what `allowed` says of each
/// name: `A OR B`, `A/B`, `A AND B`, `A WITH x`, parentheses.
fn met(expression: &str, allowed: &impl Fn(&str) -> bool) -> bool {
    let text = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let mut words: Vec<&str> = text.split_whitespace().rev().collect();
    let met = any(&mut words, allowed);
    assert!(words.is_empty(), "not understood: {expression}");
    met
}

fn any(words: &mut Vec<&str>, allowed: &impl Fn(&str) -> bool) -> bool {
    let mut met = all(words, allowed);
    while words.last() == Some(&"OR") {
        words.pop();
        met |= all(words, allowed);
    }
    met
}

fn all(words: &mut Vec<&str>, allowed: &impl Fn(&str) -> bool) -> bool {
    let mut met = true;
    loop {
        met &= match words.pop() {
            Some("(") => {
                let inner = any(words, allowed);
                assert_eq!(words.pop(), Some(")"));
                inner
            }
            Some(name) if words.last() == Some(&"WITH") => {
                words.pop();
                allowed(&format!("{name} WITH {}", words.pop().unwrap()))
            }
            Some(name) => allowed(name),
            None => panic!("a licence expression ends too early"),
        };
        if words.last() != Some(&"AND") {
            return met;
        }
        words.pop();
    }
}

#[test]
fn licence_expressions_are_understood() {
    let allowed = |name: &str| name == "A" || name == "B WITH x";
    for (expression, expected) in [
        ("A", true),
        ("C", false),
        ("C/A", true),
        ("A OR C AND C", true),
        ("C OR A AND C", false),
        ("(C OR A) AND C", false),
        ("(A OR C) AND B WITH x", true),
        ("B", false),
    ] {
        assert_eq!(met(expression, &allowed), expected, "{expression}");
    }
}

#[test]
fn every_package_has_a_licence_that_deny_toml_allows() {
    let deny = read("deny.toml");
    let quoted = |line: &str| -> Vec<String> {
        line.split('"').skip(1).step_by(2).map(str::to_owned).collect()
    };
    let line = |start: &str| deny.lines().find(|l| l.starts_with(start)).map(quoted).unwrap();
    let (allow, exception) = (line("allow = "), line("exceptions = "));
    assert!(!allow.is_empty() && exception.len() == 2);
    let metadata = metadata();
    for p in metadata["packages"].as_array().unwrap() {
        let (name, licence) = (p["name"].as_str().unwrap(), p["license"].as_str());
        let licence = licence.unwrap_or_else(|| panic!("{name} names no licence"));
        let allowed =
            |l: &str| allow.iter().any(|a| a == l) || (exception[0] == name && exception[1] == l);
        assert!(met(licence, &allowed), "{name}: {licence}");
    }
}
