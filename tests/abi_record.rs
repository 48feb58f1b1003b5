//! The ABI against its committed record, `tests/morula.abi`: what programs may be linked to.
//! Under one soname its lines are only added (`MORULA_WRITE_ABI=1` does it), never changed.
//! That the built library exports these functions and no others is a test of CTest.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod common;

use common::c_header::{self, Declaration, Header};
use std::collections::BTreeSet;
use std::path::PathBuf;

const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/morula.abi");
const HEAD: &str =
    "# What programs may be linked to, on 64-bit systems; kept by tests/abi_record.rs.\n";

/// Bytes of a field.
fn size(of: &str, field: &Declaration) -> usize {
    let each = match of {
        "int32_t" | "uint32_t" => 4,
        "double" | "uint64_t" | "size_t" | "morula_progress" => 8,
        pointer if pointer.ends_with('*') => 8,
        other => panic!("a field of the type {other}"),
    };
    each * field.dim.unwrap_or(1)
}

/// The type of an array is said with the length.
fn full_type(d: &Declaration) -> String {
    d.of.clone() + &d.dim.map(|n| format!("[{n}]")).unwrap_or_default()
}

/// The lines of the record that the header gives.
fn lines(header: &Header) -> BTreeSet<String> {
    let mut out = BTreeSet::new();
    for (name, value) in &header.constants {
        // Those of the version change with each release.
        if !name.starts_with("MORULA_VERSION") {
            out.insert(format!("constant {name} {value}"));
        }
    }
    for (name, (result, parameters)) in &header.functions {
        let parameters: Vec<String> = parameters.iter().map(full_type).collect();
        out.insert(format!("function {name}({}) {result}", parameters.join(", ")));
    }
    for (name, call) in &header.callbacks {
        out.insert(format!("callback {name} {call}"));
    }
    for (name, fields) in &header.structs {
        let mut offset = 0;
        for f in fields {
            out.insert(format!("field {name} {offset:03} {} {}", f.name, full_type(f)));
            offset += size(&f.of, f);
        }
    }
    out
}

fn record() -> BTreeSet<String> {
    let text = std::fs::read_to_string(RECORD).unwrap_or_default();
    text.lines().filter(|l| !l.starts_with('#')).map(str::to_owned).collect()
}

#[test]
fn what_was_recorded_still_holds_and_what_is_new_is_recorded() {
    let (now, recorded) = (lines(&c_header::read()), record());
    let broken: Vec<&String> = recorded.difference(&now).collect();
    assert!(broken.is_empty(), "programs that are linked already would break: {broken:#?}");
    if std::env::var_os("MORULA_WRITE_ABI").is_some() {
        let text: Vec<&str> = now.iter().map(String::as_str).collect();
        std::fs::write(RECORD, format!("{HEAD}{}\n", text.join("\n"))).unwrap();
    }
    let new: Vec<&String> = now.iter().filter(|l| !record().contains(*l)).collect();
    assert!(
        new.is_empty(),
        "not in tests/morula.abi (MORULA_WRITE_ABI=1 cargo test --test abi_record): {new:#?}"
    );
}

/// The record as assertions, which a C compiler checks with the header.
#[test]
fn a_c_compiler_reads_the_header_as_the_record_says() {
    let mut program = String::from("#include <stddef.h>\n#include \"morula.h\"\n");
    let mut asserted = 0;
    for (i, line) in record().iter().enumerate() {
        let (kind, rest) = line.split_once(' ').unwrap();
        let words: Vec<&str> = rest.split(' ').collect();
        program += &match (kind, &words[..]) {
            ("constant", [name, value]) => {
                format!("_Static_assert({name} == {value}, \"{name}\");\n")
            }
            ("field", [of, offset, name, ..]) => {
                let offset: usize = offset.parse().unwrap();
                format!("_Static_assert(offsetof({of}, {name}) == {offset}, \"{of}.{name}\");\n")
            }
            ("function", _) => {
                let (name, rest) = rest.split_once('(').unwrap();
                let (parameters, result) = rest.rsplit_once(") ").unwrap();
                let parameters = if parameters.is_empty() { "void" } else { parameters };
                format!("{result} (*const f{i})({parameters}) = {name};\n")
            }
            ("callback", [name, ..]) => {
                let (result, parameters) = rest[name.len() + 1..].split_once(' ').unwrap();
                format!("{result} c{i}{parameters};\nconst {name} p{i} = c{i};\n")
            }
            _ => panic!("no line of a record: {line}"),
        };
        asserted += 1;
    }
    assert!(asserted > 200, "only {asserted} lines");
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("abi_record.c");
    std::fs::write(&path, program).unwrap();
    let compiled = std::process::Command::new("cc")
        .args(["-std=c11", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I"])
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/include"))
        .arg(&path)
        .output();
    match compiled {
        Err(_) => println!("skipped: cc is not installed"),
        Ok(o) => assert!(o.status.success(), "{}", String::from_utf8_lossy(&o.stderr)),
    }
}
