//! What a scene shows: figures held against references, and pictures of its table.

use serde::Deserialize;
use std::collections::BTreeMap;

/// A figure of the scene beside what it should be.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShowPart {
    /// What it is.
    pub what: String,
    /// Its column: a measure, or a figure of the sweep.
    pub figure: String,
    /// Of a sweep, the run that it is taken of: columns and their values.
    #[serde(default)]
    pub at: BTreeMap<String, String>,
    /// What of the lines of measures is meant.
    #[serde(default)]
    pub of: OfName,
    /// What it is multiplied by.
    #[serde(default = "one")]
    pub times: f64,
    /// What it should be, in words.
    pub reference: String,
    /// It should be at least this,
    pub least: Option<f64>,
    /// and at most this.
    pub most: Option<f64>,
}

fn one() -> f64 {
    1.0
}

/// What of the lines of measures is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OfName {
    /// The last.
    #[default]
    Last,
    /// The greatest.
    Most,
    /// The least.
    Least,
    /// The greatest change since the first line, over the size of the first.
    Drift,
    /// The greatest rise since the first line, over the size of the first.
    Rise,
    /// The mean of the lines from `output.average` on.
    Mean,
    /// The mean time from one rise through 0 to the next, between lines by a straight line.
    Period,
}

impl OfName {
    /// That of these (time, value); `None` without any, where nothing can be told of a first line that is 0, and for the
    /// period of what does not rise through 0 twice.
    pub fn of(self, lines: &[(f64, f64)]) -> Option<f64> {
        let values: Vec<f64> = lines.iter().map(|l| l.1).collect();
        let first = *values.first()?;
        let most = |f: &dyn Fn(f64) -> f64| values.iter().map(|v| f(*v)).fold(f64::MIN, f64::max);
        match self {
            OfName::Last => values.last().copied(),
            OfName::Most => Some(most(&|v| v)),
            OfName::Least => Some(-most(&|v| -v)),
            OfName::Mean => Some(values.iter().sum::<f64>() / values.len() as f64),
            OfName::Period => {
                let rises = lines.windows(2).filter(|w| w[0].1 < 0.0 && w[1].1 >= 0.0);
                let at = |w: &[(f64, f64)]| {
                    let ([t, s], [a, b]) = ([w[0].0, w[1].0], [w[0].1, w[1].1]);
                    t + (s - t) * a / (a - b)
                };
                let times: Vec<f64> = rises.map(at).collect();
                let (a, b) = (times.first()?, times.last()?);
                (times.len() > 1).then(|| (b - a) / (times.len() - 1) as f64)
            }
            _ if first == 0.0 => None,
            OfName::Drift => Some(most(&|v| (v - first).abs()) / first.abs()),
            OfName::Rise => Some(most(&|v| v - first) / first.abs()),
        }
    }
}

/// A picture: one column against another.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotPart {
    /// The column across; `time_s` is the processor time of a run with its clumps.
    pub x: String,
    /// The column up.
    pub y: String,
    /// Columns whose values make a line each; without them all that is swept over but `x`.
    pub lines: Option<Vec<String>>,
    /// Runs that are shown: columns and their values.
    #[serde(default, rename = "where")]
    pub only: BTreeMap<String, String>,
    /// Whether the axes are even instead of logarithmic.
    #[serde(default)]
    pub even: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_of_the_lines_is_meant() {
        let v = [-2.0, 1.0, -5.0, -1.0].map(|v| (0.0, v));
        let all =
            [OfName::Last, OfName::Most, OfName::Least, OfName::Drift, OfName::Rise, OfName::Mean];
        assert_eq!(all.map(|o| o.of(&v).unwrap()), [-1.0, 1.0, -5.0, 1.5, 1.5, -1.75]);
        assert_eq!(OfName::Drift.of(&[(0.0, 0.0), (1.0, 1.0)]), None);
        let waves: Vec<(f64, f64)> =
            (0..100).map(|k| 0.1 * f64::from(k)).map(|t| (t, (2.0 * t - 1.0).sin())).collect();
        assert!((OfName::Period.of(&waves).unwrap() - std::f64::consts::PI).abs() < 1e-3);
        assert_eq!(OfName::Period.of(&waves[..20]), None);
        assert_eq!(OfName::Last.of(&[]), None);
    }
}
