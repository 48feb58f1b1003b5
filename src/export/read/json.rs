//! The JSON record: `spheres` as `[x, y, z, r]`, and what else there is.

use super::{Template, sphere};
use crate::error::{Error, Result, push};
use serde_json::Value;

pub(super) fn parse(text: &str) -> Result<Template> {
    let object: Value = serde_json::from_str(text).map_err(|e| Error::Format(e.to_string()))?;
    let list = object.get("spheres").and_then(Value::as_array);
    let list = list.ok_or_else(|| Error::Format("the object has no list \"spheres\"".into()))?;
    let body_frame = match object.get("frame") {
        None => None,
        Some(said) if said == "body" => Some(true),
        Some(said) if said == "input" => Some(false),
        Some(said) => {
            return Err(Error::Format(format!("the frame is {said}, neither input nor body")));
        }
    };
    let mut t = Template { body_frame, ..Template::default() };
    for (i, s) in list.iter().enumerate() {
        let row: Option<Vec<f64>> =
            s.as_array().and_then(|s| s.iter().map(Value::as_f64).collect());
        let Some(&[x, y, z, r]) = row.as_deref() else {
            return Err(Error::Format(format!("sphere {i} is not four numbers")));
        };
        push("spheres of a file", &mut t.spheres, sphere([x, y, z, r], &format!("sphere {i}"))?)?;
    }
    if let Some(masses) = there(&object, "masses") {
        let masses = masses.as_array();
        let masses = masses.ok_or_else(|| Error::Format("\"masses\" is no list".into()))?;
        for (i, m) in masses.iter().enumerate() {
            let m =
                m.as_f64().ok_or_else(|| Error::Format(format!("mass {i} is {m}, no number")))?;
            push("masses of a file", &mut t.masses, m)?;
        }
    }
    t.mass = number(&object, "mass")?;
    t.volume = number(&object, "volume")?;
    Ok(t)
}

/// What stands under a key; nothing where that is null.
fn there<'a>(object: &'a Value, key: &str) -> Option<&'a Value> {
    object.get(key).filter(|v| !v.is_null())
}

fn number(object: &Value, key: &str) -> Result<Option<f64>> {
    let bad = |v: &Value| Error::Format(format!("the {key} is {v}, no number"));
    there(object, key).map(|v| v.as_f64().ok_or_else(|| bad(v))).transpose()
}
