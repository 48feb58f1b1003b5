//! What each effect of a scene costs: short reruns from states that the run went through, with one effect after the
//! other left out. The run itself is not touched, and nothing is measured where it is not asked for.

use super::Scene;
use crate::dem::contact::{CohesionLaw, DampingLaw, Laws, TangentialLaw};
use crate::dem::engine::{Engine, Setup};
use crate::error::{Result, push};
use crate::run::Run;
use std::time::Instant;

/// Steps until the lists of what is near are made, and steps that are timed.
const STEPS: [u64; 2] = [64, 192];
/// The least time of so many counts.
const REPEATS: usize = 3;

/// The share that one effect has of the time of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Its name, as in the report of the engine; `bodies` is what is left: they and the walls move.
    pub name: &'static str,
    /// 0 to 1; all together are 1.
    pub part: f64,
}

/// A scene with less and less in it.
struct Rung {
    /// What it has that the next has not.
    name: &'static str,
    setup: Setup,
    breaks: bool,
    wears: bool,
}

/// The effects that the scene names, from those that lean on others down to none. Normal forces go with the search for contacts.
fn ladder(scene: &Scene) -> Result<Vec<Rung>> {
    let setup = Setup { guard: false, ..scene.engine.setup().clone() };
    let (breaks, wears) = (scene.fragmentation.is_some(), !scene.wear.is_empty());
    let mut now = Rung { name: "bodies", setup, breaks, wears };
    let mut all = Vec::new();
    let mut less = |name: &'static str, named: bool, change: &dyn Fn(&mut Rung)| -> Result<()> {
        if named {
            let whole = Rung { name, setup: now.setup.clone(), ..now };
            push("rungs", &mut all, whole)?;
            change(&mut now);
        }
        Ok(())
    };
    let s = scene.engine.setup();
    let law = |of: &dyn Fn(&Laws) -> bool| s.laws.as_ref().is_some_and(of);
    less("fragmentation", breaks, &|r| r.breaks = false)?;
    less("wear", wears, &|r| r.wears = false)?;
    less("insertion", !s.insertion.is_empty(), &|r| {
        r.setup.insertion.iter_mut().for_each(|i| i.every = u64::MAX);
    })?;
    less("drag", s.drag.is_some(), &|r| r.setup.drag = None)?;
    let change = |of: fn(&mut Laws)| move |r: &mut Rung| r.setup.laws.iter_mut().for_each(of);
    less("averaging", law(&|l| l.averaging), &change(|l| l.averaging = false))?;
    less("rolling", law(&|l| l.rolling), &change(|l| l.rolling = false))?;
    let dry = law(&|l| l.cohesion == CohesionLaw::None);
    less("cohesion", s.laws.is_some() && !dry, &change(|l| l.cohesion = CohesionLaw::None))?;
    let smooth = law(&|l| l.tangential == TangentialLaw::None);
    let rubs = s.laws.is_some() && !smooth;
    less("tangential", rubs, &change(|l| l.tangential = TangentialLaw::None))?;
    let elastic = law(&|l| l.damping == DampingLaw::None);
    let damped = s.laws.is_some() && !elastic;
    less("damping", damped, &change(|l| l.damping = DampingLaw::None))?;
    less("normal", s.laws.is_some(), &|r| r.setup.laws = None)?;
    less("gravity", s.gravity.is_some(), &|r| r.setup.gravity = None)?;
    push("rungs", &mut all, now)?;
    Ok(all)
}

/// The shares of the effects that the scene names, from what its run kept of itself.
pub fn shares(scene: &Scene, checkpoints: &[Vec<u8>], run: &Run) -> Result<Vec<Share>> {
    let rungs = ladder(scene)?;
    let mut times = vec![0.0; rungs.len()];
    for bytes in checkpoints {
        let mut least = vec![f64::MAX; rungs.len()];
        for _ in 0..REPEATS {
            for (rung, least) in rungs.iter().zip(&mut least) {
                let mut engine = Engine::resume(rung.setup.clone(), bytes)?;
                if let (true, Some(f)) = (rung.breaks, &scene.fragmentation) {
                    engine.break_by(f.clone())?;
                }
                if rung.wears {
                    engine.wear_by(scene.wear.clone())?;
                }
                engine.advance(STEPS[0], run)?;
                let start = Instant::now();
                engine.advance(STEPS[1], run)?;
                *least = least.min(start.elapsed().as_secs_f64());
            }
        }
        times.iter_mut().zip(&least).for_each(|(sum, t)| *sum += t);
    }
    let next = times.iter().skip(1).chain([&0.0]);
    let own: Vec<f64> = times.iter().zip(next).map(|(t, next)| (t - next).max(0.0)).collect();
    let sum: f64 = own.iter().sum();
    let part = |own: f64| if sum > 0.0 { own / sum } else { 0.0 };
    Ok(rungs.iter().zip(own).map(|(r, own)| Share { name: r.name, part: part(own) }).collect())
}
