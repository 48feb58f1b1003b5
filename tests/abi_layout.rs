//! Sizes of structs and places of fields as the compilers make them: the Fortran module's
//! against the C header's, and both against the sizes that the library gives.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod common;

use common::c_header::{self, Header};
use std::path::{Path, PathBuf};
use std::process::Command;

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("abi_layout").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs a tool in a folder and gives what it prints; none when it is not installed.
fn run(tool: &str, arguments: &[&str], folder: &Path) -> Option<String> {
    let out = Command::new(tool).args(arguments).current_dir(folder).output();
    match out {
        Err(_) => {
            println!("skipped: {tool} is not installed");
            None
        }
        Ok(out) => {
            let said = String::from_utf8_lossy(&out.stderr);
            assert!(out.status.success(), "{tool} {arguments:?}: {said}");
            Some(String::from_utf8(out.stdout).unwrap())
        }
    }
}

fn include(name: &str) -> String {
    format!("{}/include{name}", env!("CARGO_MANIFEST_DIR"))
}

/// `struct NAME SIZE` and `field NAME FIELD OFFSET SIZE` of all structs, from C.
fn c_layout(header: &Header) -> Option<String> {
    let mut program = String::from(
        "#include <stddef.h>\n#include <stdio.h>\n#include \"morula.h\"\nint main(void) {\n",
    );
    for (name, fields) in &header.structs {
        program += &format!("  printf(\"struct {name} %zu\\n\", sizeof({name}));\n");
        for field in fields {
            let f = &field.name;
            program += &format!(
                "  printf(\"field {name} {f} %zu %zu\\n\", offsetof({name}, {f}), \
                 sizeof((({name} *)0)->{f}));\n"
            );
        }
    }
    program += "  return 0;\n}\n";
    let folder = folder("c");
    std::fs::write(folder.join("layout.c"), program).unwrap();
    run("cc", &["-std=c11", "-I", &include(""), "layout.c", "-o", "layout"], &folder)?;
    run("./layout", &[], &folder)
}

/// The same from Fortran, by addresses of components. The module's calls into the library are
/// linked to stand-ins, none of which is called.
fn fortran_layout(header: &Header, standard: &str) -> Option<String> {
    let mut declared = String::new();
    let mut printed = String::new();
    for (i, (name, fields)) in header.structs.iter().enumerate() {
        declared += &format!("  type({name}), target :: s{i}\n");
        printed += &format!("  print '(a, i0)', 'struct {name} ', c_sizeof(s{i})\n");
        for field in fields {
            let f = &field.name;
            printed += &format!(
                "  print '(a, i0, 1x, i0)', 'field {name} {f} ', &\n    \
                 at(c_loc(s{i}%{f})) - at(c_loc(s{i})), c_sizeof(s{i}%{f})\n"
            );
        }
    }
    let program = format!(
        "program layout\n  use, intrinsic :: iso_c_binding\n  use morula\n  implicit none\n\
         {declared}{printed}contains\n  function at(pointer) result(address)\n    \
         type(c_ptr), intent(in) :: pointer\n    integer(c_intptr_t) :: address\n    \
         address = transfer(pointer, address)\n  end function at\nend program layout\n"
    );
    let folder = folder(standard);
    std::fs::write(folder.join("layout.f90"), program).unwrap();
    let stand_ins: String =
        header.functions.keys().map(|name| format!("void {name}(void) {{}}\n")).collect();
    std::fs::write(folder.join("stand_ins.c"), stand_ins).unwrap();
    run("cc", &["-c", "stand_ins.c"], &folder)?;
    let standard = format!("-std={standard}");
    let module = include("/morula.f90");
    let warnings = ["-Wall", "-Werror", "-pedantic"];
    let files = [standard.as_str(), &module, "layout.f90", "stand_ins.o", "-o", "layout"];
    run("gfortran", &[&warnings[..], &files[..]].concat(), &folder)?;
    run("./layout", &[], &folder)
}

#[test]
fn fortran_and_c_lay_out_every_struct_as_the_library_does() {
    let header = c_header::read();
    let Some(in_c) = c_layout(&header) else { return };
    let mut sizes = 0;
    for (name, which) in &header.constants {
        let Some(of) = name.strip_prefix("MORULA_STRUCT_") else { continue };
        let of = of.to_lowercase();
        let ours = morula::ffi::morula_sizeof(i32::try_from(*which).unwrap());
        let line = format!("struct morula_{of} {ours}");
        assert!(in_c.lines().any(|l| l == line), "C does not say: {line}");
        sizes += 1;
    }
    assert_eq!(sizes, header.structs.len());
    for standard in ["f2008", "f2018"] {
        let Some(in_fortran) = fortran_layout(&header, standard) else { return };
        for (c, fortran) in in_c.lines().zip(in_fortran.lines()) {
            assert_eq!(c, fortran, "C beside Fortran, {standard}");
        }
        assert_eq!(in_c.lines().count(), in_fortran.lines().count(), "{standard}");
    }
}
