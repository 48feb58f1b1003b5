//! A box of 1 × 2 × 3 as a file of every format.

pub const CORNERS: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 2.0, 0.0],
    [0.0, 2.0, 0.0],
    [0.0, 0.0, 3.0],
    [1.0, 0.0, 3.0],
    [1.0, 2.0, 3.0],
    [0.0, 2.0, 3.0],
];
pub const QUADS: [[usize; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

pub fn triangles() -> Vec<[usize; 3]> {
    QUADS.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect()
}

pub fn stl_binary(header: &[u8]) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend(12u32.to_le_bytes());
    for t in triangles() {
        out.extend([0u8; 12]);
        for c in t.iter().flat_map(|&i| CORNERS[i]) {
            out.extend((c as f32).to_le_bytes());
        }
        out.extend([0u8; 2]);
    }
    out
}

pub fn stl_ascii() -> String {
    let mut out = String::from("solid a box\n");
    for t in triangles() {
        out += " facet normal 0 0 nan\n  outer loop\n";
        for i in t {
            let [x, y, z] = CORNERS[i];
            out += &format!("   vertex {x:e} {y:.3} +{z}\n");
        }
        out += "  endloop\n endfacet\n";
    }
    out + "endsolid a box\n"
}

pub fn obj() -> String {
    let mut out = String::from("# a box\nmtllib none.mtl\no box\n");
    for [x, y, z] in CORNERS {
        out += &format!("v {x} {y} {z} 0.5 nan 1\n");
    }
    out += "vn 0 0 1\ng side\nusemtl none\n";
    for q in QUADS {
        out += &format!("f {}/7 {}//1 {} {}/1/1\n", q[0] + 1, q[1] + 1, q[2] + 1, q[3] as i64 - 8);
    }
    out
}

pub fn ply_header(format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a box\nelement vertex 8\nproperty uchar red\n\
         property float x\nproperty double y\nproperty float z\nelement face 6\n\
         property list uchar int vertex_indices\nproperty short flags\nend_header\n"
    )
}

pub fn ply_ascii() -> String {
    let mut out = ply_header("ascii");
    for [x, y, z] in CORNERS {
        out += &format!("7 {x} {y} {z}\n");
    }
    for q in QUADS {
        out += &format!("4 {} {} {} {} -1\n", q[0], q[1], q[2], q[3]);
    }
    out
}

pub fn ply_binary(big: bool) -> Vec<u8> {
    let mut out =
        ply_header(if big { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    let mut put = |bytes: &[u8]| {
        let mut b = bytes.to_vec();
        if big {
            b.reverse();
        }
        out.extend(b);
    };
    for [x, y, z] in CORNERS {
        put(&[7]);
        put(&(x as f32).to_le_bytes());
        put(&y.to_le_bytes());
        put(&(z as f32).to_le_bytes());
    }
    for q in QUADS {
        put(&[4]);
        q.iter().for_each(|&i| put(&(i as i32).to_le_bytes()));
        put(&(-1i16).to_le_bytes());
    }
    out
}

pub fn off(word: &str) -> String {
    let mut out = format!("{word} # a box\n\n8 6 0\n");
    let normal = if word.contains('N') { "0 0 1" } else { "" };
    let colour = if word.contains('C') { "255 0 0" } else { "" };
    for [x, y, z] in CORNERS {
        out += &format!(" {x} {y}\t{z} {normal} {colour}\n");
    }
    for q in QUADS {
        out += &format!("4  {} {} {} {}  0.5 0.5 0.5 # face\n", q[0], q[1], q[2], q[3]);
    }
    out
}
