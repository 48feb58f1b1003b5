//! What a scene may not ask: effects that can do nothing, bodies in each other at the start.

use super::file::SceneFile;
use super::templates::Made;
use crate::dem::{Coefficients, Engine, State, WallSetup, WallShape};
use crate::error::{Error, Result, figure};

/// Refuses effects that are named and can do nothing.
pub(super) fn refuse_idle(
    file: &SceneFile,
    templates: &[Made],
    state: &State,
    walls: &[WallSetup],
    coefficients: &[Coefficients],
) -> Result<()> {
    let e = &file.effects;
    let coming = file.insertion.iter().map(|i| i.total).sum::<u64>();
    let no = |what: &str, why: &str| {
        Err(Error::InvalidArgument(format!("effects.{what} can do nothing: {why}")))
    };
    if let Some(g) = e.gravity {
        if !g.iter().all(|c| c.is_finite()) {
            return Err(Error::NotFinite(format!(
                "effects.gravity is ({}, {}, {})",
                g[0], g[1], g[2]
            )));
        }
        if g == [0.0; 3] {
            return no("gravity", "it is 0");
        }
        if coming == 0 && state.fixed.iter().all(|f| *f) {
            return no("gravity", "every body is fixed");
        }
    }
    let alone = (state.len() + walls.len()) as u64 + coming < 2;
    if e.normal.is_some() && alone && file.fragmentation.is_none() {
        return no("normal", "there are no two things that could touch");
    }
    let zero = |of: &dyn Fn(&Coefficients) -> f64| coefficients.iter().all(|c| of(c) == 0.0);
    if e.damping.is_some() && zero(&|c| c.damping) {
        return no("damping", "every restitution is 1");
    }
    if e.tangential.is_some() && zero(&|c| c.friction) {
        return no("tangential", "every friction is 0");
    }
    if e.rolling && zero(&|c| c.rolling) {
        return no("rolling", "every coefficient of rolling is 0");
    }
    if e.cohesion.is_some() && zero(&|c| c.cohesion) {
        return no("cohesion", "every cohesion is 0");
    }
    let single = templates.iter().all(|t| t.spheres.len() == 1);
    let flat = walls.iter().all(|w| matches!(w.shape, WallShape::Plane { .. }));
    if e.averaging && single && flat {
        return no(
            "averaging",
            "every body is one sphere and every wall a plane: two never touch twice",
        );
    }
    Ok(())
}

/// Refuses bodies that are in each other or in a wall at the start.
pub(super) fn refuse_overlap(engine: &Engine, part: f64) -> Result<()> {
    let s = engine.state();
    let radius = |body: u32, sphere: u32| {
        s.template_of(body as usize).spheres().get(sphere as usize).map_or(0.0, |s| s.radius)
    };
    let [bodies, walls] = engine.contacts();
    for (of_walls, c) in bodies.iter().map(|c| (false, c)).chain(walls.iter().map(|c| (true, c))) {
        let own = radius(c.b, c.sphere_b);
        let least = if of_walls { own } else { own.min(radius(c.a, c.sphere_a)) };
        if c.overlap > part * least {
            let first = if of_walls { "wall" } else { "body" };
            return Err(Error::InvalidArgument(format!(
                "{first} {} and body {} overlap by {} at the start, more than {} of the smaller radius \
                 (run.overlap)",
                c.a,
                s.label[c.b as usize],
                figure(c.overlap),
                figure(part)
            )));
        }
    }
    Ok(())
}
