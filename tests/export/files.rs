//! Every format: numbers that read back the same, nothing half-written, bad records refused.

use super::body::record;
use super::{close, folder, numbers};
use morula::export::{ExportOptions, File, Format, Place, files, save};
use morula::math::Vec3;
use morula::{Error, Sphere};

fn text(format: Format, options: &ExportOptions) -> Vec<(Place, String)> {
    let all = files(&record(), format, options).unwrap();
    all.into_iter().map(|f| (f.place, String::from_utf8(f.bytes).unwrap())).collect()
}

fn one(format: Format) -> String {
    let mut all = text(format, &ExportOptions::default());
    assert_eq!(all[0].0, Place::At);
    all.swap_remove(0).1
}

/// The rows of four numbers or more between two lines.
fn rows(text: &str, from: &str, to: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().skip_while(|l| !l.starts_with(from)).skip(1);
    let lines = lines.take_while(|l| to.is_empty() || !l.starts_with(to));
    let rows = lines.map(|l| numbers(&l.replace([',', '\t', '(', ')'], " ")));
    rows.filter(|r| r.len() >= 4).collect()
}

#[test]
fn every_format_holds_the_spheres_exactly() {
    let r = record();
    let spheres = r.spheres.iter().map(|s| [s.center.x, s.center.y, s.center.z, s.radius]);
    let spheres: Vec<[f64; 4]> = spheres.collect();
    let check = |name: &str, found: Vec<Vec<f64>>| {
        let found: Vec<[f64; 4]> = found.iter().map(|f| [f[0], f[1], f[2], f[3]]).collect();
        assert_eq!(found, spheres, "{name}");
    };
    check("csv", rows(&one(Format::Csv), "x,y,z,r,mass", ""));
    check("deme", rows(&one(Format::Deme), "x,y,z,r", "#"));
    check("kratos", rows(&one(Format::Kratos), "Begin", "End"));
    check("yade", rows(&one(Format::Yade), "spheres = [", "]"));
    check("edem", rows(&format!("\n{}", one(Format::Edem)), "", ""));
    check("liggghts", rows(&format!("\n{}", one(Format::Liggghts)), "", ""));
    let mercury = text(Format::Mercury, &ExportOptions::default());
    assert_eq!(mercury[0].0, Place::Below("Clump/Clump.txt"));
    check("mercury", rows(&format!("\n{}", mercury[0].1), "", ""));
    let turned = |v: Vec<f64>| vec![v[1], v[2], v[3], v[0]];
    check(
        "pfc",
        rows(&one(Format::Pfc), "  pebbles", "  volume").into_iter().map(turned).collect(),
    );
    let lammps = one(Format::Lammps);
    let part = |name: &str, next: &str| -> Vec<Vec<f64>> {
        let lines = lammps.lines().skip_while(|l| *l != name).skip(2);
        lines.take_while(|l| *l != next && !l.is_empty()).map(numbers).collect()
    };
    let centers = part("Coords", "Types").into_iter().zip(part("Diameters", "Masses"));
    check("lammps", centers.map(|(c, d)| vec![c[1], c[2], c[3], d[1] / 2.0]).collect());
    let masses: Vec<f64> = part("Masses", "").iter().map(|m| m[1]).collect();
    assert_eq!(masses, r.masses);
    let json: serde_json::Value = serde_json::from_str(&one(Format::Json)).unwrap();
    let list = json["spheres"].as_array().unwrap().iter();
    let list = list.map(|s| s.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect());
    check("json", list.collect());
    assert_eq!(json["mass"].as_f64(), Some(r.mass));
    assert_eq!(json["frame"], "body");
    // Relative to the bounding diameter.
    let size = r.diameter();
    for (row, s) in rows(&one(Format::Mfix), "x,y,z,rel_d", "").iter().zip(&spheres) {
        (0..3).for_each(|k| close(row[k] * size, s[k], 1e-14, "mfix"));
        close(row[3] * size, 2.0 * s[3], 1e-14, "mfix");
        let free = row[4] / (std::f64::consts::PI * row[3] * row[3]);
        assert!((0.05..0.95).contains(&free), "{free}");
    }
    let vtp = one(Format::Vtp);
    assert!(vtp.contains("NumberOfPoints=\"6\"") && vtp.contains("Name=\"mass\""));
}

#[test]
fn what_the_body_is_stands_in_the_formats_that_take_it() {
    let r = record();
    let [a, b, c] = r.moments;
    let mercury = text(Format::Mercury, &ExportOptions::default());
    assert_eq!(mercury[1].1.trim().parse::<f64>().unwrap(), r.mass);
    assert_eq!(mercury[2].1, format!("{a:?},0.0,0.0\n0.0,{b:?},0.0\n0.0,0.0,{c:?}\n"));
    assert_eq!(mercury[3].1, "1.0,0.0,0.0\n0.0,1.0,0.0\n0.0,0.0,1.0\n");
    let deme = one(Format::Deme);
    assert!(deme.contains(&format!("# mass = {:?}\n# moi = {a:?}, {b:?}, {c:?}", r.mass)));
    let kratos = one(Format::Kratos);
    let tail: Vec<f64> =
        kratos.lines().skip_while(|l| !l.starts_with("Inertia")).flat_map(numbers).collect();
    (0..3).for_each(|k| close(tail[k] * r.mass, r.moments[k], 1e-14, "kratos"));
    assert!(kratos.contains("Name\nsix_spheres\n"));
    let pfc = one(Format::Pfc);
    let inertia = numbers(pfc.lines().last().unwrap());
    (0..3).for_each(|k| close(inertia[k] * r.density(), r.moments[k], 1e-14, "pfc"));
}

#[test]
fn placed_spheres_and_tensors_are_those_of_the_caller() {
    let r = record();
    let options = ExportOptions { placed: true, ..ExportOptions::default() };
    let csv = text(Format::Csv, &options).swap_remove(0).1;
    for (row, s) in rows(&csv, "x,y,z,r,mass", "").iter().zip(&r.spheres) {
        let p = r.axes * s.center + r.center;
        assert_eq!([row[0], row[1], row[2]], [p.x, p.y, p.z]);
    }
    // The tensor of the placed body by adding up its spheres.
    let body = text(Format::LammpsRigid, &options).swap_remove(0).1;
    let n = numbers(body.lines().last().unwrap());
    (0..3).for_each(|k| assert_eq!(n[2 + k], r.center[k]));
    let mut sum = [0.0; 6];
    for (s, m) in r.spheres.iter().zip(&r.masses) {
        let d: Vec3 = r.axes * s.center;
        let own = 0.4 * s.radius * s.radius + d.norm_squared();
        let each =
            [own - d.x * d.x, own - d.y * d.y, own - d.z * d.z, -d.x * d.y, -d.x * d.z, -d.y * d.z];
        sum.iter_mut().zip(each).for_each(|(t, e)| *t += m * e);
    }
    (0..6).for_each(|k| assert!((n[5 + k] - sum[k]).abs() < 1e-12 * sum[0], "{k}"));
    for format in Format::ALL.into_iter().filter(|f| !f.can_be_placed()) {
        let e = files(&r, format, &options).unwrap_err();
        assert!(matches!(e, Error::InvalidArgument(_)), "{}", format.name());
        assert!(e.to_string().contains(format.name()), "{e}");
    }
}

#[test]
fn other_units_scale_lengths_masses_and_moments() {
    let r = record();
    let options = ExportOptions { length: 1e3, mass: 1e6, ..ExportOptions::default() };
    let json = text(Format::Json, &options).swap_remove(0).1;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    close(json["mass"].as_f64().unwrap(), r.mass * 1e6, 1e-15, "mass");
    for k in 0..3 {
        close(json["center"][k].as_f64().unwrap(), r.center[k] * 1e3, 1e-15, "centre");
        close(json["spheres"][5][k].as_f64().unwrap(), r.spheres[5].center[k] * 1e3, 1e-15, "x");
    }
    close(json["spheres"][5][3].as_f64().unwrap(), r.spheres[5].radius * 1e3, 1e-15, "radius");
    close(json["masses"][5].as_f64().unwrap(), r.masses[5] * 1e6, 1e-15, "mass of a sphere");
    close(json["volume"].as_f64().unwrap(), r.volume * 1e9, 1e-15, "volume");
    close(json["principal_moments"][2].as_f64().unwrap(), r.moments[2] * 1e12, 1e-15, "moment");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        let options = ExportOptions { length: bad, ..ExportOptions::default() };
        assert!(files(&r, Format::Csv, &options).is_err(), "{bad}");
    }
}

#[test]
fn records_that_no_code_could_use_are_refused() {
    let change = |f: &dyn Fn(&mut morula::export::Record)| {
        let mut r = record();
        f(&mut r);
        files(&r, Format::Csv, &ExportOptions::default()).unwrap_err().to_string()
    };
    assert!(change(&|r| r.spheres.clear()).contains("no sphere"));
    assert!(change(&|r| r.masses[3] = 0.0).contains("sphere 3 has the mass 0"));
    assert!(change(&|r| r.masses[2] = f64::NAN).contains("sphere 2"));
    assert!(change(&|r| r.spheres[5].radius = -1.0).contains("sphere 5 has the radius"));
    assert!(change(&|r| r.moments[1] = 0.0).contains("principal moment"));
    assert!(change(&|r| r.name = "two\nlines".into()).contains("name"));
    assert!(
        change(&|r| {
            r.masses.pop();
        })
        .contains("6 spheres have 5 masses")
    );
    let mut alone = record();
    alone.spheres.truncate(1);
    alone.masses.truncate(1);
    for format in [Format::Lammps, Format::LammpsRigid] {
        let e = files(&alone, format, &ExportOptions::default()).unwrap_err();
        assert!(e.to_string().contains("two atoms or more"), "{e}");
    }
}

#[test]
fn nothing_half_written_has_the_name_asked_for() {
    let folder = folder("save");
    let whole = |bytes: &[u8]| File { place: Place::At, bytes: bytes.to_vec() };
    let path = folder.join("a.csv");
    save(&[whole(b"first")], &path).unwrap();
    save(&[whole(b"second")], &path).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"second");
    // A folder that is not there, a name that is a folder.
    let e = save(&[whole(b"x")], &folder.join("none").join("a.csv")).unwrap_err();
    assert!(matches!(e, Error::Io(_)) && e.to_string().contains("a.csv"), "{e}");
    std::fs::create_dir(folder.join("b.csv")).unwrap();
    save(&[whole(b"x")], &folder.join("b.csv")).unwrap_err();
    // The second file cannot be made: the first keeps what it had.
    let long: &'static str = "longer_than_names_may_be".repeat(20).leak();
    for ending in ["in", long] {
        let beside = File { place: Place::Beside(ending), bytes: b"y".to_vec() };
        if ending == "in" {
            std::fs::create_dir(folder.join("a.csv.in")).unwrap();
        }
        save(&[whole(b"third"), beside], &path).unwrap_err();
        assert_eq!(std::fs::read(&path).unwrap(), b"second");
    }
    // What another process is writing is left alone, and is no hindrance.
    let pid = std::process::id();
    let other = folder.join(format!("a.csv.{pid}-0.part"));
    std::fs::write(&other, b"half").unwrap();
    save(&[whole(b"fourth")], &path).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"fourth");
    assert_eq!(std::fs::read(&other).unwrap(), b"half");
    std::fs::remove_file(other).unwrap();
    let left: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(left.len(), 3, "{left:?}");
}

#[test]
fn folders_are_made_for_formats_of_several_files() {
    let folder = folder("mercury");
    let path = folder.join("Stone");
    save(&files(&record(), Format::Mercury, &ExportOptions::default()).unwrap(), &path).unwrap();
    for name in ["Clump/Clump.txt", "Inertia/Mass.txt", "Inertia/TOI.txt", "Inertia/PD.txt"] {
        assert!(path.join(name).exists(), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn links_and_devices_stay_what_they_are() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = folder("links");
    let file = |bytes: &[u8]| [File { place: Place::At, bytes: bytes.to_vec() }];
    save(&file(b"old"), &folder.join("there.csv")).unwrap();
    symlink("there.csv", folder.join("link.csv")).unwrap();
    save(&file(b"new"), &folder.join("link.csv")).unwrap();
    assert_eq!(std::fs::read(folder.join("there.csv")).unwrap(), b"new");
    assert!(folder.join("link.csv").is_symlink());
    // A device that takes nothing, as a disk that is full: one of our own where we may make it (then
    // a fault would cost it alone), else the system's, which we may not replace.
    let own = folder.join("device");
    let words = ["-m", "666", own.to_str().unwrap(), "c", "1", "7"];
    let made = std::process::Command::new("mknod").args(words).output();
    let made = made.is_ok_and(|o| o.status.success());
    let full = if made { own.as_path() } else { std::path::Path::new("/dev/full") };
    let device =
        |p: &std::path::Path| std::fs::metadata(p).is_ok_and(|m| m.file_type().is_char_device());
    if device(full) {
        symlink(full, folder.join("full.csv")).unwrap();
        let e = save(&file(b"x"), &folder.join("full.csv")).unwrap_err();
        assert!(matches!(e, Error::Io(_)), "{e}");
        assert!(device(full) && folder.join("full.csv").is_symlink());
    }
}

#[test]
fn single_precision_holds_the_spheres_and_they_lie_within() {
    let r = record();
    let options = ExportOptions { single: true, length: 1e3, ..ExportOptions::default() };
    let within = |name: &str, found: Vec<[f64; 4]>, spheres: &[Sphere], unit: f64| {
        assert_eq!(found.len(), spheres.len(), "{name}");
        for (f, s) in found.iter().zip(spheres) {
            assert_eq!(*f, f.map(|x| f64::from(x as f32)), "{name}");
            let (c, radius) = (s.center * unit, s.radius * unit);
            let out = (Vec3::new(f[0], f[1], f[2]) - c).norm() + f[3] - radius;
            assert!(out <= 1e-15 * radius && out > -1e-6 * radius, "{name}: {out:e}");
        }
    };
    let four = |rows: Vec<Vec<f64>>| -> Vec<[f64; 4]> {
        rows.iter().map(|f| [f[0], f[1], f[2], f[3]]).collect()
    };
    let first = |format, options: &ExportOptions| text(format, options).swap_remove(0).1;
    for (format, from, to) in [
        (Format::Csv, "x,y,z,r,mass", ""),
        (Format::Deme, "x,y,z,r", "#"),
        (Format::Kratos, "Begin", "End"),
        (Format::Yade, "spheres = [", "]"),
        (Format::Edem, "", ""),
        (Format::Liggghts, "", ""),
        (Format::Mercury, "", ""),
    ] {
        let all = format!("\n{}", first(format, &options));
        within(format.name(), four(rows(&all, from, to)), &r.spheres, 1e3);
    }
    let pfc = rows(&first(Format::Pfc, &options), "  pebbles", "  volume");
    let pfc = pfc.iter().map(|f| [f[1], f[2], f[3], f[0]]).collect();
    within("pfc", pfc, &r.spheres, 1e3);
    // What they are relative to is not in the file.
    let mfix = rows(&first(Format::Mfix, &options), "x,y,z,rel_d", "");
    let mfix = mfix.iter().map(|f| [f[0], f[1], f[2], f[3] / 2.0]).collect();
    within("mfix", mfix, &r.spheres, 1.0 / r.diameter());
    // In the caller's frame they are rounded there.
    let placed = ExportOptions { placed: true, single: true, ..ExportOptions::default() };
    let spheres = r.placed().unwrap();
    within("placed", four(rows(&first(Format::Csv, &placed), "x,y,z,r", "")), &spheres, 1.0);
    // LAMMPS has diameters; mass and moments keep their digits.
    let molecule = first(Format::Lammps, &options);
    let diameters = molecule.lines().skip_while(|l| *l != "Diameters").skip(2).take(6);
    for (line, s) in diameters.zip(&r.spheres) {
        let d = numbers(line)[1];
        assert!(d == f64::from(d as f32) && d <= 2e3 * s.radius && d > 1.999_99e3 * s.radius);
    }
    assert!(molecule.contains(&format!("{:?} mass", r.mass)));
    // Too far from the origin for what is left of the radius.
    let mut far = r.clone();
    far.center = Vec3::new(1e6, 0.0, 0.0);
    let e = files(&far, Format::Csv, &placed).unwrap_err();
    assert!(e.to_string().contains("single precision cannot hold sphere"), "{e}");
}

#[test]
fn what_was_written_reads_back() {
    let (r, folder) = (record(), folder("read"));
    for format in [Format::Csv, Format::Json, Format::Mercury, Format::Lammps, Format::Kratos] {
        let path = folder.join(format.name());
        save(&files(&r, format, &ExportOptions::default()).unwrap(), &path).unwrap();
        let t = morula::export::read::read(&path).unwrap();
        assert_eq!(t.spheres, r.spheres, "{}", format.name());
        if !t.masses.is_empty() {
            assert_eq!(t.masses, r.masses, "{}", format.name());
        }
        assert!(t.mass.is_none_or(|m| m == r.mass));
        assert!(t.volume.is_none_or(|v| v == r.volume));
    }
    assert!(morula::export::read::read(&folder).is_err());
    assert!(morula::export::read::read(&folder.join("none")).is_err());
}
