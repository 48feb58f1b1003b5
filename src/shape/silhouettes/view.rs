//! One silhouette, checked, with the sums that tell at once whether a rectangle of pixels is empty.

use super::Silhouette;
use crate::error::{Error, Result, figure, filled};

/// Greatest entry of a camera matrix: products stay numbers.
const MOST: f64 = 1e100;

/// A silhouette and its camera.
pub(super) struct View {
    pub camera: [f64; 12],
    /// First column and row with a pixel of the particle, and one past the last.
    pub from: [usize; 2],
    pub to: [usize; 2],
    pub touches_border: bool,
    width: usize,
    height: usize,
    /// Pixels of the particle above and to the left of each corner of a pixel.
    sums: Vec<u32>,
}

impl View {
    /// Checks the size of silhouette `i`; the bytes that it will take.
    pub fn bytes(i: usize, s: &Silhouette) -> Result<u64> {
        let (w, h) = (s.width, s.height);
        let pixels = w.checked_mul(h).filter(|n| u32::try_from(*n).is_ok());
        let pixels = pixels.ok_or_else(|| {
            Error::TooLarge(format!("silhouette {i} has {w} x {h} pixels, more than 2^32 - 1"))
        })?;
        if pixels == 0 {
            return Err(Error::InvalidArgument(format!("silhouette {i} has {w} x {h} pixels")));
        }
        if pixels != s.mask.len() {
            return Err(Error::InvalidArgument(format!(
                "silhouette {i} has {} values, but {w} x {h} pixels are {pixels}",
                s.mask.len()
            )));
        }
        Ok(4 * (w as u64 + 1) * (h as u64 + 1))
    }

    /// Checks silhouette `i`, whose size is right.
    pub fn new(i: usize, s: &Silhouette) -> Result<View> {
        for (k, x) in s.camera.iter().enumerate() {
            let (row, column) = (k / 4, k % 4);
            if !x.is_finite() {
                return Err(Error::NotFinite(format!(
                    "camera {i} has {x} in row {row}, column {column}"
                )));
            }
            if x.abs() > MOST {
                return Err(Error::InvalidArgument(format!(
                    "camera {i} has {} in row {row}, column {column}: out of proportion",
                    figure(*x)
                )));
            }
        }
        let (w, h) = (s.width, s.height);
        let mut sums = filled("the sums of a silhouette", (w + 1) * (h + 1), 0u32)?;
        let (mut from, mut to) = ([w, h], [0, 0]);
        for (j, row) in s.mask.chunks(w).enumerate() {
            let mut sum = 0;
            for (i, pixel) in row.iter().enumerate() {
                if *pixel != 0 {
                    sum += 1;
                    from = [from[0].min(i), from[1].min(j)];
                    to = [to[0].max(i + 1), to[1].max(j + 1)];
                }
                sums[i + 1 + (w + 1) * (j + 1)] = sums[i + 1 + (w + 1) * j] + sum;
            }
        }
        if to[0] == 0 {
            return Err(Error::Empty(format!(
                "silhouette {i} shows no particle: all of its {w} x {h} pixels are 0"
            )));
        }
        let touches_border = from.contains(&0) || to[0] == w || to[1] == h;
        let camera = s.camera;
        Ok(View { camera, from, to, touches_border, width: w, height: h, sums })
    }

    /// (u, v, w) of a point.
    fn project(&self, p: [f64; 3]) -> [f64; 3] {
        let [a, b, c, d, e, f, g, h, i, j, k, l] = self.camera;
        let [x, y, z] = p;
        [a * x + b * y + c * z + d, e * x + f * y + g * z + h, i * x + j * y + k * z + l]
    }

    /// Whether a point is seen on the particle.
    pub fn sees(&self, p: [f64; 3]) -> bool {
        let [u, v, w] = self.project(p);
        if w <= 0.0 {
            return false;
        }
        let inside =
            u >= 0.0 && v >= 0.0 && u < self.width as f64 * w && v < self.height as f64 * w;
        inside && {
            let (i, j) = ((u / w) as usize, (v / w) as usize);
            self.any([i, j], [i + 1, j + 1])
        }
    }

    /// Whether some part of the cube of lower corner `lo` may be seen on the particle: a pixel of
    /// the rectangle about its corners is.
    pub fn touches(&self, lo: [f64; 3], edge: f64) -> bool {
        let (mut least, mut most) = ([f64::MAX; 2], [-f64::MAX; 2]);
        let mut behind = 0;
        for c in 0..8 {
            let corner = [0, 1, 2].map(|a| lo[a] + if c >> a & 1 == 1 { edge } else { 0.0 });
            let [u, v, w] = self.project(corner);
            // So near the camera's plane that the quotient is no number to go by.
            if w <= 1e-12 * (u.abs() + v.abs()) || w <= 0.0 {
                behind += 1;
                continue;
            }
            let at = [u / w, v / w];
            for k in 0..2 {
                least[k] = least[k].min(at[k]);
                most[k] = most[k].max(at[k]);
            }
        }
        if behind > 0 {
            // In part behind the camera: what is in front may be seen anywhere.
            return behind < 8;
        }
        let size = [self.width as f64, self.height as f64];
        if (0..2).any(|k| most[k] < 0.0 || least[k] > size[k]) {
            return false;
        }
        // Rounding must not lose a pixel.
        let slack = 1e-9;
        let first = [0, 1].map(|k| ((least[k] - slack).max(0.0)) as usize);
        let last =
            [0, 1].map(|k| ((most[k] + slack).min(size[k]) as usize + 1).min(size[k] as usize));
        self.any(first, last)
    }

    /// Whether a pixel of the particle is in the columns and rows from `first` to before `last`.
    fn any(&self, first: [usize; 2], last: [usize; 2]) -> bool {
        let at = |i: usize, j: usize| {
            let place = i.min(self.width) + (self.width + 1) * j.min(self.height);
            u64::from(self.sums.get(place).copied().unwrap_or(0))
        };
        at(last[0], last[1]) + at(first[0], first[1])
            > at(first[0], last[1]) + at(last[0], first[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks along −z: x is the column, y the row.
    const FLAT: [f64; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

    #[test]
    fn rectangles_of_pixels_are_told_as_by_looking_at_each() {
        let (w, h) = (13, 9);
        let mask: Vec<u8> = (0..w * h).map(|i| u8::from(i * 7919 % 31 < 3)).collect();
        let s = Silhouette { mask: &mask, width: w, height: h, camera: FLAT };
        let view = View::new(0, &s).unwrap();
        for first in 0..w * h {
            for last in first..w * h {
                let (a, b) = ([first % w, first / w], [last % w + 1, last / w + 1]);
                if a[0] >= b[0] {
                    continue;
                }
                let look = (a[1]..b[1]).any(|j| (a[0]..b[0]).any(|i| mask[i + w * j] != 0));
                assert_eq!(view.any(a, b), look, "{a:?} {b:?}");
            }
        }
        for (i, pixel) in mask.iter().enumerate() {
            let p = [(i % w) as f64 + 0.5, (i / w) as f64 + 0.5, 3.0];
            assert_eq!(view.sees(p), *pixel != 0);
        }
        assert!(!view.sees([-0.5, 2.0, 0.0]) && !view.sees([2.0, 9.5, 0.0]));
        assert!(!view.touches([-3.0, 0.0, 0.0], 2.0) && view.touches([-3.0, -3.0, 0.0], 30.0));
    }

    #[test]
    fn nothing_behind_the_camera_is_seen() {
        let mut camera = FLAT;
        camera[10] = 1.0;
        let s = Silhouette { mask: &[1; 4], width: 2, height: 2, camera };
        let view = View::new(0, &s).unwrap();
        assert!(view.sees([1.0, 1.0, 0.0]) && !view.sees([1.0, 1.0, -2.0]));
        assert!(!view.touches([0.0, 0.0, -5.0], 1.0));
        assert!(view.touches([50.0, 0.0, -1.5], 1.0));
    }
}
