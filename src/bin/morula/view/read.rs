//! Reads a clump back: CSV with the header `x,y,z,r`, or JSON with `spheres` and their `frame`.

use crate::clump::Frame;
use morula::error::figure;
use morula::math::Vec3;
use morula::{Error, Result, Sphere};
use std::path::Path;

/// The spheres of a clump file, and the frame that they are in if the file says so.
pub fn clump(path: &Path) -> Result<(Vec<Sphere>, Option<Frame>)> {
    let text = std::fs::read_to_string(path).map_err(|e| Error::Io(e.to_string()))?;
    let (spheres, frame) =
        if text.trim_start().starts_with('{') { json(&text)? } else { (csv(&text)?, None) };
    if spheres.is_empty() {
        return Err(Error::Empty("there is no sphere".into()));
    }
    Ok((spheres, frame))
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

fn json(text: &str) -> Result<(Vec<Sphere>, Option<Frame>)> {
    let object: serde_json::Value =
        serde_json::from_str(text).map_err(|e| Error::Format(e.to_string()))?;
    let list = object.get("spheres").and_then(|v| v.as_array());
    let list = list.ok_or_else(|| Error::Format("the object has no list \"spheres\"".into()))?;
    let frame = match object.get("frame") {
        None => None,
        Some(said) => {
            let known = [Frame::Input, Frame::Body].into_iter().find(|f| said == f.name());
            let unknown = || Error::Format(format!("the frame is {said}, neither input nor body"));
            Some(known.ok_or_else(unknown)?)
        }
    };
    let spheres: Result<Vec<Sphere>> = list
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let numbers: Vec<f64> =
                s.as_array().into_iter().flatten().filter_map(|v| v.as_f64()).collect();
            match numbers[..] {
                [x, y, z, r] => sphere([x, y, z, r], &format!("sphere {i}")),
                _ => Err(Error::Format(format!("sphere {i} is not four numbers"))),
            }
        })
        .collect();
    Ok((spheres?, frame))
}

fn sphere([x, y, z, r]: [f64; 4], place: &str) -> Result<Sphere> {
    if [x, y, z, r].iter().any(|v| !v.is_finite()) {
        return Err(Error::NotFinite(format!("{place} holds a number that is not finite")));
    }
    if r <= 0.0 {
        return Err(Error::InvalidArgument(format!("{place} has the radius {}", figure(r))));
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
        let clump = |frame: &str| json(&format!("{{{frame}\"spheres\": [[1,2,3,0.5]]}}"));
        assert!(clump("").is_ok_and(|(read, frame)| read[0] == s[0] && frame.is_none()));
        assert!(clump("\"frame\":\"body\",").is_ok_and(|c| c.1 == Some(Frame::Body)));
        assert!(clump("\"frame\":\"lab\",").is_err() && clump("\"frame\":3,").is_err());
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
