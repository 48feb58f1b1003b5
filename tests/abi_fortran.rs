//! `include/morula.f90` against `include/morula.h`: the same functions with the
//! same arguments, the same structs with the same fields, the same constants.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod common;

use common::c_header::{self, Declaration};
use std::collections::BTreeMap;

fn read(name: &str) -> String {
    std::fs::read_to_string(format!("{}/include/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// What a declaration is, in both languages' common words.
type Kind = String;

#[derive(Debug, Default, PartialEq)]
struct Interface {
    /// Name → kinds of the arguments, then of the result.
    functions: BTreeMap<String, Vec<Kind>>,
    /// Name → fields as (name, kind).
    structs: BTreeMap<String, Vec<(String, Kind)>>,
    constants: BTreeMap<String, i64>,
}

// ---- C ----

fn c_interface() -> Interface {
    let header = c_header::read();
    let kind =
        |d: &Declaration| c_kind(&d.of) + &d.dim.map(|n| format!("({n})")).unwrap_or_default();
    let functions = header.functions.iter().map(|(name, (result, parameters))| {
        let kinds = parameters.iter().map(kind).chain([c_kind(result)]);
        (name.clone(), kinds.collect())
    });
    let structs = header.structs.iter().map(|(name, fields)| {
        (name.clone(), fields.iter().map(|f| (f.name.clone(), kind(f))).collect())
    });
    Interface {
        functions: functions.collect(),
        structs: structs.collect(),
        constants: header.constants,
    }
}

fn c_kind(c: &str) -> Kind {
    let c: String = c.replace("const", "").split_whitespace().collect();
    let kind = match c.trim_end_matches('*') {
        "int32_t" | "uint32_t" => "int32",
        "uint64_t" => "int64",
        "size_t" => "size",
        "double" => "double",
        "float" => "float",
        "uint8_t" => "int8",
        "uint16_t" => "int16",
        "char" => "char",
        "void" if !c.contains('*') => "nothing",
        "morula_shape" | "morula_solid" | "morula_clump" | "morula_body" | "morula_files"
        | "morula_cost" | "morula_sweep" | "morula_parent" | "morula_cache"
        | "morula_fragments" | "void" => "handle",
        "morula_progress" | "morula_log" => "callback",
        other => other,
    };
    let stars = c.chars().filter(|c| *c == '*').count();
    match (kind, stars) {
        // A pointer to something opaque is a value of its own in Fortran.
        ("handle", n) => "pointer".to_owned() + &"*".repeat(n - 1),
        ("char", 2) => "pointer*".to_owned(),
        (kind, n) => kind.to_owned() + &"*".repeat(n),
    }
}

// ---- Fortran ----

fn fortran_interface(source: &str) -> Interface {
    let mut found = Interface::default();
    let source = source.replace("&\n", " ");
    let lines: Vec<&str> = source.lines().map(|l| l.split('!').next().unwrap().trim()).collect();
    let mut i = 0;
    while i < lines.len() {
        let line = lines[i];
        i += 1;
        if let Some((_, rest)) = line.split_once("parameter, public :: ") {
            let (name, value) = rest.split_once(" = ").unwrap();
            let value = value.trim_end_matches("_c_int32_t").parse().unwrap();
            found.constants.insert(name.to_owned(), value);
        } else if let Some(name) = line.strip_prefix("type, bind(c), public :: ") {
            let mut fields = Vec::new();
            while !lines[i].starts_with("end type") {
                let (kind, declared) = fortran_declaration(lines[i], false);
                fields.push((declared, kind));
                i += 1;
            }
            found.structs.insert(name.to_owned(), fields);
        } else if line.contains(" bind(c)")
            && (line.starts_with("function morula_") || line.starts_with("subroutine morula_"))
        {
            let (name, rest) = line.split_once(' ').unwrap().1.split_once('(').unwrap();
            let names: Vec<String> = rest
                .split_once(')')
                .unwrap()
                .0
                .split(',')
                .map(|s| s.trim().to_owned())
                .filter(|s| !s.is_empty())
                .collect();
            let mut declared = BTreeMap::new();
            while !lines[i].starts_with("end ") {
                if lines[i] != "import" {
                    let (kind, of) = fortran_declaration(lines[i], true);
                    declared.insert(of, kind);
                }
                i += 1;
            }
            let mut kinds: Vec<Kind> = names
                .iter()
                .map(|n| declared.remove(n).unwrap_or_else(|| panic!("{name}: {n} is undeclared")))
                .collect();
            kinds.push(declared.remove("r").map_or("nothing".to_owned(), |k| {
                let by_value = k.trim_end_matches('*').to_owned();
                // A C string is handed back as a pointer.
                if by_value == "pointer" { "char*".to_owned() } else { by_value }
            }));
            assert!(declared.is_empty(), "{name}: {declared:?} are no arguments");
            found.functions.insert(name.to_owned(), kinds);
        }
    }
    found
}

fn fortran_declaration(line: &str, argument: bool) -> (Kind, String) {
    let (attributes, name) =
        line.split_once(" :: ").unwrap_or_else(|| panic!("no declaration: {line}"));
    let name = name.split(" = ").next().unwrap();
    let (name, dim) =
        name.split_once('(').map_or((name, ""), |(n, d)| (n, d.trim_end_matches(')')));
    let base = attributes.split(", ").next().unwrap();
    let base = base.split('(').nth(1).unwrap().trim_end_matches(')');
    let kind = match base {
        "c_int32_t" => "int32",
        "c_int64_t" => "int64",
        "c_int16_t" => "int16",
        "c_int8_t" => "int8",
        "c_size_t" => "size",
        "c_double" => "double",
        "c_float" => "float",
        "c_ptr" => "pointer",
        "c_funptr" => "callback",
        "kind=c_char" => "char",
        other => other,
    };
    let by_value = !argument || attributes.contains(", value");
    let mut kind = kind.to_owned() + if by_value { "" } else { "*" };
    if !argument && !dim.is_empty() {
        kind = format!("{kind}({dim})");
    }
    (kind, name.to_owned())
}

/// A C pointer that may be NULL is a `c_ptr` in Fortran: Fortran 2008 has no optional arguments
/// of C functions.
fn same(c: &str, fortran: &str) -> bool {
    c == fortran || (fortran == "pointer" && c.ends_with('*'))
}

#[test]
fn functions_have_the_same_names_and_arguments() {
    let c = c_interface().functions;
    let fortran = fortran_interface(&read("morula.f90")).functions;
    assert!(c.len() > 45, "only {} functions were found in the header", c.len());
    let names = |m: &BTreeMap<String, Vec<Kind>>| m.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&c), names(&fortran));
    for (name, ours) in &c {
        let theirs = &fortran[name];
        assert_eq!(ours.len(), theirs.len(), "{name}: {ours:?} in C, {theirs:?} in Fortran");
        for (i, (a, b)) in ours.iter().zip(theirs).enumerate() {
            assert!(same(a, b), "{name}: argument {i} is {a} in C and {b} in Fortran");
        }
    }
}

#[test]
fn structs_have_the_same_fields() {
    let c = c_interface().structs;
    let fortran = fortran_interface(&read("morula.f90")).structs;
    assert_eq!(c.len(), 24);
    assert_eq!(c.keys().collect::<Vec<_>>(), fortran.keys().collect::<Vec<_>>());
    for (name, ours) in &c {
        let theirs = &fortran[name];
        let fields = |f: &[(String, Kind)]| f.iter().map(|f| f.0.clone()).collect::<Vec<_>>();
        assert_eq!(fields(ours), fields(theirs), "{name}");
        for ((field, a), (_, b)) in ours.iter().zip(theirs) {
            assert!(same(a, b), "{name}: {field} is {a} in C and {b} in Fortran");
        }
    }
}

#[test]
fn constants_have_the_same_values() {
    let c = c_interface().constants;
    let fortran = fortran_interface(&read("morula.f90")).constants;
    assert!(c.len() > 60);
    assert_eq!(c, fortran);
}

#[test]
fn the_fortran_examples_call_every_function() {
    // Through the types of the second layer, each of which calls its C function once.
    let module = read("morula.f90");
    let programs =
        ["fortran_api", "fortran_masses", "fortran_cost", "fortran_fragments", "fortran_host"];
    let example: String = programs
        .map(|name| {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/c_examples/fortran");
            std::fs::read_to_string(format!("{folder}/{name}.f90")).unwrap()
        })
        .concat();
    let body = module.split("\ncontains\n").last().unwrap();
    for name in c_interface().functions.keys() {
        let called = format!("{name}(");
        if example.contains(&called) {
            continue;
        }
        // The procedure of the module that calls it, and what the type calls that procedure.
        let procedure = body
            .split("\n  subroutine ")
            .flat_map(|s| s.split("\n  function "))
            .find(|s| s.contains(&called))
            .and_then(|s| s.split('(').next())
            .unwrap_or_else(|| panic!("nothing in morula.f90 calls {name}"));
        let aliases = module.lines().filter_map(|l| {
            let (alias, target) = l.trim().split_once(" => ")?;
            let is = target.split(", ").any(|t| t == procedure);
            is.then(|| alias.rsplit(' ').next().unwrap().to_owned())
        });
        let mut ways = aliases.collect::<Vec<_>>();
        ways.push(procedure.to_owned());
        for (prefix, generic) in [
            ("init_", "morula_init"),
            ("labels_of_", "morula_labels"),
            ("clumps_from_", "morula_make_clumps"),
        ] {
            if procedure.starts_with(prefix) {
                ways.push(generic.to_owned());
            }
        }
        let used = ways.iter().any(|way| {
            [" ", "%", "("].iter().any(|before| example.contains(&format!("{before}{way}(")))
        });
        assert!(used, "the Fortran examples never reach {name} by way of {procedure}");
    }
}

/// The module's own procedures: name → arguments and text.
fn procedures(module: &str) -> Vec<(String, Vec<String>, String)> {
    let body = module.split("\ncontains\n").last().unwrap().replace("&\n", " ");
    let starts = body.split("\n  ").filter(|line| {
        let line = line.lines().next().unwrap_or_default();
        !line.starts_with("end ")
            && !line.starts_with('!')
            && line.contains('(')
            && (line.contains("subroutine ") || line.contains("function "))
    });
    let mut found = Vec::new();
    for start in starts {
        let line = start.lines().next().unwrap();
        let Some((name, rest)) = line.split_once('(') else { continue };
        let name = name.rsplit(' ').next().unwrap();
        let arguments = rest.split_once(')').unwrap().0.split(',').map(|a| a.trim().to_owned());
        let at = body.find(&format!("\n  {line}")).unwrap();
        let end = body[at..].find(&format!("  end subroutine {name}\n"));
        let end = end.or_else(|| body[at..].find(&format!("  end function {name}\n"))).unwrap();
        found.push((name.to_owned(), arguments.collect(), body[at..at + end].to_owned()));
    }
    found
}

#[test]
fn the_second_layer_reaches_every_function() {
    // Numbers in and out: these are Fortran as they stand.
    let plain = ["morula_version", "morula_sizeof"];
    let procedures = procedures(&read("morula.f90"));
    assert!(procedures.len() > 150, "only {} procedures were found", procedures.len());
    for name in c_interface().functions.keys().filter(|n| !plain.contains(&n.as_str())) {
        let called = format!("{name}(");
        let calls = procedures.iter().any(|(_, _, text)| text.contains(&called));
        assert!(calls, "no procedure of the second layer calls {name}");
    }
}

#[test]
fn whatever_can_fail_has_an_optional_status_as_its_last_argument() {
    let mut seen = 0;
    for (name, arguments, text) in procedures(&read("morula.f90")) {
        if !text.contains("call finish(") {
            continue;
        }
        seen += 1;
        assert_eq!(arguments.last().map(String::as_str), Some("status"), "{name}");
        let declared = "integer(c_int32_t), intent(out), optional :: status\n";
        assert!(text.contains(declared), "{name}: status is not optional");
    }
    assert!(seen > 90, "only {seen} procedures call the library");
}

#[test]
fn every_type_with_a_handle_has_a_finaliser_and_refuses_assignment() {
    let module = read("morula.f90");
    let mut types = 0;
    for part in module.split("\n  type, public :: ").skip(1) {
        let (name, rest) = part.split_once('\n').unwrap();
        let definition = rest.split_once("end type").unwrap().0;
        if !definition.contains("type(c_ptr) :: handle") {
            continue;
        }
        types += 1;
        let of = name.strip_prefix("morula_").unwrap().strip_suffix("_t").unwrap();
        for line in [
            "    private\n".to_owned(),
            format!("    procedure :: destroy => {of}_destroy\n"),
            format!("    generic :: assignment(=) => {of}_assign\n"),
            format!("    final :: {of}_final\n"),
        ] {
            assert!(definition.contains(&line), "{name} lacks: {line}");
        }
        // Elemental, so that arrays of them neither leak nor are copied.
        for procedure in ["assign", "final"] {
            let head = format!("\n  impure elemental subroutine {of}_{procedure}(");
            assert!(module.contains(&head), "{of}_{procedure} is not elemental");
        }
    }
    let handles = c_header::read().functions.keys().filter(|n| n.ends_with("_free")).count();
    assert_eq!(types, handles);
}
