use super::{Inertia, Vec3};
use nalgebra::Matrix3;

/// Axes in another order, some of them against their direction: what exchanging and mirroring the
/// coordinates of a box does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// Which axis each new one is.
    pub from: [usize; 3],
    /// Whether it runs the other way.
    pub flipped: [bool; 3],
    /// Lower plus upper bound of the box along each old axis, about whose middle it is mirrored.
    pub sum: Vec3,
}

impl Default for Axes {
    fn default() -> Self {
        Axes { from: [0, 1, 2], flipped: [false; 3], sum: Vec3::zeros() }
    }
}

impl Axes {
    /// Whether nothing changes.
    pub fn are_kept(&self) -> bool {
        self.from == [0, 1, 2] && self.flipped == [false; 3]
    }

    /// Whether left and right are exchanged.
    pub fn mirror(&self) -> bool {
        let [a, b, c] = self.from;
        let odd = (a > b) ^ (b > c) ^ (a > c);
        odd ^ self.flipped[0] ^ self.flipped[1] ^ self.flipped[2]
    }

    /// A point with the new axes.
    pub fn point(&self, p: &Vec3) -> Vec3 {
        Vec3::from_fn(|a, _| {
            let i = self.from[a];
            if self.flipped[a] { self.sum[i] - p[i] } else { p[i] }
        })
    }

    /// The same point with the old axes.
    pub fn point_back(&self, p: &Vec3) -> Vec3 {
        let mut out = Vec3::zeros();
        for a in 0..3 {
            let i = self.from[a];
            out[i] = if self.flipped[a] { self.sum[i] - p[a] } else { p[a] };
        }
        out
    }

    /// A direction with the new axes.
    pub fn direction(&self, v: &Vec3) -> Vec3 {
        Vec3::from_fn(|a, _| if self.flipped[a] { -v[self.from[a]] } else { v[self.from[a]] })
    }

    /// The same direction with the old axes.
    pub fn direction_back(&self, v: &Vec3) -> Vec3 {
        let mut out = Vec3::zeros();
        for a in 0..3 {
            out[self.from[a]] = if self.flipped[a] { -v[a] } else { v[a] };
        }
        out
    }

    /// An inertia with the new axes.
    pub fn inertia(&self, of: &Inertia) -> Inertia {
        let turn = self.matrix();
        Inertia::from_matrix(&(turn * of.matrix() * turn.transpose()))
    }

    /// The same inertia with the old axes.
    pub fn inertia_back(&self, of: &Inertia) -> Inertia {
        let turn = self.matrix();
        Inertia::from_matrix(&(turn.transpose() * of.matrix() * turn))
    }

    fn matrix(&self) -> Matrix3<f64> {
        let mut turn = Matrix3::zeros();
        for a in 0..3 {
            turn[(a, self.from[a])] = if self.flipped[a] { -1.0 } else { 1.0 };
        }
        turn
    }

    /// The numbers of three axes in the new order.
    pub fn ordered<T: Copy>(&self, of: [T; 3]) -> [T; 3] {
        self.from.map(|i| of[i])
    }

    /// Where cell `at` (new axes) of a box of cells stands: `dims` are those along the old axes.
    pub fn cell_back(&self, at: [usize; 3], dims: [usize; 3]) -> [usize; 3] {
        let mut out = [0; 3];
        for (a, new) in at.into_iter().enumerate() {
            let i = self.from[a];
            out[i] = if self.flipped[a] { dims[i] - 1 - new } else { new };
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All 48.
    fn all() -> Vec<Axes> {
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let mut out = Vec::new();
        for from in orders {
            for bits in 0..8 {
                let flipped = [0, 1, 2].map(|a| bits >> a & 1 == 1);
                out.push(Axes { from, flipped, sum: Vec3::new(1.0, 0.75, 0.5) });
            }
        }
        out
    }

    #[test]
    fn there_and_back_is_where_it_was() {
        let p = Vec3::new(0.25, 0.125, 0.375);
        let inertia = Inertia { xx: 3.0, yy: 4.0, zz: 5.0, xy: 0.5, xz: -0.25, yz: 0.75 };
        for axes in all() {
            assert_eq!(axes.point_back(&axes.point(&p)), p);
            assert_eq!(axes.direction_back(&axes.direction(&p)), p);
            assert_eq!(axes.inertia_back(&axes.inertia(&inertia)), inertia);
            let turned = axes.inertia(&inertia);
            let (v, w) = (axes.direction(&p), inertia.matrix() * p);
            assert_eq!(turned.matrix() * v, axes.direction(&w));
        }
    }

    #[test]
    fn volumes_have_the_sign_of_what_is_mirrored() {
        let corners = [Vec3::x(), Vec3::y(), Vec3::z()];
        let mut mirrored = 0;
        for axes in all() {
            let [x, y, z] = corners.map(|v| axes.direction(&v));
            assert_eq!(x.cross(&y).dot(&z), if axes.mirror() { -1.0 } else { 1.0 });
            mirrored += u32::from(axes.mirror());
        }
        assert_eq!(mirrored, 24);
    }

    #[test]
    fn cells_go_where_their_centres_go() {
        let dims = [4, 3, 2];
        for axes in all() {
            let new = axes.ordered(dims);
            for k in 0..new[2] {
                for j in 0..new[1] {
                    for i in 0..new[0] {
                        let old = axes.cell_back([i, j, k], dims);
                        let centre =
                            |c: [usize; 3]| Vec3::from_fn(|a, _| 0.25 * (c[a] as f64 + 0.5));
                        assert_eq!(axes.point_back(&centre([i, j, k])), centre(old));
                    }
                }
            }
        }
    }
}
