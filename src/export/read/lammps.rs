//! A molecule template of LAMMPS: sections Coords, Diameters and perhaps Masses.

use super::{Template, numbers, sphere};
use crate::error::{Error, Result, reserve};

const SECTIONS: [&str; 3] = ["Coords", "Diameters", "Masses"];

pub(super) fn parse(text: &str) -> Result<Template> {
    let mut count = None;
    let mut mass = None;
    // Rows of each section, by the number of the atom.
    let mut rows: [Vec<(usize, Vec<f64>)>; 3] = Default::default();
    let mut section = None;
    let mut heading = true;
    for (i, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        if line.starts_with(|c: char| c.is_ascii_alphabetic()) {
            heading = false;
            section = SECTIONS.iter().position(|s| *s == line);
            continue;
        }
        if heading {
            if let Some(n) = line.strip_suffix(" atoms") {
                count = n.trim().parse::<usize>().ok();
            } else if let Some(m) = line.strip_suffix(" mass") {
                mass = m.trim().parse().ok();
            }
            continue;
        }
        let Some(section) = section else { continue };
        let bad = || Error::Format(format!("line {} is no row of {}", i + 1, SECTIONS[section]));
        let row = numbers(line).ok_or_else(bad)?;
        let (id, row) = row.split_first().ok_or_else(bad)?;
        let whole = id.fract() == 0.0 && *id >= 1.0 && *id <= 1e9;
        if !whole || row.len() != if section == 0 { 3 } else { 1 } {
            return Err(bad());
        }
        rows[section].push((*id as usize, row.to_vec()));
    }
    let count = count.ok_or_else(|| Error::Format("the header has no number of atoms".into()))?;
    for (section, rows) in rows.iter_mut().enumerate() {
        rows.sort_by_key(|r| r.0);
        let needed = section < 2 || !rows.is_empty();
        let complete = rows.len() == count && (1..).zip(rows.iter()).all(|(k, r)| k == r.0);
        if needed && !complete {
            return Err(Error::Format(format!(
                "{} has {} rows, not one for each of the atoms 1 to {count}",
                SECTIONS[section],
                rows.len()
            )));
        }
    }
    let [coords, diameters, masses] = rows;
    let mut spheres = reserve("spheres of a file", count)?;
    for ((id, c), (_, d)) in coords.iter().zip(&diameters) {
        spheres.push(sphere([c[0], c[1], c[2], 0.5 * d[0]], &format!("atom {id}"))?);
    }
    let masses = masses.iter().map(|m| m.1[0]).collect();
    Ok(Template { spheres, masses, mass, ..Template::default() })
}
