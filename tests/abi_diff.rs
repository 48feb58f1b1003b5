//! `scripts/abi.sh` on headers that were changed on purpose: what breaks linked programs fails,
//! what is added passes and is listed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

use std::path::PathBuf;
use std::process::Command;

/// The header with one change, through the script: whether it passes, and what is said.
/// None when abidiff is not installed.
fn judged(name: &str, change: impl Fn(&str) -> String) -> Option<(bool, String)> {
    let root = env!("CARGO_MANIFEST_DIR");
    // From the baseline, so that what is new in the header of today is no part of it.
    let header = std::fs::read_to_string(format!("{root}/tests/abi/baseline.h")).unwrap();
    let changed = change(&header);
    assert_ne!(header, changed, "{name} changes nothing");
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("abi_diff_{name}.h"));
    std::fs::write(&path, changed).unwrap();
    let script = format!("{root}/scripts/abi.sh");
    let out = Command::new("sh").arg(script).arg("--header").arg(&path).output().unwrap();
    let said =
        String::from_utf8_lossy(&out.stdout).into_owned() + &String::from_utf8_lossy(&out.stderr);
    match out.status.code() {
        Some(3) => {
            println!("skipped: {said}");
            None
        }
        Some(code @ (0 | 1)) => Some((code == 0, said)),
        other => panic!("{name}: the script ended with {other:?}: {said}"),
    }
}

fn with(header: &str, from: &str, to: &str) -> String {
    assert!(header.contains(from), "{from} is not in the header");
    header.replacen(from, to, 1)
}

#[test]
fn what_breaks_linked_programs_fails() {
    type Change = fn(&str) -> String;
    let changes: [(&str, Change, &str); 9] = [
        ("field_removed", |h| with(h, "  double m_min;\n", ""), "data member deletion"),
        (
            "last_field_removed",
            |h| with(h, "  double relative_error;\n} morula_moments", "} morula_moments"),
            "relative_error",
        ),
        (
            "field_of_another_type",
            |h| with(h, "  double weld_tolerance;", "  uint64_t weld_tolerance;"),
            "weld_tolerance",
        ),
        (
            "fields_exchanged",
            |h| {
                let (a, b) = ("  int32_t bodies;\n", "  int32_t index_base;\n");
                with(h, &format!("{a}{b}"), &format!("{b}{a}"))
            },
            "offset changed",
        ),
        (
            "field_inserted",
            |h| with(h, "  double length_unit;\n", "  double length_unit;\n  double more;\n"),
            "data member insertion",
        ),
        (
            "function_removed",
            |h| with(h, "int32_t morula_parent_bytes(", "int32_t *morula_gone("),
            "morula_parent_bytes",
        ),
        (
            "parameter_of_another_type",
            |h| with(h, "morula_cache_new(uint64_t limit", "morula_cache_new(uint32_t limit"),
            "morula_cache_new",
        ),
        (
            "another_result",
            |h| with(h, "uint32_t morula_version(", "size_t morula_version("),
            "return type changed",
        ),
        (
            "another_callback",
            |h| with(h, "(*morula_progress)(double", "(*morula_progress)(int32_t"),
            "morula_progress",
        ),
    ];
    for (name, change, word) in changes {
        let Some((passes, said)) = judged(name, change) else { return };
        assert!(!passes, "{name} passes: {said}");
        assert!(said.contains("NOT COMPATIBLE") && said.contains(word), "{name}: {said}");
    }
}

#[test]
fn what_is_added_passes_and_is_listed() {
    let added = judged("added", |h| {
        let h = with(h, "} morula_cache_counts;", "  uint64_t trimmed;\n} morula_cache_counts;");
        let function = "int32_t morula_cache_trim(const struct morula_cache *cache);\n";
        with(&h, "void morula_cache_free(", &format!("{function}void morula_cache_free("))
    });
    let Some((passes, said)) = added else { return };
    assert!(passes, "{said}");
    for word in ["added only", "morula_cache_trim", "trimmed"] {
        assert!(said.contains(word), "{word} is not listed: {said}");
    }
}

#[test]
fn the_header_of_today_goes_with_the_baseline() {
    let root = env!("CARGO_MANIFEST_DIR");
    let out = Command::new("sh").arg(format!("{root}/scripts/abi.sh")).output().unwrap();
    let said = String::from_utf8_lossy(&out.stdout);
    assert!(matches!(out.status.code(), Some(0 | 3)), "{said}");
}
