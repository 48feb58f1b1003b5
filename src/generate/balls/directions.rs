//! Directions over the sphere: Fibonacci's lattice, in groups of eight that lie close together,
//! so that a neighbour mostly hides all of a group or none.

use wide::f32x8;

/// Directions, eight to a group.
#[derive(Debug, Clone)]
pub(crate) struct Directions {
    groups: Vec<[f32x8; 3]>,
}

impl Directions {
    /// About `m` directions: the next multiple of eight.
    pub(crate) fn new(m: usize) -> Directions {
        let n = m.div_ceil(8).max(1) * 8;
        let turn = std::f64::consts::PI * (1.0 + 5f64.sqrt());
        let mut all: Vec<[f32; 3]> = (0..n)
            .map(|i| {
                let i = i as f64 + 0.5;
                let z = 1.0 - 2.0 * i / n as f64;
                let r = (1.0 - z * z).max(0.0).sqrt();
                [(r * (turn * i).cos()) as f32, (r * (turn * i).sin()) as f32, z as f32]
            })
            .collect();
        gather(&mut all);
        let groups = all.chunks_exact(8).map(|g| {
            [0, 1, 2].map(|a| f32x8::new(std::array::from_fn(|l| g.get(l).map_or(0.0, |d| d[a]))))
        });
        Directions { groups: groups.collect() }
    }

    /// Number of directions.
    pub(crate) fn len(&self) -> usize {
        8 * self.groups.len()
    }

    /// The directions turned, into `out`.
    pub(crate) fn turned(&self, rows: &[[f32; 3]; 3], out: &mut Vec<[f32x8; 3]>) {
        out.clear();
        let [a, b, c] = rows;
        let dot = |r: &[f32; 3], [x, y, z]: &[f32x8; 3]| *x * r[0] + *y * r[1] + *z * r[2];
        out.extend(self.groups.iter().map(|d| [dot(a, d), dot(b, d), dot(c, d)]));
    }
}

/// Sorts so that each run of eight lies close together: halves across the longest extent.
fn gather(all: &mut [[f32; 3]]) {
    if all.len() <= 8 {
        return;
    }
    let extent = |a: usize| {
        let ends = all.iter().fold((2.0f32, -2.0f32), |(lo, hi), d| (lo.min(d[a]), hi.max(d[a])));
        ends.1 - ends.0
    };
    let longest = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    all.sort_by(|d, e| d[longest].total_cmp(&e[longest]));
    let (low, high) = all.split_at_mut(all.len() / 16 * 8);
    gather(low);
    gather(high);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_directions_are_there_and_groups_are_close() {
        for m in [8, 50, 96, 256] {
            let d = Directions::new(m);
            assert_eq!(d.len(), m.div_ceil(8) * 8);
            let mut sum = [0.0f32; 3];
            let mut spread: f32 = 0.0;
            for g in &d.groups {
                let [x, y, z] = g.map(|v| v.to_array());
                for l in 0..8 {
                    let d = [x[l], y[l], z[l]];
                    assert!((d.iter().map(|v| v * v).sum::<f32>() - 1.0).abs() < 1e-5);
                    let dot = x[0] * x[l] + y[0] * y[l] + z[0] * z[l];
                    spread += (1.0 - dot) / d.len() as f32;
                    (0..3).for_each(|a| sum[a] += d[a]);
                }
            }
            assert!(sum.iter().all(|s| s.abs() < 0.02 * m as f32), "{sum:?}");
            // Eight of m directions in a cap of 8/m of the sphere: 1 − cos is at most 4 · 8 / m.
            assert!(m < 48 || spread / (d.len() as f32 / 3.0) < 32.0 / m as f32, "{m} {spread}");
        }
    }
}
