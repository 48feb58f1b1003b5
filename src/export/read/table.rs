//! Rows of x, y, z, r and perhaps a mass, with or without the header that says so.

use super::{Template, numbers, sphere};
use crate::error::{Error, Result, push};

pub(super) fn parse(text: &str) -> Result<Template> {
    let lines = text.lines().enumerate().map(|(i, l)| (i + 1, l.trim()));
    let mut lines = lines.filter(|(_, l)| !l.is_empty() && !l.starts_with('#')).peekable();
    let mut wanted = None;
    if let Some((i, first)) = lines.peek()
        && numbers(first).is_none()
    {
        let names: Vec<String> = first
            .split([',', ';', ' ', '\t'])
            .filter(|w| !w.is_empty())
            .map(str::to_lowercase)
            .collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        wanted = Some(match names[..] {
            ["x", "y", "z", "r" | "radius"] => 4,
            ["x", "y", "z", "r" | "radius", "mass"] => 5,
            _ => {
                return Err(Error::Format(format!(
                    "line {i} is {first:?}, neither numbers nor the header x,y,z,r or x,y,z,r,mass"
                )));
            }
        });
        lines.next();
    }
    let mut t = Template::default();
    for (i, line) in lines {
        let row = numbers(line);
        let count = row.as_ref().map_or(0, Vec::len);
        let wanted = *wanted.get_or_insert(count);
        let place = format!("line {i}");
        match row.as_deref() {
            Some(&[x, y, z, r, ref mass @ ..]) if count == wanted && mass.len() <= 1 => {
                push("spheres of a file", &mut t.spheres, sphere([x, y, z, r], &place)?)?;
                if let [m] = mass {
                    if !m.is_finite() {
                        return Err(Error::NotFinite(format!("{place} has the mass {m}")));
                    }
                    push("masses of a file", &mut t.masses, *m)?;
                }
            }
            _ => {
                let wanted = if wanted == 5 { "five" } else { "four" };
                return Err(Error::Format(format!("line {i} is not {wanted} numbers")));
            }
        }
    }
    Ok(t)
}
