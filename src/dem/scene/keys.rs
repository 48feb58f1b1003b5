//! Reading scene files: quick variants, values set by hand, and the nearest valid name for a wrong one.

use super::file::SceneFile;
use crate::error::{Error, Result};

/// A scene from the text of its file. With `quick` its table `quick` is laid over the rest; `set` are further
/// (path, value) pairs, such as `templates.stone.spheres` and `30`, the value as TOML or a bare word.
///
/// Refused with `Format`: what is not TOML, unknown keys (with the nearest valid one), values of another kind.
pub fn parse(text: &str, quick: bool, set: &[(String, String)]) -> Result<SceneFile> {
    // As it stands first, so that the place of an error is told.
    let whole: SceneFile = toml::from_str(text).map_err(|e| said(&e, text))?;
    if !quick && set.is_empty() {
        return Ok(whole);
    }
    let mut table: toml::Table = toml::from_str(text).map_err(|e| said(&e, text))?;
    if quick && let Some(toml::Value::Table(over)) = table.remove("quick") {
        lay(&mut table, over);
    }
    for (path, value) in set {
        put(&mut table, path, value)?;
    }
    toml::Value::Table(table).try_into().map_err(|e| said(&e, ""))
}

/// Lays one table over another; arrays and numbers replace what was there.
fn lay(table: &mut toml::Table, over: toml::Table) {
    for (key, value) in over {
        match (table.get_mut(&key), value) {
            (Some(toml::Value::Table(below)), toml::Value::Table(above)) => lay(below, above),
            (_, value) => {
                table.insert(key, value);
            }
        }
    }
}

/// Sets the value at a path with dots; `*` is every table or element there.
fn put(table: &mut toml::Table, path: &str, value: &str) -> Result<()> {
    let read = format!("v = {value}");
    let value = match toml::from_str::<toml::Table>(&read) {
        Ok(mut table) => table.remove("v"),
        Err(_) => Some(toml::Value::String(value.to_owned())),
    };
    let value = value.ok_or_else(|| Error::Internal("a value is lost".into()))?;
    let keys: Vec<&str> = path.split('.').collect();
    let mut found = 0;
    reach(&mut toml::Value::Table(std::mem::take(table)), &keys, &value, &mut found)
        .map_err(|at| Error::InvalidArgument(format!("the scene has no {at}, to set {path}")))
        .map(|whole| {
            if let toml::Value::Table(whole) = whole {
                *table = whole;
            }
        })
}

fn reach(
    at: &mut toml::Value,
    keys: &[&str],
    value: &toml::Value,
    found: &mut usize,
) -> std::result::Result<toml::Value, String> {
    let Some((key, rest)) = keys.split_first() else {
        *found += 1;
        return Ok(value.clone());
    };
    match at {
        toml::Value::Table(table) if *key == "*" => {
            for inner in table.iter_mut() {
                *inner.1 = reach(inner.1, rest, value, found)?;
            }
        }
        toml::Value::Table(table) => {
            if rest.is_empty() {
                table.insert((*key).to_owned(), value.clone());
                *found += 1;
            } else {
                let inner = table.get_mut(*key).ok_or_else(|| (*key).to_owned())?;
                *inner = reach(inner, rest, value, found)?;
            }
        }
        toml::Value::Array(all) => {
            let which: Vec<usize> = match key.parse::<usize>() {
                _ if *key == "*" => (0..all.len()).collect(),
                Ok(i) if i < all.len() => vec![i],
                _ => return Err(format!("element {key} of {}", all.len())),
            };
            for i in which {
                all[i] = reach(&mut all[i], rest, value, found)?;
            }
        }
        _ => return Err((*key).to_owned()),
    }
    Ok(at.clone())
}

/// What TOML says, with the nearest valid name where it knows a name not.
fn said(e: &toml::de::Error, text: &str) -> Error {
    let line = e.span().map(|s| 1 + text[..s.start.min(text.len())].matches('\n').count());
    let place = match line {
        Some(line) if !text.is_empty() => format!("line {line}: "),
        _ => String::new(),
    };
    let message = e.message().lines().next().unwrap_or_default();
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let unknown = message.starts_with("unknown field") || message.starts_with("unknown variant");
    if let (true, Some((wrong, valid))) = (unknown, names.split_first()) {
        let like = |name: &&&str| (strsim::jaro_winkler(wrong, name) * 1e6) as u64;
        if let Some(near) = valid.iter().max_by_key(like) {
            let kind = if message.starts_with("unknown field") { "key" } else { "choice" };
            return Error::Format(format!("{place}unknown {kind} {wrong}; the nearest is {near}"));
        }
    }
    Error::Format(format!("{place}{message}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "title = \"one ball\"\n[run]\nend = 2.0\n[effects]\ngravity = [0, 0, -9.81]\n\
        [templates.ball]\nball = 0.5\ndensity = 1.0\nmaterial = \"m\"\n[materials.m]\n\
        [[bodies]]\ntemplate = \"ball\"\nposition = [0, 0, 1]\n\
        [quick]\nrun = { end = 1.0 }\n";

    #[test]
    fn a_scene_its_quick_variant_and_values_by_hand() {
        let scene = parse(SCENE, false, &[]).unwrap();
        assert_eq!((scene.run.end, scene.bodies.len()), (2.0, 1));
        assert_eq!(parse(SCENE, true, &[]).unwrap().run.end, 1.0);
        let set = |p: &str, v: &str| (p.to_owned(), v.to_owned());
        let by =
            [set("run.end", "3"), set("templates.*.spheres", "7"), set("bodies.0.fixed", "true")];
        let scene = parse(SCENE, true, &by);
        let scene = scene.unwrap();
        assert_eq!((scene.run.end, scene.templates["ball"].spheres), (3.0, Some(7)));
        assert!(scene.bodies[0].fixed);
        let bare = parse(SCENE, false, &[set("templates.ball.method", "mss")]).unwrap();
        assert_eq!(bare.templates["ball"].method, Some(super::super::file::MethodName::Mss));
    }

    #[test]
    fn wrong_names_are_told_with_the_nearest() {
        let says = |from: &str, to: &str, words: &str| {
            let e = parse(&SCENE.replace(from, to), false, &[]).unwrap_err().to_string();
            assert!(e.contains(words), "{e}");
        };
        says("gravity =", "gravty =", "line 5: unknown key gravty; the nearest is gravity");
        says("ball = 0.5", "ball = true", "line 7: invalid type");
        says("[run]", "[[run]]", "line ");
        says("end = 2.0", "step = 1.0", "missing field `end`");
        says(
            "density = 1.0",
            "density = 1.0\nmethod = \"bets\"",
            "unknown choice bets; the nearest is best",
        );
        let by = ("templates.bell.spheres".to_owned(), "3".to_owned());
        let e = parse(SCENE, false, &[by]).unwrap_err().to_string();
        assert!(e.contains("the scene has no bell"), "{e}");
        let by = ("run.stop".to_owned(), "3".to_owned());
        let e = parse(SCENE, false, &[by]).unwrap_err().to_string();
        assert!(e.contains("unknown key stop; the nearest is step"), "{e}");
    }
}
