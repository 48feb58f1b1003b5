//! MFiX glued-sphere particles, `gsp_config.csv`: places and diameters relative to the bounding
//! diameter; what of each sphere's surface is free, relative to its square (MFiX uses it for heat).
//! Neighbours through which heat flows are not told: -1, with no area.

use super::{Record, rounded};
use crate::error::{Result, collected};
use crate::math::{Sphere, Vec3};
use std::f64::consts::PI;
use std::fmt::Write;

/// Directions by which the free surface of a sphere is told.
const DIRECTIONS: usize = 1000;

pub(super) fn table(r: &Record, single: bool) -> Result<String> {
    let whole = r.diameter();
    let mut out = String::from(
        "#version = 1\nx,y,z,rel_d,rel_sa,w,e,s,n,t,b,w_na,e_na,s_na,n_na,t_na,b_na,pid\n",
    );
    let relative = r.spheres.iter().map(|s| Sphere::new(s.center / whole, s.radius / whole));
    let relative: Vec<Sphere> = collected("spheres of a file", relative)?;
    for (s, free) in rounded(&relative, single)?.iter().zip(free(r)) {
        let (c, d) = (s.center, 2.0 * s.radius);
        let _ = writeln!(
            out,
            "{:?},{:?},{:?},{d:?},{:?},-1,-1,-1,-1,-1,-1,0.0,0.0,0.0,0.0,0.0,0.0,1",
            c.x,
            c.y,
            c.z,
            free * PI * d * d
        );
    }
    Ok(out)
}

/// The part of each sphere's surface that lies in no other.
fn free(r: &Record) -> impl Iterator<Item = f64> {
    r.spheres.iter().map(|s| {
        let near = r
            .spheres
            .iter()
            .filter(|o| *o != s && (o.center - s.center).norm() < o.radius + s.radius);
        let near: Vec<_> = near.collect();
        let open = (0..DIRECTIONS).filter(|&k| {
            let p = s.center + direction(k) * s.radius;
            !near.iter().any(|o| (p - o.center).norm_squared() < o.radius * o.radius)
        });
        open.count() as f64 / DIRECTIONS as f64
    })
}

/// The kth of evenly spread directions (Fibonacci).
fn direction(k: usize) -> Vec3 {
    let z = 1.0 - (2 * k + 1) as f64 / DIRECTIONS as f64;
    let turn = PI * (1.0 + 5f64.sqrt()) * (k as f64 + 0.5);
    let across = (1.0 - z * z).sqrt();
    Vec3::new(across * turn.cos(), across * turn.sin(), z)
}
