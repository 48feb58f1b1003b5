//! The comparison as a table for people, as CSV and as JSON.

use super::entry::{Made, Row};
use serde_json::{Value, json};
use std::io::Write;

/// What the table says of the shape.
pub struct About<'a> {
    pub input: &'a str,
    pub diameter: f64,
    pub cells: [usize; 3],
    pub threads: usize,
    /// Wall-clock seconds of what serves all methods: reading and checking, grid and distances.
    pub read: f64,
    pub grid: f64,
    pub notes: Vec<String>,
}

/// Titles and columns, aligned.
pub fn text(out: &mut dyn Write, about: &About, rows: &[Row]) -> std::io::Result<()> {
    let [x, y, z] = about.cells;
    writeln!(
        out,
        "{}: {x} x {y} x {z} cells, read in {:.0} ms, grid and distances made in {:.0} ms",
        about.input,
        1e3 * about.read,
        1e3 * about.grid
    )?;
    writeln!(
        out,
        "{:<17} {:>9} {:>7} {:>9} {:>9} {:>11} {:>9} {:>8} {:>8}  stopped by",
        "method", "n", "D", "coverage", "overshoot", "protrusion", "rms", "CPU ms", "wall ms"
    )?;
    writeln!(
        out,
        "{:<17} {:>9} {:>7} {:>9} {:>9} {:>11} {:>9} {:>8} {:>8}",
        "", "", "", "%", "%", "% of d_eq", "% of d_eq", "", ""
    )?;
    for row in rows {
        write!(out, "{:<17} ", row.entry.name())?;
        match &row.made {
            Err(_) => writeln!(out, "{}", row.failure().unwrap_or_default())?,
            Ok(made) => {
                let q = &made.quality;
                let n = made.clump.spheres.len();
                let count =
                    if n == row.asked { n.to_string() } else { format!("{n}/{}", row.asked) };
                let cpu = made.cpu_seconds.map_or("-".into(), |s| format!("{:.1}", 1e3 * s));
                writeln!(
                    out,
                    "{count:>9} {:>7.4} {:>9.2} {:>9.2} {:>11.3} {:>9.3} {cpu:>8} {:>8.1}  {}",
                    q.mismatch,
                    100.0 * q.coverage,
                    100.0 * q.overshoot,
                    100.0 * q.protrusion / about.diameter,
                    100.0 * q.rms_distance / about.diameter,
                    1e3 * made.wall_seconds,
                    made.clump.stopped.name()
                )?;
            }
        }
    }
    Ok(())
}

/// One line a method; lengths over the equivalent diameter. Of a method that failed, its sentence.
pub fn csv(out: &mut dyn Write, about: &About, rows: &[Row]) -> std::io::Result<()> {
    writeln!(
        out,
        "method,asked,n,D,coverage,overshoot,protrusion_deq,rms_deq,cpu_s,wall_s,stopped,error"
    )?;
    for row in rows {
        write!(out, "{},{},", row.entry.name(), row.asked)?;
        match &row.made {
            Err(_) => {
                let sentence = row.failure().unwrap_or_default().replace('"', "\"\"");
                writeln!(out, ",,,,,,,,,\"{sentence}\"")?;
            }
            Ok(made) => {
                let q = &made.quality;
                writeln!(
                    out,
                    "{},{},{},{},{},{},{},{},{},",
                    made.clump.spheres.len(),
                    q.mismatch,
                    q.coverage,
                    q.overshoot,
                    q.protrusion / about.diameter,
                    q.rms_distance / about.diameter,
                    made.cpu_seconds.map_or(String::new(), |s| s.to_string()),
                    made.wall_seconds,
                    made.clump.stopped.name()
                )?;
            }
        }
    }
    Ok(())
}

/// One object; lengths in the caller's unit, as `morula clump --json` has them.
pub fn object(about: &About, rows: &[Row]) -> Value {
    let clumps: Vec<Value> = rows
        .iter()
        .map(|row| match &row.made {
            Err(_) => json!({
                "method": row.entry.name(), "asked": row.asked, "error": row.failure(),
            }),
            Ok(made) => clump(row, made),
        })
        .collect();
    json!({
        "input": about.input,
        "equivalent_diameter": about.diameter,
        "cells": about.cells,
        "threads": about.threads,
        "seconds": { "read": about.read, "grid": about.grid },
        "notes": about.notes,
        "clumps": clumps,
    })
}

fn clump(row: &Row, made: &Made) -> Value {
    let q = &made.quality;
    json!({
        "method": row.entry.name(),
        "asked": row.asked,
        "n": made.clump.spheres.len(),
        "D": q.mismatch,
        "coverage": q.coverage,
        "overshoot": q.overshoot,
        "protrusion": q.protrusion,
        "rms_distance": q.rms_distance,
        "hausdorff": q.hausdorff,
        "roughness": q.roughness,
        "volume_error": q.volume_error,
        "cpu_seconds": made.cpu_seconds,
        "wall_seconds": made.wall_seconds,
        "stopped": made.clump.stopped.name(),
        "note": made.clump.note,
        "error": null,
    })
}
