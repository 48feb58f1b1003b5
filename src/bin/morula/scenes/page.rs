//! The page of all scenes: figures beside references, then the tables of sweeps.

use super::Shown;
use std::fmt::Write;

/// index.md.
pub fn page(all: &[Shown], quick: bool) -> String {
    let mut out = String::from("# What the scenes show\n\n");
    let variant = if quick { " --quick" } else { "" };
    let _ = writeln!(
        out,
        "Written by `morula scenes{variant}`. Times are processor seconds; all else is the same on every run.\n"
    );
    out += "| scene | figure | reference | ours | holds | spheres | time s |\n| --- | --- | --- | --- | --- | --- | --- |\n";
    for shown in all {
        let spheres = shown.table.rows.iter().map(|r| r.spheres).max().unwrap_or(0);
        let seconds = format!("{:.2}", shown.table.seconds);
        let mut first = true;
        for show in &shown.file.shows {
            let found = shown.figure(show);
            // Only what this variant runs.
            let Some(v) = found else { continue };
            let holds = match (show.least, show.most) {
                (None, None) => "",
                (least, most) => {
                    let low = least.is_some_and(|l| v < l);
                    if low || most.is_some_and(|m| v > m) { "no" } else { "yes" }
                }
            };
            let (name, n, time) = if first {
                (shown.name.as_str(), spheres.to_string(), seconds.as_str())
            } else {
                ("", String::new(), "")
            };
            first = false;
            let (what, reference) = (&show.what, &show.reference);
            let _ = writeln!(
                out,
                "| {name} | {what} | {reference} | {} | {holds} | {n} | {time} |",
                number(v)
            );
        }
        if first {
            let (name, title) = (&shown.name, &shown.file.title);
            let _ = writeln!(out, "| {name} | {title} | | | | {spheres} | {seconds} |");
        }
    }
    shares(&mut out, all);
    for shown in all {
        if !shown.many && shown.file.plots.is_empty() {
            continue;
        }
        let _ = writeln!(out, "\n## {}\n\n{}.\n", shown.name, shown.file.title);
        if !shown.file.plots.is_empty() {
            let _ = writeln!(out, "![{0}]({0}.svg)\n", shown.name);
        }
        if shown.many {
            for (k, cells) in shown.means().lines().iter().enumerate() {
                let _ = writeln!(out, "| {} |", cells.join(" | "));
                if k == 0 {
                    let _ = writeln!(out, "|{}", " --- |".repeat(cells.len()));
                }
            }
        }
    }
    out
}

/// How the effects of each scene share the time of a step: a column for each effect.
fn shares(out: &mut String, all: &[Shown]) {
    let named = super::bars::effects(all);
    if named.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n## Where the time of a step goes\n\n![shares](shares.svg)\n");
    let _ = writeln!(out, "Percent; `bodies` is what is left without any effect.\n");
    let _ = writeln!(
        out,
        "| scene | {} |\n| --- |{}",
        named.join(" | "),
        " ---: |".repeat(named.len())
    );
    for shown in all.iter().filter(|s| !s.shares.is_empty()) {
        let of = |n: &&str| {
            let share = shown.shares.iter().find(|s| s.name == *n);
            share.map_or(String::new(), |s| format!("{:.1}", 100.0 * s.part))
        };
        let cells: Vec<String> = named.iter().map(of).collect();
        let _ = writeln!(out, "| {} | {} |", shown.name, cells.join(" | "));
    }
}

/// A figure as it is read best.
pub fn number(v: f64) -> String {
    if v == 0.0 {
        return "0".into();
    }
    if (1e-3..1e5).contains(&v.abs()) { format!("{v:.4}") } else { format!("{v:.2e}") }
}
