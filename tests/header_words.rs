//! What the header says of each function: errors, ownership, threads. C programmers have
//! nothing else to go by; the programs in c_examples hold the library to it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::c_header::{self, Declaration};
use std::collections::{BTreeMap, BTreeSet};

/// Name → its comment as one line.
fn comments() -> BTreeMap<String, String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/include/morula.h");
    let header = std::fs::read_to_string(path).unwrap();
    let mut found = BTreeMap::new();
    let mut comment = Vec::new();
    for line in header.lines() {
        if let Some(words) = line.strip_prefix("///") {
            comment.push(words.trim());
            continue;
        }
        let name = line.find("morula_").and_then(|at| line[at..].split_once('('));
        if let Some((name, _)) = name
            && line.starts_with(|c: char| c.is_ascii_lowercase())
            && !line.starts_with("typedef")
        {
            found.insert(name.to_owned(), comment.join(" "));
        }
        comment.clear();
    }
    found
}

/// What a comment says under `word`, and all that stands after it.
fn clause(comment: &str, word: &str) -> Option<String> {
    let low = comment.to_lowercase();
    low.match_indices(':').find_map(|(at, _)| {
        let heads = low[..at].rsplit(". ").next().unwrap();
        heads.split(", ").any(|h| h.trim() == word).then(|| comment[at + 1..].trim().to_owned())
    })
}

/// What a comment says under `word`, followed to the function that it names with "as".
fn said(comments: &BTreeMap<String, String>, function: &str, word: &str) -> Option<String> {
    let mut function = function.to_owned();
    for _ in 0..4 {
        let clause = clause(&comments[&function], word)?;
        let next = clause.strip_prefix("as morula_").and_then(|rest| rest.split_once("()"));
        match next {
            Some((name, _)) if comments.contains_key(&format!("morula_{name}")) => {
                function = format!("morula_{name}");
            }
            Some((name, _)) => panic!("{function}: there is no morula_{name}()"),
            None => return Some(clause),
        }
    }
    panic!("{function}: goes round in a circle");
}

fn is_handle(d: &Declaration) -> bool {
    let of = d.of.replace("const ", "").replace('*', "");
    ["shape", "solid", "clump", "body", "files", "cost", "sweep", "parent", "cache", "fragments"]
        .iter()
        .any(|h| of == format!("morula_{h}"))
}

#[test]
fn every_function_says_what_it_returns_and_what_threads_may_do() {
    let (header, comments) = (c_header::read(), comments());
    assert!(header.functions.len() > 100);
    for (name, (result, parameters)) in &header.functions {
        let threads = said(&comments, name, "threads");
        let threads = threads.unwrap_or_else(|| panic!("{name} says nothing of threads"));
        let handles: Vec<&Declaration> =
            parameters.iter().filter(|p| is_handle(p) && !p.of.ends_with("**")).collect();
        if handles.iter().any(|p| !p.of.contains("const")) {
            // Only what takes a handle back changes one.
            assert!(name.ends_with("_free"), "{name} changes a handle");
            assert!(threads.contains("no other thread"), "{name}: {threads}");
        } else if !handles.is_empty() {
            let at_once = threads.contains("at the same time") || threads.contains("only read");
            assert!(at_once, "{name} takes const handles: {threads}");
        }
        if result == "void" {
            continue;
        }
        let returns = said(&comments, name, "returns");
        let returns = returns.unwrap_or_else(|| panic!("{name} does not say what it returns"));
        match result.as_str() {
            // Texts: for how long they last.
            "const char*" => {
                assert!(returns.contains("static") || comments[name].contains("until"), "{name}");
            }
            "int32_t" => {
                let said = returns.contains("OK") || returns.starts_with("the statuses of morula_");
                assert!(said, "{name}: {returns}");
            }
            _ => {}
        }
    }
}

#[test]
fn every_function_that_makes_a_handle_names_the_one_that_frees_it() {
    let (header, comments) = (c_header::read(), comments());
    let mut makers = 0;
    for (name, (_, parameters)) in &header.functions {
        for made in parameters.iter().filter(|p| is_handle(p) && p.of.ends_with("**")) {
            // An array of handles to read from.
            if made.of.contains("const") {
                continue;
            }
            makers += 1;
            let ownership = said(&comments, name, "ownership")
                .unwrap_or_else(|| panic!("{name} does not say whose *{} is", made.name));
            let of = made.of.trim_end_matches('*');
            assert!(ownership.contains(&format!("{of}_free()")), "{name}: {ownership}");
        }
    }
    assert!(makers > 25, "only {makers} functions make handles");
}

#[test]
fn every_status_that_a_function_names_exists() {
    let (header, comments) = (c_header::read(), comments());
    let known: Vec<&str> =
        header.constants.keys().filter_map(|c| c.strip_prefix("MORULA_STATUS_")).collect();
    let mut named = 0;
    for name in header.functions.keys() {
        let Some(returns) = said(&comments, name, "returns") else { continue };
        let returns = returns.split("Ownership:").next().unwrap();
        let returns = returns.split("Threads:").next().unwrap();
        // What stands in parentheses explains one.
        let returns: String = returns
            .split('(')
            .enumerate()
            .map(|(i, part)| if i == 0 { part } else { part.split_once(')').map_or("", |p| p.1) })
            .collect();
        let words = returns.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        for word in
            words.filter(|w| w.len() > 3 && w.chars().all(|c| c.is_ascii_uppercase() || c == '_'))
        {
            let word = word.strip_prefix("MORULA_STATUS_").unwrap_or(word);
            if word.starts_with("MORULA_") || word == "NULL" {
                continue;
            }
            assert!(known.contains(&word), "{name} names the status {word}");
            named += 1;
        }
    }
    assert!(named > 300, "only {named} statuses named");
}

/// The statuses that a function names, and those of the functions that it refers to.
fn statuses(comments: &BTreeMap<String, String>, function: &str, found: &mut BTreeSet<String>) {
    let returns = clause(&comments[function], "returns").unwrap_or_default();
    let returns = returns.split("Ownership:").next().unwrap().split("Threads:").next().unwrap();
    // What stands in parentheses explains one.
    let mut depth = 0;
    let outside: String = returns
        .replace("()", "")
        .chars()
        .filter(|&c| {
            depth += i32::from(c == '(');
            let keep = depth == 0;
            depth -= i32::from(c == ')');
            keep
        })
        .collect();
    for word in outside.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')) {
        if word != function && comments.contains_key(word) {
            statuses(comments, word, found);
        } else if !word.is_empty() && !word.contains(|c: char| c.is_ascii_lowercase()) {
            found.insert(word.trim_start_matches("MORULA_STATUS_").to_owned());
        }
    }
}

/// The arguments of each call of `name` in a program in C.
fn calls<'a>(code: &'a str, name: &str) -> Vec<Vec<&'a str>> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices(name) {
        let before = code[..at].chars().next_back();
        if before.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_') {
            continue;
        }
        let (mut arguments, mut depth, mut from) = (Vec::new(), 0, at + name.len() + 1);
        for (i, c) in code[at + name.len()..].char_indices() {
            let i = at + name.len() + i;
            depth += i32::from(c == '(') - i32::from(c == ')');
            if depth == 0 || (depth == 1 && c == ',') {
                arguments.push(code[from..i].trim());
                from = i + 1;
            }
            if depth == 0 {
                break;
            }
        }
        found.push(arguments);
    }
    found
}

/// Each status that a program in c_examples waits for is one that the header names for the function.
#[test]
fn every_status_that_a_program_waits_for_is_one_that_its_function_names() {
    let comments = comments();
    let mut named = BTreeMap::new();
    let (mut checked, mut missing) = (0, Vec::new());
    for folder in ["c", "fragmentation", "lammps"] {
        let folder = format!("{}/c_examples/{folder}", env!("CARGO_MANIFEST_DIR"));
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "c") {
                continue;
            }
            let code = std::fs::read_to_string(&path).unwrap();
            for arguments in calls(&code, "STATUS") {
                let [call, expected] = arguments[..] else { panic!("{arguments:?}") };
                let function = call.split('(').next().unwrap().trim();
                let waits = expected.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
                for status in waits.filter_map(|w| w.strip_prefix("MORULA_STATUS_")) {
                    if !comments.contains_key(function) {
                        continue;
                    }
                    let all = named.entry(function.to_owned()).or_insert_with(|| {
                        let mut all = BTreeSet::new();
                        statuses(&comments, function, &mut all);
                        all
                    });
                    checked += 1;
                    if !all.contains(status) {
                        missing.push(format!("{}: {call}: {status}", path.display()));
                    }
                }
            }
        }
    }
    assert!(missing.is_empty(), "not in the header:\n{}", missing.join("\n"));
    assert!(checked > 200, "only {checked} statuses waited for");
}

/// What any function may return stands once, in the header's first comment.
#[test]
fn the_head_names_what_any_function_may_return() {
    let header = include_str!("../include/morula.h");
    let head = header.split("*/").next().unwrap();
    for word in ["INTERNAL", "INVALID_ARGUMENT for a pointer", "hook"] {
        assert!(head.contains(word), "the head does not say {word}");
    }
}

/// What `stress` has threads call at the same time on one handle of each kind: all that takes a const
/// handle but these.
#[test]
fn every_const_call_is_raced_by_threads() {
    const NOT: [&str; 3] = ["morula_body_write", "morula_clump_write", "morula_cache_clear"];
    let header = c_header::read();
    let code =
        concat!(include_str!("../c_examples/c/stress.h"), include_str!("../c_examples/c/stress.c"));
    let (mut raced, mut kinds) = (0, BTreeSet::new());
    for (name, (_, parameters)) in &header.functions {
        let given = parameters.iter().filter(|p| is_handle(p) && p.of.starts_with("const "));
        let given: Vec<&str> = given.map(|p| p.of.as_str()).collect();
        if given.is_empty() {
            continue;
        }
        let called = code.contains(&format!("{name}("));
        assert_eq!(called, !NOT.contains(&name.as_str()), "{name}");
        raced += usize::from(called);
        kinds.extend(given.iter().map(|of| of.replace("const", "").replace(['*', ' '], "")));
    }
    let page = include_str!("../docs/borders.md");
    let (kinds, all) = (kinds.len(), raced + NOT.len());
    let said =
        format!("one handle of each of the {kinds} kinds, with {raced} of the {all} const calls");
    assert!(page.contains(&said), "docs/borders.md does not say: {said}");
}
