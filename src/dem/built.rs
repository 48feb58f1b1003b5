//! Effects that are left out of the library, to weigh what the code of one costs a scene that does not name it:
//! `MORULA_WITHOUT=gravity,drag cargo build` builds an engine without these, which refuses scenes that name
//! them (`scripts/zero_cost.sh`). Without that variable, as always, all are built.

use super::engine::Setup;
use super::{CohesionLaw, DampingLaw, TangentialLaw};
use crate::error::{Error, Result};

/// Those that are left out.
const WITHOUT: Option<&str> = option_env!("MORULA_WITHOUT");

/// Whether an effect is built. Ask for it as `const { built(…) }`: the search is not folded where it is left to run time.
pub(crate) const fn built(name: &str) -> bool {
    let Some(out) = WITHOUT else { return true };
    let (a, b) = (name.as_bytes(), out.as_bytes());
    // The name from the start or after a comma, up to a comma or the end.
    let (mut from, mut k) = (0, 0);
    while from + k <= b.len() {
        let end = from + k == b.len() || b[from + k] == b',';
        if end && k == a.len() {
            return false;
        }
        if end || k == a.len() || a[k] != b[from + k] {
            while from < b.len() && b[from] != b',' {
                from += 1;
            }
            (from, k) = (from + 1, 0);
        } else {
            k += 1;
        }
    }
    true
}

/// Refused: an effect that is not built.
pub(crate) fn check(name: &str, named: bool) -> Result<()> {
    if named && !built(name) {
        return Err(Error::Unsupported(format!("the engine was built without {name}")));
    }
    Ok(())
}

/// Refused: effects that are not built.
pub(crate) fn check_all(s: &Setup) -> Result<()> {
    check("gravity", s.gravity.is_some())?;
    check("drag", s.drag.is_some())?;
    check("insertion", !s.insertion.is_empty())?;
    let still = super::WallMotion::Still;
    check("motion", s.walls.iter().any(|w| w.motion != still))?;
    let Some(laws) = &s.laws else { return Ok(()) };
    check("normal", true)?;
    check("damping", laws.damping != DampingLaw::None)?;
    check("tangential", laws.tangential != TangentialLaw::None)?;
    check("rolling", laws.rolling)?;
    check("cohesion", laws.cohesion != CohesionLaw::None)?;
    check("averaging", laws.averaging)
}
