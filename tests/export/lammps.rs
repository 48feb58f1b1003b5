use super::body::{Case, cases};
use super::rotation::{SPIN, STEP, check};
use super::{close, folder, numbers, run};
use morula::export::{ExportOptions, Format, Record, files, save};
use std::path::Path;

/// Atoms of the template, joined by the fix with the file of the body.
const INPUT: &str = "\
units si
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary f f f
region box block -0.1 0.1 -0.1 0.1 -0.1 0.1
create_box 1 box
molecule clump clump.mol
fix prop all property/atom mol ghost yes
create_atoms 0 single 0 0 0 mol clump 12345 rotate 0 0 0 1 units box
neigh_modify exclude molecule/intra all
comm_modify cutoff 0.02
pair_style granular
pair_coeff * * hertz/material 5e7 0.5 0.29 tangential mindlin NULL 1.0 0.35 damping tsuji
";

const OUTPUT: &str = "
thermo_style custom step
compute b all rigid/local rigid id mass inertiax inertiay inertiaz omegax omegay omegaz x y z
dump d all local 1000 out.txt index c_b[2] c_b[3] c_b[4] c_b[5] c_b[6] c_b[7] c_b[8]
dump_modify d format float %.17g
";

fn write(r: &Record, format: Format, path: &Path) {
    save(&files(r, format, &ExportOptions::default()).unwrap(), path).unwrap();
}

/// Mass, principal moments ascending, angular velocity.
type Dumped = (f64, [f64; 3], [f64; 3]);

/// The last body that was dumped.
fn last(folder: &Path) -> Dumped {
    let text = std::fs::read_to_string(folder.join("out.txt")).unwrap();
    let n = numbers(text.lines().last().unwrap());
    let mut moments = [n[2], n[3], n[4]];
    moments.sort_by(f64::total_cmp);
    (n[1], moments, [n[5], n[6], n[7]])
}

/// The body of the infile, spinning; what it is after 1000 steps, and what was said. None where a program is not there.
fn spun(r: &Record, folder: &Path, program: &str, words: &[&str]) -> Option<(String, Dumped)> {
    write(r, Format::Lammps, &folder.join("clump.mol"));
    write(r, Format::LammpsRigid, &folder.join("body.txt"));
    // The file's body is at rest: give it its angular momentum, the nine last numbers' middle.
    let text = std::fs::read_to_string(folder.join("body.txt")).unwrap();
    let l = [0, 1, 2].map(|k| r.moments[k] * SPIN[k]);
    let moving = text.trim_end().strip_suffix("0 0 0 0 0 0 0 0 0").unwrap();
    let moving = format!("{moving}0 0 0 {:?} {:?} {:?} 0 0 0\n", l[0], l[1], l[2]);
    std::fs::write(folder.join("body.txt"), moving).unwrap();
    let input = format!(
        "{INPUT}fix rigid all rigid/small molecule mol clump infile body.txt\ntimestep {STEP}\n{OUTPUT}run 1000\n"
    );
    std::fs::write(folder.join("in.txt"), input).unwrap();
    let said = run(program, &[words, &["-in", "in.txt", "-log", "none"]].concat(), folder)?;
    Some((said, last(folder)))
}

#[test]
fn a_body_of_the_infile_has_its_mass_and_turns_as_euler_says() {
    for Case { name, record: r, .. } in cases() {
        let folder = folder(&format!("lammps-infile-{name}"));
        let Some((_, (mass, moments, spin))) = spun(&r, &folder, "lmp", &[]) else { return };
        close(mass, r.mass, 1e-14, "mass");
        (0..3).for_each(|k| close(moments[k], r.moments[k], 1e-13, "moment"));
        check(&format!("LAMMPS, {name}"), r.moments, 1000, &spin, 1e-7);
    }
}

#[test]
fn two_ranks_turn_a_body_as_one_does() {
    if run("lmp", &["-help"], Path::new(".")).is_none() {
        return;
    }
    // It lies across the border between the two halves of the box.
    for Case { name, record: r, .. } in cases() {
        let folder = folder(&format!("lammps-ranks-{name}"));
        let words = ["--oversubscribe", "-np", "2", "lmp"];
        let Some((said, last)) = spun(&r, &folder, "mpirun", &words) else { return };
        assert!(said.contains("1 by 1 by 2 MPI processor grid"), "{said}");
        let (mass, moments, spin) = last;
        close(mass, r.mass, 1e-14, "mass");
        (0..3).for_each(|k| close(moments[k], r.moments[k], 1e-13, "moment"));
        check(&format!("LAMMPS on two ranks, {name}"), r.moments, 1000, &spin, 1e-7);
    }
}

#[test]
fn atoms_alone_add_up_to_the_body() {
    // Without the infile LAMMPS adds up the atoms as solid spheres: the corrected masses make that
    // the body's own mass and moments.
    for Case { name, record: r, exact } in cases() {
        let folder = folder(&format!("lammps-atoms-{name}"));
        write(&r, Format::Lammps, &folder.join("clump.mol"));
        let input =
            format!("{INPUT}fix rigid all rigid/small molecule\ntimestep {STEP}\n{OUTPUT}run 0\n");
        std::fs::write(folder.join("in.txt"), input).unwrap();
        if run("lmp", &["-in", "in.txt", "-log", "none"], &folder).is_none() {
            return;
        }
        let (mass, moments, _) = last(&folder);
        close(mass, r.mass, 1e-13, "mass");
        // Three spheres have no such masses: as near as they can be.
        let within = if exact { 1e-12 } else { 0.2 };
        (0..3).for_each(|k| close(moments[k], r.moments[k], within, "moment"));
    }
}

#[test]
fn a_template_that_is_deposited_has_the_moments_of_its_header() {
    // No atom yet, so the fix takes mass and inertia from the template.
    let start =
        INPUT.replace("create_atoms 0 single 0 0 0 mol clump 12345 rotate 0 0 0 1 units box\n", "");
    for Case { name, record: r, .. } in cases() {
        let folder = folder(&format!("lammps-deposit-{name}"));
        write(&r, Format::Lammps, &folder.join("clump.mol"));
        let input = format!(
            "{start}fix rigid all rigid/small molecule mol clump\n\
             region ins block -0.05 0.05 -0.05 0.05 -0.05 0.05\n\
             fix dep all deposit 1 0 1 12345 region ins mol clump rigid rigid near 0.01\n\
             timestep {STEP}\n{OUTPUT}run 1000\n"
        );
        std::fs::write(folder.join("in.txt"), input).unwrap();
        if run("lmp", &["-in", "in.txt", "-log", "none"], &folder).is_none() {
            return;
        }
        let (mass, moments, _) = last(&folder);
        close(mass, r.mass, 1e-14, "mass");
        (0..3).for_each(|k| close(moments[k], r.moments[k], 1e-13, "moment"));
    }
}
