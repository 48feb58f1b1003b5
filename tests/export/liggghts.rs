use super::body::cases;
use super::rotation::{SPIN, STEP, check};
use super::{close, folder, numbers, run};
use morula::export::{ExportOptions, Format, files, save};

#[test]
fn a_template_has_its_mass_and_turns_as_euler_says() {
    for case in cases() {
        let (r, folder) = (&case.record, folder(&format!("liggghts-{}", case.name)));
        let written = files(r, Format::Liggghts, &ExportOptions::default()).unwrap();
        save(&written, &folder.join("clump.txt")).unwrap();
        let [a, b, c] = SPIN;
        let input = format!(
            "atom_style sphere\natom_modify map array\nboundary f f f\nnewton off\n\
         communicate single vel yes\nunits si\n\
         region box block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box\ncreate_box 1 box\n\
         neighbor 0.002 bin\nneigh_modify delay 0\n\
         fix m1 all property/global youngsModulus peratomtype 5e6\n\
         fix m2 all property/global poissonsRatio peratomtype 0.3\n\
         fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9\n\
         fix m4 all property/global coefficientFriction peratomtypepair 1 0.5\n\
         pair_style gran model hertz tangential history\npair_coeff * *\ntimestep {STEP}\n\
         variable clump_file string clump.txt\nvariable clump_type equal 1\n\
         include clump.txt.in\n\
         fix pdd all particledistribution/discrete 15485867 1 clump 1.0\n\
         region ins block -0.02 0.02 -0.02 0.02 -0.02 0.02 units box\n\
         fix ins all insert/pack seed 32452843 distributiontemplate pdd vel constant 0 0 0 \
         omega constant {a} {b} {c} insert_every once overlapcheck yes \
         orientation constant 0 0 0 1 all_in yes particles_in_region 1 region ins\n\
         fix ms all multisphere\nthermo_style custom step\nthermo 500\n\
         dump d all custom 500 out.txt id mass omegax omegay omegaz\n\
         dump_modify d format \"%d %.17g %.17g %.17g %.17g\"\nrun 1000\n"
        );
        std::fs::write(folder.join("in.txt"), input).unwrap();
        let Some(_) = run("liggghts", &["-in", "in.txt"], &folder) else { return };
        let text = std::fs::read_to_string(folder.join("out.txt")).unwrap();
        let n = numbers(text.lines().last().unwrap());
        close(n[1], r.mass, 1e-13, "mass");
        // It is inserted in the first step.
        check(&format!("LIGGGHTS, {}", case.name), r.moments, 999, &n[2..], 1e-7);
    }
}
