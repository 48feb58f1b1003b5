//! Frames for ParaView: a point for each sphere.

use crate::dem::engine::Engine;
use crate::export::vtp_points;
use crate::math::Sphere;

/// The spheres of all bodies in space as a VTP file, with the radius, the label of the body, and the velocity.
pub(super) fn frame(engine: &Engine) -> String {
    let s = engine.state();
    let (mut spheres, mut labels, mut velocities) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..s.len() {
        let r = s.orientation[i].matrix();
        let w = s.angular_velocity(i);
        for sphere in s.template_of(i).spheres() {
            let arm = r * sphere.center;
            spheres.push(Sphere::new(s.position[i] + arm, sphere.radius));
            labels.push(s.label[i]);
            velocities.push(s.velocity[i] + w.cross(&arm));
        }
    }
    vtp_points(&spheres, &labels, &velocities)
}
