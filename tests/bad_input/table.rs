//! Runs cases in processes of their own and keeps the table of what they gave.

use crate::expect::{Expect, compact};
use crate::road::Outcome;
use morula::ffi::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longer than this is a hang.
const HANG_SECONDS: f64 = 20.0;

/// Seconds of CPU time that a process has used; 0 where the system does not tell.
fn cpu_seconds(pid: u32) -> f64 {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|t| t.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Runs one case; an error when it hangs or dies. A machine with other work to
/// do is no hang: what counts is the case's own time on a processor.
fn run(path: &Path, bodies: i32) -> Result<Outcome, String> {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "one_case", "--nocapture", "--test-threads=1"])
        .env("MORULA_CASE", path)
        .env("MORULA_BODIES", bodies.to_string())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        let used = cpu_seconds(child.id());
        if used > HANG_SECONDS || start.elapsed().as_secs_f64() > 15.0 * HANG_SECONDS {
            child.kill().unwrap();
            child.wait().unwrap();
            return Err(format!("hangs ({used:.0} s)"));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let out = child.wait_with_output().unwrap();
    let (text, errors) =
        (String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr));
    let line = text.lines().find_map(|l| l.strip_prefix("OUTCOME\t"));
    let cells: Vec<&str> = line.map(|l| l.splitn(6, '\t').collect()).unwrap_or_default();
    let [status, spheres, mismatch, peak, fault, message] = cells[..] else {
        return Err(format!("died: {} {errors}", out.status));
    };
    if errors.contains("panicked") {
        return Err(format!("prints a panic: {errors}"));
    }
    Ok(Outcome {
        status: status.parse().unwrap(),
        message: message.to_owned(),
        spheres: spheres.parse().unwrap(),
        mismatch: mismatch.parse().unwrap(),
        peak_kib: peak.parse().unwrap(),
        fault: fault.to_owned(),
    })
}

pub struct Table {
    rows: Vec<String>,
    faults: Vec<String>,
    peak_kib: u64,
}

impl Table {
    pub fn new() -> Self {
        Table {
            rows: vec!["case,bodies,outcome,spheres,D,message".into()],
            faults: Vec::new(),
            peak_kib: 0,
        }
    }

    pub fn case(&mut self, name: &str, path: &Path, expect: Expect) {
        // First as it comes, then, where bodies were refused, all of them and the largest.
        let first = self.one(name, path, MORULA_BODIES_REFUSE, expect);
        if first == Some(MORULA_STATUS_SEVERAL_BODIES) {
            self.one(name, path, MORULA_BODIES_ALL, Expect::Either);
            self.one(name, path, MORULA_BODIES_LARGEST, Expect::Either);
        }
    }

    fn one(&mut self, name: &str, path: &Path, bodies: i32, expect: Expect) -> Option<i32> {
        let choice = ["refuse", "largest", "all"][bodies as usize];
        let o = match run(path, bodies) {
            Ok(outcome) => outcome,
            Err(what) => {
                println!("{name},{choice} {what}");
                self.faults.push(format!("{name} ({choice}): {what}"));
                return None;
            }
        };
        self.peak_kib = self.peak_kib.max(o.peak_kib);
        let row = format!("{name},{choice},{},{},{:.4}", o.name(), o.spheres, o.mismatch);
        println!("{row} {}", o.message);
        self.rows.push(format!("{row},\"{}\"", o.message.replace('"', "'")));
        let mut fault = |what: &str| self.faults.push(format!("{name} ({choice}): {what}: {o:?}"));
        if o.status == 0 {
            if !o.fault.is_empty() {
                fault("a bad clump");
            }
            if compact(name) && o.mismatch > 0.25 {
                fault("ten spheres should come closer to a compact body");
            }
        } else if o.status == MORULA_STATUS_INTERNAL {
            fault("a defect of the library");
        } else if o.message.split_whitespace().count() < 3 || o.message.contains("\\n") {
            fault("no clear sentence");
        }
        match expect {
            Expect::Good if o.status != 0 => fault("a clump was expected"),
            Expect::Refused(statuses) if !statuses.contains(&o.status) => {
                fault("another status expected")
            }
            _ => {}
        }
        Some(o.status)
    }

    pub fn finish(self, part: &str) {
        if let Some(file) = std::env::var_os("MORULA_TABLE") {
            let mut path = PathBuf::from(file);
            let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
            path.set_file_name(format!("{stem}_{part}.csv"));
            std::fs::write(path, self.rows.join("\n") + "\n").unwrap();
        }
        let peak = self.peak_kib;
        println!("{part}: {} rows, peak memory of a case {peak} KiB", self.rows.len() - 1);
        assert!(peak < 2 << 20, "peak memory {peak} KiB");
        assert!(self.faults.is_empty(), "{}", self.faults.join("\n"));
    }
}

/// Cells of a line of comma-separated values, in which a cell may be quoted.
pub fn split_csv(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}
