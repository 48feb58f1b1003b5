//! What the outputs have in common: the curves with their names.

use super::papers::Mark;
use crate::compare::entry::Entry;
use morula::cost::{Curve, Swept};

/// A curve.
pub struct Line {
    pub name: String,
    pub entry: Entry,
    pub cells: [usize; 3],
    pub curve: Curve,
}

/// All curves of a shape.
pub struct List {
    pub title: String,
    pub diameter: f64,
    pub threads: usize,
    pub lines: Vec<Line>,
    pub marks: Vec<Mark>,
}

/// The name of a line: its method, and what else it is one of several by.
pub fn name(entry: Entry, swept: &Swept, [cells, seconds]: [bool; 2]) -> String {
    let mut name = entry.name();
    if cells {
        name += &format!(", {} cells", swept.cells.iter().max().unwrap_or(&0));
    }
    if seconds {
        name += &match swept.seconds {
            0.0 => ", no deadline".to_string(),
            s => format!(", {s} s"),
        };
    }
    name
}
