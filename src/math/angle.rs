use super::Vec3;

/// Signed solid angle of a triangle from `p`, positive when `p` is behind it
/// (van Oosterom and Strackee 1983).
pub fn solid_angle(t: &[Vec3; 3], p: &Vec3) -> f64 {
    let (re, im) = half_solid_angle(t, p);
    2.0 * im.atan2(re)
}

/// A complex number whose argument is half of it; 0 from a corner of the triangle.
pub(crate) fn half_solid_angle(t: &[Vec3; 3], p: &Vec3) -> (f64, f64) {
    let (a, b, c) = (t[0] - p, t[1] - p, t[2] - p);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let im = a.dot(&b.cross(&c));
    let re = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    (re, im)
}
