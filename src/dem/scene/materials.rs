//! What each two materials of a scene do to each other.

use super::file::{MaterialPart, PairPart, SceneFile};
use crate::dem::{Between, Coefficients, Laws, Material};
use crate::error::{Error, Result, reserve};
use std::collections::BTreeMap;

/// The coefficients of each two materials in the order of their names, row by row; those of two of which no
/// body is made are nothing, as they never touch.
pub(super) fn coefficients(file: &SceneFile, laws: Option<&Laws>) -> Result<Vec<Coefficients>> {
    for (i, p) in file.pairs.iter().enumerate() {
        for name in &p.between {
            known(&file.materials, name, &format!("pair {i}"))?;
        }
    }
    let names: Vec<&String> = file.materials.keys().collect();
    let bodily = |name: &String| file.templates.values().any(|t| t.material == *name);
    let mut all = reserve("coefficients", (names.len() * names.len()).max(1))?;
    for a in &names {
        for b in &names {
            let about = |e: Error| e.about(&format!("materials {a} and {b}"));
            all.push(match laws {
                Some(laws) if bodily(a) || bodily(b) => of_two(file, laws, a, b).map_err(about)?,
                _ => Coefficients::default(),
            });
        }
    }
    if all.is_empty() {
        all.push(Coefficients::default());
    }
    Ok(all)
}

/// The number of a material.
pub(super) fn known(
    materials: &BTreeMap<String, MaterialPart>,
    name: &str,
    who: &str,
) -> Result<u32> {
    let at = materials.keys().position(|n| n == name);
    at.map(|at| at as u32).ok_or_else(|| {
        Error::InvalidArgument(format!("{who} is of the material {name}, which is not there"))
    })
}

/// What their pair says, else what both say alike.
fn of_two(file: &SceneFile, laws: &Laws, a: &str, b: &str) -> Result<Coefficients> {
    let (m, n) = (&file.materials[a], &file.materials[b]);
    let pair = file.pairs.iter().find(|p| {
        let [x, y] = &p.between;
        (x == a && y == b) || (x == b && y == a)
    });
    type Of<'a, T> = &'a dyn Fn(&T) -> Option<f64>;
    let of = |what: &str, in_pair: Of<PairPart>, in_one: Of<MaterialPart>| match (
        pair.and_then(in_pair),
        in_one(m),
        in_one(n),
    ) {
        (Some(v), ..) => Ok(Some(v)),
        (None, x, y) if x == y => Ok(x),
        _ => Err(Error::InvalidArgument(format!(
            "they differ in {what}: a [[pairs]] between them must tell it"
        ))),
    };
    let between = Between {
        stiffness: of("stiffness", &|p| p.stiffness, &|m| m.stiffness)?,
        shear: of("shear", &|p| p.shear, &|m| m.shear)?,
        restitution: of("restitution", &|p| p.restitution, &|m| m.restitution)?,
        friction: of("friction", &|p| p.friction, &|m| m.friction)?,
        viscosity: of("viscosity", &|p| p.viscosity, &|m| m.viscosity)?,
        rolling: of("rolling", &|p| p.rolling, &|m| m.rolling)?,
        cohesion: of("cohesion", &|p| p.cohesion, &|m| m.cohesion)?,
    };
    let elastic = |m: &MaterialPart| Some(Material { young: m.young?, poisson: m.poisson? });
    let both = elastic(m).zip(elastic(n)).map(|(m, n)| [m, n]);
    if laws.normal == crate::dem::NormalLaw::Linear && (m.young.or(n.young)).is_some() {
        return Err(Error::InvalidArgument(
            "a Young's modulus does nothing without the hertz law".into(),
        ));
    }
    Coefficients::of(laws, both, &between)
}
