//! Checks that hard cases stay numerically stable: one list for the command line's `selftest` and for
//! the tests, each case with its measure, its bound and the value found.
//!
//! A case that misses its bound, fails or panics is a line that says so, never an end of the run.

mod accumulation;
mod algebra;
pub mod bodies;
mod convergence;
mod found;
mod invariance;
#[cfg(feature = "dem")]
mod motion;
mod particles;
mod references;
mod shapes;
#[cfg(feature = "dem")]
mod stiffness;
mod symmetry;
mod voxels;

use morula::error::{Error, figure};
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::Instant;

/// What a value must be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// This or less.
    AtMost(f64),
    /// This or more.
    AtLeast(f64),
    /// Between these two.
    Within(f64, f64),
    /// Any number: it is there to be read.
    Told,
}

impl Bound {
    /// Whether a value keeps it; what is no finite number keeps none.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Bound::AtMost(most) => value <= most,
                Bound::AtLeast(least) => value >= least,
                Bound::Within(least, most) => (least..=most).contains(&value),
                Bound::Told => true,
            }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Bound::AtMost(most) => write!(f, "<= {}", figure(*most)),
            Bound::AtLeast(least) => write!(f, ">= {}", figure(*least)),
            Bound::Within(least, most) => write!(f, "{} .. {}", figure(*least), figure(*most)),
            Bound::Told => f.write_str("told"),
        }
    }
}

/// What came of a case.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// The value found.
    Value(f64),
    /// It could not be run here.
    Skipped(String),
    /// It failed or panicked.
    Failed(String),
}

/// One line of the matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its group.
    pub group: &'static str,
    /// Its name.
    pub name: String,
    /// What is measured.
    pub measure: &'static str,
    /// What it must be.
    pub bound: Bound,
    /// Why it must.
    pub why: &'static str,
    /// What came of it.
    pub outcome: Outcome,
    /// Wall-clock time that it took.
    pub seconds: f64,
}

impl Case {
    /// Whether it kept its bound, or could not be run.
    pub fn pass(&self) -> bool {
        match &self.outcome {
            Outcome::Value(value) => self.bound.holds(*value),
            Outcome::Skipped(_) => true,
            Outcome::Failed(_) => false,
        }
    }
}

/// Why a case gave no value.
pub struct Miss(String);

impl From<Error> for Miss {
    fn from(error: Error) -> Miss {
        Miss(error.to_string())
    }
}

impl From<String> for Miss {
    fn from(text: String) -> Miss {
        Miss(text)
    }
}

/// A value or the reason why there is none.
type Found = Result<f64, Miss>;

/// Takes cases one after the other.
struct Matrix<'a> {
    group: &'static str,
    full: bool,
    data: Option<PathBuf>,
    told: &'a mut dyn FnMut(Case),
}

/// What a case is about.
struct About {
    measure: &'static str,
    bound: Bound,
    why: &'static str,
}

impl Matrix<'_> {
    /// Runs one case.
    fn case(&mut self, name: impl Into<String>, about: &About, work: impl FnOnce() -> Found) {
        let started = Instant::now();
        let outcome = match catch_unwind(AssertUnwindSafe(work)) {
            Ok(Ok(value)) => Outcome::Value(value),
            Ok(Err(Miss(text))) => Outcome::Failed(text),
            Err(payload) => {
                let text = payload.downcast_ref::<String>().map(String::as_str);
                let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
                Outcome::Failed(format!("panicked: {}", text.unwrap_or("without a word")))
            }
        };
        self.tell(name.into(), about, outcome, started.elapsed().as_secs_f64());
    }

    /// A case that cannot be run here.
    fn skip(&mut self, name: impl Into<String>, about: &About, reason: &str) {
        self.tell(name.into(), about, Outcome::Skipped(reason.into()), 0.0);
    }

    fn tell(&mut self, name: String, about: &About, outcome: Outcome, seconds: f64) {
        let About { measure, bound, why } = *about;
        (self.told)(Case { group: self.group, name, measure, bound, why, outcome, seconds });
    }
}

/// A group of cases: its name, and what runs them.
type Group = (&'static str, fn(&mut Matrix));

/// The groups in the order in which they are run.
const GROUPS: &[Group] = &[
    ("invariance", invariance::run),
    ("shapes", shapes::run),
    ("algebra", algebra::run),
    ("references", references::run),
    ("convergence", convergence::run),
    ("accumulation", accumulation::run),
    #[cfg(feature = "dem")]
    ("stiffness", stiffness::run),
];

/// The names of the groups.
pub fn groups() -> impl Iterator<Item = &'static str> {
    GROUPS.iter().map(|(name, _)| *name)
}

/// What is run.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Also the cases that take minutes, and the whole of those that are cut short else.
    pub full: bool,
    /// Groups; none: all of them.
    pub groups: Vec<String>,
    /// The folder of real particles; without it their cases are skipped.
    pub data: Option<PathBuf>,
}

/// Runs the cases and tells each when it is done.
pub fn run(options: &Options, mut told: impl FnMut(Case)) {
    for (group, cases) in GROUPS {
        if options.groups.is_empty() || options.groups.iter().any(|g| g == group) {
            let (full, data) = (options.full, options.data.clone());
            cases(&mut Matrix { group, full, data, told: &mut told });
        }
    }
}
