//! Scene files as a user writes them.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used, clippy::panic)]

use morula::dem::scene::{Over, Place, Scene, Sink, build, parse, play, rows_before, shares};
use morula::{Error, Result, Run};
use std::path::Path;

const BALL: &str = r#"
[run]
end = 0.004
step_part = 0.005
parted = true
[effects]
normal = "linear"
damping = "contact"
[materials.steel]
stiffness = 1e4
restitution = 0.6
[templates.ball]
ball = 0.01
density = 2500
material = "steel"
[[walls]]
plane = { normal = [0, 0, 2], offset = 0.5 }
material = "steel"
[[bodies]]
template = "ball"
position = [0, 0, 0.51001]
velocity = [0, 0, -1]
[output]
every = 1e-3
frames = 2e-3
measures = ["time", "vz:0", "energy"]
[quick]
output = { frames = 1 }
"#;

fn scene(text: &str, set: &[(&str, &str)]) -> Result<Scene> {
    let set: Vec<_> = set.iter().map(|(p, v)| (p.to_string(), v.to_string())).collect();
    build(&parse(text, false, &set)?, Path::new("."), &Run::serial())
}

/// Keeps what a run writes.
#[derive(Default)]
struct Kept {
    rows: Vec<Vec<Option<f64>>>,
    frames: Vec<(u64, String)>,
    checkpoints: Vec<(u64, Vec<u8>)>,
    stop: Option<u64>,
}

impl Sink for Kept {
    fn row(&mut self, values: &[Option<f64>]) -> Result<()> {
        self.rows.push(values.to_vec());
        Ok(())
    }
    fn frame(&mut self, number: u64, vtp: &str) -> Result<()> {
        self.frames.push((number, vtp.to_owned()));
        Ok(())
    }
    fn checkpoint(&mut self, steps: u64, bytes: &[u8]) -> Result<()> {
        self.checkpoints.push((steps, bytes.to_vec()));
        Ok(())
    }
    fn at(&mut self, place: &Place) -> bool {
        self.stop.is_none_or(|steps| place.steps < steps)
    }
}

#[test]
fn a_ball_rebounds_as_its_material_says() {
    for law in ["linear", "hertz"] {
        let text = match law {
            "hertz" => BALL
                .replace("\"linear\"", "\"hertz\"")
                .replace("stiffness = 1e4", "young = 1e8\npoisson = 0.3"),
            _ => BALL.to_owned(),
        };
        let mut scene = scene(&text, &[]).unwrap();
        let mut kept = Kept::default();
        let over = play(&mut scene, &mut kept, &Run::serial()).unwrap();
        assert_eq!(over, Over::Parted, "{law}");
        let speed = kept.rows.last().unwrap()[1].unwrap();
        assert!((speed - 0.6).abs() < 0.002, "{law}: {speed}");
        assert_eq!(kept.rows[0][0], Some(0.0));
        assert!(kept.frames[0].1.contains("Name=\"velocity\""));
    }
}

#[test]
fn a_caller_may_end_it_and_later_go_on() {
    let run = Run::serial();
    let text = BALL.replace("parted = true", "");
    let mut whole = scene(&text, &[]).unwrap();
    let mut kept = Kept::default();
    assert_eq!(play(&mut whole, &mut kept, &run).unwrap(), Over::End);
    let mut parts = scene(&text, &[]).unwrap();
    let mut first = Kept { stop: Some(300), ..Kept::default() };
    assert_eq!(play(&mut parts, &mut first, &run).unwrap(), Over::Cancelled);
    assert!(parts.engine.steps() >= 300 && parts.engine.steps() < whole.engine.steps());
    assert_eq!(play(&mut parts, &mut Kept::default(), &run).unwrap(), Over::End);
    assert_eq!(parts.engine.state().velocity, whole.engine.state().velocity);
    assert_eq!(parts.engine.state().position, whole.engine.state().position);
}

#[test]
fn what_cannot_be_is_told() {
    let says = |path: &str, value: &str, words: &str| {
        let Err(e) = scene(BALL, &[(path, value)]) else { panic!("{path} = {value} is taken") };
        assert!(e.to_string().contains(words), "{path} = {value}: {e}");
    };
    says("effects.gravity", "[0, 0, 0]", "effects.gravity can do nothing: it is 0");
    says("effects.tangential", "mindlin", "a tangential law needs a friction, and there is none");
    says(
        "materials.steel.friction",
        "0.3",
        "a friction of 0.3 does nothing without a tangential law",
    );
    says("effects.averaging", "true", "effects.averaging can do nothing");
    says("effects.cohesion", "linear", "needs a cohesion, and there is none");
    says("effects.normal", "hertz", "does nothing without a linear law");
    says("materials.steel.restitution", "1.5", "the restitution is 1.5, above 1");
    says("materials.steel.restitution", "-0.1", "the restitution is -0.1");
    says("materials.steel.restitution", "1", "effects.damping can do nothing");
    says("materials.steel.stiffness", "0", "the stiffness is 0");
    says("run.step", "0", "time step is 0");
    says("run.step", "1", "beyond what the clumps allow");
    says("run.end", "nan", "run.end is NaN");
    says("output.every", "0", "output.every is 0");
    says(
        "output.measures",
        "[\"vx:0\", \"kinetc\"]",
        "unknown measure kinetc; the nearest is kinetic",
    );
    says("output.measures", "[\"vx:4\"]", "a body that is not there");
    says("bodies.0.template", "bell", "the template bell, which is not there");
    says("bodies.0.position", "[0, 0, 0.501]", "wall 0 and body 0 overlap by 0.009 at the start");
    says("bodies.0.velocity", "[0, nan, 0]", "body 0 has the velocity (0, NaN, 0)");
    says("bodies.0.rotation", "[0, 0, 0, 0]", "body 0 has the rotation (0, 0, 0, 0)");
    says("templates.ball.density", "0", "the density 0");
    says("templates.ball.shape", "stone", "needs one of ball, shape, file");
    says("templates.ball.material", "wood", "the template ball is of the material wood");
    says("walls.0.material", "wood", "wall 0 is of the material wood");
    says("walls.0.box", "{ lo = [0, 0, 0], hi = [1, 1, 1] }", "wall 0 needs one of plane");
    let gone = BALL.replace("normal = \"linear\"\n", "").replace("stiffness = 1e4\n", "");
    let e = scene(&gone, &[]).map(|_| ()).unwrap_err();
    assert!(e.to_string().contains("effects.damping does nothing without effects.normal"), "{e}");
    let fixed = [("bodies.0.fixed", "true"), ("effects.gravity", "[0, 0, -9.81]")];
    let e = scene(BALL, &fixed).map(|_| ()).unwrap_err();
    assert!(e.to_string().contains("every body is fixed"), "{e}");
    assert!(matches!(e, Error::InvalidArgument(_)));
}

/// Every scene that is kept here can be read, built and begun, as it stands and as a quick one.
#[test]
fn the_scenes_of_the_project_are_sound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        for quick in [false, true] {
            let file = parse(&text, quick, &[]).unwrap_or_else(|e| panic!("{path:?}: {e}"));
            assert!(!file.title.is_empty(), "{path:?} has no title");
        }
        seen += 1;
    }
    assert!(seen >= 8);
}

const BED: &str = r#"
[run]
end = 0.03
seed = 5
speed = 0.5
[effects]
gravity = [0, 0, -9.81]
normal = "hertz"
damping = "contact"
tangential = "mindlin"
averaging = true
drag = { viscosity = 1e-3 }
[materials.sweet]
young = 1e6
poisson = 0.29
restitution = 0.5
friction = 0.35
[materials.glass]
young = 1e6
poisson = 0.29
restitution = 0.5
friction = 0.3
[[pairs]]
between = ["sweet", "glass"]
friction = 0.3
[templates.sweet]
shape = "box"
set = { a = 0.01, b = 0.008, c = 0.005 }
spheres = 6
effort = "draft"
cells = 24
density = 1377
material = "sweet"
[[walls]]
cylinder = { center = [0, 0, 0.05], axis = [0, 0, 1], radius = 0.02, length = 0.1 }
material = "glass"
[[walls]]
mesh = { shape = "box", scale = 0.004 }
material = "glass"
[[insertion]]
templates = ["sweet"]
cylinder = { center = [0, 0, 0.01], radius = 0.01, height = 0.06 }
velocity = [0, 0, -0.5]
total = 12
at_once = [1, 3]
every = 2e-3
[output]
every = 1e-3
checkpoint = 4e-3
measures = ["time", "bodies", "energy", "top", "z:3", "vx:11"]
"#;

#[test]
fn a_run_that_goes_on_is_one_that_was_never_stopped() {
    let whole = |threads: usize| {
        let mut scene = scene(BED, &[]).unwrap();
        let mut kept = Kept::default();
        play(&mut scene, &mut kept, &Run::new(threads).unwrap()).unwrap();
        (scene, kept)
    };
    let (first, kept) = whole(1);
    assert_eq!(first.engine.state().len(), 12);
    assert!(kept.rows[0][4].is_none() && kept.rows.last().unwrap().iter().all(Option::is_some));
    assert!(first.engine.work().calls.tangential > 0 && first.engine.work().drag > 0);
    let bits = |rows: &[Vec<Option<f64>>]| -> Vec<Option<u64>> {
        rows.iter().flatten().map(|v| v.map(f64::to_bits)).collect()
    };
    let (_, two) = whole(2);
    assert_eq!(bits(&kept.rows), bits(&two.rows));
    for (steps, bytes) in &kept.checkpoints[1..4] {
        let mut again = scene(BED, &[]).unwrap();
        again.resume(bytes).unwrap();
        assert_eq!(again.engine.steps(), *steps);
        let before = rows_before(&again, *steps) as usize;
        let mut rest = Kept::default();
        play(&mut again, &mut rest, &Run::serial()).unwrap();
        assert_eq!(bits(&kept.rows[before..]), bits(&rest.rows));
        assert_eq!(kept.checkpoints.last(), rest.checkpoints.last());
    }
    // Of another scene, and damaged.
    let (_, bytes) = &kept.checkpoints[1];
    let e = scene(BALL, &[]).unwrap().resume(bytes).unwrap_err().to_string();
    assert!(e.contains("material"), "{e}");
    assert!(scene(BED, &[]).unwrap().resume(&bytes[..bytes.len() - 3]).is_err());
}

#[test]
fn insertions_that_cannot_be_are_refused() {
    let says = |path: &str, value: &str, words: &str| {
        let Err(e) = scene(BED, &[(path, value)]) else { panic!("{path} = {value} is taken") };
        assert!(e.to_string().contains(words), "{path} = {value}: {e}");
    };
    says("insertion.0.templates", "[\"swet\"]", "insertion 0 is of the template swet");
    says("insertion.0.every", "0", "insertion 0 comes every 0");
    says("insertion.0.box", "{ lo = [0, 0, 0], hi = [1, 1, 1] }", "needs one of box and cylinder");
    says("insertion.0.at_once", "[3, 1]", "does nothing");
    says("effects.drag", "{ viscosity = 0 }", "a drag without viscosity or density does nothing");
    says("walls.1.mesh", "{ shape = \"bx\" }", "wall 1: no analytic particle is called");
    says("output.measures", "[\"z:12\"]", "a body that is not there: 12 are");
    says(
        "materials.glass.restitution",
        "0.7",
        "materials glass and sweet: they differ in restitution",
    );
}

/// Shares are those of the effects that are named, and of the bodies; they add up, and leave the run as it was.
#[test]
fn shares_are_of_what_is_named() {
    let run = Run::serial();
    let mut bed = scene(BED, &[("run.end", "0.012")]).unwrap();
    let mut kept = Kept::default();
    play(&mut bed, &mut kept, &run).unwrap();
    let before = bed.engine.checkpoint().unwrap();
    let bytes: Vec<Vec<u8>> = kept.checkpoints.iter().map(|c| c.1.clone()).collect();
    let found = shares(&bed, &bytes[1..], &run).unwrap();
    let names: Vec<&str> = found.iter().map(|s| s.name).collect();
    let named =
        ["insertion", "drag", "averaging", "tangential", "damping", "normal", "gravity", "bodies"];
    assert_eq!(names, named);
    assert!((found.iter().map(|s| s.part).sum::<f64>() - 1.0).abs() < 1e-12, "{found:?}");
    assert!(found.iter().all(|s| (0.0..=1.0).contains(&s.part)), "{found:?}");
    assert!(bed.engine.checkpoint().unwrap() == before);
}

/// Balls that hang where they are put.
fn hung(walls: &str, balls: &[(f64, f64, f64)], measures: &str) -> Vec<Option<f64>> {
    let bodies: String = balls
        .iter()
        .map(|(x, y, z)| {
            format!("[[bodies]]\ntemplate = \"ball\"\nposition = [{x:?}, {y:?}, {z:?}]\n")
        })
        .collect();
    let text = BALL
        .split("[[walls]]")
        .next()
        .unwrap()
        .replace("restitution = 0.6", "")
        .replace("damping = \"contact\"\n", "");
    let text =
        format!("{text}{walls}material = \"steel\"\n{bodies}[output]\nmeasures = {measures}\n");
    let scene = scene(&text, &[]).unwrap();
    scene.watch.row(&scene.engine)
}

/// Of a ball of radius r on a floor the mean top over its disc is 5/3 r; under that height a box of 6 r × 4 r is filled
/// by 4π/3 / (6 · 4 · 5/3).
#[test]
fn height_and_solid_fraction_of_a_ball_on_a_floor() {
    let r = 0.01;
    let area = [24.0, std::f64::consts::PI * 9.0];
    let walls = [
        "[[walls]]\nbox = { lo = [0.0, 0.0, 0.5], hi = [0.06, 0.04, 0.7] }\n",
        "[[walls]]\nplane = { normal = [0, 0, 3], offset = 0.5 }\nmaterial = \"steel\"\n\
         [[walls]]\ncylinder = { center = [0.03, 0.02, 0], axis = [0, 0, -2], radius = 0.03 }\n",
    ];
    for (walls, area) in walls.iter().zip(area) {
        let row = hung(
            walls,
            &[(0.025, 0.022, 0.5 + r)],
            "[\"height\", \"solid\", \"top\", \"profile\"]",
        );
        let (height, solid) = (row[0].unwrap(), row[1].unwrap());
        assert!((height / (5.0 / 3.0 * r) - 1.0).abs() < 2e-3, "{height}");
        let wanted = 4.0 / 3.0 * std::f64::consts::PI / (area * 5.0 / 3.0);
        assert!((solid / wanted - 1.0).abs() < 5e-3, "{solid} {wanted}");
        assert!((row[2].unwrap() - (0.5 + 2.0 * r)).abs() < 1e-12);
        // From the side a disc: its mean top is (1 + π/4) r; 20 places meet it.
        let profile = row[3].unwrap();
        assert!((profile / r / (1.0 + std::f64::consts::PI / 4.0) - 1.0).abs() < 0.02, "{profile}");
    }
    // Overlapping spheres count once: the same ball twice, one of them a hair higher.
    let twice = [(0.025, 0.022, 0.5 + r), (0.025, 0.022, 0.5 + 3.0 * r)];
    let row = hung(walls[0], &twice, "[\"height\", \"solid\"]");
    let (height, solid) = (row[0].unwrap(), row[1].unwrap());
    assert!((height / (11.0 / 3.0 * r) - 1.0).abs() < 2e-3, "{height}");
    let wanted = 8.0 / 3.0 * std::f64::consts::PI / (24.0 * 11.0 / 3.0);
    assert!((solid / wanted - 1.0).abs() < 5e-3, "{solid} {wanted}");
}

/// A slope of balls in a drum has the angle at which they lie, whichever way it goes up.
#[test]
fn the_angle_of_a_slope_in_a_drum() {
    let drum = "[[walls]]\ncylinder = { center = [0, 0, 1], axis = [0, 1, 0], radius = 0.22, length = 0.06 }\n";
    for angle in [31.0f64, -12.0] {
        let slope = angle.to_radians().tan();
        let mut balls: Vec<(f64, f64, f64)> = Vec::new();
        for i in -7..=7 {
            for y in [-0.019, 0.019] {
                let x = 0.022 * f64::from(i);
                balls.push((x, y, 1.0 + slope * x - 0.02));
            }
        }
        let row = hung(drum, &balls, "[\"angle\"]");
        assert!((row[0].unwrap() - angle.abs()).abs() < 0.2, "{row:?}");
    }
    // Too few to make a slope.
    assert_eq!(hung(drum, &[(0.0, 0.0, 0.9)], "[\"angle\"]"), [None]);
    // The measures are refused where there is nothing to measure them in.
    for (name, wall) in
        [("height", "an upright cylinder or box"), ("angle", "a level axis and a length")]
    {
        let e = scene(BALL, &[("output.measures", &format!("[\"{name}\"]"))]).map(|_| ());
        assert!(e.unwrap_err().to_string().contains(wall));
    }
    let e = scene(BALL, &[("output.average", "0"), ("output.measures", "[\"top\"]")]).map(|_| ());
    assert!(e.unwrap_err().to_string().contains("output.average needs the measure time"));
}
