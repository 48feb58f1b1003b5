//! Many runs of one scene, or throws in many poses: a table of what came of them, and what each cost.

use crate::cpu;
use crate::fail::{About, Done, Fail};
use crate::progress::Bar;
use crate::write;
use morula::dem::scene::file::TemplatePart;
use morula::dem::scene::impacts::{Impacts, impacts};
use morula::dem::scene::sweep::{Case, columns};
use morula::dem::scene::{Makes, Place, Scene, Sink, build_with, play};
use morula::{Error, Result, Run};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// What the runs of a scene came to.
pub struct Table {
    /// Names of what is swept over.
    pub keys: Vec<String>,
    /// Names of what was found.
    pub figures: Vec<String>,
    /// The runs.
    pub rows: Vec<Row>,
    /// Processor time of all, clumps that runs share made once.
    pub seconds: f64,
}

/// One run.
pub struct Row {
    /// What it is.
    pub labels: Vec<String>,
    /// What was found.
    pub values: Vec<Option<f64>>,
    /// Spheres of all bodies.
    pub spheres: u64,
    /// Processor time of making its clumps, and of running.
    pub making: f64,
    /// As above.
    pub running: f64,
}

/// The last line of measures alone.
struct Last(Vec<Option<f64>>);

impl Sink for Last {
    fn row(&mut self, values: &[Option<f64>]) -> Result<()> {
        self.0 = values.to_vec();
        Ok(())
    }
    fn frame(&mut self, _: u64, _: &str) -> Result<()> {
        Ok(())
    }
    fn checkpoint(&mut self, _: u64, _: &[u8]) -> Result<()> {
        Ok(())
    }
    fn at(&mut self, _: &Place) -> bool {
        true
    }
}

/// Runs all cases, and says what each is doing.
pub fn run(cases: &[Case], folder: &Path, threads: usize, bar: &Bar) -> Done<(Table, String)> {
    let keys = cases.first().map_or(Vec::new(), |c| columns(&c.file));
    let mut makes = Makes::default();
    // What making each clump took: a later run that has it from before pays the same.
    let mut paid: Vec<(TemplatePart, f64)> = Vec::new();
    let mut figures = Vec::new();
    let mut rows: Vec<Row> = Vec::new();
    let mut all: Vec<Option<Impacts>> = Vec::new();
    let (mut throws, mut seconds) = (String::new(), 0.0);
    for (k, case) in cases.iter().enumerate() {
        let what = case.labels.join(" ");
        bar.set(k as f64 / cases.len() as f64, &what);
        let about = || if what.is_empty() { "the scene".to_owned() } else { what.clone() };
        let now = || cpu::seconds().unwrap_or_default();
        let pool = Run::new(threads).about("--threads")?.with_seed(case.file.run.seed);
        let before = now();
        let mut scene = build_with(&case.file, folder, &mut makes, &pool).about(&about())?;
        let took = now() - before;
        let mut making = 0.0;
        for part in case.file.templates.values() {
            match paid.iter().find(|p| p.0 == *part) {
                Some(p) => making += p.1,
                None => {
                    paid.push((part.clone(), took));
                    making += took;
                }
            }
        }
        let spheres = |s: &Scene| -> u64 {
            let s = s.engine.state();
            (0..s.len()).map(|i| s.template_of(i).spheres().len() as u64).sum()
        };
        let before = now();
        let (names, values, thrown) = match &case.file.impacts {
            Some(part) => {
                let found = impacts(&scene, &case.file, part, &pool).about(&about())?;
                let (names, values) = said(&found);
                list(&mut throws, &keys, case, &found);
                (names, values, Some(found))
            }
            None => {
                let mut last = Last(Vec::new());
                play(&mut scene, &mut last, &pool).about(&about())?;
                (scene.watch.names().to_vec(), last.0, None)
            }
        };
        let running = now() - before;
        seconds += took + running;
        if k == 0 {
            figures = names;
        } else if figures != names {
            return Err(Fail::Library {
                error: Error::InvalidArgument("runs of one sweep measure different things".into()),
                about: about(),
            });
        }
        let (labels, spheres) = (case.labels.clone(), spheres(&scene));
        rows.push(Row { labels, values, spheres, making, running });
        all.push(thrown);
    }
    let mut table = Table { keys, figures, rows, seconds };
    compare(&mut table, cases, &all)?;
    Ok((table, throws))
}

/// What throws are told by.
fn said(found: &Impacts) -> (Vec<String>, Vec<Option<f64>>) {
    let mut pairs = Vec::new();
    if let Some(a) = &found.agreement {
        let each = [("rms", a.mean), ("worst", a.worst), ("rigid", a.rigid), ("floor", a.floor)];
        for (name, [v, w]) in each {
            pairs.push((format!("{name}_v"), v));
            pairs.push((format!("{name}_w"), w));
        }
    } else {
        let n = found.thrown.len().max(1) as f64;
        let speed = found.velocity.norm();
        let of = |f: &dyn Fn(&morula::dem::impact::After) -> f64| {
            found.thrown.iter().map(|t| f(&t.after)).sum::<f64>() / n
        };
        pairs.push(("speed".into(), of(&|a| a.velocity.norm() / speed)));
        pairs.push(("spin".into(), of(&|a| a.angular_velocity.norm())));
    }
    pairs.push(("contacts".into(), found.most()));
    pairs.push(("steps".into(), found.steps() as f64));
    pairs.into_iter().map(|(n, v)| (n, Some(v))).unzip()
}

/// The throws of one run, each on a line.
fn list(out: &mut String, keys: &[String], case: &Case, found: &Impacts) {
    if out.is_empty() {
        let before = keys.iter().map(|k| format!("{k},")).collect::<String>();
        let _ = writeln!(out, "{before}throw,tilt,azimuth,vx,vy,vz,wx,wy,wz,contacts");
    }
    let before = case.labels.iter().map(|k| format!("{},", quoted(k))).collect::<String>();
    for (k, t) in found.thrown.iter().enumerate() {
        let [tilt, azimuth] =
            t.pose.map_or([String::new(), String::new()], |p| p.map(|v| v.to_string()));
        let (v, w) = (t.after.velocity, t.after.angular_velocity);
        let most = t.after.most;
        let motion: Vec<String> = v.iter().chain(w.iter()).map(|v| format!("{v:?}")).collect();
        let _ = writeln!(out, "{before}{k},{tilt},{azimuth},{},{most}", motion.join(","));
    }
}

/// How far the rebounds of each run are from those of the run with the last value of a column.
fn compare(table: &mut Table, cases: &[Case], all: &[Option<Impacts>]) -> Done {
    let Some(part) = cases.first().and_then(|c| c.file.impacts.clone()) else { return Ok(()) };
    for name in &part.compare {
        let Some(at) = table.keys.iter().position(|k| k == name) else {
            let why = format!("impacts.compare names {name}, which nothing sweeps over");
            return Err(Fail::Library { error: Error::InvalidArgument(why), about: String::new() });
        };
        let last = cases.last().and_then(|c| c.labels.get(at));
        for i in 0..cases.len() {
            let like = |c: &Case| {
                let same = |(k, l): (usize, &String)| {
                    if k == at { Some(l) == last } else { Some(l) == cases[i].labels.get(k) }
                };
                c.labels.iter().enumerate().all(same)
            };
            let other = cases.iter().position(like).and_then(|j| all[j].as_ref());
            let radius = 0.5 * diameter(cases, i);
            let found = all[i].as_ref().zip(other).and_then(|(a, b)| a.against(b, radius));
            table.rows[i].values.extend([found.map(|f| f[0]), found.map(|f| f[1])]);
        }
        table.figures.extend([format!("dv_{name}"), format!("dw_{name}")]);
    }
    Ok(())
}

/// What spins are made speeds by: the scale of the template thrown.
fn diameter(cases: &[Case], i: usize) -> f64 {
    let file = &cases[i].file;
    let name = file.bodies.first().map(|b| b.template.clone()).unwrap_or_default();
    file.templates.get(&name).map_or(1.0, |t| t.scale)
}

impl Table {
    /// The column of this name in a row, as a number.
    pub fn number(&self, row: &Row, column: &str) -> Option<f64> {
        if let Some(k) = self.keys.iter().position(|c| c == column) {
            return row.labels.get(k)?.parse().ok();
        }
        if let Some(k) = self.figures.iter().position(|c| c == column) {
            return row.values.get(k).copied()?;
        }
        match column {
            "n" => Some(row.spheres as f64),
            "generation_s" => Some(row.making),
            "run_s" => Some(row.running),
            "time_s" => Some(row.making + row.running),
            _ => None,
        }
    }

    /// Whether a row has these values in these columns.
    pub fn is(&self, row: &Row, at: &BTreeMap<String, String>) -> bool {
        at.iter().all(|(column, value)| {
            let k = self.keys.iter().position(|c| c == column);
            k.and_then(|k| row.labels.get(k)) == Some(value)
        })
    }

    /// The means over the columns that `over` is true for; figures and times alike.
    pub fn mean(&self, over: &[bool]) -> Table {
        let keep = |labels: &[String]| -> Vec<String> {
            let kept = labels.iter().zip(over).filter(|(_, over)| !**over);
            kept.map(|(l, _)| l.clone()).collect()
        };
        let mut table = Table {
            keys: keep(&self.keys),
            figures: self.figures.clone(),
            rows: Vec::new(),
            seconds: self.seconds,
        };
        let mut counts: Vec<f64> = Vec::new();
        for row in &self.rows {
            let labels = keep(&row.labels);
            if let Some(k) = table.rows.iter().position(|r| r.labels == labels) {
                let (to, n) = (&mut table.rows[k], counts[k]);
                let step = |a: f64, b: f64| a + (b - a) / (n + 1.0);
                for (a, b) in to.values.iter_mut().zip(&row.values) {
                    *a = (*a).zip(*b).map(|(a, b)| step(a, b));
                }
                to.making = step(to.making, row.making);
                to.running = step(to.running, row.running);
                counts[k] += 1.0;
            } else {
                let values = row.values.clone();
                table.rows.push(Row { labels, values, ..*row });
                counts.push(1.0);
            }
        }
        table
    }

    fn head(&self) -> Vec<String> {
        let own = |s: &str| s.to_owned();
        let (keys, figures) = (self.keys.iter().cloned(), self.figures.iter().cloned());
        keys.chain([own("n")]).chain(figures).chain([own("generation_s"), own("run_s")]).collect()
    }

    fn cells(&self, row: &Row, show: impl Fn(f64) -> String) -> Vec<String> {
        let values = row.values.iter().map(|v| v.map_or(String::new(), &show));
        row.labels
            .iter()
            .cloned()
            .chain([row.spheres.to_string()])
            .chain(values)
            .chain([row.making, row.running].map(|s| format!("{s:.3}")))
            .collect()
    }

    /// One line a run.
    pub fn csv(&self) -> String {
        // Cases may be arrays.
        let quoted = |c: &String| if c.contains(',') { format!("\"{c}\"") } else { c.clone() };
        let line =
            |cells: Vec<String>| cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n";
        let mut out = line(self.head());
        for row in &self.rows {
            out += &line(self.cells(row, |v| format!("{v:?}")));
        }
        out
    }

    /// The same for people.
    pub fn text(&self, out: &mut dyn std::io::Write) -> std::io::Result<()> {
        for cells in aligned(&self.lines()) {
            writeln!(out, "{cells}")?;
        }
        Ok(())
    }

    /// Titles and cells, rounded.
    pub fn lines(&self) -> Vec<Vec<String>> {
        let show = |v: f64| {
            if v == 0.0 || (1e-3..1e5).contains(&v.abs()) {
                if v == v.round() { format!("{v}") } else { format!("{v:.4}") }
            } else {
                format!("{v:.3e}")
            }
        };
        let rows = self.rows.iter().map(|r| self.cells(r, show));
        std::iter::once(self.head()).chain(rows).collect()
    }
}

/// Values may be arrays.
fn quoted(cell: &str) -> String {
    if cell.contains(',') { format!("\"{cell}\"") } else { cell.to_owned() }
}

/// Columns of one width each.
fn aligned(lines: &[Vec<String>]) -> Vec<String> {
    let columns = lines.first().map_or(0, Vec::len);
    let width = |k: usize| lines.iter().filter_map(|l| l.get(k)).map(|c| c.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|k| width(k).unwrap_or(0)).collect();
    let one = |l: &Vec<String>| {
        let cells: Vec<String> =
            l.iter().zip(&widths).map(|(c, w)| format!("{c:>w$}", w = *w)).collect();
        cells.join("  ")
    };
    lines.iter().map(one).collect()
}

/// Writes the table, and the throws where there are any, into a folder.
pub fn save(table: &Table, throws: &str, folder: &Path) -> Done {
    std::fs::create_dir_all(folder).map_err(|e| Fail::file(folder, e))?;
    let put = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(|e| Fail::file(&path, e))
    };
    put("sweep.csv", &table.csv())?;
    if !throws.is_empty() {
        put("impacts.csv", throws)?;
    }
    Ok(())
}

/// Prints the table.
pub fn print(title: &str, table: &Table) -> Done {
    write::to_terminal(|out| {
        writeln!(out, "{title}")?;
        table.text(out)
    })
}
