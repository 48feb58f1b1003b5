//! Kratos, `.clu`.

use super::{Template, numbers, sphere};
use crate::error::{Error, Result, push};

pub(super) fn parse(text: &str) -> Result<Template> {
    let mut t = Template { body_frame: Some(true), ..Template::default() };
    let mut lines = text.lines().enumerate().map(|(i, l)| (i + 1, bare(l)));
    for (i, line) in
        lines.by_ref().skip_while(|(_, l)| !l.starts_with("Begin centers_and_radii")).skip(1)
    {
        if line.starts_with("End centers_and_radii") {
            break;
        }
        if line.is_empty() {
            continue;
        }
        let row = numbers(line);
        let Some(&[x, y, z, r]) = row.as_deref() else {
            return Err(Error::Format(format!("line {i} is not four numbers")));
        };
        push("spheres of a file", &mut t.spheres, sphere([x, y, z, r], &format!("line {i}"))?)?;
    }
    // The volume is on the line of its word or on the next that holds something.
    let mut rest = lines.map(|(_, l)| l).filter(|l| !l.is_empty());
    while let Some(line) = rest.next() {
        if let Some(same) = line.strip_prefix("Volume") {
            let value =
                if same.trim().is_empty() { rest.next().unwrap_or("") } else { same.trim() };
            t.volume = value.parse().ok();
        }
    }
    Ok(t)
}

/// Without the comment.
fn bare(line: &str) -> &str {
    line.split("//").next().unwrap_or("").trim()
}
