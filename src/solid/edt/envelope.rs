//! Lower envelopes of parabolas: the transform along one line.

/// No background in reach; heights are otherwise not negative.
pub(super) const NO_HEIGHT: f64 = -1.0;

/// A parabola of the lower envelope.
#[derive(Clone, Copy, Default)]
pub(super) struct Arc {
    /// Where its source is.
    at: usize,
    /// Its height there.
    height: f64,
    /// From where on it is the lowest.
    start: f64,
}

/// `out[q] = min over s of line[s] + weight (q − s)²` wherever `line` is not 0; sources
/// without height do not count, and with none left the result has no height either.
/// If `TRACK`, `source[q]` is the s that won.
pub(super) fn envelope<const TRACK: bool>(
    line: &[f64],
    weight: f64,
    reciprocal: &[f64],
    arcs: &mut [Arc],
    out: &mut [f64],
    source: &mut [u16],
) {
    let n = line.len();
    let mut next = 0;
    while let Some(skip) = line[next..].iter().position(|&h| h != 0.0) {
        out[next..next + skip].fill(0.0);
        if TRACK {
            own_source(source, next, next + skip);
        }
        let begin = next + skip;
        let end = line[begin..].iter().position(|&h| h == 0.0).map_or(n, |d| begin + d);
        next = end;
        let (low, high) = (begin as f64, (end - 1) as f64);
        // The run with the background cells at its ends: nothing farther can win.
        let first = begin.saturating_sub(1);
        let last = (end + 1).min(n);
        let mut count = 0;
        'sources: for (at, &height) in line[..last].iter().enumerate().skip(first) {
            if height < 0.0 {
                continue;
            }
            let mut start = low;
            while count > 0 {
                let top = arcs[count - 1];
                start =
                    (height - top.height) * reciprocal[at - top.at] + 0.5 * (at + top.at) as f64;
                if start > high {
                    continue 'sources;
                }
                if start > top.start {
                    break;
                }
                start = low;
                count -= 1;
            }
            arcs[count] = Arc { at, height, start };
            count += 1;
        }
        if count == 0 {
            out[begin..end].fill(NO_HEIGHT);
            continue;
        }
        let mut k = 0;
        let mut arc = arcs[0];
        for q in begin..end {
            let here = q as f64;
            while k + 1 < count && arcs[k + 1].start < here {
                k += 1;
                arc = arcs[k];
            }
            let d = here - arc.at as f64;
            out[q] = arc.height + weight * (d * d);
            if TRACK {
                source[q] = arc.at as u16;
            }
        }
    }
    out[next..n].fill(0.0);
    if TRACK {
        own_source(source, next, n);
    }
}

/// Background cells are their own source.
pub(super) fn own_source(source: &mut [u16], from: usize, to: usize) {
    for (q, s) in source.iter_mut().enumerate().take(to).skip(from) {
        *s = q as u16;
    }
}
