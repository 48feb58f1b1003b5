//! Many runs of one file: every combination of the cases that it lists.

use super::file::SceneFile;
use super::keys::parse;
use crate::error::{Error, Result, push};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The most runs that one file may ask for.
const MOST: usize = 10_000;

/// What is different from run to run: the values at a path, or named cases of several paths.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepPart {
    /// Its column in tables; without it that is the last part of the path.
    pub name: Option<String>,
    /// A path, as `--set` takes it.
    pub path: Option<String>,
    /// The values there.
    #[serde(default)]
    pub values: Vec<toml::Value>,
    /// Or cases.
    #[serde(default)]
    pub cases: Vec<CasePart>,
    /// Whether what is shown is the mean over them: seeds, poses.
    #[serde(default)]
    pub mean: bool,
}

/// Values at several paths that belong together.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CasePart {
    /// What it is called.
    pub is: String,
    /// Paths and values; none: the file as it stands.
    #[serde(default)]
    pub set: BTreeMap<String, toml::Value>,
}

/// One of the runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// What it is in each column, in the order of [`columns`].
    pub labels: Vec<String>,
    /// Its scene.
    pub file: SceneFile,
}

/// The names of what is swept over.
pub fn columns(file: &SceneFile) -> Vec<String> {
    let last = |p: &String| p.rsplit('.').next().unwrap_or(p).to_owned();
    let of = |s: &SweepPart| s.name.clone().or(s.path.as_ref().map(last)).unwrap_or_default();
    file.sweep.iter().map(of).collect()
}

/// Paths and values.
type Pairs = Vec<(String, String)>;
/// What they are called.
type Choice = (String, Pairs);

fn choices(i: usize, part: &SweepPart) -> Result<Vec<Choice>> {
    let bad = |what: &str| Err(Error::InvalidArgument(format!("sweep {i} {what}")));
    // A table prints as TOML, a word without its quotes.
    let word = |v: &toml::Value| v.as_str().map_or(v.to_string(), str::to_owned);
    Ok(match (&part.path, part.values.as_slice(), part.cases.as_slice()) {
        (Some(path), values, []) if !values.is_empty() => {
            values.iter().map(|v| (word(v), vec![(path.clone(), v.to_string())])).collect()
        }
        (None, [], cases) if !cases.is_empty() => {
            if part.name.is_none() {
                return bad("has cases and no name");
            }
            let set =
                |c: &CasePart| c.set.iter().map(|(p, v)| (p.clone(), v.to_string())).collect();
            cases.iter().map(|c| (c.is.clone(), set(c))).collect()
        }
        _ => return bad("needs a path and its values, or a name and cases"),
    })
}

/// The runs of a file, the last sweep fastest; one, where it sweeps over nothing. What `set` says holds for all of them.
///
/// Refused: what [`parse`] refuses, sweeps without values, more than 10000 runs.
pub fn cases(text: &str, quick: bool, set: &[(String, String)]) -> Result<Vec<Case>> {
    let file = parse(text, quick, set)?;
    let mut runs: Vec<(Vec<String>, Pairs)> = vec![(Vec::new(), Vec::new())];
    for (i, part) in file.sweep.iter().enumerate() {
        let choices = choices(i, part)?;
        if runs.len().saturating_mul(choices.len()) > MOST {
            return Err(Error::TooLarge(format!(
                "the sweeps ask for more than {MOST} runs: sweep {i} makes {} of {}",
                runs.len().saturating_mul(choices.len()),
                runs.len()
            )));
        }
        let mut more = Vec::new();
        for (labels, pairs) in &runs {
            for (label, own) in &choices {
                let labels = labels.iter().chain([label]).cloned().collect();
                let pairs = pairs.iter().chain(own).cloned().collect();
                push("runs", &mut more, (labels, pairs))?;
            }
        }
        runs = more;
    }
    let one = |(labels, pairs): (Vec<String>, Pairs)| {
        let all: Vec<_> = set.iter().cloned().chain(pairs).collect();
        Ok(Case { labels, file: parse(text, quick, &all)? })
    };
    runs.into_iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "[run]\nend = 2.0\n[templates.ball]\nball = 0.5\ndensity = 1.0\nmaterial = \"m\"\n\
        [materials.m]\n[[sweep]]\npath = \"run.end\"\nvalues = [1, 2.5]\n\
        [[sweep]]\nname = \"law\"\ncases = [{ is = \"none\" }, { is = \"spring\", set = { \"effects.normal\" = \
        \"linear\", \"materials.m.stiffness\" = 3 } }]\n[effects]\n";

    #[test]
    fn every_combination_is_a_run_the_last_fastest() {
        let all = cases(SCENE, false, &[("run.seed".into(), "4".into())]).unwrap();
        assert_eq!(columns(&all[0].file), ["end", "law"]);
        let labels: Vec<_> = all.iter().map(|c| c.labels.join(" ")).collect();
        assert_eq!(labels, ["1 none", "1 spring", "2.5 none", "2.5 spring"]);
        assert_eq!((all[2].file.run.end, all[2].file.run.seed), (2.5, 4));
        assert!(all[2].file.effects.normal.is_none() && all[3].file.effects.normal.is_some());
        assert_eq!(all[3].file.materials["m"].stiffness, Some(3.0));
    }

    #[test]
    fn sweeps_that_are_none_are_refused() {
        let says = |from: &str, to: &str, words: &str| {
            let e = cases(&SCENE.replace(from, to), false, &[]).unwrap_err().to_string();
            assert!(e.contains(words), "{e}");
        };
        says("values = [1, 2.5]", "values = []", "sweep 0 needs a path and its values");
        says("name = \"law\"", "", "sweep 1 has cases and no name");
        says("run.end", "run.ends", "unknown key ends; the nearest is end");
        let many = format!("values = [{}]", "1,".repeat(MOST / 2 + 1));
        says("values = [1, 2.5]", &many, "more than 10000 runs: sweep 1 makes 10002");
        says("is = \"none\"", "is = \"none\", sets = {}", "unknown key sets; the nearest is set");
    }
}
