use super::Vec3;

/// Signed solid angle of a triangle from `p`, positive when `p` is behind it
/// (van Oosterom and Strackee 1983).
pub fn solid_angle(t: &[Vec3; 3], p: &Vec3) -> f64 {
    let [a, b, c] = t.map(|v| v - p);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let numerator = a.dot(&b.cross(&c));
    let denominator = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * numerator.atan2(denominator)
}
