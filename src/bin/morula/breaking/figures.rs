//! `fragments.json`.

use super::{Args, Surfaces, name};
use crate::weighing;
use morula::fragment::{Fragment, Held, Moving, Parent, ParentMap, Shattered};
use morula::math::Vec3;
use serde_json::{Map, Value, json};

pub fn object(
    args: &Args,
    parent: &Parent,
    held: &Held,
    broken: &Shattered,
    surfaces: &Surfaces,
    [prepared, broke]: [f64; 2],
) -> Value {
    let solid = parent.solid();
    let frame = solid.frame();
    let spheres: Vec<Value> = parent
        .unit_spheres()
        .iter()
        .map(|s| frame.sphere_to_input(s))
        .map(|s| json!([s.center.x, s.center.y, s.center.z, s.radius]))
        .collect();
    let mut notes: Vec<String> = broken.notes.clone();
    for (i, surface) in surfaces.iter().enumerate() {
        if let Err(why) = surface {
            notes.push(format!("no mesh of fragment {i}: {why}"));
        }
    }
    let both = broken.fragments.iter().zip(surfaces).enumerate();
    let fragments: Vec<Value> = both
        .map(|(i, (f, surface))| fragment(i, f, surface.is_ok(), f.region.moments(frame).volume))
        .collect();
    let dust: Vec<Value> = broken
        .dust
        .iter()
        .map(|c| {
            let mut map = moving(&c.moving);
            map.insert("cell".into(), c.dust.cell.into());
            map.insert("volume".into(), c.dust.moments.volume.into());
            Value::Object(map)
        })
        .collect();
    json!({
        "input": args.input,
        "cut": args.how.name(),
        "seed": args.reading.seed.unwrap_or(0),
        "parent": {
            "n": spheres.len(),
            "spheres": spheres,
            "volume": solid.moments().volume,
            "mass": held.mass,
            "centre": held.center.as_slice(),
            "inertia": held.inertia.to_array(),
            "velocity": held.velocity.as_slice(),
            "angular_velocity": held.angular_velocity.as_slice(),
        },
        "fragments": fragments,
        "dust": dust,
        "conservation": residuals(held, broken),
        "notes": notes,
        "seconds": { "parent": prepared, "break": broke },
    })
}

fn fragment(i: usize, f: &Fragment, mesh: bool, volume: f64) -> Value {
    let c = &f.clump;
    let mut map = moving(&f.moving);
    let more = json!({
        "cell": f.region.cell(),
        "mesh": mesh.then(|| name(i, "stl")),
        "spheres": name(i, "csv"),
        "n": c.spheres.len(),
        "stopped": c.stopped.name(),
        "volume": volume,
        "coverage": c.coverage,
        "union_of_parent_volume": c.volume_share,
        "time_step_factor": c.step_factor,
        "parent_spheres": origins(&c.map),
    });
    if let Value::Object(more) = more {
        map.extend(more);
    }
    if let Some(masses) = &f.masses {
        map.extend(weighing::keys(masses));
    }
    if !f.no_masses.is_empty() {
        map.insert("no_masses".into(), f.no_masses.clone().into());
    }
    Value::Object(map)
}

/// For each sphere the parent's that it comes from, each with the share of its volume.
fn origins(map: &ParentMap) -> Value {
    let of = |w: &[u32]| {
        let range = w[0] as usize..w[1] as usize;
        range.map(|k| json!([map.parents[k], map.shares[k]])).collect::<Value>()
    };
    map.starts.windows(2).map(of).collect()
}

fn moving(m: &Moving) -> Map<String, Value> {
    let all = json!({
        "mass": m.mass,
        "centre": m.center.as_slice(),
        "inertia": m.inertia.to_array(),
        "principal_moments": m.principal.moments,
        "position": m.position.as_slice(),
        "quaternion": m.rotation,
        "velocity": m.velocity.as_slice(),
        "angular_velocity": m.angular_velocity.as_slice(),
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// What fragments and dust have together less what the body had, each over the sum of the sizes of
/// its terms.
fn residuals(held: &Held, broken: &Shattered) -> Value {
    let pieces = || {
        let dust = broken.dust.iter().map(|c| &c.moving);
        broken.fragments.iter().map(|f| &f.moving).chain(dust)
    };
    let own = held.inertia.matrix() * held.angular_velocity;
    let (mut mass, mut centre, mut momentum) = (-held.mass, Vec3::zeros(), Vec3::zeros());
    let mut angular = -own;
    let mut energy =
        -0.5 * (held.mass * held.velocity.norm_squared() + held.angular_velocity.dot(&own));
    let mut sizes = [held.mass, 0.0, 0.0, own.norm(), energy.abs()];
    for m in pieces() {
        let arm = m.position - held.position;
        let spin = m.inertia.matrix() * m.angular_velocity;
        mass += m.mass;
        centre += arm * m.mass;
        momentum += (m.velocity - held.velocity) * m.mass;
        angular += arm.cross(&m.velocity) * m.mass + spin;
        energy += 0.5 * (m.mass * m.velocity.norm_squared() + m.angular_velocity.dot(&spin));
        sizes[1] += m.mass * arm.norm();
        sizes[2] += m.mass * (m.velocity.norm() + held.velocity.norm());
        sizes[3] += m.mass * arm.norm() * m.velocity.norm() + spin.norm();
    }
    let over = |x: f64, size: f64| if size > 0.0 { x.abs() / size } else { 0.0 };
    json!({
        "mass": over(mass, sizes[0]),
        "centre": over(centre.norm(), sizes[1]),
        "momentum": over(momentum.norm(), sizes[2]),
        "angular_momentum": over(angular.norm(), sizes[3]),
        "kinetic_energy": over(energy, sizes[4]),
        "inertia": broken.inertia_error,
        "energy_difference": broken.energy,
        "shift": broken.shift.as_slice(),
    })
}
