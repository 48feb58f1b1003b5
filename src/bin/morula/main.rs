//! The command line: a thin face on the library.
//!
//! Exit codes: 0 success, 1 failure (one sentence on stderr, ending in the
//! status name of the C ABI), 2 wrong usage. A reader that closes our pipe
//! early ends the program quietly with 0.

mod breaking;
mod clump;
mod compare;
#[cfg(feature = "dem")]
mod converge;
mod cost;
mod covering;
mod cpu;
mod demands;
mod export;
mod fail;
mod figures;
mod given;
mod info;
mod input;
mod labels;
mod measure;
mod method;
mod progress;
mod sample;
#[cfg(feature = "dem")]
mod scenes;
mod selftest;
#[cfg(feature = "dem")]
mod simulate;
mod stability;
#[cfg(feature = "dem")]
mod sweep;
mod view;
mod weighing;
mod write;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use fail::Fail;
use std::io::Write;
use std::process::ExitCode;

/// Turns the shape of a particle into a clump of overlapping spheres for DEM solvers.
#[derive(Parser)]
#[command(name = "morula", version, after_help = "Exit codes: 0 success, 1 failure, 2 usage.")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Make a clump of a shape and write its spheres
    Clump(Box<clump::Args>),
    /// Break a shape into fragments, each with a mesh, spheres, and its share of the motion
    Break(Box<breaking::Args>),
    /// Say what a shape is: report, moments, principal frame, labels
    Info(Box<info::Args>),
    /// Write a built-in analytic particle as a mesh
    Sample(sample::Args),
    /// Measure a clump that a file holds, alone or against a target
    Measure(Box<measure::Args>),
    /// Write a clump as the files that a DEM code reads
    Export(Box<export::Args>),
    /// Draw a clump beside its target
    View(Box<view::Args>),
    /// Say what accuracy costs in time: a price list by the number of spheres, as a table and a page
    Cost(Box<cost::Args>),
    /// Make clumps of a shape by every method, side by side in a table and a picture
    Compare(Box<compare::Args>),
    /// Run hard cases, each held to its bound, and print them as a table; 1 on any miss
    Selftest(Box<selftest::Args>),
    /// Simulate rigid clumps as a scene file says
    #[cfg(feature = "dem")]
    Simulate(Box<simulate::Args>),
    /// Run all scenes of a folder and write what they show, with tables and pictures
    #[cfg(feature = "dem")]
    Scenes(Box<scenes::Args>),
    /// Raise the number of spheres of a scene until what is measured no longer changes, and say what that cost
    #[cfg(feature = "dem")]
    Converge(Box<converge::Args>),
}

fn main() -> ExitCode {
    // Options take negative numbers, so that it is their range that is said to be missed.
    let command = Cli::command().mut_subcommands(|sub| {
        sub.mut_args(|a| {
            let takes = a.get_action().takes_values() && !a.is_positional();
            a.allow_negative_numbers(takes)
        })
    });
    let parsed = command.try_get_matches().and_then(|m| Cli::from_arg_matches(&m));
    let cli = match parsed {
        Ok(cli) => cli,
        Err(e) => return parsing_stopped(&e),
    };
    let done = match &cli.command {
        Command::Clump(args) => clump::run(args),
        Command::Break(args) => breaking::run(args),
        Command::Info(args) => info::run(args),
        Command::Sample(args) => sample::run(args),
        Command::Measure(args) => measure::run(args),
        Command::Export(args) => export::run(args),
        Command::View(args) => view::run(args),
        Command::Cost(args) => cost::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Selftest(args) => selftest::run(args),
        #[cfg(feature = "dem")]
        Command::Simulate(args) => simulate::run(args),
        #[cfg(feature = "dem")]
        Command::Scenes(args) => scenes::run(args),
        #[cfg(feature = "dem")]
        Command::Converge(args) => converge::run(args),
    };
    match done {
        Ok(()) | Err(Fail::Pipe) => ExitCode::SUCCESS,
        Err(fail) => {
            let _ = writeln!(std::io::stderr(), "morula: {fail}");
            ExitCode::from(fail.exit_code())
        }
    }
}

/// Help and version go to stdout; anything else is one sentence on stderr.
fn parsing_stopped(e: &clap::Error) -> ExitCode {
    if !e.use_stderr() {
        let _ = e.print();
        return ExitCode::SUCCESS;
    }
    let text = e.render().to_string();
    if text.starts_with("error:") {
        let _ = writeln!(std::io::stderr(), "morula: {}", one_sentence(&text));
    } else {
        // No subcommand at all: clap renders the help.
        let _ = write!(std::io::stderr(), "{text}");
    }
    ExitCode::from(2)
}

/// The first paragraph of clap's message in one line.
fn one_sentence(text: &str) -> String {
    let first = text.trim_start_matches("error:").split("\n\n").next().unwrap_or("");
    let words: Vec<&str> = first.split_whitespace().collect();
    format!("{} (try --help)", words.join(" "))
}
