//! Reads a clump back: CSV with the header `x,y,z,r`, or JSON with `spheres`.

use morula::math::Vec3;
use morula::{Error, Result, Sphere};
use std::path::Path;

/// The spheres of a clump file.
pub fn spheres(path: &Path) -> Result<Vec<Sphere>> {
    let text = std::fs::read_to_string(path).map_err(|e| Error::Io(e.to_string()))?;
    let spheres = if text.trim_start().starts_with('{') { json(&text)? } else { csv(&text)? };
    if spheres.is_empty() {
        return Err(Error::Empty("there is no sphere".into()));
    }
    Ok(spheres)
}

fn csv(text: &str) -> Result<Vec<Sphere>> {
    let mut lines = text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty());
    let header = lines.next().map_or("", |(_, l)| l).replace(' ', "");
    if header != "x,y,z,r" {
        return Err(Error::Format(format!("line 1 is \"{header}\", not the header x,y,z,r")));
    }
    lines
        .map(|(i, line)| {
            let numbers = line.split(',').map(|v| v.trim().parse::<f64>()).collect::<Vec<_>>();
            match numbers[..] {
                [Ok(x), Ok(y), Ok(z), Ok(r)] => sphere([x, y, z, r], &format!("line {}", i + 1)),
                _ => Err(Error::Format(format!("line {} is not four numbers", i + 1))),
            }
        })
        .collect()
}

fn json(text: &str) -> Result<Vec<Sphere>> {
    let object: serde_json::Value =
        serde_json::from_str(text).map_err(|e| Error::Format(e.to_string()))?;
    let list = object.get("spheres").and_then(|v| v.as_array());
    let list = list.ok_or_else(|| Error::Format("the object has no list \"spheres\"".into()))?;
    list.iter()
        .enumerate()
        .map(|(i, s)| {
            let numbers: Vec<f64> =
                s.as_array().into_iter().flatten().filter_map(|v| v.as_f64()).collect();
            match numbers[..] {
                [x, y, z, r] => sphere([x, y, z, r], &format!("sphere {i}")),
                _ => Err(Error::Format(format!("sphere {i} is not four numbers"))),
            }
        })
        .collect()
}

fn sphere([x, y, z, r]: [f64; 4], place: &str) -> Result<Sphere> {
    if [x, y, z, r].iter().any(|v| !v.is_finite()) {
        return Err(Error::NotFinite(format!("{place} holds a number that is not finite")));
    }
    if r <= 0.0 {
        return Err(Error::InvalidArgument(format!("{place} has the radius {r}")));
    }
    Ok(Sphere::new(Vec3::new(x, y, z), r))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_read_and_faults_name_their_place() {
        let s = csv("x,y,z,r\n1,2,3,0.5\n\n-1e-3,0,0,2\n").unwrap();
        assert_eq!(s[1], Sphere::new(Vec3::new(-1e-3, 0.0, 0.0), 2.0));
        assert_eq!(json("{\"spheres\": [[1,2,3,0.5]]}").unwrap()[0], s[0]);
        for (text, place) in [
            ("a,b\n", "line 1"),
            ("x,y,z,r\n1,2,3\n", "line 2"),
            ("x,y,z,r\n1,2,3,nan\n", "line 2"),
            ("x,y,z,r\n1,2,3,-4\n", "line 2"),
        ] {
            assert!(csv(text).unwrap_err().to_string().contains(place), "{text}");
        }
        assert!(json("{\"spheres\": [[1,2]]}").is_err() && json("{}").is_err());
    }
}
