//! What stands in the files beside the spheres, and what surfaces and names are like.

use super::body::record;
use super::{close, numbers};
use morula::Sphere;
use morula::export::{ExportOptions, Format, Place, files};
use morula::math::Vec3;

fn text(format: Format, file: usize) -> String {
    let mut all = files(&record(), format, &ExportOptions::default()).unwrap();
    String::from_utf8(all.swap_remove(file).bytes).unwrap()
}

fn one(format: Format) -> String {
    text(format, 0)
}

#[test]
fn what_stands_beside_the_spheres_is_the_bodys_own() {
    let r = record();
    let [a, b, c] = r.moments;
    let has = |text: &str, line: String| assert!(text.contains(&line), "{line:?} in {text}");
    has(&one(Format::Deme), format!("\n# volume = {:?}\n", r.volume));
    has(
        &one(Format::Yade),
        format!(
            "]\nmass = {:?}\nmoments = ({a:?}, {b:?}, {c:?})\nvolume = {:?}\n",
            r.mass, r.volume
        ),
    );
    has(&one(Format::Pfc), format!("\n  volume {:?} ...\n", r.volume));
    let ball = r.spheres.iter().map(|s| s.center.norm() + s.radius).fold(0.0, f64::max);
    let size = 2.0 * ball;
    has(&one(Format::Kratos), format!("\n0.0 0.0 0.0 {size:?}\n\nSize\n{size:?}\n"));
    has(&one(Format::Kratos), format!("\nVolume\n{:?}\n", r.volume));
    let places = files(&r, Format::Liggghts, &ExportOptions::default()).unwrap();
    assert_eq!((places[0].place, places[1].place), (Place::At, Place::Beside("in")));
    has(
        &text(Format::Liggghts, 1),
        format!(
            " density constant {:?} nspheres 6 ntry 1000000 spheres file ${{clump_file}} scale 1.0 \
             type ${{clump_type}} mass {:?} inertia_tensor {a:?} 0.0 0.0 {b:?} 0.0 {c:?} use_density\n",
            r.mass / r.volume,
            r.mass
        ),
    );
    has(
        &one(Format::Lammps),
        format!(
            "\n6 atoms\n{:?} mass\n0.0 0.0 0.0 com\n{a:?} {b:?} {c:?} 0.0 0.0 0.0 inertia\n",
            r.mass
        ),
    );
    has(
        &one(Format::LammpsRigid),
        format!(
            "\n1\n1 {:?} 0.0 0.0 0.0 {a:?} {b:?} {c:?} 0.0 0.0 0.0 0 0 0 0 0 0 0 0 0\n",
            r.mass
        ),
    );
    let json: serde_json::Value = serde_json::from_str(&one(Format::Json)).unwrap();
    let list = |v: &serde_json::Value| -> Vec<f64> {
        v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    assert_eq!(list(&json["masses"]), r.masses);
    assert_eq!(list(&json["principal_moments"]), r.moments);
    assert_eq!(list(&json["center"]), r.center.as_slice());
    assert_eq!(list(&json["quaternion"]), r.quaternion);
    assert_eq!(json["volume"].as_f64(), Some(r.volume));
    assert_eq!(json["density"].as_f64(), Some(r.mass / r.volume));
    // Each of the body's axes, in the caller's frame.
    (0..3).for_each(|k| assert_eq!(list(&json["axes"][k]), r.axes.column(k).as_slice()));
    let vtp = one(Format::Vtp);
    for (name, expected) in [
        ("radius", r.spheres.iter().map(|s| s.radius).collect::<Vec<_>>()),
        ("mass", r.masses.clone()),
        ("points", r.spheres.iter().flat_map(|s| [s.center.x, s.center.y, s.center.z]).collect()),
    ] {
        let lines = vtp.lines().skip_while(|l| !l.contains(&format!("Name=\"{name}\""))).skip(1);
        let found: Vec<f64> = lines.take_while(|l| !l.starts_with('<')).flat_map(numbers).collect();
        assert_eq!(found, expected, "{name}");
    }
}

#[test]
fn the_free_surface_of_glued_spheres_is_that_of_two_caps_less() {
    // Two equal spheres hide a cap of each other: of height r − d/2, that part of 2 r.
    let mut r = record();
    r.spheres = [0.6, -0.6].map(|x| Sphere::new(Vec3::new(x, 0.0, 0.0), 1.0)).to_vec();
    r.masses.truncate(2);
    let file = files(&r, Format::Mfix, &ExportOptions::default()).unwrap().swap_remove(0);
    let text = String::from_utf8(file.bytes).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let header = "x,y,z,rel_d,rel_sa,w,e,s,n,t,b,w_na,e_na,s_na,n_na,t_na,b_na,pid";
    assert_eq!((lines.len(), lines[0], lines[1]), (4, "#version = 1", header));
    for line in &lines[2..] {
        let cells = numbers(&line.replace(',', " "));
        // The bounding diameter is 3.2; no neighbours, no areas to them, one particle.
        close(cells[3], 2.0 / 3.2, 1e-14, "diameter");
        let part = cells[4] / (std::f64::consts::PI * cells[3] * cells[3]);
        assert!((part - (1.0 - 0.4 / 2.0)).abs() < 5e-3, "{part}");
        assert_eq!(cells[5..11], [-1.0; 6]);
        assert_eq!(cells[11..], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    }
}

#[test]
fn surfaces_are_of_the_spheres_and_turned_outward() {
    let r = record();
    let options = ExportOptions { facets: 1, ..ExportOptions::default() };
    let bytes = |format| files(&r, format, &options).unwrap().swap_remove(0).bytes;
    let outward = |t: [Vec3; 3], s: &Sphere, rounding: f64| {
        let [a, b, c] = t;
        let normal = (b - a).cross(&(c - a));
        assert!(normal.dot(&(a - s.center)) > 0.0);
        for v in t {
            assert!(((v - s.center).norm() / s.radius - 1.0).abs() < rounding);
        }
        normal.normalize()
    };
    let stl = bytes(Format::Stl);
    let single = |at: usize| f64::from(f32::from_le_bytes(stl[at..at + 4].try_into().unwrap()));
    let vector = |at: usize| Vec3::new(single(at), single(at + 4), single(at + 8));
    assert_eq!(u32::from_le_bytes(stl[80..84].try_into().unwrap()), 6 * 80);
    assert_eq!(stl.len(), 84 + 50 * 6 * 80);
    for k in 0..6 * 80 {
        let at = 84 + 50 * k;
        let found = outward([1, 2, 3].map(|i| vector(at + 12 * i)), &r.spheres[k / 80], 1e-5);
        assert!(found.dot(&vector(at)) > 0.999);
    }
    let ply = bytes(Format::Ply);
    let end = b"end_header\n";
    let head = ply.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let said = String::from_utf8(ply[..head].to_vec()).unwrap();
    assert!(said.contains("element vertex 252\n") && said.contains("element face 480\n"), "{said}");
    let whole = |at: usize| i32::from_le_bytes(ply[at..at + 4].try_into().unwrap()) as usize;
    let double = |at: usize| f64::from_le_bytes(ply[at..at + 8].try_into().unwrap());
    let vertex = |i: usize| [0, 8, 16].map(|k| double(head + 28 * i + k)).into();
    for k in 0..6 * 80 {
        let at = head + 28 * 252 + 13 * k;
        assert_eq!(ply[at], 3);
        let corners = [1, 5, 9].map(|i| whole(at + i));
        corners.iter().for_each(|v| assert_eq!(whole(head + 28 * v + 24), k / 80));
        outward(corners.map(vertex), &r.spheres[k / 80], 1e-12);
    }
    assert_eq!(ply.len(), head + 28 * 252 + 13 * 480);
}

#[test]
fn names_of_any_length_leave_the_first_line_short() {
    // LAMMPS takes what is beyond 255 bytes of it for the next.
    let mut r = record();
    r.name = "ä".repeat(3000);
    for format in [Format::Lammps, Format::LammpsRigid] {
        let file = files(&r, format, &ExportOptions::default()).unwrap().swap_remove(0);
        let text = String::from_utf8(file.bytes).unwrap();
        let first = text.lines().next().unwrap();
        assert!(first.starts_with("# ä") && first.len() < 255, "{first}");
    }
}
