//! `morula cost`: what accuracy costs in time, as a table, CSV, a picture and a page to look at.

mod list;
mod page;
mod papers;
pub mod picture;
mod table;

use crate::compare::entry::Entry;
use crate::fail::{About as _, Done, Fail};
use crate::input::parse::{not_negative, numbers, positive, whole};
use crate::input::{self, Fineness, Reading};
use crate::progress::Bar;
use crate::write;
use clap::ValueEnum;
use list::{Line, List};
use morula::cost::{
    Bounds, Choice, CurveOptions, Goal, StepModel, SweepOptions, choose, ladder, sweep,
};
use morula::generate::{Effort, Levels};
use morula::mass::{Contact, ContactOptions};
use morula::solid::{Resolution, Solid};
use morula::{Error, Run};
use std::io::Write;
use std::path::Path;

#[derive(clap::Args)]
pub struct Args {
    /// Shape: as for `morula clump`
    input: String,
    /// The largest number of spheres
    #[arg(short = 'n', long = "spheres", value_name = "N", default_value_t = 100, value_parser = count)]
    spheres: usize,
    /// Numbers of spheres, ascending, with commas [default: from 1 to N, about ten between each and
    /// its tenfold]
    #[arg(long, value_name = "N,…", value_delimiter = ',', conflicts_with = "spheres", value_parser = count)]
    counts: Vec<usize>,
    /// Methods, a line each
    #[arg(
        long,
        value_enum,
        value_name = "NAME,…",
        value_delimiter = ',',
        default_value = "best,best-draft,inscribed,cover,mss"
    )]
    methods: Vec<Entry>,
    /// What the clumps of one line have to do with each other
    #[arg(long, value_enum, default_value_t = LevelsArg::Free)]
    levels: LevelsArg,
    /// Cells along the longest edge, several with commas: each method has a line for each
    #[arg(long, value_name = "N,…", value_delimiter = ',', value_parser = input::parse::above_0)]
    sweep_cells: Vec<u32>,
    /// Seconds that each clump may take, several with commas: each method has a line for each; 0: as
    /// long as it takes
    #[arg(long, value_name = "SECONDS,…", value_delimiter = ',', default_value = "0", value_parser = not_negative)]
    seconds: Vec<f64>,
    /// Beginning of the names of the files: NAME.csv, NAME.svg, NAME.html
    #[arg(short, long, value_name = "NAME", default_value = "cost")]
    output: String,
    /// Print the table only
    #[arg(long, conflicts_with = "output")]
    no_files: bool,
    /// Print one JSON object in place of the table
    #[arg(long)]
    json: bool,
    /// Columns along each of the two sampled axes of the quality figures, 8 to 8192
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = whole::<usize>)]
    columns: usize,
    /// Threads; 0: all cores. The clumps do not depend on it
    #[arg(long, default_value_t = 0, value_parser = whole::<usize>)]
    threads: usize,
    /// No progress bar, no notes
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    choosing: Choosing,
    #[command(flatten)]
    contacts: Contacts,
    #[command(flatten)]
    fineness: Fineness,
    #[command(flatten)]
    reading: Reading,
}

/// The choice of a point.
#[derive(clap::Args)]
#[command(next_help_heading = "Choice")]
struct Choosing {
    /// What is made best within the bounds: the choice is printed with its reason
    #[arg(long, value_enum, default_value_t = GoalArg::Knee)]
    goal: GoalArg,
    /// Most spheres
    #[arg(long, value_name = "N", value_parser = count)]
    max_spheres: Option<usize>,
    /// Greatest mismatch
    #[arg(long, value_name = "D", value_parser = not_negative)]
    max_mismatch: Option<f64>,
    /// Least coverage, 0 to 1
    #[arg(long, value_name = "SHARE", value_parser = not_negative)]
    min_coverage: Option<f64>,
    /// Greatest RMS distance between the surfaces, over the equivalent diameter
    #[arg(long, value_name = "PART", value_parser = not_negative)]
    max_surface: Option<f64>,
    /// Most seconds of the method
    #[arg(long, value_name = "SECONDS", value_parser = not_negative)]
    max_seconds: Option<f64>,
    /// Greatest cost of a step, in steps with single spheres
    #[arg(long, value_name = "COST", value_parser = not_negative)]
    max_step_cost: Option<f64>,
    /// Greatest cost of simulated time, in the same unit
    #[arg(long, value_name = "COST", value_parser = not_negative)]
    max_time_cost: Option<f64>,
}

/// The contacts for which time steps hold.
#[derive(clap::Args)]
#[command(next_help_heading = "Contacts")]
struct Contacts {
    /// Mass per cubed length unit
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    density: f64,
    /// Stiffness of a linear spring [default: 1]
    #[arg(long, value_name = "K", value_parser = positive, conflicts_with = "young")]
    stiffness: Option<f64>,
    /// Young's modulus, for contacts by Hertz
    #[arg(long, value_name = "E", value_parser = positive)]
    young: Option<f64>,
    /// Poisson's ratio
    #[arg(long, value_name = "NU", default_value_t = 0.3, value_parser = not_negative)]
    poisson: f64,
    /// Cost of a step with n spheres over one with single spheres: as fitted to a solver, lammps or
    /// morula (the engine of `morula simulate`), or a + b n + c n² + (d n + e n²) / K, K steps from
    /// one list of neighbours to the next
    #[arg(long, value_name = "SOLVER|a,b,c,d,e,K", default_value = "lammps", value_parser = step_model)]
    step_model: StepModel,
    /// Greatest speed at which two particles meet
    #[arg(long, value_name = "V", default_value_t = 1.0, value_parser = not_negative)]
    speed: f64,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum GoalArg {
    /// Where more spheres stop paying
    Knee,
    /// Fewest spheres
    Spheres,
    /// Least D
    Mismatch,
    /// Fewest seconds of the method
    Seconds,
    /// Cheapest step
    StepCost,
    /// Cheapest simulated time
    TimeCost,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum LevelsArg {
    /// Nothing
    Free,
    /// Each starts from the one before
    Chained,
    /// Each holds all spheres of the one before (best, cover, euclidean)
    Nested,
}

fn step_model(text: &str) -> Result<StepModel, String> {
    match text {
        "lammps" => Ok(StepModel::LAMMPS),
        "morula" => Ok(StepModel::MORULA),
        _ if text.contains(',') => numbers::<6>(text).map(|[a, b, c, d, e, rebuild]| StepModel {
            step: [a, b, c],
            lists: [d, e],
            rebuild,
        }),
        _ => Err(format!("{text} is neither lammps nor morula nor six numbers")),
    }
}

fn count(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if n > 0 => Ok(n),
        _ => Err(format!("{text} is not a whole number from 1 on")),
    }
}

pub fn run(args: &Args) -> Done {
    if args.output.is_empty() || args.output == "-" {
        return Err(Fail::Usage("--output is the beginning of file names".into()));
    }
    let files = ["csv", "svg", "html"].map(|e| format!("{}.{e}", args.output));
    if !args.no_files {
        files.iter().try_for_each(|f| input::keep(&[&args.input], f))?;
    }
    let bar = Bar::new("cost", args.quiet);
    let run = Run::new(args.threads).about("")?.with_seed(args.reading.seed.unwrap_or(0));
    let run = bar.attach(run);
    let shape = args.reading.shape(&args.input, &run)?;
    let options = args.options(&shape)?;
    let swept = sweep(&shape, &options, &run).about(&args.input)?;
    let solid = Solid::new(&shape, &options.solid, &Run::serial()).about(&args.input)?;
    drop(bar);
    input::warn(&shape, args.quiet);
    let several = [options.resolutions.len() > 1, options.seconds.len() > 1];
    let mut lines = Vec::new();
    let mut first: Option<Error> = None;
    for (one, entry) in swept.into_iter().zip(args.entries(&options)) {
        let name = list::name(entry, &one, several);
        match one.curve {
            Ok(curve) => lines.push(Line { name, entry, cells: one.cells, curve }),
            Err(error) => {
                if !args.quiet {
                    let _ = writeln!(std::io::stderr(), "note: {name}: {error}");
                }
                first = first.or(Some(error));
            }
        }
    }
    if let (true, Some(error)) = (lines.is_empty(), first) {
        return Err(error).about(&args.input);
    }
    let title = Path::new(&args.input).file_name().and_then(|n| n.to_str()).unwrap_or(&args.input);
    let list = List {
        title: title.to_string(),
        marks: papers::marks(&solid),
        diameter: lines.first().map_or(0.0, |l| l.curve.diameter),
        threads: run.pool().threads(),
        lines,
    };
    let (bounds, goal) = args.choosing.bounds();
    let choices: Vec<(String, morula::Result<Choice>)> = list
        .lines
        .iter()
        .map(|l| (l.name.clone(), choose(&l.curve.points, &bounds, goal)))
        .collect();
    if !args.no_files {
        let [csv, svg, html] = &files;
        write::to(csv, |out| table::csv(out, &list))?;
        let drawn = picture::svg(&list).map_err(|e| Fail::Library {
            error: Error::Internal(format!("the picture could not be drawn: {e}")),
            about: svg.clone(),
        })?;
        write::to(svg, |out| out.write_all(drawn.as_bytes()))?;
        write::to(html, |out| page::html(out, &list, &choices, &solid))?;
    }
    write::to_stdout(|out| match args.json {
        true => writeln!(out, "{}", table::object(&list, &choices)),
        false => table::text(out, &list, &choices),
    })
}

impl Args {
    fn options(&self, shape: &morula::Shape) -> Done<SweepOptions> {
        let solid = self.fineness.options(shape, &self.input, &self.reading)?;
        let resolutions = match &self.sweep_cells[..] {
            [] => vec![solid.resolution],
            some => some.iter().map(|&n| Resolution::CellsLongest(n)).collect(),
        };
        let counts =
            if self.counts.is_empty() { ladder(self.spheres) } else { self.counts.clone() };
        let levels = match self.levels {
            LevelsArg::Free => Levels::Free,
            LevelsArg::Chained => Levels::Chained,
            LevelsArg::Nested => Levels::Nested,
        };
        let c = &self.contacts;
        let contact = match c.young {
            Some(young) => Contact::Material { young, poisson: c.poisson },
            None => Contact::Stiffness(c.stiffness.unwrap_or(1.0)),
        };
        let mut curve = CurveOptions {
            counts,
            levels,
            density: c.density,
            contact: ContactOptions { contact, speed: c.speed, contacts: 1 },
            step: c.step_model,
            ..CurveOptions::default()
        };
        curve.quality.columns = self.columns;
        let method = |e: &Entry| {
            let o = e.options(1);
            (o.method, o.effort)
        };
        let methods: Vec<(_, Effort)> = self.methods.iter().map(method).collect();
        Ok(SweepOptions { resolutions, methods, seconds: self.seconds.clone(), solid, curve })
    }

    /// What each curve of the sweep is of, in its order.
    fn entries<'a>(&'a self, options: &'a SweepOptions) -> impl Iterator<Item = Entry> + 'a {
        let each =
            move |_| self.methods.iter().flat_map(|e| options.seconds.iter().map(move |_| *e));
        options.resolutions.iter().flat_map(each)
    }
}

impl Choosing {
    fn bounds(&self) -> (Bounds, Goal) {
        let bounds = Bounds {
            spheres: self.max_spheres,
            mismatch: self.max_mismatch,
            coverage: self.min_coverage,
            surface: self.max_surface,
            seconds: self.max_seconds,
            step_cost: self.max_step_cost,
            time_cost: self.max_time_cost,
        };
        let goal = match self.goal {
            GoalArg::Knee => Goal::Knee,
            GoalArg::Spheres => Goal::Spheres,
            GoalArg::Mismatch => Goal::Mismatch,
            GoalArg::Seconds => Goal::Seconds,
            GoalArg::StepCost => Goal::StepCost,
            GoalArg::TimeCost => Goal::TimeCost,
        };
        (bounds, goal)
    }
}
