//! Files that are legal but unusual, long ones, and the memory that they take.

use super::files::*;
use super::*;

#[test]
fn faces_may_come_before_the_vertices() {
    let ascii = ply_ascii();
    let (head, body) = ascii.split_once("end_header\n").unwrap();
    let (start, faces) = head.split_at(head.find("element face").unwrap());
    let (start, vertices) = start.split_at(start.find("element vertex").unwrap());
    let lines: Vec<&str> = body.lines().collect();
    let turned = format!(
        "{start}{faces}{vertices}end_header\n{}\n\n{}\n",
        lines[8..].join("\n"),
        lines[..8].join("\n \n")
    );
    is_box(turned.as_bytes(), "turned.ply");
    breaks(&turned, ["4 0 3 2 1", "4 0 3 2 8"], "index.ply", INDEX, "PLY face 0 names vertex 8");
    for big in [false, true] {
        let bytes = ply_binary(big);
        let from = bytes.len() - 8 * 17 - 6 * 19;
        let mut turned = String::from_utf8(bytes[..from].to_vec()).unwrap();
        turned = turned.replace(&format!("{vertices}{faces}"), &format!("{faces}{vertices}"));
        let mut turned = turned.into_bytes();
        turned.extend(&bytes[from + 8 * 17..]);
        turned.extend(&bytes[from..from + 8 * 17]);
        is_box(&turned, "turned.ply");
    }
}

#[test]
fn numbers_of_off_may_stand_anywhere() {
    let plain: String = {
        let v: String = CORNERS.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
        let f: String =
            QUADS.iter().map(|q| format!("4 {} {} {} {}\n", q[0], q[1], q[2], q[3])).collect();
        format!("OFF\n8 6 12\n{v}{f}")
    };
    for text in [plain.clone(), plain.replace("8 6 12", "8 6")] {
        is_box(text.as_bytes(), "lines.off");
        is_box(text.replace('\n', " ").as_bytes(), "one line.off");
        is_box(text.replace('\n', "\r").as_bytes(), "cr.off");
        is_box(text.replace(' ', "\n").as_bytes(), "one a line.off");
        is_box(text.replace(' ', " # why\n\n#\n ").as_bytes(), "comments.off");
        is_box(
            text.replacen("OFF\n", "# before\n\nOFF # at\n\n# after\n", 1).as_bytes(),
            "top.off",
        );
        // Two vertices a line, as some programs write them.
        let mut lines: Vec<&str> = text.lines().collect();
        let joined = [lines[2], lines[3]].join(" ");
        lines.splice(2..4, [joined.as_str()]);
        is_box(lines.join("\n").as_bytes(), "two a line.off");
    }
    // A face over two lines, with colours.
    is_box(off("OFF").replace("4  0 3 2 1", "4  0 3\n2 1").as_bytes(), "over.off");
    is_box(off("CNOFF").replace('\n', "\r").as_bytes(), "colours cr.off");
    // Counts that do not fit the numbers are still a fault.
    fails(
        plain.replace("8 6 12", "8 5 12").replace('\n', " ").as_bytes(),
        "five.off",
        FORMAT,
        "line 1",
    );
    breaks(&plain, ["1 2 3\n", "1 nan 3\n"], "nan.off", NOT_FINITE, "line 9: y of vertex 6 is NaN");
}

#[test]
fn lines_of_obj_may_end_and_go_on_in_any_way() {
    let good = obj();
    is_box(good.replace('\n', "\r").as_bytes(), "cr.obj");
    is_box(good.replace("f ", "# C:\\dir\\\n\n  \nf ").as_bytes(), "comments.obj");
    is_box(good.replace("f 1/7 ", "f 1/7 \\\r\n ").as_bytes(), "continued.obj");
    is_box(good.replace('\n', " # why\n").as_bytes(), "ends.obj");
    breaks(
        &good,
        ["v 1 2 0", "v 1 nan 0"],
        "nan.obj",
        NOT_FINITE,
        "line 6: vertex 3, counted from 1, has y = NaN",
    );
    breaks(
        &good.replace('\n', "\r"),
        ["v 1 2 0", "v 1 2 -1e999"],
        "inf.obj",
        NOT_FINITE,
        "line 6: vertex 3, counted from 1, has z = -inf",
    );
    breaks(&stl_ascii(), ["0.000", "inf"], "inf.stl", NOT_FINITE, "line 4: y of the vertex is inf");
}

#[test]
fn long_reads_can_be_cancelled() {
    use std::cell::Cell;
    // Broken at the end, so that whatever asks does so while it reads.
    let many = 60_000;
    let corner = "   vertex 0 0 0\n".repeat(3);
    let facet = format!(" facet normal 0 0 1\n  outer loop\n{corner}  endloop\n endfacet\n");
    let mut binary = stl_binary(b"x")[..80].to_vec();
    binary.extend((many as u32).to_le_bytes());
    binary.extend(vec![0; 50 * many]);
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {many}\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n{}x\n",
        "0 0 0\n".repeat(many)
    );
    let off = format!("OFF\n{many} 1 0\n{}x x x x\n", "0 0 0\n".repeat(many));
    let files: [(&str, Vec<u8>); 5] = [
        ("a.obj", format!("{}f x\n", "v 0 0 0\n".repeat(many)).into_bytes()),
        ("a.stl", format!("solid\n{}x\n", facet.repeat(many / 8)).into_bytes()),
        ("a.ply", ply.into_bytes()),
        ("a.off", off.into_bytes()),
        ("b.stl", binary),
    ];
    for (name, bytes) in files {
        let asked = Cell::new(0);
        let after = |most: i32| {
            asked.set(0);
            let asked = &asked;
            let run = Run::serial().with_progress(Box::new(move |_| {
                asked.set(asked.get() + 1);
                asked.get() > most
            }));
            Shape::from_bytes(&bytes, name, &FileOptions::default(), &run).unwrap_err()
        };
        let e = after(i32::MAX);
        assert!(!matches!(e, Error::Cancelled(_)) && asked.get() >= 10, "{name}: {e}");
        let e = after(7);
        assert!(matches!(&e, Error::Cancelled(s) if s.contains("reading")), "{name}: {e}");
        assert_eq!(asked.get(), 8, "{name}");
    }
}

#[test]
fn what_is_held_counts_towards_the_limit() {
    // The arrays of the file beside those of the import.
    let mut options = FileOptions::default();
    let with = |options: &FileOptions, name: &str, bytes: &[u8]| {
        Shape::from_bytes(bytes, name, options, &Run::serial())
    };
    options.import.memory_limit = 8 * 60 + 12 * 200;
    let files = [
        ("a.off", off("OFF").into_bytes()),
        ("a.obj", obj().into_bytes()),
        ("a.ply", ply_ascii().into_bytes()),
    ];
    for (name, bytes) in &files {
        let e = with(&options, name, bytes).unwrap_err();
        assert!(
            matches!(&e, Error::MemoryLimit(s) if s.contains("as read, the limit is 2880")),
            "{name}: {e}"
        );
    }
    options.import.memory_limit += 1000;
    for (name, bytes) in &files {
        with(&options, name, bytes).unwrap();
    }
    // The file itself beside what is read from it.
    let mut soup = stl_binary(b"x");
    soup[80..84].copy_from_slice(&5000u32.to_le_bytes());
    soup.resize(84 + 50 * 5000, 0);
    let path = std::env::temp_dir().join(format!("morula-held-{}.stl", std::process::id()));
    std::fs::write(&path, &soup).unwrap();
    options.import.memory_limit = 84 * 5000 + 1000;
    let e = Shape::from_file(&path, &options, &Run::serial()).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    let words = "15000 vertices and 5000 faces need 420000 bytes beside the 250084 of the file";
    assert!(matches!(&e, Error::MemoryLimit(s) if s.contains(words)), "{e}");
}
