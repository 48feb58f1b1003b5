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
        let row: Vec<f64> = s.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        let [x, y, z, r] = row[..] else {
            return Err(Error::Format(format!("sphere {i} is not four numbers")));
        };
        push("spheres of a file", &mut t.spheres, sphere([x, y, z, r], &format!("sphere {i}"))?)?;
    }
    for (i, m) in object.get("masses").and_then(Value::as_array).into_iter().flatten().enumerate() {
        let m = m.as_f64().ok_or_else(|| Error::Format(format!("mass {i} is {m}, no number")))?;
        push("masses of a file", &mut t.masses, m)?;
    }
    t.mass = object.get("mass").and_then(Value::as_f64);
    t.volume = object.get("volume").and_then(Value::as_f64);
    Ok(t)
}
