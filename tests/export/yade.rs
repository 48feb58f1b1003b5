use super::body::cases;
use super::rotation::{SPIN, STEP, check};
use super::{close, folder, numbers, run};
use morula::export::{ExportOptions, Format, files, save};

#[test]
fn a_clump_of_the_module_has_its_mass_and_turns_as_euler_says() {
    for case in cases() {
        let (r, folder) = (&case.record, folder(&format!("yade-{}", case.name)));
        let written = files(r, Format::Yade, &ExportOptions::default()).unwrap();
        save(&written, &folder.join("stone.py")).unwrap();
        let [a, b, c] = SPIN;
        let script = format!(
            "import sys\nsys.path.insert(0, '.')\nimport stone\n\
         O.materials.append(FrictMat(density=1, label='rock'))\n\
         clump, members = stone.append('rock')\n\
         other, _ = stone.append('rock', position=(1, 0, 0), orientation=Quaternion((1, 2, 3), 0.7))\n\
         assert len(O.materials) == 1 + len(stone.spheres)\n\
         s = O.bodies[clump].state\n\
         print('READ', s.mass, s.inertia[0], s.inertia[1], s.inertia[2], s.pos.norm())\n\
         print('MOVED', O.bodies[other].state.mass, (O.bodies[other].state.pos - Vector3(1, 0, 0)).norm())\n\
         i = s.inertia\nw = Vector3({a}, {b}, {c})\n\
         s.angVel = w\n\
         s.angMom = s.ori * (Matrix3(i[0], 0, 0, 0, i[1], 0, 0, 0, i[2]) * (s.ori.conjugate() * w))\n\
         O.engines = [ForceResetter(), NewtonIntegrator(damping=0, exactAsphericalRot=True)]\n\
         O.dt = {STEP}\nO.run(1000, True)\nv = s.angVel\nprint('SPIN', v[0], v[1], v[2])\n"
        );
        std::fs::write(folder.join("run.py"), script).unwrap();
        let Some(said) = run("yade", &["-x", "-n", "run.py"], &folder) else { return };
        let line = |word: &str| numbers(said.lines().find(|l| l.starts_with(word)).unwrap());
        let read = line("READ");
        close(read[0], r.mass, 1e-13, "mass");
        let mut moments = [read[1], read[2], read[3]];
        moments.sort_by(f64::total_cmp);
        (0..3).for_each(|k| close(moments[k], r.moments[k], 1e-12, "moment"));
        let size = r.diameter();
        assert!(read[4] < 1e-12 * size, "{read:?}");
        let moved = line("MOVED");
        close(moved[0], r.mass, 1e-13, "mass");
        assert!(moved[1] < 1e-10 * size, "{moved:?}");
        // Its integrator is of the second order; the axes of three spheres are not quite the body's.
        let within = if case.exact { 1e-3 } else { 2e-2 };
        check(&format!("YADE, {}", case.name), r.moments, 1000, &line("SPIN"), within);
    }
}
