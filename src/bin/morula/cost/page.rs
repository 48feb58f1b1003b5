//! The page: curves, a slider, and target and clump to be turned. One file that needs no other.

use super::list::List;
use super::picture::COLOURS;
use super::table::points;
use crate::view::surface;
use morula::Solid;
use morula::cost::Choice;
use serde_json::{Value, json};
use std::io::Write;

const PAGE: &str = include_str!("page.html");
const SCRIPT: &str = include_str!("page.js");
/// Most triangles of the target that are shown.
const MOST: usize = 400_000;

/// Writes the page.
pub fn html(
    out: &mut dyn Write,
    list: &List,
    choices: &[(String, morula::Result<Choice>)],
    solid: &Solid,
) -> std::io::Result<()> {
    // No text of the data can end the script that holds it.
    let data = data(list, choices, solid).to_string().replace('<', "\\u003c");
    let title = escaped(&list.title);
    let page = PAGE.replace("{{title}}", &title);
    let (head, rest) = page.split_once("{{data}}").unwrap_or((&page, ""));
    let (middle, tail) = rest.split_once("{{script}}").unwrap_or((rest, ""));
    for part in [head, &data, middle, SCRIPT, tail] {
        out.write_all(part.as_bytes())?;
    }
    Ok(())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn data(list: &List, choices: &[(String, morula::Result<Choice>)], solid: &Solid) -> Value {
    let frame = solid.frame();
    let lines: Vec<Value> = list
        .lines
        .iter()
        .zip(choices)
        .enumerate()
        .map(|(i, (line, (_, choice)))| {
            let clump = |c: &morula::Clump| {
                let unit = c.spheres.iter().map(|s| frame.sphere_to_unit(s));
                let all = unit.flat_map(|s| [s.center.x, s.center.y, s.center.z, s.radius]);
                base64(all.flat_map(|x| (x as f32).to_le_bytes()))
            };
            let [r, g, b] = <[u8; 3]>::from(COLOURS[i % COLOURS.len()]);
            json!({
                "name": line.name,
                "colour": format!("rgb({r},{g},{b})"),
                "points": points(line),
                "clumps": line.curve.clumps.iter().map(clump).collect::<Vec<_>>(),
                "choice": choice.as_ref().ok().map(|c| c.index),
                "why": match choice { Ok(c) => c.why.clone(), Err(e) => e.to_string() },
            })
        })
        .collect();
    json!({
        "title": list.title,
        "lines": lines,
        "papers": list.marks.iter()
            .map(|m| json!({ "what": m.what, "n": m.spheres, "D": m.mismatch })).collect::<Vec<_>>(),
        "mesh": mesh(solid),
    })
}

/// The target's triangles: corners as 16 bits of their box, normals as 8 bits.
fn mesh(solid: &Solid) -> Value {
    let all = surface::triangles(solid.body());
    let step = all.len().div_ceil(MOST).max(1);
    let shown = || all.iter().step_by(step);
    let corners = || shown().flat_map(|t| t.corners);
    let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
    for p in corners() {
        for a in 0..3 {
            (low[a], high[a]) = (low[a].min(p[a]), high[a].max(p[a]));
        }
    }
    let edge = [0, 1, 2].map(|a| (high[a] - low[a]).max(1e-12));
    let whole = |p: morula::math::Vec3| {
        [0, 1, 2].map(|a| ((p[a] - low[a]) / edge[a] * 65535.0).round() as u16)
    };
    let part = |n: morula::math::Vec3| [0, 1, 2].map(|a| (127.0 * n[a]).round() as i8 as u8);
    json!({
        "count": shown().count(),
        "low": low,
        "edge": edge,
        "corners": base64(corners().flat_map(whole).flat_map(u16::to_le_bytes)),
        "normals": base64(shown().flat_map(|t| t.normals).flat_map(part)),
    })
}

/// As text of 64 letters, four for three bytes (RFC 4648).
fn base64(bytes: impl Iterator<Item = u8>) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bytes: Vec<u8> = bytes.collect();
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let at = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_stand_for_bytes() {
        let of = |text: &str| base64(text.bytes());
        assert_eq!(
            ["", "f", "fo", "foo", "foob"].map(of),
            ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]
        );
    }

    #[test]
    fn titles_cannot_be_markup() {
        assert_eq!(escaped("<b a=\"&\">"), "&lt;b a=&quot;&amp;&quot;&gt;");
    }
}
