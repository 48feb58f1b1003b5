//! `morula simulate`: a scene in, measures and frames out.

mod go;
mod out;

pub use go::{Job, Ran, go};
pub use out::CHECKPOINT;

use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::progress::Bar;
use crate::{sweep, write};
use morula::dem::Engine;
use morula::dem::scene::sweep::cases;
use morula::dem::scene::{Over, parse};
use morula::error::count;
use std::path::{Path, PathBuf};

/// Simulates rigid clumps as a scene file says: bodies, walls, and the effects that it names and no
/// others (docs/scenes.md).
///
/// Into DIR go measures.csv, checkpoint.bin, breaks.csv and wear.csv of bodies that break or wear and, where
/// the scene asks for them, frame_000000.vtp and so on for ParaView. A scene that sweeps over values or throws a body in many poses makes a table instead, sweep.csv, with
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

/// PATH=VALUE of `--set`.
pub fn pair(text: &str) -> std::result::Result<(String, String), String> {
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
    let ran = go(&Job {
        scene: path,
        quick: args.quick,
        set: &args.set,
        output: args.output.as_ref().map(PathBuf::from),
        resume: args.resume,
        threads: args.threads,
        shares: args.shares,
        what: String::new(),
        quiet: args.quiet,
    })?;
    if args.quiet { Ok(()) } else { summary(&ran) }
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

fn summary(ran: &Ran) -> Done {
    let (scene, over, seconds, parts) = (&ran.scene, ran.over, ran.seconds, &ran.parts);
    let engine: &Engine = &scene.engine;
    let state = engine.state();
    let spheres: u64 = (0..state.len()).map(|i| state.template_of(i).spheres().len() as u64).sum();
    write::to_stdout(|out| {
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
            engine.steps(),
            engine.time(),
            ran.steps as f64 / seconds.max(1e-9)
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
        if let Some(from) = scene.average {
            writeln!(out, "means from {from} on")?;
            for (k, name) in scene.watch.names().iter().enumerate().filter(|n| n.1 != "time") {
                let Some(mean) = ran.mean(k) else { continue };
                let error = mean.error.map_or("?".into(), |e| format!("{e:.1e}"));
                writeln!(out, "{name:>20}  {:.6e} ± {error} ({} lines)", mean.mean, mean.count)?;
            }
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
