//! How many spheres, where that is not said: the fewest for a mismatch, or as many as a least
//! radius or the time allows.

use super::best;
use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, figure};
use crate::generate::{Effort, GenerateOptions};
use crate::measure::{QualityOptions, quality};
use crate::run::Run;
use crate::solid::Solid;
use std::cell::RefCell;

/// Most spheres that are tried where no number is given.
const MOST: usize = 5000;
/// Numbers of spheres that are tried first.
const FIRST: usize = 8;
/// Twice as many spheres that leave this part of D or more are not worth it: all further ones
/// would have to be smaller than the least radius.
const USELESS: f64 = 0.95;

/// A clump by the method best: of the number of spheres asked for, or of the number that the other
/// criteria lead to.
pub(in crate::generate) fn make(
    solid: &Solid,
    options: &GenerateOptions,
    run: &Run,
) -> Result<Clump> {
    super::check(options)?;
    fits(solid, options)?;
    let search = Search { solid, options, run, kept: RefCell::default() };
    let found = match (options.spheres, options.mismatch) {
        (0, 0.0) => search.most(),
        (_, 0.0) => return best(solid, options, run),
        _ => search.fewest(),
    };
    match (found, search.kept.into_inner()) {
        // There is a clump: it goes out.
        (Err(Error::Cancelled(_)), Some((_, clump))) => {
            let stopped = if run.cancelled(0.0) { Stopped::Cancelled } else { Stopped::Deadline };
            let note = "the search for the number of spheres was stopped".into();
            Ok(Clump { stopped, note, ..clump })
        }
        (found, _) => found,
    }
}

/// Refuses a least radius that no sphere can have.
pub(in crate::generate) fn fits(solid: &Solid, options: &GenerateOptions) -> Result<()> {
    let ball = (0.75 / std::f64::consts::PI * solid.unit_moments().volume).cbrt();
    if options.min_radius / solid.frame().scale > ball {
        return Err(Error::NoSpheres(format!(
            "a single sphere with a radius of {} or more has more volume than the body",
            figure(options.min_radius)
        )));
    }
    Ok(())
}

struct Search<'a, 'r> {
    solid: &'a Solid,
    options: &'a GenerateOptions,
    run: &'a Run<'r>,
    /// The last clump, and whether it is good enough: if not, a later one takes its place.
    kept: RefCell<Option<(bool, Clump)>>,
}

/// A clump and its D, as the quality figures measure it.
struct Tried {
    clump: Clump,
    d: f64,
}

impl Tried {
    fn late(&self) -> bool {
        matches!(self.clump.stopped, Stopped::Deadline | Stopped::Cancelled)
    }
}

impl Search<'_, '_> {
    /// The clump of `n` spheres, the `k`th that is tried.
    fn at(&self, n: usize, effort: Effort, k: i32) -> Result<Tried> {
        let options = GenerateOptions { spheres: n, mismatch: 0.0, effort, ..self.options.clone() };
        // Grid and seeds of one more clump take their time.
        if self.kept.borrow().is_some() && (self.run.cancelled(0.0) || self.run.late()) {
            return Err(Error::Cancelled("stopped between two numbers of spheres".into()));
        }
        self.run.within([1.0 - 0.8f64.powi(k), 1.0 - 0.8f64.powi(k + 1)], || {
            let clump = best(self.solid, &options, self.run)?;
            let mut kept = self.kept.borrow_mut();
            if kept.as_ref().is_none_or(|k| !k.0) {
                *kept = Some((false, clump.clone()));
            }
            let wanted = QualityOptions { surface: false, ..QualityOptions::default() };
            // Cancelled or late, what there is goes out.
            match quality(self.solid, &clump.spheres, &wanted, self.run) {
                Ok(q) => {
                    if q.mismatch <= self.options.mismatch {
                        *kept = Some((true, clump.clone()));
                    }
                    Ok(Tried { clump, d: q.mismatch })
                }
                Err(Error::Cancelled(_)) => {
                    Ok(Tried { clump: Clump { stopped: Stopped::Cancelled, ..clump }, d: 1.0 })
                }
                Err(e) => Err(e),
            }
        })
    }

    /// The fewest spheres whose D is at most the one asked for. Drafts tell about where; then the
    /// number is halved in between with the effort asked for. D falls with n but for a per cent
    /// of noise, so the clump is good enough, and one with fewer might just be, too.
    fn fewest(&self) -> Result<Clump> {
        let (goal, effort) = (self.options.mismatch, self.options.effort);
        let most = if self.options.spheres > 0 { self.options.spheres } else { MOST };
        let mut k = -1;
        let mut at = |n: usize, effort| {
            k += 1;
            self.at(n, effort, k)
        };
        // Too few spheres, as far as is known.
        let mut low = 0;
        let mut n = FIRST.min(most);
        while n < most {
            let draft = at(n, Effort::Draft)?;
            if draft.late() {
                return Ok(self.told(draft));
            }
            if draft.d <= goal {
                break;
            }
            low = n;
            n = n.saturating_mul(2).min(most);
        }
        let mut good = at(n, effort)?;
        // What a draft reaches by luck more work may not: a little more then.
        while !good.late() && good.d > goal && n < most {
            low = n;
            n = (n + n / 4 + 1).min(most);
            good = at(n, effort)?;
        }
        if good.late() || good.d > goal {
            return Ok(self.told(good));
        }
        // Drafts are up to a third worse: what was too few for them may do.
        if effort != Effort::Draft {
            low /= 2;
        }
        while n - low > 1 {
            let middle = low + (n - low) / 2;
            let tried = at(middle, effort)?;
            if tried.late() {
                good.clump.stopped = tried.clump.stopped;
                good.clump.note = "the search for fewer spheres was stopped".into();
                return Ok(good.clump);
            }
            if tried.d <= goal {
                (n, good) = (middle, tried);
            } else {
                low = middle;
            }
        }
        good.clump.stopped = Stopped::Mismatch;
        Ok(good.clump)
    }

    /// The clump of a search for a mismatch that ended without reaching it.
    fn told(&self, tried: Tried) -> Clump {
        let Tried { mut clump, d } = tried;
        if matches!(clump.stopped, Stopped::Spheres) && self.options.spheres == 0 {
            clump.stopped = Stopped::Exhausted;
            clump.note = format!(
                "{MOST} spheres have a mismatch of {d:.5}, not {}: name a number of spheres for more",
                figure(self.options.mismatch)
            );
        }
        clump
    }

    /// Twice as many spheres again and again, while there is time and they are not too small.
    fn most(&self) -> Result<Clump> {
        let effort = self.options.effort;
        let mut n = FIRST;
        let mut kept = self.at(n, effort, 0)?;
        for k in 1.. {
            if kept.late() || n == MOST {
                break;
            }
            n = (2 * n).min(MOST);
            let tried = self.at(n, effort, k)?;
            if tried.late() {
                kept.clump.stopped = tried.clump.stopped;
                break;
            }
            if self.options.min_radius > 0.0 && tried.d > USELESS * kept.d {
                kept.clump.stopped = Stopped::Radius;
                break;
            }
            kept = tried;
        }
        if kept.clump.stopped == Stopped::Spheres {
            kept.clump.stopped = Stopped::Exhausted;
            kept.clump.note = format!("{MOST} spheres are the most where no number is named");
        }
        Ok(kept.clump)
    }
}
