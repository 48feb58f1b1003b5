//! `morula simulate`: a scene in, measures and frames out.

use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::progress::Bar;
use crate::write;
use morula::dem::Engine;
use morula::dem::scene::{Over, Place, Scene, Sink, build, parse, play, rows_before};
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
/// Into DIR go measures.csv, checkpoint.bin and, where the scene asks for them, frame_000000.vtp and so on
/// for ParaView.
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
    /// No progress bar, no summary, no notes
    #[arg(short, long)]
    quiet: bool,
}

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
    let mut out = Out::new(args, &scene, &bar)?;
    let run = Run::new(args.threads).about("--threads")?;
    let start = Instant::now();
    let over = play(&mut scene, &mut out, &run).about(&args.scene)?;
    let seconds = start.elapsed().as_secs_f64();
    out.close()?;
    drop(bar);
    if args.quiet {
        return Ok(());
    }
    summary(&scene, over, seconds)
}

/// What the run writes.
struct Out<'a> {
    measures: Option<(PathBuf, BufWriter<File>)>,
    folder: Option<PathBuf>,
    bar: &'a Bar,
    start: Instant,
    /// Steps when it began.
    first: u64,
}

impl<'a> Out<'a> {
    fn new(args: &Args, scene: &Scene, bar: &'a Bar) -> Done<Out<'a>> {
        let folder = args.output.as_ref().map(PathBuf::from);
        let mut measures = None;
        if let Some(folder) = &folder {
            std::fs::create_dir_all(folder).map_err(|e| Fail::file(folder, e))?;
            let path = folder.join("measures.csv");
            // Of a run that goes on, the lines up to the checkpoint stay.
            let kept = if args.resume {
                let old = std::fs::read_to_string(&path).map_err(|e| Fail::file(&path, e))?;
                let rows = rows_before(scene, scene.engine.steps()) as usize;
                old.lines().skip(1).take(rows).map(|l| format!("{l}\n")).collect()
            } else {
                String::new()
            };
            let file = File::create(&path).map_err(|e| Fail::file(&path, e))?;
            let mut to = BufWriter::new(file);
            let names = scene.watch.names().join(",");
            write!(to, "{names}\n{kept}").map_err(|e| Fail::file(&path, e))?;
            measures = Some((path, to));
        }
        Ok(Out { measures, folder, bar, start: Instant::now(), first: scene.engine.steps() })
    }

    fn close(&mut self) -> Done {
        match &mut self.measures {
            Some((path, to)) => to.flush().map_err(|e| Fail::file(path, e)),
            None => Ok(()),
        }
    }
}

fn io(path: &Path, e: &std::io::Error) -> Error {
    Error::Io(format!("{}: {e}", path.display()))
}

impl Sink for Out<'_> {
    fn row(&mut self, values: &[Option<f64>]) -> Result<()> {
        let Some((path, to)) = &mut self.measures else { return Ok(()) };
        let text: Vec<String> =
            values.iter().map(|v| v.map_or(String::new(), |v| format!("{v:?}"))).collect();
        writeln!(to, "{}", text.join(",")).map_err(|e| io(path, &e))
    }

    fn frame(&mut self, number: u64, vtp: &str) -> Result<()> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let path = folder.join(format!("frame_{number:06}.vtp"));
        std::fs::write(&path, vtp).map_err(|e| io(&path, &e))
    }

    fn checkpoint(&mut self, _: u64, bytes: &[u8]) -> Result<()> {
        let Some(folder) = &self.folder else { return Ok(()) };
        // What stands in measures.csv then is as old as the checkpoint.
        if let Some((path, to)) = &mut self.measures {
            to.flush().map_err(|e| io(path, &e))?;
        }
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

fn summary(scene: &Scene, over: Over, seconds: f64) -> Done {
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
        let named = engine.effects().into_iter().filter(|e| e.calls > 0 || e.bytes > 0);
        for e in named {
            writeln!(out, "{:>20}  {} calls, {} bytes", e.name, e.calls, e.bytes)?;
        }
        Ok(())
    })
}

fn count_of(n: u64, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}
