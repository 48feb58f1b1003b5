//! The same bed in LAMMPS: `fix rigid/small` with our bodies, `pair_style granular` with our law.

use super::{FRICTION, POISSON, RADIUS, STEP, YOUNG};
use morula::dem::Engine;
use nalgebra::Matrix3;
use std::fmt::Write;
use std::process::Command;

/// The restitution at which LAMMPS's polynomial for `damping tsuji` gives our dashpot.
fn restitution(alpha: f64) -> f64 {
    let polynomial = |e: f64| {
        let c = [1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218];
        c.iter().rev().fold(0.0, |sum, c| sum * e + c)
    };
    let (mut lo, mut hi) = (0.0, 1.0);
    for _ in 0..60 {
        let e = 0.5 * (lo + hi);
        if polynomial(e) > alpha { lo = e } else { hi = e }
    }
    0.5 * (lo + hi)
}

/// Mean height of all spheres.
pub fn height(engine: &Engine) -> f64 {
    let s = engine.state();
    let all = (0..s.len()).flat_map(|i| (0..s.template_of(i).spheres().len()).map(move |k| (i, k)));
    let (sum, count) = all.fold((0.0, 0), |(z, n), (i, k)| (z + s.sphere_center(i, k).z, n + 1));
    sum / f64::from(count)
}

/// Data file and file of bodies.
fn files(engine: &Engine) -> (String, String) {
    let s = engine.state();
    let (mut atoms, mut molecules, mut bodies) = (String::new(), String::new(), String::new());
    let mut id = 0;
    for i in 0..s.len() {
        let t = s.template_of(i);
        for (k, sphere) in t.spheres().iter().enumerate() {
            id += 1;
            let c = s.sphere_center(i, k);
            let d = 2.0 * sphere.radius;
            writeln!(atoms, "{id} 1 {d:?} 1377 {:?} {:?} {:?}", c.x, c.y, c.z).unwrap();
            writeln!(molecules, "{id} {}", i + 1).unwrap();
        }
        let r = s.orientation[i].matrix();
        let own = Matrix3::from_diagonal(&t.moments().into());
        let j = r * own * r.transpose();
        let (x, v, l) = (s.position[i], s.velocity[i], s.momentum[i]);
        writeln!(
            bodies,
            "{} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} 0 0 0",
            i + 1,
            t.mass(),
            x.x, x.y, x.z,
            j.m11, j.m22, j.m33, j.m12, j.m13, j.m23,
            v.x, v.y, v.z,
            l.x, l.y, l.z
        )
        .unwrap();
    }
    let data = format!(
        "clumps\n\n{id} atoms\n1 atom types\n\n-0.03 0.03 xlo xhi\n-0.03 0.03 ylo yhi\n-0.01 1.0 zlo zhi\n\nAtoms # sphere\n\n{atoms}\nMolecules\n\n{molecules}"
    );
    (data, format!("{}\n{bodies}", s.len()))
}

/// Processor seconds of a step, the mean height of the spheres afterwards, and the skin with which it was fastest.
pub fn time(engine: &Engine, steps: u64, skins: &[f64]) -> Option<(f64, f64, f64)> {
    let folder = std::env::temp_dir().join(format!("morula-dem-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (data, bodies) = files(engine);
    std::fs::write(folder.join("clumps.data"), data).unwrap();
    std::fs::write(folder.join("bodies"), bodies).unwrap();
    let e = restitution(engine.setup().coefficients[0].damping);
    let law = format!(
        "hertz/material {YOUNG} {e} {POISSON} tangential mindlin NULL 1.0 {FRICTION} damping tsuji limit_damping"
    );
    let reach = 2.2 * engine.state().template_of(0).bound();
    let mut best: Option<(f64, f64, f64)> = None;
    for &skin in skins {
        let input = format!(
            "units si
atom_style sphere
atom_modify map array
boundary f f f
comm_modify vel yes cutoff {reach}
fix prop all property/atom mol ghost yes
read_data clumps.data fix prop NULL Molecules
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes exclude molecule/intra all
pair_style granular
pair_coeff * * {law}
timestep {STEP}
fix g all gravity 9.81 vector 0 0 -1 disable
fix rb all rigid/small molecule infile bodies gravity g
fix floor all wall/gran granular {law} zplane 0.0 NULL
fix side all wall/gran granular {law} zcylinder {RADIUS}
compute z all property/atom z
compute mean all reduce ave c_z
thermo_style custom step c_mean
thermo_modify format float %.12g
thermo {steps}
run {steps}
"
        );
        std::fs::write(folder.join("in"), input).unwrap();
        let out = Command::new("lmp")
            .args(["-in", "in", "-log", "none"])
            .env("OMP_NUM_THREADS", "1")
            .current_dir(&folder)
            .output()
            .ok()?;
        let text = String::from_utf8_lossy(&out.stdout).into_owned();
        let after = |mark: &str| text.split(mark).nth(1).map(str::trim_start);
        let first = |text: &str| text.split([' ', '%']).next().unwrap_or("").parse::<f64>().ok();
        let Some(loop_time) = after("Loop time of").and_then(first) else {
            println!("lmp failed: {text}");
            return None;
        };
        let share = text.lines().find_map(|l| {
            l.split_once("% CPU use").and_then(|(s, _)| s.trim().parse::<f64>().ok())
        })?;
        let z = text
            .lines()
            .filter_map(|l| {
                let mut w = l.split_whitespace();
                (w.next()? == steps.to_string()).then(|| w.next()?.parse::<f64>().ok())?
            })
            .next()?;
        let step = loop_time * share / 100.0 / steps as f64;
        println!("  lammps with a skin of {skin}: {:.1} microseconds a step", step * 1e6);
        if best.is_none_or(|b| step < b.0) {
            best = Some((step, z, skin));
        }
    }
    let _ = std::fs::remove_dir_all(&folder);
    best
}
