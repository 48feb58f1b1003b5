//! `morula scenes`: every scene of a folder, and one page of what they show.

mod bars;
mod page;
mod picture;

use crate::cpu;
use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::progress::Bar;
use crate::sweep::{self, Row, Table};
use crate::write;
use morula::dem::scene::shows::{OfName, ShowPart};
use morula::dem::scene::sweep::{Case, cases};
use morula::dem::scene::{Place, SceneFile, Share, Sink, build, play, shares};
use morula::{Result, Run};
use std::path::{Path, PathBuf};

/// Runs all scenes of a folder and writes what they show: index.md with each figure beside its reference and the processor time
/// that it took, NAME.csv of every run, NAME.svg of what the scene draws.
///
/// All but the times is the same on every run.
#[derive(clap::Args)]
pub struct Args {
    /// Folder of scene files
    #[arg(default_value = "scenes")]
    folder: String,
    /// Their quick variants
    #[arg(long)]
    quick: bool,
    /// Only the scene of this name; may be given more than once
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Folder to write into; it is made where there is none
    #[arg(short, long, value_name = "DIR", default_value = "docs/scenes")]
    output: String,
    /// Threads; 0: all cores. The figures do not depend on it
    #[arg(long, default_value_t = 1, value_parser = whole::<usize>)]
    threads: usize,
    /// Measure how the time of a step is shared among the effects, by short reruns without them
    #[arg(long)]
    shares: bool,
    /// No progress bar, no table
    #[arg(short, long)]
    quiet: bool,
}

/// A scene that has run.
pub struct Shown {
    /// The name of its file.
    pub name: String,
    /// What the file says.
    pub file: SceneFile,
    /// All runs, or the one; then with its lines of measures.
    pub table: Table,
    /// Whether it is a sweep.
    pub many: bool,
    /// Lines of measures of the one run.
    pub lines: Vec<Vec<Option<f64>>>,
    /// How its effects share the time of a step, where that is asked for.
    pub shares: Vec<Share>,
}

/// Most checkpoints from which shares are measured.
const KEPT: usize = 8;

/// All lines of measures, and where shares are asked for the checkpoints.
struct Lines {
    lines: Vec<Vec<Option<f64>>>,
    kept: Option<Vec<Vec<u8>>>,
}

impl Sink for Lines {
    fn row(&mut self, values: &[Option<f64>]) -> Result<()> {
        self.lines.push(values.to_vec());
        Ok(())
    }
    fn frame(&mut self, _: u64, _: &str) -> Result<()> {
        Ok(())
    }
    fn checkpoint(&mut self, _: u64, bytes: &[u8]) -> Result<()> {
        if let Some(kept) = &mut self.kept {
            kept.push(bytes.to_vec());
        }
        Ok(())
    }
    fn at(&mut self, _: &Place) -> bool {
        true
    }
}

pub fn run(args: &Args) -> Done {
    let folder = Path::new(&args.folder);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(|e| Fail::file(folder, e))? {
        let path = entry.map_err(|e| Fail::file(folder, e))?.path();
        let name = path.file_stem().and_then(|n| n.to_str()).unwrap_or_default().to_owned();
        let wanted = args.only.is_empty() || args.only.contains(&name);
        if wanted && path.extension().is_some_and(|e| e == "toml") {
            files.push((name, path));
        }
    }
    files.sort();
    if let Some(missing) = args.only.iter().find(|o| !files.iter().any(|f| f.0 == **o)) {
        return Err(Fail::Usage(format!("there is no scene {missing} in {}", args.folder)));
    }
    if files.is_empty() {
        return Err(Fail::Usage(format!("there is no scene in {}", args.folder)));
    }
    let out = Path::new(&args.output);
    std::fs::create_dir_all(out).map_err(|e| Fail::file(out, e))?;
    let mut all = Vec::new();
    for (name, path) in &files {
        let bar = Bar::new(name, args.quiet);
        let shown = one(name, path, folder, args, &bar)?;
        drop(bar);
        save(&shown, out)?;
        all.push(shown);
    }
    if all.iter().any(|s| !s.shares.is_empty()) {
        let svg = bars::svg(&all).map_err(|e| Fail::Library {
            error: morula::Error::InvalidArgument(e.to_string()),
            about: "shares".into(),
        })?;
        put(&out.join("shares.svg"), &svg)?;
    }
    let page = page::page(&all, args.quick);
    put(&out.join("index.md"), &page)?;
    if args.quiet {
        return Ok(());
    }
    write::to_terminal(|to| to.write_all(page.as_bytes()))
}

fn one(name: &str, path: &PathBuf, folder: &Path, args: &Args, bar: &Bar) -> Done<Shown> {
    let said = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|e| Fail::file(path, e))?;
    let cases: Vec<Case> = cases(&text, args.quick, &[]).about(&said)?;
    let file = match cases.first() {
        Some(case) => case.file.clone(),
        None => return Err(Fail::Usage(format!("{said} asks for no run"))),
    };
    let many = file.impacts.is_some() || !file.sweep.is_empty();
    let name = name.to_owned();
    if many {
        let (table, _) = sweep::run(&cases, folder, args.threads, bar)?;
        return Ok(Shown { name, file, table, many, lines: Vec::new(), shares: Vec::new() });
    }
    let now = || cpu::seconds().unwrap_or_default();
    let run = Run::new(args.threads).about("--threads")?.with_seed(file.run.seed);
    let before = now();
    let mut scene = build(&file, folder, &run).about(&said)?;
    let making = now() - before;
    if args.shares {
        scene.checkpoint = Some(scene.end / KEPT as f64);
    }
    let mut out = Lines { lines: Vec::new(), kept: args.shares.then(Vec::new) };
    let before = now();
    play(&mut scene, &mut out, &run).about(&said)?;
    let running = now() - before;
    let parts = match &out.kept {
        Some(kept) => shares(&scene, kept, &run).about(&said)?,
        None => Vec::new(),
    };
    let lines = out.lines;
    let state = scene.engine.state();
    let spheres = (0..state.len()).map(|i| state.template_of(i).spheres().len() as u64).sum();
    let figures = scene.watch.names().to_vec();
    let values = lines.last().cloned().unwrap_or_default();
    let rows = vec![Row { labels: Vec::new(), values, spheres, making, running }];
    Ok(Shown {
        name,
        file,
        table: Table { keys: Vec::new(), figures, rows, seconds: making + running },
        many,
        lines,
        shares: parts,
    })
}

impl Shown {
    /// The table that is shown: means over seeds and the like.
    pub fn means(&self) -> Table {
        let over: Vec<bool> = self.file.sweep.iter().map(|s| s.mean).collect();
        self.table.mean(&over)
    }

    /// The figure that a scene is there for; `None` where this variant has no such run.
    pub fn figure(&self, show: &ShowPart) -> Option<f64> {
        if self.many {
            let table = self.means();
            let row = table.rows.iter().find(|r| table.is(r, &show.at))?;
            return table.number(row, &show.figure).map(|v| v * show.times);
        }
        let k = self.table.figures.iter().position(|f| *f == show.figure)?;
        let time = self.table.figures.iter().position(|f| f == "time");
        let from = self.file.output.average.filter(|_| show.of == OfName::Mean);
        let late = |line: &&Vec<Option<f64>>| match (from, time) {
            (Some(from), Some(k)) => line.get(k).is_some_and(|t| t.is_some_and(|t| t >= from)),
            _ => true,
        };
        let at = |l: &Vec<Option<f64>>| time.and_then(|t| *l.get(t)?).unwrap_or(0.0);
        let timed = |l: &Vec<Option<f64>>| Some((at(l), (*l.get(k)?)?));
        let values: Vec<(f64, f64)> = self.lines.iter().filter(late).filter_map(timed).collect();
        show.of.of(&values).map(|v| v * show.times)
    }
}

fn put(path: &Path, text: &str) -> Done {
    std::fs::write(path, text).map_err(|e| Fail::file(path, e))
}

fn save(shown: &Shown, out: &Path) -> Done {
    let csv = if shown.many {
        shown.table.csv()
    } else {
        let mut csv = shown.table.figures.join(",") + "\n";
        for line in &shown.lines {
            let cells: Vec<String> =
                line.iter().map(|v| v.map_or(String::new(), |v| format!("{v:?}"))).collect();
            csv += &(cells.join(",") + "\n");
        }
        csv
    };
    put(&out.join(format!("{}.csv", shown.name)), &csv)?;
    if shown.file.plots.is_empty() {
        return Ok(());
    }
    let svg = picture::svg(shown).map_err(|e| Fail::Library {
        error: morula::Error::InvalidArgument(e.to_string()),
        about: shown.name.clone(),
    })?;
    put(&out.join(format!("{}.svg", shown.name)), &svg)
}
