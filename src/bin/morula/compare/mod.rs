//! `morula compare`: clumps of one shape by every method, side by side as a table and a picture.

pub mod entry;
mod picture;
mod table;

use crate::clump::equivalent_diameter;
use crate::fail::{About as _, Done, Fail};
use crate::input::parse::{not_negative, positive, whole};
use crate::input::{self, Fineness, Reading};
use crate::progress::Bar;
use crate::view::{angle, size};
use crate::write;
use entry::{Entry, Row};
use morula::Run;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::Instant;

#[derive(clap::Args)]
pub struct Args {
    /// Shape: as for `morula clump`
    input: String,
    /// Number of spheres; several with commas
    #[arg(short = 'n', long = "spheres", value_name = "N,…", value_delimiter = ',',
          default_value = "30", value_parser = count)]
    spheres: Vec<usize>,
    /// Methods to compare, in this order [default: all but best-thorough]
    #[arg(long, value_enum, value_name = "NAME,…", value_delimiter = ',')]
    methods: Vec<Entry>,
    /// Compare best-thorough as well, which takes seconds
    #[arg(long, conflicts_with = "methods")]
    thorough: bool,
    /// Picture to write, a PNG
    #[arg(short, long, value_name = "FILE.png", default_value = "compare.png")]
    output: String,
    /// Draw nothing
    #[arg(long, conflicts_with = "output")]
    no_picture: bool,
    /// Print one JSON object in place of the table
    #[arg(long)]
    json: bool,
    /// Write the table to this file as well, as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<String>,
    /// Each method stops at its first checkpoint after this many seconds
    #[arg(long, value_name = "SECONDS", value_parser = not_negative)]
    deadline: Option<f64>,
    /// Threads; 0: all cores. The clumps do not depend on it
    #[arg(long, default_value_t = 0, value_parser = whole::<usize>)]
    threads: usize,
    /// Turn of the viewer about z, degrees
    #[arg(long, default_value_t = -60.0, allow_hyphen_values = true, value_parser = angle)]
    azimuth: f64,
    /// Height of the viewer above the xy plane, degrees
    #[arg(long, default_value_t = 25.0, allow_hyphen_values = true, value_parser = angle)]
    elevation: f64,
    /// Width and height of the picture in pixels [default: 1500 wide, as high as it takes]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(usize, usize)>,
    /// End of the colour scale, in percent of the equivalent diameter [default: what fits]
    #[arg(long, value_name = "PERCENT", value_parser = positive)]
    scale: Option<f64>,
    /// No progress bar, no notes
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    fineness: Fineness,
    #[command(flatten)]
    reading: Reading,
}

fn count(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if n > 0 => Ok(n),
        _ => Err(format!("{text} is not a whole number from 1 on")),
    }
}

pub fn run(args: &Args) -> Done {
    args.check()?;
    let bar = Bar::new("compare", args.quiet);
    let start = Instant::now();
    let run = bar.attach(Run::new(args.threads).about("")?);
    let shape = args.reading.shape(&args.input, &run)?;
    let read = start.elapsed().as_secs_f64();
    let solid = args.fineness.solid(&shape, &args.input, &args.reading, &run)?;
    // What several methods need is made here, so that none pays for the others.
    solid.distance(&run).about(&args.input)?;
    solid.surface(&run).about(&args.input)?;
    let grid = start.elapsed().as_secs_f64() - read;
    drop(run);

    let mut rows = Vec::new();
    for entry in args.entries() {
        for &n in &args.spheres {
            bar.say(&entry.name());
            rows.push(Row::make(entry, n, &solid, &args.new_run(&bar)?));
        }
    }
    if rows.iter().all(|row| row.made.is_err()) {
        let first = rows.into_iter().find_map(|row| row.made.err());
        return match first {
            Some(Fail::Library { error, .. }) => Err(error).about(&args.input),
            other => other.map_or(Ok(()), Err),
        };
    }
    let title = Path::new(&args.input).file_name().and_then(|n| n.to_str()).unwrap_or(&args.input);
    let run = args.new_run(&bar)?;
    let canvas = if args.no_picture {
        None
    } else {
        bar.say("drawing");
        Some(picture::draw(args, title, &solid, &rows, &run).about(&args.output)?)
    };
    drop(bar);
    input::warn(&shape, args.quiet);
    if let Some(canvas) = canvas {
        write::to(&args.output, |out| canvas.write_png(out))?;
    }
    let about = table::About {
        input: &args.input,
        diameter: equivalent_diameter(solid.moments().volume),
        cells: solid.grid().dims,
        threads: run.pool().threads(),
        read,
        grid,
        notes: shape.report.notes.iter().chain(solid.notes()).cloned().collect(),
    };
    if let Some(path) = &args.csv {
        write::to(path, |out| table::csv(out, &about, &rows))?;
    }
    write::to_stdout(|out| match args.json {
        true => writeln!(out, "{}", table::object(&about, &rows)),
        false => table::text(out, &about, &rows),
    })?;
    if !args.quiet && !args.json {
        remarks(&about, &rows);
    }
    Ok(())
}

impl Args {
    /// Refuses outputs that would overwrite something, before any work.
    fn check(&self) -> Done {
        if !self.no_picture {
            input::keep(&[&self.input], &self.output)?;
            let extension = Path::new(&self.output).extension();
            if extension.is_none_or(|e| !e.eq_ignore_ascii_case("png")) {
                return Err(Fail::Usage(format!("{} is no name for a PNG picture", self.output)));
            }
        }
        match &self.csv {
            Some(path) if path == "-" => {
                Err(Fail::Usage("--csv takes a file: stdout has the table".into()))
            }
            Some(path) => input::keep(&[&self.input], path),
            None => Ok(()),
        }
    }

    fn entries(&self) -> Vec<Entry> {
        if self.methods.is_empty() { Entry::all(self.thorough) } else { self.methods.clone() }
    }

    /// Each method has its own, so that none works with another's deadline.
    fn new_run<'a>(&self, bar: &Bar) -> Done<Run<'a>> {
        let mut run = Run::new(self.threads).about("")?.with_seed(self.reading.seed.unwrap_or(0));
        if let Some(seconds) = self.deadline {
            run = run.with_deadline(seconds);
        }
        Ok(bar.attach(run))
    }
}

/// Why there are fewer spheres than asked for, and what is odd about the shape, at a terminal.
fn remarks(about: &table::About, rows: &[Row]) {
    let mut err = std::io::stderr();
    if !err.is_terminal() {
        return;
    }
    for row in rows {
        if let Ok(made) = &row.made
            && !made.clump.note.is_empty()
        {
            let _ = writeln!(err, "{}: {}", row.entry.name(), made.clump.note);
        }
    }
    for note in &about.notes {
        let _ = writeln!(err, "note: {note}");
    }
}
