//! The price list as a table for people, as CSV and as JSON.

use super::list::{Line, List};
use morula::cost::{Choice, Point};
use serde_json::{Value, json};
use std::io::Write;

/// Titles and columns, aligned; then the choice of each line.
pub fn text(
    out: &mut dyn Write,
    list: &List,
    choices: &[(String, morula::Result<Choice>)],
) -> std::io::Result<()> {
    writeln!(out, "{}: d_eq {:.6e}, {} threads", list.title, list.diameter, list.threads)?;
    writeln!(
        out,
        "{:<22} {:>6} {:>7} {:>8} {:>9} {:>8} {:>9} {:>8} {:>9} {:>9} {:>9} {:>9}",
        "method",
        "n",
        "D",
        "coverage",
        "overshoot",
        "surface",
        "roughness",
        "inertia",
        "time",
        "time step",
        "step",
        "simulated"
    )?;
    writeln!(
        out,
        "{:<22} {:>6} {:>7} {:>8} {:>9} {:>8} {:>9} {:>8} {:>9} {:>9} {:>9} {:>9}",
        "", "", "", "%", "%", "% d_eq", "degrees", "error %", "ms", "/ sphere", "/ sphere", "time"
    )?;
    for line in &list.lines {
        for p in &line.curve.points {
            let n = if p.spheres == p.asked {
                p.spheres.to_string()
            } else {
                format!("{}/{}", p.spheres, p.asked)
            };
            writeln!(
                out,
                "{:<22} {n:>6} {:>7.4} {:>8.2} {:>9.2} {:>8.3} {:>9.2} {:>8.3} {:>9.1} {:>9.3} {:>9.1} {:>9.1}",
                line.name,
                p.mismatch,
                100.0 * p.coverage,
                100.0 * p.overshoot,
                100.0 * p.surface,
                p.roughness.to_degrees(),
                100.0 * p.inertia,
                1e3 * p.seconds,
                p.step_factor,
                p.step_cost,
                p.time_cost
            )?;
        }
        for (n, error) in &line.curve.failed {
            writeln!(out, "{:<22} {n:>6} {error}", line.name)?;
        }
    }
    for (name, choice) in choices {
        match choice {
            Ok(choice) => writeln!(out, "{name}: {}", choice.why)?,
            Err(error) => writeln!(out, "{name}: {error}")?,
        }
    }
    Ok(())
}

const COLUMNS: [&str; 21] = [
    "asked",
    "n",
    "D",
    "coverage",
    "overshoot",
    "surface_deq",
    "hausdorff_deq",
    "protrusion_deq",
    "roughness_rad",
    "union_inertia",
    "inertia",
    "masses",
    "seconds",
    "seconds_so_far",
    "time_step",
    "rayleigh",
    "step_factor",
    "least_radius",
    "step_cost",
    "time_cost",
    "stopped",
];

/// In the order of the columns.
fn values(p: &Point) -> [Value; 21] {
    [
        json!(p.asked),
        json!(p.spheres),
        json!(p.mismatch),
        json!(p.coverage),
        json!(p.overshoot),
        json!(p.surface),
        json!(p.hausdorff),
        json!(p.protrusion),
        json!(p.roughness),
        json!(p.union_inertia),
        json!(p.inertia),
        json!(p.masses.map(|m| m.name())),
        json!(p.seconds),
        json!(p.seconds_so_far),
        json!(p.time_step.clump),
        json!(p.time_step.rayleigh),
        json!(p.step_factor),
        json!(p.least_radius),
        json!(p.step_cost),
        json!(p.time_cost),
        json!(p.stopped.name()),
    ]
}

/// One line a point; lengths over the equivalent diameter.
pub fn csv(out: &mut dyn Write, list: &List) -> std::io::Result<()> {
    writeln!(out, "line,method,cells,{}", COLUMNS.join(","))?;
    for line in &list.lines {
        let cells = line.cells.iter().max().unwrap_or(&0);
        for p in &line.curve.points {
            write!(out, "\"{}\",{},{cells}", line.name, line.entry.name())?;
            for value in values(p) {
                match value {
                    Value::Null => write!(out, ",")?,
                    Value::String(text) => write!(out, ",{text}")?,
                    number => write!(out, ",{number}")?,
                }
            }
            writeln!(out)?;
        }
    }
    Ok(())
}

/// The points of a line.
pub fn points(line: &Line) -> Value {
    let point = |p: &Point| -> Value {
        COLUMNS
            .iter()
            .map(|c| c.to_string())
            .zip(values(p))
            .collect::<serde_json::Map<_, _>>()
            .into()
    };
    line.curve.points.iter().map(point).collect()
}

/// One object.
pub fn object(list: &List, choices: &[(String, morula::Result<Choice>)]) -> Value {
    let lines: Vec<Value> = list
        .lines
        .iter()
        .zip(choices)
        .map(|(line, (_, choice))| {
            json!({
                "name": line.name,
                "method": line.entry.name(),
                "cells": line.cells,
                "prepared_seconds": line.curve.prepared,
                "points": points(line),
                "failed": line.curve.failed.iter()
                    .map(|(n, e)| json!({ "n": n, "error": e.to_string() })).collect::<Vec<_>>(),
                "choice": choice.as_ref().ok().map(|c| c.index),
                "why": match choice { Ok(c) => c.why.clone(), Err(e) => e.to_string() },
            })
        })
        .collect();
    json!({
        "input": list.title,
        "equivalent_diameter": list.diameter,
        "threads": list.threads,
        "papers": list.marks.iter().map(|m| json!({ "what": m.what, "n": m.spheres, "D": m.mismatch }))
            .collect::<Vec<_>>(),
        "lines": lines,
    })
}
