//! The scenes of stones that break: nothing is lost, nothing is gained, pieces keep off each other.
#![cfg(feature = "dem")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use morula::dem::effects::fragmentation::BreakRecord;
use morula::dem::scene::{BREAK_COLUMNS, Place, Scene, Sink, break_line, build, parse, play};
use morula::{Result, Run};
use std::path::Path;

/// Keeps what a run writes.
#[derive(Default)]
struct Kept {
    rows: Vec<Vec<Option<f64>>>,
    breaks: Vec<BreakRecord>,
    checkpoints: Vec<(u64, Vec<u8>)>,
}

impl Sink for Kept {
    fn row(&mut self, values: &[Option<f64>]) -> Result<()> {
        self.rows.push(values.to_vec());
        Ok(())
    }
    fn frame(&mut self, _: u64, _: &str) -> Result<()> {
        Ok(())
    }
    fn checkpoint(&mut self, steps: u64, bytes: &[u8]) -> Result<()> {
        self.checkpoints.push((steps, bytes.to_vec()));
        Ok(())
    }
    fn broke(&mut self, record: &BreakRecord) -> Result<()> {
        self.breaks.push(record.clone());
        Ok(())
    }
    fn at(&mut self, _: &Place) -> bool {
        true
    }
}

fn scene(name: &str, set: &[(&str, &str)]) -> Result<Scene> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let text = std::fs::read_to_string(folder.join(name)).unwrap();
    let set: Vec<_> = set.iter().map(|(p, v)| (p.to_string(), v.to_string())).collect();
    build(&parse(&text, true, &set)?, &folder, &Run::serial())
}

/// Runs a quick scene, and from each of its checkpoints on again: the same lines, the same bytes.
fn whole(name: &str) -> Kept {
    let run = Run::serial();
    let mut first = scene(name, &[]).unwrap();
    let mut kept = Kept::default();
    play(&mut first, &mut kept, &run).unwrap();
    let dt = first.engine.setup().dt;
    let lines = |b: &[BreakRecord]| b.iter().map(|b| break_line(b, dt)).collect::<Vec<_>>();
    let checkpoints = &kept.checkpoints;
    let (steps, bytes) = &checkpoints[checkpoints.len() / 2];
    let later = kept.breaks.iter().position(|b| b.step > *steps).unwrap_or(kept.breaks.len());
    let mut again = scene(name, &[]).unwrap();
    again.resume(bytes).unwrap();
    let mut rest = Kept::default();
    play(&mut again, &mut rest, &run).unwrap();
    assert_eq!(lines(&kept.breaks[later..]), lines(&rest.breaks), "{name}");
    assert!(checkpoints.last() == rest.checkpoints.last(), "{name} goes on otherwise");
    assert!(!kept.breaks.is_empty(), "{name}: nothing broke");
    for line in lines(&kept.breaks) {
        assert_eq!(line.split(',').count(), BREAK_COLUMNS.split(',').count(), "{line}");
    }
    kept
}

/// What holds of every break.
fn check(name: &str, breaks: &[BreakRecord]) {
    for b in breaks {
        let line = break_line(b, 1.0);
        println!("{name}: {line}");
        // The rest of the body may all be dust.
        assert!(b.fragments.len() > 1 || b.dust > 0.0, "{name}: {line}");
        // Mass, momentum, angular momentum, dust included.
        assert!(b.errors().iter().all(|e| *e < 1e-12), "{name}: {line}");
        // Motion, place and springs together hold no more than before, but for rounding.
        let size = b.before.kinetic + b.before.potential.abs() + b.before.stored;
        assert!(b.after.sum() - b.before.sum() <= 1e-12 * size, "{name}: {line}");
        assert!((b.after.kinetic - b.before.kinetic).abs() <= 1e-12 * size, "{name}: {line}");
        assert!(b.after.stored <= b.before.stored + 1e-12 * size, "{name}: {line}");
        // Pieces keep off each other, and press no neighbour deeper than the body did.
        assert_eq!((b.between.count, b.between.deepest), (0, 0.0), "{name}: {line}");
        let [body, pieces] = b.around;
        assert!(pieces.deepest <= body.deepest * (1.0 + 1e-9), "{name}: {line}");
    }
}

#[test]
fn a_stone_breaks_in_free_flight() {
    let kept = whole("breakage_flight.toml");
    check("flight", &kept.breaks);
    assert_eq!(kept.breaks.len(), 2);
    assert!(kept.breaks.iter().all(|b| b.around[0].count == 0 && b.before.stored == 0.0));
    // Of a piece, at the time asked for.
    assert_eq!((kept.breaks[0].label, kept.breaks[1].label), (0, 1));
    assert!(kept.breaks[1].step.abs_diff(2 * kept.breaks[0].step) < 2);
}

#[test]
fn stones_break_on_impact() {
    let kept = whole("breakage_impact.toml");
    check("impact", &kept.breaks);
    let [first, ..] = &kept.breaks[..] else { panic!("nothing broke") };
    assert!(kept.breaks.len() >= 2);
    // Hit by the plate alone, fast, and with loaded springs.
    assert!(first.around[0].count > 0 && first.before.stored > 0.0 && first.before.kinetic > 0.01);
}

#[test]
fn stones_break_among_neighbours_that_press() {
    let kept = whole("breakage_bed.toml");
    check("bed", &kept.breaks);
    assert!(kept.breaks.len() >= 2);
    assert!(kept.breaks.iter().any(|b| b.around[0].count >= 3 && b.around[1].count > 0));
    // The springs that press hold a good part of it all.
    assert!(kept.breaks.iter().any(|b| b.before.stored > 0.01 * b.before.kinetic));
}

#[test]
fn a_breakage_that_cannot_be_is_refused() {
    let says = |name: &str, set: &[(&str, &str)], words: &str| {
        let Err(e) = scene(name, set) else { panic!("{set:?} is taken") };
        assert!(e.to_string().contains(words), "{set:?}: {e}");
    };
    let flight = "breakage_flight.toml";
    let one = |path: &str, value: &str, words: &str| says(flight, &[(path, value)], words);
    one("fragmentation.at", "[]", "names no impulse, no stress and no time");
    one("fragmentation.cels", "3", "unknown key cels; the nearest is cells");
    one("fragmentation.cells", "1", "cells is 1, not 2 to 65536");
    one("fragmentation.spheres", "0", "fragmentation.spheres is 0");
    one("fragmentation.gap", "-1e-3", "gap is -0.001, not a number of 0 or more");
    one("fragmentation.min_radius", "nan", "min_radius is NaN");
    one("fragmentation.generations", "0", "generations is 0");
    one("fragmentation.least_volume", "1", "least_volume is 1, not a number above 0 and below");
    one("fragmentation.pattern", "seded", "unknown choice seded; the nearest is seeded");
    one("fragmentation.impulse", "1", "impulse needs a window");
    one("fragmentation.window", "1", "window does nothing without impulse");
    one("fragmentation.stress", "-1", "the limit of fragmentation is -1");
    one("fragmentation.templates", "[\"ston\"]", "names ston, which is not there");
    one("fragmentation.templates", "[]", "no body that moves is of its templates");
    one("bodies.0.fixed", "true", "every body is fixed");
    one("fragmentation.at", "[{ time = 9, body = 0 }]", "at.0 is at 9, not within the run");
    one("fragmentation.at", "[{ tim = 9, body = 0 }]", "unknown key tim; the nearest is time");
    one("templates.stone.inertia", "union", "whose mass is that of its spheres");
    let both = [("fragmentation.stress", "1"), ("fragmentation.impulse", "1")];
    says(flight, &both, "impulse and stress are both there");
    let ball = [("templates.stone", "{ ball = 0.01, density = 2600, material = \"stone\" }")];
    says(flight, &ball, "stone is of given spheres, not of a shape");
}
