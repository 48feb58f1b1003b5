//! `morula converge`: more and more spheres until what is measured stays as it is.

use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::simulate::{CHECKPOINT, Job, Ran, go, pair};
use crate::write;
use morula::Error;
use morula::dem::scene::{Mean, parse};
use std::path::{Path, PathBuf};

/// Runs a scene with one value after another, by default the spheres of its clumps, until two that follow each other
/// give the same measure within twice their combined error; prints measure, error and time of each.
///
/// The error of one run is that of the mean from `output.average` on, in blocks that grow until they no longer remember
/// each other; of several seeds it is the greater of that and their scatter. Into DIR goes converge.csv, and a folder a
/// run with the files of `morula simulate`; runs found there go on from their checkpoints.
#[derive(clap::Args)]
pub struct Args {
    /// Scene file, TOML
    scene: String,
    /// The measure, as scenes name it
    #[arg(long)]
    measure: String,
    /// Values to take in turn: n=10,30,100 for spheres, or a path of the scene with values
    #[arg(long, value_name = "PATH=V1,V2,...", value_parser = pair)]
    over: (String, String),
    /// Seeds 1 to K for every value
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = whole::<u64>)]
    seeds: u64,
    /// Take all values, even where the measure has settled
    #[arg(long)]
    all: bool,
    /// The scene's own quick variant
    #[arg(long)]
    quick: bool,
    /// Set a value of the scene, as in `morula simulate`
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = pair)]
    set: Vec<(String, String)>,
    /// Folder to write into
    #[arg(short, long, value_name = "DIR")]
    output: Option<String>,
    /// Threads; 0: all cores. The result does not depend on it
    #[arg(long, default_value_t = 1, value_parser = whole::<usize>)]
    threads: usize,
    /// No progress bar, no notes
    #[arg(short, long)]
    quiet: bool,
}

/// What one value gave.
struct Step {
    value: String,
    mean: f64,
    error: Option<f64>,
    seconds: f64,
    worked: Option<f64>,
}

pub fn run(args: &Args) -> Done {
    let (path, values) = &args.over;
    let paths = if path == "n" { made(args)? } else { vec![path.clone()] };
    let values: Vec<&str> = values.split(',').map(str::trim).collect();
    if values.contains(&"") {
        return Err(Fail::Usage(format!(
            "--over {}={} has an empty value",
            args.over.0, args.over.1
        )));
    }
    let mut steps: Vec<Step> = Vec::new();
    let mut settled = None;
    for value in values {
        let step = step(args, &paths, value)?;
        write::to_stdout(|out| {
            if steps.is_empty() {
                writeln!(
                    out,
                    "{:>12} {:>14} {:>10} {:>10} {:>10}",
                    args.over.0, args.measure, "error", "s", "CPU s"
                )?;
            }
            writeln!(
                out,
                "{value:>12} {:>14.6e} {:>10} {:>10.2} {:>10}",
                step.mean,
                step.error.map_or("?".into(), |e| format!("{e:.1e}")),
                step.seconds,
                step.worked.map_or("?".into(), |s| format!("{s:.2}"))
            )
        })?;
        if let Some(last) = steps.last()
            && let Some((a, b)) = last.error.zip(step.error)
            && (step.mean - last.mean).abs() <= 2.0 * a.hypot(b)
        {
            settled = settled.or(Some((last.value.clone(), step.value.clone())));
        } else {
            settled = None;
        }
        steps.push(step);
        if settled.is_some() && !args.all {
            break;
        }
    }
    save(args, &steps)?;
    write::to_stdout(|out| match &settled {
        Some((a, b)) => {
            writeln!(out, "settled: from {a} to {b} it stays within twice the combined error")
        }
        None if steps.iter().any(|s| s.error.is_none()) => writeln!(
            out,
            "not settled: no error is known; output.average of the scene or --seeds would tell it"
        ),
        None => {
            writeln!(out, "not settled: the last two differ by more than twice the combined error")
        }
    })
}

/// The paths to the numbers of spheres of all templates that are made of a shape.
fn made(args: &Args) -> Done<Vec<String>> {
    let scene = Path::new(&args.scene);
    let text = std::fs::read_to_string(scene).map_err(|e| Fail::file(scene, e))?;
    let file = parse(&text, args.quick, &args.set).about(&args.scene)?;
    let made = file.templates.iter().filter(|(_, t)| t.shape.is_some() || t.file.is_some());
    let paths: Vec<String> = made.map(|(name, _)| format!("templates.{name}.spheres")).collect();
    if paths.is_empty() {
        return Err(Fail::Usage("--over n needs a template that is made of a shape".into()));
    }
    Ok(paths)
}

fn step(args: &Args, paths: &[String], value: &str) -> Done<Step> {
    let (mut means, mut seconds, mut worked): (Vec<Mean>, f64, Option<f64>) =
        (Vec::new(), 0.0, Some(0.0));
    for seed in 1..=args.seeds.max(1) {
        let mut set = args.set.clone();
        set.extend(paths.iter().map(|p| (p.clone(), value.to_owned())));
        if args.seeds > 1 {
            set.push(("run.seed".to_owned(), seed.to_string()));
        }
        let name: String =
            value.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let folder =
            args.output.as_ref().map(|o| PathBuf::from(o).join(format!("{name}_seed{seed}")));
        let ran = go(&Job {
            scene: Path::new(&args.scene),
            quick: args.quick,
            set: &set,
            resume: folder.as_ref().is_some_and(|f| f.join(CHECKPOINT).exists()),
            output: folder,
            threads: args.threads,
            shares: false,
            what: format!("{}={value}, seed {seed}: ", args.over.0),
            quiet: args.quiet,
        })?;
        means.push(measured(args, &ran)?);
        seconds += ran.seconds;
        worked = worked.zip(ran.worked).map(|(a, b)| a + b);
    }
    let count = means.len() as f64;
    let mean = means.iter().map(|m| m.mean).sum::<f64>() / count;
    let own: Option<Vec<f64>> = means.iter().map(|m| m.error).collect();
    let own = own.map(|e| e.iter().map(|e| e * e).sum::<f64>().sqrt() / count);
    let scatter = (means.len() > 1).then(|| {
        let squares: f64 = means.iter().map(|m| (m.mean - mean) * (m.mean - mean)).sum();
        (squares / (count - 1.0) / count).sqrt()
    });
    let error = match (own, scatter) {
        (Some(a), Some(b)) => Some(a.max(b)),
        (a, b) => a.or(b),
    };
    Ok(Step { value: value.to_owned(), mean, error, seconds, worked })
}

fn measured(args: &Args, ran: &Ran) -> Done<Mean> {
    let names = ran.scene.watch.names();
    let Some(k) = names.iter().position(|n| *n == args.measure) else {
        let what = format!(
            "the scene does not measure {}; output.measures names {}",
            args.measure,
            names.join(", ")
        );
        return Err(Error::InvalidArgument(what)).about(&args.scene);
    };
    match ran.mean(k) {
        Some(mean) => Ok(mean),
        None => {
            let what = format!("{} has no value at the end", args.measure);
            Err(Error::InvalidArgument(what)).about(&args.scene)
        }
    }
}

fn save(args: &Args, steps: &[Step]) -> Done {
    let Some(folder) = &args.output else { return Ok(()) };
    let mut text = format!("{},{},error,seconds,cpu_seconds\n", args.over.0, args.measure);
    for s in steps {
        let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:?}"));
        text += &format!(
            "{},{:?},{},{:?},{}\n",
            s.value,
            s.mean,
            number(s.error),
            s.seconds,
            number(s.worked)
        );
    }
    let path = Path::new(folder).join("converge.csv");
    std::fs::create_dir_all(folder).map_err(|e| Fail::file(Path::new(folder), e))?;
    std::fs::write(&path, text).map_err(|e| Fail::file(&path, e))
}
