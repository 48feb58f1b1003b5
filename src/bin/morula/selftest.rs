//! `morula selftest`: hard cases, each held to its bound.

use crate::fail::{Done, Fail};
use crate::stability::{self, Case, Options, Outcome};
use crate::write;
use clap::builder::PossibleValuesParser;
use serde_json::{Value, json};

#[derive(clap::Args)]
pub struct Args {
    /// Also the cases that take minutes to hours
    #[arg(long)]
    full: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Only this group; may be given more than once
    #[arg(long, value_name = "GROUP", value_parser = PossibleValuesParser::new(stability::groups()))]
    group: Vec<String>,
    /// Folder of real particles [default: that of the environment variable MORULA_DATA; else their
    /// cases are skipped]
    #[arg(long, value_name = "FOLDER")]
    data: Option<std::path::PathBuf>,
}

pub fn run(args: &Args) -> Done {
    let data = args.data.clone().or_else(|| std::env::var_os("MORULA_DATA").map(Into::into));
    let options = Options { full: args.full, groups: args.group.clone(), data };
    let mut cases: Vec<Case> = Vec::new();
    let mut pipe: Done = Ok(());
    if !args.json {
        write::to_stdout(|out| writeln!(out, "{}", line(&HEAD)))?;
    }
    stability::run(&options, |case| {
        if !args.json && pipe.is_ok() {
            pipe = write::to_stdout(|out| writeln!(out, "{}", row(&case)));
        }
        cases.push(case);
    });
    pipe?;
    let missed = cases.iter().filter(|c| !c.pass()).count();
    let skipped = cases.iter().filter(|c| matches!(c.outcome, Outcome::Skipped(_))).count();
    write::to_stdout(|out| {
        if args.json {
            let all: Vec<Value> = cases.iter().map(object).collect();
            writeln!(out, "{}", json!({ "cases": all, "missed": missed, "skipped": skipped }))
        } else {
            let n = cases.len();
            writeln!(out, "{n} cases, {missed} missed, {skipped} skipped")
        }
    })?;
    if missed > 0 { Err(Fail::Missed(missed)) } else { Ok(()) }
}

const HEAD: [&str; 6] = ["group", "case", "measure", "bound", "value", "pass"];

/// Columns of one line.
fn line([group, name, measure, bound, value, pass]: &[&str; 6]) -> String {
    format!("{group:<13}{name:<52} {measure:<54} {bound:<16} {value:<12} {pass}")
}

fn row(case: &Case) -> String {
    let (value, pass) = match &case.outcome {
        Outcome::Value(value) => (format!("{value:.3e}"), if case.pass() { "yes" } else { "NO" }),
        Outcome::Skipped(reason) => ("-".into(), reason.as_str()),
        Outcome::Failed(_) => ("-".into(), "NO"),
    };
    let bound = case.bound.to_string();
    let mut text = line(&[case.group, &case.name, case.measure, &bound, &value, pass]);
    if let Outcome::Failed(reason) = &case.outcome {
        text.push_str(&format!(": {reason}"));
    }
    text
}

fn object(case: &Case) -> Value {
    let (value, reason) = match &case.outcome {
        Outcome::Value(value) => (Some(*value), None),
        Outcome::Skipped(reason) | Outcome::Failed(reason) => (None, Some(reason)),
    };
    json!({
        "group": case.group, "case": case.name, "measure": case.measure,
        "bound": case.bound.to_string(), "why": case.why, "value": value, "pass": case.pass(),
        "skipped": matches!(case.outcome, Outcome::Skipped(_)), "reason": reason,
        "seconds": case.seconds,
    })
}
