//! One simulation from its file to its end.

use super::out::{CHECKPOINT, Out};
use crate::cpu;
use crate::fail::{About, Done, Fail};
use crate::progress::Bar;
use morula::Run;
use morula::dem::scene::{Mean, Over, Scene, Share, block_mean, build, parse, play, shares};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What is to be simulated, and where to.
pub struct Job<'a> {
    /// The scene file.
    pub scene: &'a Path,
    pub quick: bool,
    pub set: &'a [(String, String)],
    pub output: Option<PathBuf>,
    pub resume: bool,
    pub threads: usize,
    /// Whether the share of each effect is measured afterwards.
    pub shares: bool,
    /// Said on the bar before all else.
    pub what: String,
    /// Neither bar nor notes.
    pub quiet: bool,
}

/// A simulation that has ended.
pub struct Ran {
    pub scene: Scene,
    pub over: Over,
    /// All lines of measures.
    pub rows: Vec<Vec<Option<f64>>>,
    /// By the clock, without the clumps, since it began or went on.
    pub seconds: f64,
    /// Processor time.
    pub worked: Option<f64>,
    /// Steps in that time.
    pub steps: u64,
    /// Shares of the effects, where they were asked for.
    pub parts: Vec<Share>,
}

impl Ran {
    /// The mean of a measure over the lines from `output.average` on; without that, its last value.
    pub fn mean(&self, measure: usize) -> Option<Mean> {
        let names = self.scene.watch.names();
        let Some(from) = self.scene.average else {
            let last = (*self.rows.last()?.get(measure)?)?;
            return block_mean(&[last]);
        };
        let time = names.iter().position(|n| n == "time")?;
        let late =
            |row: &&Vec<Option<f64>>| row.get(time).is_some_and(|t| t.is_some_and(|t| t >= from));
        let values: Vec<f64> =
            self.rows.iter().filter(late).filter_map(|r| *r.get(measure)?).collect();
        block_mean(&values)
    }
}

/// Runs it.
pub fn go(job: &Job) -> Done<Ran> {
    let name = job.scene.display().to_string();
    let text = std::fs::read_to_string(job.scene).map_err(|e| Fail::file(job.scene, e))?;
    let file = parse(&text, job.quick, job.set).about(&name)?;
    let bar = Bar::new(&format!("{}making clumps", job.what), job.quiet);
    let seed = file.run.seed;
    let made = bar.attach(Run::new(job.threads).about("--threads")?.with_seed(seed));
    let folder = job.scene.parent().unwrap_or(Path::new("."));
    let mut scene = build(&file, folder, &made).about(&name)?;
    drop(made);
    if !job.quiet {
        for note in &scene.notes {
            let _ = writeln!(std::io::stderr(), "note: {note}");
        }
    }
    if let (true, Some(folder)) = (job.resume, &job.output) {
        let path = folder.join(CHECKPOINT);
        let bytes = std::fs::read(&path).map_err(|e| Fail::file(&path, e))?;
        scene.resume(&bytes).about(&path.display().to_string())?;
    }
    if job.shares {
        scene.checkpoint.get_or_insert(scene.end / 8.0);
    }
    let mut out = Out::new(job, &scene, &bar)?;
    let run = Run::new(job.threads).about("--threads")?;
    let (start, before, first) = (Instant::now(), cpu::seconds(), scene.engine.steps());
    let over = play(&mut scene, &mut out, &run).about(&name)?;
    let seconds = start.elapsed().as_secs_f64();
    let worked = cpu::seconds().zip(before).map(|(after, before)| (after - before).max(0.0));
    out.flush().about(&name)?;
    let parts = match &out.kept {
        Some(kept) => shares(&scene, kept, &run).about(&name)?,
        None => Vec::new(),
    };
    let steps = scene.engine.steps() - first;
    let rows = std::mem::take(&mut out.rows);
    Ok(Ran { scene, over, rows, seconds, worked, steps, parts })
}
