//! `morula simulate`: a scene in, measures and frames out.

use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::progress::Bar;
use crate::{sweep, write};
use morula::dem::Engine;
use morula::dem::effects::fragmentation::BreakRecord;
use morula::dem::effects::wear::WearRecord;
use morula::dem::scene::sweep::cases;
use morula::dem::scene::{
    BREAK_COLUMNS, Over, Place, Scene, Share, Sink, WEAR_COLUMNS, break_line, build, parse, play,
    rows_before, shares, wear_line,
};
use morula::error::count;
use morula::export::save_in;
use morula::{Error, Result, Run};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simulates rigid clumps as a scene file says: bodies, walls, and the effects that it names and no
/// others (docs/scenes.md).
///
/// Into DIR go measures.csv, checkpoint.bin, breaks.csv and wear.csv of bodies that break or wear and, where the scene asks for them, frame_000000.vtp and so on
/// for ParaView. A scene that sweeps over values or throws a body in many poses makes a table instead, sweep.csv, with
/// the processor time of each run, and impacts.csv of all throws.
#[derive(clap::Args)]
pub struct Args {
    /// Scene file, TOML
    scene: String,
    /// The scene's own quick variant
    #[arg(long)]
    quick: bool,
    /// Set a value of the scene: templates.stone.spheres=30; * stands for every one; may be given more
    /// than once
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = pair)]
    set: Vec<(String, String)>,
    /// Folder to write into; it is made where there is none
    #[arg(short, long, value_name = "DIR")]
    output: Option<String>,
    /// Go on from DIR/checkpoint.bin: all files become, byte for byte, those of a run that was never stopped
    #[arg(long, requires = "output")]
    resume: bool,
    /// Threads; 0: all cores. The result does not depend on it
    #[arg(long, default_value_t = 1, value_parser = whole::<usize>)]
    threads: usize,
    /// After the run, tell what share of a step's time each effect has: parts of the run are run again with one after
    /// the other left out
    #[arg(long, conflicts_with = "quiet")]
    shares: bool,
    /// No progress bar, no summary, no notes
    #[arg(short, long)]
    quiet: bool,
}

/// Most checkpoints from which shares are measured.
const KEPT: usize = 8;
/// The newest checkpoint.
const CHECKPOINT: &str = "checkpoint.bin";

fn pair(text: &str) -> std::result::Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.is_empty() => Ok((path.into(), value.into())),
        _ => Err(format!("{text} is not of the form PATH=VALUE")),
    }
}

pub fn run(args: &Args) -> Done {
    let path = Path::new(&args.scene);
    let text = std::fs::read_to_string(path).map_err(|e| Fail::file(path, e))?;
    let file = parse(&text, args.quick, &args.set).about(&args.scene)?;
    if file.impacts.is_some() || !file.sweep.is_empty() {
        return many(args, &text, path);
    }
    let bar = Bar::new("making clumps", args.quiet);
    let seed = file.run.seed;
    let made = bar.attach(Run::new(args.threads).about("--threads")?.with_seed(seed));
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut scene = build(&file, folder, &made).about(&args.scene)?;
    drop(made);
    if !args.quiet {
        for note in &scene.notes {
            let _ = writeln!(std::io::stderr(), "note: {note}");
        }
    }
    if let (true, Some(folder)) = (args.resume, &args.output) {
        let path = Path::new(folder).join(CHECKPOINT);
        let bytes = std::fs::read(&path).map_err(|e| Fail::file(&path, e))?;
        scene.resume(&bytes).about(&path.display().to_string())?;
    }
    if args.shares {
        scene.checkpoint.get_or_insert(scene.end / 8.0);
    }
    let mut out = Out::new(args, &scene, &bar)?;
    let run = Run::new(args.threads).about("--threads")?;
    let start = Instant::now();
    let over = play(&mut scene, &mut out, &run).about(&args.scene)?;
    let seconds = start.elapsed().as_secs_f64();
    out.flush().about(&args.scene)?;
    let parts = match &out.kept {
        Some(kept) => shares(&scene, kept, &run).about(&args.scene)?,
        None => Vec::new(),
    };
    drop(bar);
    if args.quiet {
        return Ok(());
    }
    summary(&scene, over, seconds, &parts)
}

/// Many runs of one file: their table.
fn many(args: &Args, text: &str, path: &Path) -> Done {
    if args.resume {
        return Err(Fail::Usage("a sweep does not go on from a checkpoint".into()));
    }
    let bar = Bar::new("sweeping", args.quiet);
    let cases = cases(text, args.quick, &args.set).about(&args.scene)?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let (table, throws) = sweep::run(&cases, folder, args.threads, &bar)?;
    drop(bar);
    if let Some(folder) = &args.output {
        sweep::save(&table, &throws, Path::new(folder))?;
    }
    if args.quiet {
        return Ok(());
    }
    let Some(first) = cases.first() else { return Ok(()) };
    let over: Vec<bool> = first.file.sweep.iter().map(|s| s.mean).collect();
    sweep::print(&first.file.title, &table.mean(&over))
}

/// Which lines of a table stay: by number and text.
type Keep<'a> = &'a dyn Fn(usize, &str) -> bool;

/// A table that grows while it runs.
struct Csv {
    path: PathBuf,
    to: BufWriter<File>,
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
        Ok(Csv { path, to })
    }

    fn line(&mut self, line: &str) -> Result<()> {
        writeln!(self.to, "{line}").map_err(|e| io(&self.path, &e))
    }
}

/// What the run writes.
struct Out<'a> {
    measures: Option<Csv>,
    breaks: Option<Csv>,
    wear: Option<Csv>,
    /// Some of the checkpoints, where shares are asked for.
    kept: Option<Vec<Vec<u8>>>,
    folder: Option<PathBuf>,
    dt: f64,
    bar: &'a Bar,
    start: Instant,
    /// Steps when it began.
    first: u64,
}

/// Whether a line that begins with its step is of a run up to `steps`.
fn until(steps: u64) -> impl Fn(usize, &str) -> bool {
    move |_, line| {
        let step = line.split(',').next().and_then(|s| s.parse::<u64>().ok());
        step.is_some_and(|s| s <= steps)
    }
}

impl<'a> Out<'a> {
    fn new(args: &Args, scene: &Scene, bar: &'a Bar) -> Done<Out<'a>> {
        let folder = args.output.as_ref().map(PathBuf::from);
        let (first, dt) = (scene.engine.steps(), scene.engine.setup().dt);
        let (mut measures, mut breaks, mut wear) = (None, None, None);
        if let Some(folder) = &folder {
            std::fs::create_dir_all(folder).map_err(|e| Fail::file(folder, e))?;
            // Of a run that goes on, the lines up to the checkpoint stay.
            let rows = rows_before(scene, first) as usize;
            let early = move |i: usize, _: &str| i < rows;
            let until = until(first);
            let old = |keep| args.resume.then_some(keep);
            let names = scene.watch.names().join(",");
            measures =
                Some(Csv::new(folder, "measures.csv", &names, old(&early as &dyn Fn(_, &_) -> _))?);
            if scene.fragmentation.is_some() {
                breaks = Some(Csv::new(folder, "breaks.csv", BREAK_COLUMNS, old(&until))?);
            }
            if !scene.wear.is_empty() {
                wear = Some(Csv::new(folder, "wear.csv", WEAR_COLUMNS, old(&until))?);
            }
        }
        let kept = args.shares.then(Vec::new);
        Ok(Out { measures, breaks, wear, kept, folder, dt, bar, start: Instant::now(), first })
    }

    fn flush(&mut self) -> Result<()> {
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
        self.bar.set(part, &format!("{speed:.0} steps/s, {left:.0} s left"));
        true
    }
}

fn summary(scene: &Scene, over: Over, seconds: f64, parts: &[Share]) -> Done {
    let engine: &Engine = &scene.engine;
    let (state, work) = (engine.state(), engine.work());
    let spheres: u64 = (0..state.len()).map(|i| state.template_of(i).spheres().len() as u64).sum();
    write::to_terminal(|out| {
        writeln!(out, "{}", if scene.title.is_empty() { "scene" } else { &scene.title })?;
        let limit = scene.limit.map_or(String::new(), |l| {
            format!(" ({:.3} of what the clumps allow)", engine.setup().dt / l)
        });
        let bodies = count_of(state.len() as u64, "body", "bodies");
        writeln!(
            out,
            "{bodies} of {}; steps of {:e}{limit}",
            count(spheres, "sphere"),
            engine.setup().dt
        )?;
        let why = match over {
            Over::End => "the end",
            Over::Rest => "rest",
            Over::Parted => "parting",
            Over::Cancelled => "a cancel",
        };
        writeln!(
            out,
            "{} steps up to {why} at {:.6}, {seconds:.2} s, {:.0} steps/s",
            work.steps,
            engine.time(),
            work.steps as f64 / seconds.max(1e-9)
        )?;
        for (name, value) in scene.watch.names().iter().zip(scene.watch.row(engine)) {
            match value {
                Some(value) => writeln!(out, "{name:>20}  {value:.6e}")?,
                None => writeln!(out, "{name:>20}  -")?,
            }
        }
        if !engine.breaks().is_empty() {
            let n = engine.breaks().len() as u64;
            writeln!(out, "{} since this run began", count(n, "break"))?;
        }
        let named = engine.effects().into_iter().filter(|e| e.calls > 0 || e.bytes > 0);
        for e in named {
            let part = parts.iter().find(|p| p.name == e.name);
            let part =
                part.map_or(String::new(), |p| format!(", {:.1} % of the time", 100.0 * p.part));
            writeln!(out, "{:>20}  {} calls, {} bytes{part}", e.name, e.calls, e.bytes)?;
        }
        if let Some(rest) = parts.iter().find(|p| p.name == "bodies") {
            let part = 100.0 * rest.part;
            writeln!(
                out,
                "{:>20}  what moves them and the walls, {part:.1} % of the time",
                "bodies"
            )?;
        }
        Ok(())
    })
}

fn count_of(n: u64, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}
