use super::*;
use proptest::prelude::*;

/// Boxes of a block that is cut twice, and the block.
fn parts(at: Vec3) -> (Vec<Moments>, Moments) {
    let of = |lo: Vec3, hi: Vec3| {
        let e = hi - lo;
        let volume = e.product();
        let s = e.component_mul(&e) * (volume / 12.0);
        Moments {
            volume,
            centroid: (lo + hi) * 0.5 + at,
            inertia: Inertia::from_second_moments([s.x, s.y, s.z, 0.0, 0.0, 0.0]),
            relative_error: 0.0,
        }
    };
    let (a, b, c) = (Vec3::new(0.3, 1.0, 0.7), Vec3::new(2.0, 0.6, 0.7), Vec3::new(2.0, 1.0, 0.7));
    let parts = vec![
        of(Vec3::zeros(), a),
        of(Vec3::new(0.3, 0.0, 0.0), b),
        of(Vec3::new(0.3, 0.6, 0.0), c),
    ];
    (parts, of(Vec3::zeros(), c))
}

fn held(whole: &Moments, density: f64, scale: f64, v: [f64; 10]) -> Held {
    let mass = density * whole.volume * scale.powi(3);
    let factor = density * scale.powi(5);
    Held {
        mass,
        center: whole.centroid,
        inertia: Inertia::from_matrix(&(whole.inertia.matrix() * factor)),
        scale,
        position: Vec3::new(v[0], v[1], v[2]),
        rotation: [v[3], v[4], v[5], 0.3],
        velocity: Vec3::new(v[6], v[7], v[8]),
        angular_velocity: Vec3::new(v[9], v[0] - v[6], v[4] * v[8]),
    }
}

/// Mass, momentum, angular momentum about the parent's centre, and kinetic energy, as a solver
/// adds them up.
fn totals(pieces: &[Moving], about: &Vec3) -> (f64, Vec3, Vec3, f64) {
    let (mut m, mut p, mut l, mut e) = (0.0, Vec3::zeros(), Vec3::zeros(), 0.0);
    for x in pieces {
        let [w, i, j, k] = x.rotation;
        let q = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        let body = q.inverse() * x.angular_velocity;
        let spin = body.component_mul(&Vec3::from(x.principal.moments));
        m += x.mass;
        p += x.velocity * x.mass;
        l += (x.position - about).cross(&x.velocity) * x.mass + q * spin;
        e += 0.5 * (x.mass * x.velocity.norm_squared() + body.dot(&spin));
    }
    (m, p, l, e)
}

fn parent(h: &Held) -> (Vec3, f64) {
    let [w, i, j, k] = h.rotation;
    let q = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
    let body = q.inverse() * h.angular_velocity;
    let spin = h.inertia.matrix() * body;
    (q * spin, 0.5 * (h.mass * h.velocity.norm_squared() + body.dot(&spin)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn nothing_is_lost(
        v in prop::array::uniform10(-2.0f64..2.0),
        size in -9i32..7,
        far in 0.0f64..1e3,
        off in 0.5f64..2.0,
    ) {
        let (parts, whole) = parts(Vec3::new(far, -far, 0.5 * far));
        let mut h = held(&whole, 2500.0, 10f64.powi(size), v);
        h.position *= h.scale;
        // A solver that holds another inertia, and another centre.
        let others = [1.0, off];
        for other in others {
            h.inertia.yy *= other;
            h.inertia.xy += (other - 1.0) * 0.1 * h.inertia.xx;
            h.center.x += 0.01 * (other - 1.0);
            let over = h.hand_over(&parts, 0.0).unwrap();
            let (m, p, l, e) = totals(&over.pieces, &h.position);
            let (spin, energy) = parent(&h);
            prop_assert!((m / h.mass - 1.0).abs() <= 1e-15);
            let fast = h.velocity.norm() + h.angular_velocity.norm() * h.scale;
            prop_assert!((p - h.velocity * h.mass).norm() <= 1e-12 * h.mass * fast);
            prop_assert!((l - spin).norm() <= 1e-12 * (spin.norm() + h.mass * h.scale * fast));
            prop_assert!((e - energy - over.energy).abs() <= 1e-12 * energy.max(e));
            if other == 1.0 {
                prop_assert!(over.energy.abs() <= 1e-12 * energy && over.inertia < 1e-12);
            }
            // The centre of all pieces is the parent's.
            let at: Vec3 = over.pieces.iter().map(|x| (x.position - h.position) * x.mass).sum();
            prop_assert!(at.norm() <= 1e-12 * h.mass * h.scale);
            let at: Vec3 = over.pieces.iter().map(|x| (x.center - h.center) * x.mass).sum();
            prop_assert!(at.norm() <= 1e-12 * h.mass * (1.0 + far));
        }
    }
}

#[test]
fn pieces_of_a_body_with_the_solid_s_inertia_move_as_its_points_did() {
    let (parts, whole) = parts(Vec3::zeros());
    let mut h = held(&whole, 1.0, 1.0, [0.0; 10]);
    h.rotation = [1.0, 0.0, 0.0, 0.0];
    h.position = Vec3::new(5.0, 6.0, 7.0);
    h.velocity = Vec3::new(1.0, 2.0, 3.0);
    h.angular_velocity = Vec3::new(0.0, 0.0, 10.0);
    let over = h.hand_over(&parts, 0.0).unwrap();
    let first = &over.pieces[0];
    // 0.85 before the centre along x, in the middle along y.
    assert!((first.position - Vec3::new(4.15, 6.0, 7.0)).norm() < 1e-14);
    assert!((first.velocity - Vec3::new(1.0, 2.0 - 8.5, 3.0)).norm() < 1e-13);
    assert!((first.angular_velocity - h.angular_velocity).norm() < 1e-14);
    assert!(over.shift.norm() < 1e-15 && over.energy.abs() < 1e-12);
}

#[test]
fn a_resting_body_rests_on_whatever_its_inertia_is() {
    let (parts, whole) = parts(Vec3::zeros());
    let mut h = held(&whole, 1.0, 1.0, [0.0; 10]);
    h.inertia = Inertia::default();
    let over = h.hand_over(&parts, 0.0).unwrap();
    assert!(over.pieces.iter().all(|p| p.velocity.norm() + p.angular_velocity.norm() == 0.0));
    h.angular_velocity = Vec3::x();
    // It has no angular momentum at all.
    let over = h.hand_over(&parts, 0.0).unwrap();
    assert!(over.pieces.iter().all(|p| p.angular_velocity.norm() == 0.0) && over.energy == 0.0);
}

#[test]
fn what_is_wrong_is_named() {
    let (parts, whole) = parts(Vec3::zeros());
    let good = held(&whole, 1.0, 1.0, [0.0; 10]);
    let says = |h: Held, parts: &[Moments], words: &str| {
        let e = h.hand_over(parts, 0.0).unwrap_err().to_string();
        assert!(e.contains(words), "{e}");
    };
    says(Held { mass: -1.0, ..good }, &parts, "mass is -1");
    says(Held { scale: 0.0, ..good }, &parts, "scale is 0");
    says(Held { rotation: [0.0; 4], ..good }, &parts, "rotation is 0");
    says(Held { velocity: Vec3::new(0.0, f64::NAN, 0.0), ..good }, &parts, "NaN");
    says(good, &[], "no piece");
    let mut bad = parts;
    bad[1].volume = 0.0;
    says(good, &bad, "piece 1");
    bad[1].volume = f64::NAN;
    says(good, &bad, "piece 1");
}
