//! A small stroke font: letters as polylines, drawn antialiased at any size.
//!
//! A glyph is a list of strokes separated by `;`. The first letter says how a
//! stroke runs through its points: `L` straight, `C` rounded, `O` rounded and
//! closed. Each point is two digits, x from the left and y from the bottom;
//! the baseline is y = 2, small letters reach 6, capitals 8.

/// A stroke in font units.
pub type Stroke = Vec<[f32; 2]>;

/// The strokes of a character and its width, in font units (capitals are 6 high, from y = 0).
pub fn glyph(c: char) -> (Vec<Stroke>, f32) {
    let text = strokes(c);
    let mut width: f32 = 0.0;
    let mut out = Vec::new();
    for stroke in text.split(';').filter(|s| !s.is_empty()) {
        let (kind, digits) = stroke.split_at(1);
        let digits: Vec<f32> = digits.bytes().map(|b| f32::from(b.saturating_sub(b'0'))).collect();
        let mut points: Stroke = digits.chunks_exact(2).map(|p| [p[0], p[1] - 2.0]).collect();
        width = points.iter().fold(width, |w, p| w.max(p[0]));
        if kind != "L" {
            for _ in 0..3 {
                points = rounder(&points, kind == "O");
            }
        }
        if kind == "O"
            && let Some(first) = points.first().copied()
        {
            points.push(first);
        }
        out.push(points);
    }
    (out, if c == ' ' { 1.2 } else { width })
}

/// One step of corner cutting (Chaikin 1974); open strokes keep their ends.
fn rounder(points: &[[f32; 2]], closed: bool) -> Stroke {
    let mix = |a: [f32; 2], b: [f32; 2], t: f32| [0, 1].map(|i| a[i] + t * (b[i] - a[i]));
    let mut out = Vec::with_capacity(2 * points.len());
    let n = points.len();
    for i in 0..if closed { n } else { n.saturating_sub(1) } {
        let (a, b) = (points[i], points[(i + 1) % n]);
        let first = !closed && i == 0;
        let last = !closed && i + 2 == n;
        out.push(if first { a } else { mix(a, b, 0.25) });
        out.push(if last { b } else { mix(a, b, 0.75) });
    }
    out
}

#[rustfmt::skip]
fn strokes(c: char) -> &'static str {
    match c {
        '0' => "O02424808", '1' => "L172822", '2' => "C0608484502;L0242",
        '3' => "C0708484525;C2545420203", '4' => "L32380444", '5' => "L480805;C051646420203",
        '6' => "O02424606;C040838", '7' => "L084812", '8' => "O05454808;O02424505",
        '9' => "O04444808;C464212",
        'A' => "L022842;L1434", 'B' => "L0208;C08484505;C05454202", 'C' => "C474808024243",
        'D' => "L0208;C08484202", 'E' => "L48080242;L0535", 'F' => "L480802;L0535",
        'G' => "C474808024245;L2545", 'H' => "L0208;L4248;L0545", 'I' => "L0208",
        'J' => "C38320203", 'K' => "L0208;L4804;L1542", 'L' => "L080232",
        'M' => "L0208254842", 'N' => "L02084248", 'O' => "O02424808",
        'P' => "L0208;C08484404", 'Q' => "O02424808;L2442", 'R' => "L0208;C08484505;L2542",
        'S' => "C4748080545420203", 'T' => "L0848;L2822", 'U' => "C08024248", 'V' => "L082248",
        'W' => "L0812263248", 'X' => "L0248;L0842", 'Y' => "L082548;L2522", 'Z' => "L08480242",
        'a' => "O02323606;L3632", 'b' => "L0802;O02323606", 'c' => "C353606023233",
        'd' => "L3832;O02323606", 'e' => "L0434;C343606023233", 'f' => "C281812;L0626",
        'g' => "O02323606;C36300001", 'h' => "L0802;C04063632", 'i' => "L0602;L0808",
        'j' => "C161000;L1818", 'k' => "L0802;L3604;L1432", 'l' => "L0802",
        'm' => "L0602;C04062622;C24264642", 'n' => "L0602;C04063632", 'o' => "O02323606",
        'p' => "L0600;O02323606", 'q' => "L3630;O02323606", 'r' => "L0602;C040626",
        's' => "C3536060434320203", 't' => "C181222;L0626", 'u' => "C06023234;L3632",
        'v' => "L062246", 'w' => "L0612253246", 'x' => "L0236;L0632", 'y' => "L0622;L462210",
        'z' => "L06360232",
        '.' => "L0202", ',' => "L1201", ':' => "L0202;L0606", ';' => "L1201;L1616",
        '%' => "O06262808;O22424424;L0248", '+' => "L0545;L2337", '-' => "L0525",
        '\u{2212}' => "L0545", '=' => "L0444;L0646", '(' => "C18060412", ')' => "C08161402",
        '/' => "L0238", '_' => "L0141", '°' => "O06262808", '\'' => "L0806",
        '<' => "L470543", '>' => "L074503", '|' => "L0108", '·' => "L0505", '#' => "L1218;L3238;L0444;L0646",
        '~' => "C04163446", '*' => "L2337;L0545;L0743", '×' => "L1436;L1634", ' ' => "",
        _ => "L0242480802",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_printable_character_of_the_titles_has_strokes() {
        for c in ('0'..='9').chain('a'..='z').chain('A'..='Z').chain(".,:%+-−=()/_".chars()) {
            let (strokes, width) = glyph(c);
            assert!(!strokes.is_empty() && (0.0..=4.0).contains(&width), "{c}");
            assert_ne!(self::strokes(c), self::strokes('\u{1}'), "{c} has no glyph");
            for p in strokes.iter().flatten() {
                assert!((0.0..=4.5).contains(&p[0]) && (-2.0..=6.5).contains(&p[1]), "{c} {p:?}");
            }
        }
    }
}
