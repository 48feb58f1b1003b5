//! A stone that wears flat in place: nothing is lost, nothing is gained, it comes to rest.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use morula::dem::effects::wear::WearRecord;
use morula::dem::scene::{Place, Scene, Sink, WEAR_COLUMNS, build, parse, play, wear_line};
use morula::{Result, Run};
use std::path::Path;

#[derive(Default)]
struct Kept {
    flats: Vec<WearRecord>,
    checkpoints: Vec<Vec<u8>>,
}

impl Sink for Kept {
    fn row(&mut self, _: &[Option<f64>]) -> Result<()> {
        Ok(())
    }
    fn frame(&mut self, _: u64, _: &str) -> Result<()> {
        Ok(())
    }
    fn checkpoint(&mut self, _: u64, bytes: &[u8]) -> Result<()> {
        self.checkpoints.push(bytes.to_vec());
        Ok(())
    }
    fn wore(&mut self, record: &WearRecord) -> Result<()> {
        self.flats.push(record.clone());
        Ok(())
    }
    fn at(&mut self, _: &Place) -> bool {
        true
    }
}

fn scene(set: &[(&str, &str)]) -> Result<Scene> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let text = std::fs::read_to_string(folder.join("flatten.toml")).unwrap();
    let set: Vec<_> = set.iter().map(|(p, v)| (p.to_string(), v.to_string())).collect();
    build(&parse(&text, true, &set)?, &folder, &Run::serial())
}

#[test]
fn a_stone_wears_flat_step_by_step() {
    let run = Run::serial();
    let mut whole = scene(&[]).unwrap();
    let mut kept = Kept::default();
    play(&mut whole, &mut kept, &run).unwrap();
    let dt = whole.engine.setup().dt;
    assert_eq!(kept.flats.len(), 8);
    let mut mass = whole.templates[0].body.mass;
    for f in &kept.flats {
        let line = wear_line(f, dt);
        println!("{line}");
        assert_eq!(line.split(',').count(), WEAR_COLUMNS.split(',').count());
        assert!(f.errors.iter().all(|e| *e < 1e-12), "{line}");
        assert!((f.mass + f.dust - mass).abs() < 1e-12 * mass && f.dust > 0.0, "{line}");
        mass = f.mass;
        let size = f.before.kinetic + f.before.potential.abs() + f.before.stored;
        assert!(f.after.sum() - f.before.sum() <= 1e-12 * size, "{line}");
        assert!(f.around[1].deepest <= f.around[0].deepest * (1.0 + 1e-9), "{line}");
        assert!(f.spheres == 20 && f.coverage > 0.6 && f.mismatch() < 0.25, "{line}");
    }
    // Each flat is cut from a stone that has come to lie on the one before.
    assert!(kept.flats[1..].iter().all(|f| f.around[0].count > 0));
    // It rests, on the label that it always had, and on several spheres.
    let e = &whole.engine;
    assert_eq!(e.state().label, [0]);
    let speed = e.state().velocity[0].norm();
    assert!(speed < 1e-3, "{speed}");
    assert!(e.contacts()[1].len() >= 3, "{:?}", e.contacts()[1]);
    // From the middle on, to the same lines and bytes.
    let mut again = scene(&[]).unwrap();
    again.resume(&kept.checkpoints[4]).unwrap();
    let mut rest = Kept::default();
    play(&mut again, &mut rest, &run).unwrap();
    assert!(!rest.flats.is_empty() && kept.flats.ends_with(&rest.flats));
    assert!(kept.checkpoints.last() == rest.checkpoints.last());
}

#[test]
fn a_wear_that_cannot_be_is_refused() {
    let says = |path: &str, value: &str, words: &str| {
        let Err(e) = scene(&[(path, value)]) else { panic!("{path} = {value} is taken") };
        assert!(e.to_string().contains(words), "{path} = {value}: {e}");
    };
    says("wear.0.body", "1", "wear 0 is of the body 1, which is not there");
    says("wear.0.evry", "1", "unknown key evry; the nearest is every");
    says("wear.0.every", "9", "wear 0 comes every 9, not above 0 and within the run");
    says("wear.0.times", "0", "wear 0 comes 0 times");
    says("wear.0.depth", "0", "wear 0 has the depth 0");
    says("wear.0.direction", "[0, 0, 0]", "wear 0 has the direction (0, 0, 0)");
    says("wear.0.spheres", "0", "wear 0 leaves 0 spheres");
    says("templates.stone.inertia", "union", "whose mass is that of its spheres");
    let ball = "{ ball = 0.005, density = 2600, material = \"stone\" }";
    let both = [("templates.stone", ball), ("effects.averaging", "false")];
    let Err(e) = scene(&both) else { panic!("a ball wears") };
    assert!(e.to_string().contains("stone is of given spheres, not of a shape"), "{e}");
    let breaks = "{ templates = [\"stone\"], stress = 1, cells = 3 }";
    says("fragmentation", breaks, "wear 0 is of the body 0, which breaks");
}
