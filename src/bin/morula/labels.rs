//! `morula info --labels`: the labels that a volume holds.

use crate::fail::{About, Done, Fail};
use crate::input::{self, Reading};
use crate::write;
use morula::Run;
use morula::shape::read::file_labels;
use morula::shape::voxels::LabelInfo;
use serde_json::{Value, json};

pub fn run(path: &str, reading: &Reading, as_json: bool) -> Done {
    if path.starts_with("sample:") {
        return Err(Fail::Usage(format!("{path} is a built-in particle: it has no labels")));
    }
    reading.counts_only()?;
    let labels = file_labels(input::file(path)?, &reading.file_options()?, &Run::serial());
    let labels = labels.about(path)?;
    write::to_stdout(|out| {
        if as_json {
            let list: Vec<Value> = labels.iter().map(object).collect();
            return writeln!(out, "{}", json!({ "input": path, "labels": list }));
        }
        writeln!(out, "{:>10} {:>12}  {:<24} border", "label", "cells", "box")?;
        for l in &labels {
            let bounds = (0..3)
                .map(|a| format!("{}-{}", l.first[a], l.last[a]))
                .collect::<Vec<_>>()
                .join(" ");
            let border = if l.touches_border { "touches" } else { "" };
            writeln!(out, "{:>10} {:>12}  {bounds:<24} {border}", l.label, l.cells)?;
        }
        Ok(())
    })
}

fn object(l: &LabelInfo) -> Value {
    json!({
        "label": l.label, "cells": l.cells, "first": l.first, "last": l.last,
        "touches_border": l.touches_border,
    })
}
