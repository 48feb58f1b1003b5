//! A scene from its start to its end.

use super::Scene;
use super::frames::frame;
use crate::dem::effects::fragmentation::BreakRecord;
use crate::dem::effects::wear::WearRecord;
use crate::dem::energy;
use crate::error::Result;
use crate::run::Run;

/// Steps between two looks at whether the run is over.
const LOOK: u64 = 256;

/// Where a running scene is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Time so far, and when it ends.
    pub time: f64,
    /// The end.
    pub end: f64,
    /// Steps so far.
    pub steps: u64,
}

/// Takes what a run writes down. An error of its ends the run.
pub trait Sink {
    /// A line of measures, in the order of [`super::Watch::names`].
    fn row(&mut self, values: &[Option<f64>]) -> Result<()>;
    /// Frame `number`, from 0, as a VTP file.
    fn frame(&mut self, number: u64, vtp: &str) -> Result<()>;
    /// A checkpoint after so many steps.
    fn checkpoint(&mut self, steps: u64, bytes: &[u8]) -> Result<()>;
    /// A body has broken.
    fn broke(&mut self, _: &BreakRecord) -> Result<()> {
        Ok(())
    }
    /// A body has worn.
    fn wore(&mut self, _: &WearRecord) -> Result<()> {
        Ok(())
    }
    /// Asked now and then; what it returns says whether to go on.
    fn at(&mut self, place: &Place) -> bool;
}

/// Why a run was over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Its time was.
    End,
    /// The bodies were at rest.
    Rest,
    /// They had parted.
    Parted,
    /// The caller wanted no more.
    Cancelled,
}

/// Runs a scene on from where it is to its end.
pub fn play(scene: &mut Scene, sink: &mut dyn Sink, run: &Run) -> Result<Over> {
    let dt = scene.engine.setup().dt;
    let count = |time: f64| ((time / dt).round().max(1.0)) as u64;
    let last = count(scene.end);
    let every = scene.every.map(count);
    let frames = scene.frames.map(count);
    let kept = scene.checkpoint.map(count);
    scene.engine.start(run)?;
    if scene.engine.steps() == 0 {
        sink.row(&scene.watch.row(&scene.engine))?;
        if frames.is_some() {
            sink.frame(0, &frame(&scene.engine))?;
        }
    }
    let mut told = [scene.engine.breaks().len(), scene.engine.flats().len()];
    let mut contacts = scene.engine.work().contacts;
    let mut over = Over::End;
    while scene.engine.steps() < last {
        let at = scene.engine.steps();
        let next = |period: Option<u64>| period.map_or(last, |p| (at / p + 1) * p);
        let to =
            last.min(next(every)).min(next(frames)).min(next(kept)).min((at / LOOK + 1) * LOOK);
        let advanced = scene.engine.advance(to - at, run);
        for b in scene.engine.breaks().iter().skip(told[0]) {
            sink.broke(b)?;
        }
        for w in scene.engine.flats().iter().skip(told[1]) {
            sink.wore(w)?;
        }
        told = [scene.engine.breaks().len(), scene.engine.flats().len()];
        advanced?;
        let due = |period: Option<u64>| period.is_some_and(|p| to.is_multiple_of(p));
        if due(every) && to < last {
            sink.row(&scene.watch.row(&scene.engine))?;
        }
        if due(frames) {
            let number = to / frames.unwrap_or(1);
            sink.frame(number, &frame(&scene.engine))?;
        }
        if due(kept) && to < last {
            sink.checkpoint(to, &scene.engine.checkpoint()?)?;
        }
        let place = Place { time: scene.engine.time(), end: scene.end, steps: to };
        if !sink.at(&place) {
            over = Over::Cancelled;
            break;
        }
        if let Some(rest) = scene.rest {
            let [a, b] = energy::kinetic(scene.engine.state());
            if a + b < rest {
                over = Over::Rest;
                break;
            }
        }
        if scene.parted {
            // None since the last look, and some before.
            let now = scene.engine.work().contacts;
            if now > 0 && now == contacts {
                over = Over::Parted;
                break;
            }
            contacts = now;
        }
    }
    sink.row(&scene.watch.row(&scene.engine))?;
    sink.checkpoint(scene.engine.steps(), &scene.engine.checkpoint()?)?;
    Ok(over)
}

/// How many lines of measures a run has written when it has come to a step that is a checkpoint's.
pub fn rows_before(scene: &Scene, steps: u64) -> u64 {
    let dt = scene.engine.setup().dt;
    1 + scene.every.map_or(0, |every| steps / ((every / dt).round().max(1.0)) as u64)
}
