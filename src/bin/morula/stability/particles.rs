//! Invariance on real particles: two of them, all with `--full`.

use super::bodies::{Arrays, Ask, apart, made, moved, on_lattice, shuffled};
use super::invariance::{ANOTHER, BITS, PERCENT, PLACES, TURNED, change, images, turned};
use super::{Matrix, Miss};
use morula::generate::{Effort, Method};
use morula::run::Run;
use morula::shape::read::FileOptions;
use morula::shape::{Body, Shape};
use std::path::{Path, PathBuf};

pub fn run(m: &mut Matrix) {
    let Some(data) = m.data.clone() else {
        return [&BITS, &PLACES, &PERCENT, &TURNED]
            .iter()
            .for_each(|about| m.skip("real particles", about, "no data"));
    };
    let found = match m.full {
        true => all(&data.join("particles")),
        false => Ok(["asteroid/kleopatra.obj", "cement/cement140_02475_rough.stl"]
            .map(|name| data.join("particles").join(name))
            .into()),
    };
    match found {
        Ok(paths) => paths.iter().for_each(|path| particle(m, path)),
        Err(error) => m.case("real particles", &BITS, || Err(error)),
    }
}

/// The particles' files, by name.
fn all(folder: &Path) -> Result<Vec<PathBuf>, Miss> {
    let mut paths = Vec::new();
    let of = |folder: &Path| std::fs::read_dir(folder).map_err(|e| Miss(e.to_string()));
    for kind in of(folder)? {
        let kind = kind.map_err(|e| Miss(e.to_string()))?.path();
        for path in of(&kind)? {
            let path = path.map_err(|e| Miss(e.to_string()))?.path();
            if path.extension().is_some_and(|e| e == "obj" || e == "stl") {
                paths.push(path);
            }
        }
    }
    paths.sort();
    Ok(paths)
}

/// The surface as the import leaves it, of a size near 1.
fn surface(path: &Path) -> Result<Arrays, Miss> {
    let shape = Shape::from_file(path, &FileOptions::default(), &Run::serial())?;
    match &*shape.body {
        Body::Mesh(mesh) => {
            let of = |v: &morula::math::Vec3| [v.x, v.y, v.z];
            Ok((mesh.vertices.iter().map(of).collect(), mesh.faces.clone()))
        }
        Body::Voxels(_) => Err(Miss("no mesh".into())),
    }
}

fn particle(m: &mut Matrix, path: &Path) {
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mesh = match surface(path) {
        Ok(mesh) => mesh,
        Err(miss) => return m.case(name, &PERCENT, || Err(miss)),
    };
    let (draft, ask) =
        (Ask::new(Method::Best, 20), Ask { effort: Effort::Normal, ..Ask::new(Method::Best, 20) });
    m.case(format!("{name} times 2^-40"), &BITS, || {
        let small = 2f64.powi(-40);
        let put = moved(&mesh, |p| p.map(|x| x * small));
        apart(&made(&put, &draft)?.1, &made(&mesh, &draft)?.1, small, [0.0; 3])
    });
    m.case(format!("{name} on 3 threads"), &BITS, || {
        let many = made(&mesh, &Ask { threads: 3, ..draft })?.1;
        apart(&many, &made(&mesh, &draft)?.1, 1.0, [0.0; 3])
    });
    m.case(format!("{name} 1e8 sizes away, exactly"), &PLACES, || {
        let (mesh, shift) = (on_lattice(mesh.clone()), [1e8, -3e7, 17.0]);
        let put = moved(&mesh, |p| [0, 1, 2].map(|i| p[i] + shift[i]));
        let off = apart(&made(&put, &draft)?.1, &made(&mesh, &draft)?.1, 1.0, shift)?;
        Ok(off / (1e8 * 0.5 * f64::EPSILON))
    });
    let far = [1e8 / 3.0, -1e8 / 7.0, 1e8 / 1.1];
    let faces: Vec<[u32; 3]> =
        shuffled(mesh.1.len(), 3).into_iter().map(|i| mesh.1[i as usize]).collect();
    for (what, about, changed) in [
        ("times 7.7e-12", &PERCENT, moved(&mesh, |p| p.map(|x| x * 7.7e-12))),
        ("triangles in another order", &PERCENT, (mesh.0.clone(), faces)),
        ("1e8 sizes away, rounded", &ANOTHER, moved(&mesh, |p| [0, 1, 2].map(|i| p[i] + far[i]))),
        ("rounded to single precision", &ANOTHER, moved(&mesh, |p| p.map(|x| f64::from(x as f32)))),
    ] {
        m.case(format!("{name}, {what}"), about, || change(&mesh, &changed, &ask));
    }
    images(m, &name, &on_lattice(mesh.clone()), &ask);
    m.case(format!("{name}, turned"), &TURNED, || turned(&mesh, &ask));
}
