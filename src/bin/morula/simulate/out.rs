//! What a simulation writes while it runs.

use super::Job;
use crate::fail::{Done, Fail};
use crate::progress::Bar;
use morula::dem::effects::fragmentation::BreakRecord;
use morula::dem::effects::wear::WearRecord;
use morula::dem::scene::{
    BREAK_COLUMNS, Place, Scene, Sink, WEAR_COLUMNS, break_line, rows_before, wear_line,
};
use morula::export::save_in;
use morula::{Error, Result};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The newest checkpoint.
pub const CHECKPOINT: &str = "checkpoint.bin";
/// Most checkpoints from which shares are measured.
const KEPT: usize = 8;

/// Which lines of a table stay: by number and text.
type Keep<'a> = &'a dyn Fn(usize, &str) -> bool;

/// A table that grows while it runs.
struct Csv {
    path: PathBuf,
    to: BufWriter<File>,
    /// The lines of the old one.
    kept: String,
}

impl Csv {
    /// With the lines of an old one, in their order, for which `keep` is true where it goes on.
    fn new(folder: &Path, name: &str, head: &str, keep: Option<Keep>) -> Done<Csv> {
        let path = folder.join(name);
        let mut kept = String::new();
        if let Some(keep) = keep {
            let old = std::fs::read_to_string(&path).map_err(|e| Fail::file(&path, e))?;
            let lines = old.lines().skip(1).enumerate().filter(|(i, l)| keep(*i, l));
            kept = lines.map(|(_, l)| format!("{l}\n")).collect();
        }
        let file = File::create(&path).map_err(|e| Fail::file(&path, e))?;
        let mut to = BufWriter::new(file);
        write!(to, "{head}\n{kept}").map_err(|e| Fail::file(&path, e))?;
        Ok(Csv { path, to, kept })
    }

    fn line(&mut self, line: &str) -> Result<()> {
        writeln!(self.to, "{line}").map_err(|e| io(&self.path, &e))
    }
}

/// What the run writes.
pub struct Out<'a> {
    /// All lines of measures, those of the run that goes on as well.
    pub rows: Vec<Vec<Option<f64>>>,
    measures: Option<Csv>,
    breaks: Option<Csv>,
    wear: Option<Csv>,
    /// Some of the checkpoints, where shares are asked for.
    pub kept: Option<Vec<Vec<u8>>>,
    folder: Option<PathBuf>,
    dt: f64,
    bar: &'a Bar,
    what: &'a str,
    start: Instant,
    /// Steps when it began.
    first: u64,
}

/// The numbers of a line, empty fields as nothing.
fn numbers(line: &str) -> Vec<Option<f64>> {
    line.split(',').map(|v| v.parse().ok()).collect()
}

/// Whether a line that begins with its step is of a run up to `steps`.
fn until(steps: u64) -> impl Fn(usize, &str) -> bool {
    move |_, line| {
        let step = line.split(',').next().and_then(|s| s.parse::<u64>().ok());
        step.is_some_and(|s| s <= steps)
    }
}

impl<'a> Out<'a> {
    pub fn new(job: &'a Job, scene: &Scene, bar: &'a Bar) -> Done<Out<'a>> {
        let folder = job.output.as_deref();
        let mut rows = Vec::new();
        let (first, dt) = (scene.engine.steps(), scene.engine.setup().dt);
        let (mut measures, mut breaks, mut wear) = (None, None, None);
        if let Some(folder) = folder {
            std::fs::create_dir_all(folder).map_err(|e| Fail::file(folder, e))?;
            // Of a run that goes on, the lines up to the checkpoint stay.
            let lines = rows_before(scene, first) as usize;
            let early = move |i: usize, _: &str| i < lines;
            let until = until(first);
            let old = |keep| job.resume.then_some(keep);
            let names = scene.watch.names().join(",");
            let keep = old(&early as Keep);
            let table = Csv::new(folder, "measures.csv", &names, keep)?;
            rows = table.kept.lines().map(numbers).collect();
            measures = Some(table);
            if scene.fragmentation.is_some() {
                breaks = Some(Csv::new(folder, "breaks.csv", BREAK_COLUMNS, old(&until))?);
            }
            if !scene.wear.is_empty() {
                wear = Some(Csv::new(folder, "wear.csv", WEAR_COLUMNS, old(&until))?);
            }
        }
        let kept = job.shares.then(Vec::new);
        let (folder, what, start) = (job.output.clone(), &job.what[..], Instant::now());
        Ok(Out { rows, measures, breaks, wear, kept, folder, dt, bar, what, start, first })
    }

    pub fn flush(&mut self) -> Result<()> {
        for csv in [&mut self.measures, &mut self.breaks, &mut self.wear].into_iter().flatten() {
            csv.to.flush().map_err(|e| io(&csv.path, &e))?;
        }
        Ok(())
    }
}

fn io(path: &Path, e: &std::io::Error) -> Error {
    Error::Io(format!("{}: {e}", path.display()))
}

impl Sink for Out<'_> {
    fn row(&mut self, values: &[Option<f64>]) -> Result<()> {
        self.rows.push(values.to_vec());
        let text: Vec<String> =
            values.iter().map(|v| v.map_or(String::new(), |v| format!("{v:?}"))).collect();
        self.measures.as_mut().map_or(Ok(()), |csv| csv.line(&text.join(",")))
    }

    fn wore(&mut self, record: &WearRecord) -> Result<()> {
        let line = wear_line(record, self.dt);
        self.wear.as_mut().map_or(Ok(()), |csv| csv.line(&line))
    }

    fn broke(&mut self, record: &BreakRecord) -> Result<()> {
        let line = break_line(record, self.dt);
        self.breaks.as_mut().map_or(Ok(()), |csv| csv.line(&line))
    }

    fn frame(&mut self, number: u64, vtp: &str) -> Result<()> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let path = folder.join(format!("frame_{number:06}.vtp"));
        std::fs::write(&path, vtp).map_err(|e| io(&path, &e))
    }

    fn checkpoint(&mut self, _: u64, bytes: &[u8]) -> Result<()> {
        if let Some(kept) = &mut self.kept {
            kept.push(bytes.to_vec());
            if kept.len() > KEPT {
                // Every second one goes.
                let mut even = false;
                kept.retain(|_| {
                    even = !even;
                    even
                });
            }
        }
        // What stands in the tables then is as old as the checkpoint.
        self.flush()?;
        let Some(folder) = &self.folder else { return Ok(()) };
        save_in(folder, &[(CHECKPOINT.to_owned(), bytes.to_vec())])
    }

    fn at(&mut self, place: &Place) -> bool {
        let seconds = self.start.elapsed().as_secs_f64();
        let part = (place.time / place.end).clamp(1e-9, 1.0);
        let (speed, left) =
            ((place.steps - self.first) as f64 / seconds, seconds * (1.0 - part) / part);
        let what = self.what;
        self.bar.set(part, &format!("{what}{speed:.0} steps/s, {left:.0} s left"));
        true
    }
}
