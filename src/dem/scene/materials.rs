//! What each two materials of a scene do to each other.

use super::file::{EffectsPart, MaterialPart, NormalName, PairPart, SceneFile, TangentialName};
use crate::dem::Coefficients;
use crate::dem::effects::damping;
use crate::error::{Error, Result, figure, reserve};
use std::collections::BTreeMap;

/// Stiffness in the plane of contact over that along the normal, where a linear law is not told (Cundall and
/// Strack 1979; 2/7 makes both contacts last as long for a ball).
const SHEAR: f64 = 2.0 / 7.0;

/// The names in order, and the coefficients of each two, row by row.
pub(super) fn coefficients(file: &SceneFile) -> Result<(Vec<&str>, Vec<Coefficients>)> {
    let names: Vec<&str> = file.materials.keys().map(String::as_str).collect();
    for (name, m) in &file.materials {
        check(name, m, &file.effects)?;
    }
    for (i, p) in file.pairs.iter().enumerate() {
        for name in &p.between {
            known(&file.materials, name, &format!("pair {i}"))?;
        }
    }
    let mut all = reserve("coefficients", names.len() * names.len())?;
    for a in &names {
        for b in &names {
            all.push(of_two(file, a, b)?);
        }
    }
    Ok((names, all))
}

pub(super) fn known(
    materials: &BTreeMap<String, MaterialPart>,
    name: &str,
    who: &str,
) -> Result<usize> {
    let at = materials.keys().position(|n| n == name);
    at.ok_or_else(|| {
        Error::InvalidArgument(format!("{who} is of the material {name}, which is not there"))
    })
}

/// Refuses numbers out of their range, and those that no effect reads.
fn check(name: &str, m: &MaterialPart, e: &EffectsPart) -> Result<()> {
    let bad = |what: &str, v: f64, range: &str| {
        Err(Error::InvalidArgument(format!(
            "the {what} of the material {name} is {}, not {range}",
            figure(v)
        )))
    };
    for (what, v, most) in [
        ("restitution", m.restitution, 1.0),
        ("friction", m.friction, f64::MAX),
        ("viscosity", m.viscosity, f64::MAX),
        ("shear", m.shear, f64::MAX),
        ("rolling", m.rolling, f64::MAX),
        ("cohesion", m.cohesion, f64::MAX),
        ("young", m.young, f64::MAX),
        ("stiffness", m.stiffness, f64::MAX),
    ] {
        if let Some(v) = v
            && !(v >= 0.0 && v <= most)
        {
            return bad(
                what,
                v,
                if most > 1.0 { "a number of 0 or more" } else { "between 0 and 1" },
            );
        }
    }
    if let Some(v) = m.poisson
        && !(v > -1.0 && v <= 0.5)
    {
        return bad("poisson", v, "between -1 and 1/2");
    }
    let idle = |what: &str, why: &str| {
        Err(Error::InvalidArgument(format!(
            "the material {name} has {what}, but the scene names no {why}: it would do nothing"
        )))
    };
    let hertz = e.normal == Some(NormalName::Hertz);
    match () {
        () if m.restitution.is_some() && e.damping.is_none() => idle("restitution", "damping"),
        () if m.friction.is_some() && e.tangential.is_none() => idle("friction", "tangential law"),
        () if m.viscosity.is_some() && e.tangential != Some(TangentialName::Viscous) => {
            idle("viscosity", "viscous friction")
        }
        () if m.rolling.is_some() && !e.rolling => idle("rolling resistance", "rolling"),
        () if m.cohesion.is_some() && e.cohesion.is_none() => idle("cohesion", "cohesion"),
        () if m.young.is_some() && !hertz => idle("a Young's modulus", "hertz law"),
        () if m.stiffness.is_some() && e.normal != Some(NormalName::Linear) => {
            idle("a stiffness", "linear law")
        }
        () => Ok(()),
    }
}

/// What two materials do to each other: what their pair says, else what both say alike.
fn of_two(file: &SceneFile, a: &str, b: &str) -> Result<Coefficients> {
    let e = &file.effects;
    let Some(normal) = e.normal else { return Ok(Coefficients::default()) };
    let (m, n) = (&file.materials[a], &file.materials[b]);
    let pair = file.pairs.iter().find(|p| {
        let [x, y] = &p.between;
        (x == a && y == b) || (x == b && y == a)
    });
    type Of<'a, T> = &'a dyn Fn(&T) -> Option<f64>;
    let of = |what: &str, in_pair: Of<PairPart>, in_one: Of<MaterialPart>| {
        if let Some(v) = pair.and_then(in_pair) {
            return Ok(v);
        }
        match (in_one(m), in_one(n)) {
            (Some(x), Some(y)) if x == y => Ok(x),
            _ => Err(Error::InvalidArgument(format!(
                "the {what} of {a} and {b} is not told: give both the same, or a [[pairs]] between them"
            ))),
        }
    };
    let own = |name: &str, what: &str, v: Option<f64>| {
        v.ok_or_else(|| Error::InvalidArgument(format!("the material {name} has no {what}")))
    };
    let mut c = Coefficients::default();
    match normal {
        NormalName::Linear => {
            c.stiffness = of("stiffness", &|p| p.stiffness, &|m| m.stiffness)?;
            let told =
                pair.is_some_and(|p| p.shear.is_some()) || m.shear.is_some() || n.shear.is_some();
            let shear = if told { of("shear", &|p| p.shear, &|m| m.shear)? } else { SHEAR };
            c.shear = shear * c.stiffness;
        }
        NormalName::Hertz => {
            let mut soft = [0.0; 2];
            for (name, m) in [(a, m), (b, n)] {
                let young = own(name, "young", m.young)?;
                let poisson = own(name, "poisson", m.poisson)?;
                if young <= 0.0 {
                    return Err(Error::InvalidArgument(format!(
                        "the young of the material {name} is 0"
                    )));
                }
                // 1/E = Σ (1 − ν²)/Y; 1/G = Σ (2 − ν)/G_i with G_i = Y/(2 (1 + ν)).
                soft[0] += (1.0 - poisson * poisson) / young;
                soft[1] += (2.0 - poisson) * 2.0 * (1.0 + poisson) / young;
            }
            c.stiffness = 1.0 / soft[0];
            c.shear = 8.0 / soft[1];
        }
    }
    if c.stiffness <= 0.0 {
        return Err(Error::InvalidArgument(format!("the stiffness of {a} and {b} is 0")));
    }
    if e.damping.is_some() {
        let restitution = of("restitution", &|p| p.restitution, &|m| m.restitution)?;
        if !(0.0..=1.0).contains(&restitution) {
            let v = figure(restitution);
            return Err(Error::InvalidArgument(format!(
                "the restitution of {a} and {b} is {v}, not between 0 and 1"
            )));
        }
        let ratio = damping::ratio(restitution);
        c.damping = match normal {
            NormalName::Linear => 2.0 * ratio,
            NormalName::Hertz => 5.0f64.sqrt() * ratio,
        };
        c.tangential_damping = 1.0;
    }
    if e.tangential.is_some() {
        c.friction = of("friction", &|p| p.friction, &|m| m.friction)?;
    }
    if e.tangential == Some(TangentialName::Viscous) {
        c.viscosity = of("viscosity", &|p| p.viscosity, &|m| m.viscosity)?;
    }
    if e.rolling {
        c.rolling = of("rolling", &|p| p.rolling, &|m| m.rolling)?;
    }
    if e.cohesion.is_some() {
        c.cohesion = of("cohesion", &|p| p.cohesion, &|m| m.cohesion)?;
    }
    Ok(c)
}
