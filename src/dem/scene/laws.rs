//! The laws of contact that a scene names.

use super::file::*;
use crate::dem::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
use crate::error::{Error, Result};

pub(super) fn laws(e: &EffectsPart) -> Result<Option<Laws>> {
    let Some(normal) = e.normal else {
        let others = [
            ("damping", e.damping.is_some()),
            ("tangential", e.tangential.is_some()),
            ("rolling", e.rolling),
            ("cohesion", e.cohesion.is_some()),
            ("averaging", e.averaging),
        ];
        return match others.iter().find(|o| o.1) {
            Some((name, _)) => Err(Error::InvalidArgument(format!(
                "effects.{name} does nothing without effects.normal: there are no contacts"
            ))),
            None => Ok(None),
        };
    };
    Ok(Some(Laws {
        normal: match normal {
            NormalName::Linear => NormalLaw::Linear,
            NormalName::Hertz => NormalLaw::Hertz,
        },
        damping: match e.damping {
            None => DampingLaw::None,
            Some(DampingName::Bodies) => DampingLaw::Bodies,
            Some(DampingName::Contact) => DampingLaw::Contact,
        },
        tangential: match e.tangential {
            None => TangentialLaw::None,
            Some(TangentialName::Viscous) => TangentialLaw::Viscous,
            Some(TangentialName::Mindlin) => TangentialLaw::Mindlin,
            Some(TangentialName::NoSlip) => TangentialLaw::NoSlip,
        },
        rolling: e.rolling,
        cohesion: match e.cohesion {
            None => CohesionLaw::None,
            Some(CohesionName::Linear) => CohesionLaw::Linear,
            Some(CohesionName::Jkr) => CohesionLaw::Jkr,
        },
        averaging: e.averaging,
    }))
}
