use super::{Inertia, Vec3};
use nalgebra::Matrix3;

/// Moments closer than this, relative to the greatest, count as equal: the axes
/// between them are then chosen, not computed.
const EQUAL: f64 = 1e-10;
/// Numbers of unit size below this count as zero, and as equal, where a sign is chosen.
const ZERO: f64 = 1e-14;
/// How much more of itself the rounding of coordinates may be in the moments: they are of the
/// second degree, over twice the radius.
const FELT: f64 = 8.0;

/// Principal moments and axes of an inertia tensor.
///
/// The rule is deterministic. Moments ascend. An axis of its own has its
/// largest component positive (of equal ones the first). Two equal moments: the
/// first of their axes is the input x axis projected into their plane, or y
/// when x lies within 30° of the third axis. Three equal moments: the input
/// axes. The last axis to be found is the cross product of the other two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalFrame {
    /// Principal moments, ascending.
    pub moments: [f64; 3],
    /// Columns are the body axes in the input frame; right-handed.
    pub axes: Matrix3<f64>,
    /// The same rotation, body to input, as `w, x, y, z` with w ≥ 0; when w is 0, the first
    /// component that is not 0 is positive.
    pub quaternion: [f64; 4],
}

impl PrincipalFrame {
    /// The principal frame of `inertia`, which is exact up to rounding.
    pub fn of(inertia: &Inertia) -> Self {
        PrincipalFrame::of_rounded(inertia, 0.0)
    }

    /// The same for a body whose coordinates are rounded by `noise` of its size (see
    /// [`super::UnitFrame::noise`]): moments that differ by no more than such rounding explains
    /// count as equal, and so do components of their axes.
    pub fn of_rounded(inertia: &Inertia, noise: f64) -> Self {
        let greatest = inertia.to_array().iter().fold(0.0f64, |m, v| m.max(v.abs()));
        if !(greatest.is_finite() && greatest > 0.0) {
            return PrincipalFrame::with_axes([0.0; 3], Matrix3::identity(), ZERO);
        }
        // Divided by a power of two: no bit changes, nothing under- or overflows.
        let unit = power_of_two(greatest);
        let (values, vectors) = jacobi(inertia.matrix() / unit);
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        let m = order.map(|i| values[i]);
        let noise = (FELT * noise).min(1.0);
        let near = |a: f64, b: f64| b - a <= EQUAL.max(noise) * m[2].abs();
        // How far noise may turn an axis: its share of the gap to the next moment.
        let gap = |i: usize| {
            let below = if i > 0 { m[i] - m[i - 1] } else { f64::MAX };
            let above = if i < 2 { m[i + 1] - m[i] } else { f64::MAX };
            below.min(above)
        };
        let turned = |i: usize| {
            let share = noise * m[2].abs();
            ZERO.max(if share < gap(i) {
                (share / gap(i)).min(0.1)
            } else {
                0.1 * f64::from(noise > 0.0)
            })
        };
        let axis = |i: usize| signed(vectors.column(order[i]).into_owned(), turned(i));
        let zero = match (near(m[0], m[1]), near(m[1], m[2])) {
            (true, true) => ZERO,
            (true, false) => turned(2),
            (false, true) => turned(0),
            (false, false) => turned(1),
        };
        let axes = match (near(m[0], m[1]), near(m[1], m[2])) {
            (true, true) => Matrix3::identity(),
            (true, false) => {
                let alone = axis(2);
                let first = beside(&alone);
                Matrix3::from_columns(&[first, alone.cross(&first), alone])
            }
            (false, true) => {
                let alone = axis(0);
                let first = beside(&alone);
                Matrix3::from_columns(&[alone, first, alone.cross(&first)])
            }
            (false, false) => {
                let (a, b) = (axis(0), axis(1));
                Matrix3::from_columns(&[a, b, a.cross(&b)])
            }
        };
        PrincipalFrame::with_axes(m.map(|v| v * unit), axes, zero)
    }

    fn with_axes(moments: [f64; 3], axes: Matrix3<f64>, zero: f64) -> Self {
        PrincipalFrame { moments, axes, quaternion: quaternion(&axes, zero) }
    }
}

/// The greatest power of two that is not above `v`, which is finite and positive.
fn power_of_two(v: f64) -> f64 {
    if v.is_normal() { f64::from_bits(v.to_bits() & 0x7ff0_0000_0000_0000) } else { 1.0 }
}

/// The axis with its largest component positive; what differs by `zero` is as large.
fn signed(v: Vec3, zero: f64) -> Vec3 {
    let v = v / v.norm();
    let mut largest = 0;
    for i in 1..3 {
        if v[i].abs() > v[largest].abs() + zero {
            largest = i;
        }
    }
    if v[largest] < 0.0 { -v } else { v }
}

/// The input axis x, or y where x is within 30° of `alone`, projected into the plane across it.
fn beside(alone: &Vec3) -> Vec3 {
    let from = if alone.x * alone.x <= 0.75 { Vec3::x() } else { Vec3::y() };
    let p = from - alone * alone.dot(&from);
    p / p.norm()
}

/// Eigenvalues and eigenvectors by cyclic Jacobi rotations: exact on a diagonal
/// matrix, and orthogonal to rounding.
fn jacobi(mut a: Matrix3<f64>) -> ([f64; 3], Matrix3<f64>) {
    let mut v = Matrix3::identity();
    for _ in 0..32 {
        let off = a[(0, 1)].abs() + a[(0, 2)].abs() + a[(1, 2)].abs();
        if off <= f64::MIN_POSITIVE {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let apq: f64 = a[(p, q)];
            let gap = a[(q, q)] - a[(p, p)];
            // Too small to change either diagonal entry: done with.
            if apq.abs() <= 1e-18 * (a[(p, p)].abs() + a[(q, q)].abs()) {
                a[(p, q)] = 0.0;
                a[(q, p)] = 0.0;
                continue;
            }
            let (x, y) = (gap.abs(), 2.0 * apq.abs());
            let t = y / (x + (x * x + y * y).sqrt());
            let t = if (gap < 0.0) != (apq < 0.0) { -t } else { t };
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            let mut g = Matrix3::identity();
            g[(p, p)] = c;
            g[(q, q)] = c;
            g[(p, q)] = s;
            g[(q, p)] = -s;
            a = g.transpose() * a * g;
            a[(p, q)] = 0.0;
            a[(q, p)] = 0.0;
            v *= g;
        }
    }
    ([a[(0, 0)], a[(1, 1)], a[(2, 2)]], v)
}

/// The quaternion of a rotation matrix (Shepperd 1978: from the largest component).
fn quaternion(r: &Matrix3<f64>, zero: f64) -> [f64; 4] {
    let (x, y, z) = (r[(0, 0)], r[(1, 1)], r[(2, 2)]);
    let squares = [1.0 + x + y + z, 1.0 + x - y - z, 1.0 - x + y - z, 1.0 - x - y + z];
    let mut largest = 0;
    for i in 1..4 {
        if squares[i] > squares[largest] {
            largest = i;
        }
    }
    let wx = r[(2, 1)] - r[(1, 2)];
    let wy = r[(0, 2)] - r[(2, 0)];
    let wz = r[(1, 0)] - r[(0, 1)];
    let xy = r[(0, 1)] + r[(1, 0)];
    let xz = r[(0, 2)] + r[(2, 0)];
    let yz = r[(1, 2)] + r[(2, 1)];
    let s = squares[largest];
    let mut q = match largest {
        0 => [s, wx, wy, wz],
        1 => [wx, s, xy, xz],
        2 => [wy, xy, s, yz],
        _ => [wz, xz, yz, s],
    };
    let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    q = q.map(|c| c / norm);
    if q[0].abs() <= zero {
        q[0] = 0.0;
    }
    // −0 is turned with the rest, so that equal rotations give equal bytes.
    let first = q.iter().find(|c| c.abs() > zero);
    let sign = if first.is_some_and(|c| *c < 0.0) { -1.0 } else { 1.0 };
    q.map(|c| c * sign + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn diagonal(m: [f64; 3]) -> Matrix3<f64> {
        Matrix3::from_diagonal(&m.into())
    }

    fn rotation(a: f64, b: f64, c: f64) -> Matrix3<f64> {
        nalgebra::Rotation3::from_euler_angles(a, b, c).into_inner()
    }

    fn check(tensor: &Matrix3<f64>, tolerance: f64) -> PrincipalFrame {
        let f = PrincipalFrame::of(&Inertia::from_matrix(tensor));
        let back = f.axes * diagonal(f.moments) * f.axes.transpose();
        let size = tensor.abs().max();
        assert!((back - tensor).abs().max() <= tolerance * size, "{back} {tensor}");
        assert!((f.axes.determinant() - 1.0).abs() < 1e-14);
        assert!((f.axes.transpose() * f.axes - Matrix3::identity()).abs().max() < 1e-14);
        assert!(f.moments[0] <= f.moments[1] && f.moments[1] <= f.moments[2]);
        let [w, x, y, z] = f.quaternion;
        let q = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(w, x, y, z));
        assert!((q.to_rotation_matrix().into_inner() - f.axes).abs().max() < 1e-13);
        assert!(w >= 0.0);
        f
    }

    #[test]
    fn equal_moments_give_the_input_axes() {
        for m in [[1.0; 3], [0.4, 0.4 + 1e-13, 0.4]] {
            let f = check(&diagonal(m), 1e-12);
            assert_eq!(f.axes, Matrix3::identity());
            assert_eq!(f.quaternion, [1.0, 0.0, 0.0, 0.0]);
        }
        let turned = rotation(0.3, 0.5, 0.7);
        let f = check(&(turned * diagonal([2.0; 3]) * turned.transpose()), 1e-12);
        assert_eq!(f.axes, Matrix3::identity());
    }

    #[test]
    fn a_spheroid_gives_its_axis_whatever_the_noise() {
        for (moments, slot) in [([1.0, 3.0, 3.0], 0), ([1.0, 1.0, 3.0], 2)] {
            for axis in 0..3 {
                let mut about = [moments[1]; 3];
                about[axis] = if slot == 0 { moments[0] } else { moments[2] };
                let clean = check(&diagonal(about), 1e-12);
                assert_eq!(clean.axes[(axis, slot)], 1.0);
                // Rounding noise must not turn the free axes.
                for seed in 0..20 {
                    let e = |k: f64| 1e-15 * (k * 12.9898 + f64::from(seed)).sin();
                    let noise =
                        Matrix3::new(e(1.), e(2.), e(3.), e(2.), e(4.), e(5.), e(3.), e(5.), e(6.));
                    let noisy = check(&(diagonal(about) + noise), 1e-12);
                    assert!((noisy.axes - clean.axes).abs().max() < 1e-13);
                }
            }
        }
        let r = rotation(0.2, -0.4, 1.1);
        let f = check(&(r * diagonal([1.0, 3.0, 3.0]) * r.transpose()), 1e-12);
        assert!((f.axes.column(0).dot(&r.column(0)).abs() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn rounded_coordinates_do_not_turn_the_free_axes() {
        let noise = 1e-8;
        for moments in [[1.0, 3.0, 3.0], [1.0, 1.0, 3.0], [2.0, 2.0, 2.0]] {
            let clean = PrincipalFrame::of(&Inertia::from_matrix(&diagonal(moments)));
            for seed in 0..20 {
                let e = |k: f64| noise * (k * 12.9898 + f64::from(seed)).sin();
                let noisy = diagonal(moments)
                    + Matrix3::new(e(1.), e(2.), e(3.), e(2.), e(4.), e(5.), e(3.), e(5.), e(6.));
                let f = PrincipalFrame::of_rounded(&Inertia::from_matrix(&noisy), noise);
                assert!((f.axes - clean.axes).abs().max() < 1e-6, "{moments:?} {}", f.axes);
                for (q, c) in f.quaternion.iter().zip(clean.quaternion) {
                    assert!((q - c).abs() < 1e-6, "{moments:?} {:?}", f.quaternion);
                }
            }
        }
        // An axis with two components of one size has one sign.
        let r = rotation(0.0, 0.0, -std::f64::consts::FRAC_PI_4);
        for seed in 0..20 {
            let e = |k: f64| noise * (k * 12.9898 + f64::from(seed)).sin();
            let noisy = r * diagonal([1.0, 2.0, 3.0]) * r.transpose()
                + Matrix3::new(e(1.), e(2.), e(3.), e(2.), e(4.), e(5.), e(3.), e(5.), e(6.));
            let f = PrincipalFrame::of_rounded(&Inertia::from_matrix(&noisy), noise);
            assert!(f.axes[(0, 0)] > 0.5 && f.axes[(1, 0)] < -0.5, "{}", f.axes);
        }
    }

    #[test]
    fn half_turns_have_one_quaternion() {
        // Columns (x, −y, −z), (−x, −y, z) …: w = 0.
        let f = check(&diagonal([3.0, 2.0, 1.0]), 1e-15);
        assert_eq!(f.axes, Matrix3::new(0., 0., -1., 0., 1., 0., 1., 0., 0.));
        let q = quaternion(&Matrix3::new(-1., 0., 0., 0., -1., 0., 0., 0., 1.), ZERO);
        assert_eq!(q, [0.0, 0.0, 0.0, 1.0]);
        let q = quaternion(&Matrix3::new(-1., 0., 0., 0., 0., -1., 0., -1., 0.), ZERO);
        assert_eq!(q[0], 0.0);
        assert!(q[1] == 0.0 && q[2] > 0.0 && q[3] < 0.0);
    }

    #[test]
    fn sizes_far_from_one() {
        let r = rotation(0.2, -0.4, 1.1);
        let unit = r * diagonal([1.0, 2.0, 2.5]) * r.transpose();
        let f = check(&unit, 1e-14);
        for k in [-200, -40, 40, 200] {
            let g = check(&(unit * 2f64.powi(k)), 1e-14);
            assert_eq!(f.axes, g.axes);
            assert_eq!(f.moments.map(|m| m * 2f64.powi(k)), g.moments);
        }
        for size in [1e-60, 1e60] {
            check(&(unit * size), 1e-14);
        }
        let none = PrincipalFrame::of(&Inertia::default());
        assert_eq!(none.axes, Matrix3::identity());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn a_turned_body_gives_back_the_rotation(
            a in -3.0..3.0f64, b in -1.5..1.5f64, c in -3.0..3.0f64,
            low in 0.1..1.0f64, gap in 0.05..1.0f64, more in 0.05..1.0f64,
        ) {
            let r = rotation(a, b, c);
            let m = [low, low + gap, low + gap + more];
            let f = check(&(r * diagonal(m) * r.transpose()), 1e-13);
            for i in 0..3 {
                prop_assert!((f.moments[i] - m[i]).abs() < 1e-13 * m[2]);
                let along = f.axes.column(i).dot(&r.column(i));
                prop_assert!((along.abs() - 1.0).abs() < 1e-12);
            }
        }

        #[test]
        fn nearly_equal_moments_still_reproduce_the_tensor(
            a in -3.0..3.0f64, b in -1.5..1.5f64, c in -3.0..3.0f64, exponent in -16.0..-2.0f64,
        ) {
            let r = rotation(a, b, c);
            let e = 10f64.powf(exponent);
            for m in [[1.0, 1.0 + e, 2.0], [1.0, 2.0, 2.0 + e], [1.0, 1.0 + e, 1.0 + 2.0 * e]] {
                check(&(r * diagonal(m) * r.transpose()), 5e-10);
            }
        }
    }
}
