//! `morula view`.

use super::*;

#[test]
fn pictures_have_their_size_and_show_something() {
    let folder = folder("pictures");
    let draw = |of: &str, to: &str, more: &[&str]| {
        let (of, to) = (folder.join(of), folder.join(to));
        succeeds(&strs(&clump(&["-o", text(&of), "-q"])));
        let view = ["view", "sample:ellipsoid", text(&of), "-o", text(&to), "--size", "600x260"];
        let from = ["--cells", "24", "--azimuth", "-30", "--elevation", "40"];
        succeeds(&[view.as_slice(), &from, more].concat());
        to
    };
    let png = draw("c.csv", "p.png", &[]);
    let (size, pixels) = pixels(&png);
    assert_eq!(size, (600, 260));
    assert_eq!(pixels.len(), 3 * 600 * 260);
    // Each third of the picture holds dark, coloured and white pixels.
    for third in 0..3 {
        let (mut white, mut other) = (0, 0);
        for (i, p) in pixels.chunks_exact(3).enumerate() {
            if i % 600 / 200 == third {
                if p == [255, 255, 255] { white += 1 } else { other += 1 }
            }
        }
        assert!(white > 2000 && other > 2000, "third {third}: {white} white, {other} other");
    }
    // JSON clumps are drawn as well, and the same.
    let again = draw("c.json", "again.png", &["--threads", "1"]);
    assert_eq!(std::fs::read(png).unwrap(), std::fs::read(again).unwrap());
}
