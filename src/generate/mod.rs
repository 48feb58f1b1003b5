//! The methods that turn a solid into a clump.

mod ball;
mod balls;
mod baselines;
pub mod best;
pub mod cover;
mod inscribed;
mod lazy;
mod many;
pub mod mss;
mod packed;
mod select;
mod series;
mod surface_fit;
mod warn;

use crate::clump::{Clump, Stopped};
use crate::error::{Error, Result, figure};
use crate::math::Sphere;
use crate::measure::{self, QualityOptions};
use crate::run::{Run, Stage};
use crate::solid::Solid;
pub(crate) use balls::Plane;
pub(crate) use balls::random::Random;
pub use baselines::OVERLAP;
pub use best::{BestOptions, Effort, HalfSpace, Symmetry};
pub use cover::CoverOptions;
pub use inscribed::Bound;
pub use many::{batch, batch_labels, levels};
pub(crate) use many::{each, each_label};
pub use series::Levels;
pub(crate) use series::Series;

/// A method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Local maxima of the distance transform, then of 2E − Ẽ (Buchele et al. 2026).
    Mss,
    /// Least mismatch for the number of spheres: greedy cover, refinement of exposed surfaces,
    /// spheres moved to where they help more.
    #[default]
    Best,
    /// Spheres through four points of the surface, fitted to it by least squares (Price et al.
    /// 2007). The number of spheres is the method's own; `spheres` limits it.
    SurfaceFit,
    /// Most coverage with no sphere beyond the surface: radii are exact depths.
    Inscribed,
    /// Largest inscribed spheres about a thinned skeleton by greedy set cover (Yuan 2019): none
    /// reaches beyond the surface.
    Cover,
    /// Spheres of nearly one radius (within 5 %) that do not overlap and keep within the surface, as
    /// large as their number allows: the grains of a body that may break. They cover it poorly:
    /// about half of the volume at 20 to 100 spheres, never three quarters.
    Packed,
    /// The greatest ball in what is left of the body, again and again (CLUMP, Angelidakis et al.
    /// 2021), each ball shrunk by the overlap and taken away.
    Euclidean,
    /// The greatest balls that touch the surface from inside at its points (Ferellec and McDowell
    /// 2010).
    FerellecMcDowell,
    /// Balls about the points of the axis of a body of revolution (Favier et al. 1999).
    Favier,
    /// Balls about the cells of a grid, those that cover most chosen first (Garcia et al. 2009;
    /// Li, Xu and Meng 2015).
    UniformGrid,
}

impl Method {
    /// Whether it reads `tolerance`.
    fn tolerates(self) -> bool {
        use Method::*;
        matches!(self, Inscribed | Euclidean | FerellecMcDowell | Favier | UniformGrid)
    }
}

/// What a generator is asked for. The criteria apply alone or together; the
/// first that is met stops the method.
#[derive(Debug, Clone, PartialEq)]
pub struct GenerateOptions {
    /// The method.
    pub method: Method,
    /// Number of spheres; 0: no limit (then another criterion must be given).
    pub spheres: usize,
    /// Stop at this mismatch D (on the method's own grid, but for [`Method::Best`]: as the quality
    /// figures have it); 0: no target.
    pub mismatch: f64,
    /// Least radius, in the caller's unit.
    pub min_radius: f64,
    /// Least distance between centres, in cells (δ_min of Buchele et al. 2026, section 3.4).
    pub min_distance: f64,
    /// Added to every radius, in cells; 0 has no bias.
    pub radius_offset: f64,
    /// Limit the radii so that no sphere reaches beyond the true surface (Buchele et al. 2026, section 3.5).
    pub confine: bool,
    /// Stop when this share of the volume is covered, by the cells of [`Method::Cover`]; 0: no
    /// target.
    pub coverage: f64,
    /// What [`Method::Cover`] covers, and with what.
    pub cover: CoverOptions,
    /// How far a sphere may reach beyond the surface, in the caller's unit: read by
    /// [`Method::Inscribed`] and the baselines of the field ([`Method::Euclidean`] and those after it).
    pub tolerance: f64,
    /// [`Method::Euclidean`]: by which part of its radius a ball is shrunk before it is taken from
    /// the body; 0: the balls do not overlap.
    pub overlap: f64,
    /// How long [`Method::Best`] and [`Method::Inscribed`] look for a clump.
    pub effort: Effort,
    /// What a clump by [`Method::Best`] must keep to.
    pub best: BestOptions,
    /// Quality to measure on the result; `None` costs nothing.
    pub quality: Option<QualityOptions>,
}

impl Default for GenerateOptions {
    fn default() -> Self {
        GenerateOptions {
            method: Method::Best,
            spheres: 50,
            mismatch: 0.0,
            min_radius: 0.0,
            min_distance: 0.0,
            radius_offset: 0.0,
            confine: false,
            coverage: 0.0,
            cover: CoverOptions::default(),
            tolerance: 0.0,
            overlap: OVERLAP,
            effort: Effort::Normal,
            best: BestOptions::default(),
            quality: None,
        }
    }
}

/// Makes a clump.
pub fn generate(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    check(options, run)?;
    let solid = run.time(Stage::Generate, || solid.with_told_axes(run))?;
    let mut clump = run.time(Stage::Generate, || made(solid, options, run))?;
    keep_radii(&mut clump.spheres, options);
    // A cancelled call measures no more: the clump goes out without figures.
    if let Some(wanted) = &options.quality
        && clump.stopped != Stopped::Cancelled
    {
        match run.time(Stage::Measure, || measure::quality(solid, &clump.spheres, wanted, run)) {
            Ok(quality) => clump.quality = Some(quality),
            Err(Error::Cancelled(_)) => {}
            Err(error) => return Err(error),
        }
    }
    clump.warnings = warn::warnings(solid, options, &clump);
    clump.counters = run.counters();
    Ok(clump)
}

/// Bounds of radii hold to the last digit in the caller's unit, which is not that of the methods.
fn keep_radii(spheres: &mut [Sphere], options: &GenerateOptions) {
    const LAST: f64 = 8.0 * f64::EPSILON;
    let (least, most) = (options.min_radius, options.best.max_radius);
    for s in spheres {
        if s.radius < least && s.radius >= (1.0 - LAST) * least {
            s.radius = least;
        }
        if most > 0.0 && s.radius > most && s.radius <= (1.0 + LAST) * most {
            s.radius = most;
        }
    }
}

fn made(solid: &Solid, options: &GenerateOptions, run: &Run) -> Result<Clump> {
    match options.method {
        Method::Mss => {
            solid.find_inside(run)?;
            mss::mss(solid, options, run)
        }
        Method::Best => best::fewest::make(solid, options, run),
        Method::SurfaceFit => surface_fit::surface_fit(solid, options, run),
        Method::Inscribed => inscribed::inscribed(solid, options, None, run),
        Method::Cover => cover::cover(solid, options, run),
        Method::Packed => packed::packed(solid, options, run),
        Method::Euclidean => baselines::euclidean(solid, options, run),
        Method::FerellecMcDowell => baselines::ferellec_mcdowell(solid, options, run),
        Method::Favier => baselines::favier(solid, options, run),
        Method::UniformGrid => baselines::uniform_grid(solid, options, run),
    }
}

/// Makes a clump by [`Method::Inscribed`] of which no sphere leaves a further bound, such as the
/// union of the spheres of another clump. The figures of quality are not made. The bound is in the solid's
/// unit frame, and so is the search: not in the axes that the body tells.
pub fn inscribed_within(
    solid: &Solid,
    options: &GenerateOptions,
    bound: Bound,
    run: &Run,
) -> Result<Clump> {
    check(options, run)?;
    if options.method != Method::Inscribed {
        return Err(Error::InvalidArgument(
            "a further bound is read by the method inscribed alone".into(),
        ));
    }
    inscribed::inscribed(solid, options, Some(bound), run)
}

fn check(o: &GenerateOptions, run: &Run) -> Result<()> {
    for (name, value) in [
        ("mismatch", o.mismatch),
        ("min_radius", o.min_radius),
        ("min_distance", o.min_distance),
        ("coverage", o.coverage),
        ("tolerance", o.tolerance),
    ] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::InvalidArgument(format!(
                "{name} is {}, not a number ≥ 0",
                figure(value)
            )));
        }
    }
    if !o.radius_offset.is_finite() {
        return Err(Error::InvalidArgument(format!(
            "radius_offset is {}, not a number",
            o.radius_offset
        )));
    }
    if o.coverage > 1.0 {
        return Err(Error::InvalidArgument(format!(
            "coverage is {}, more than 1",
            figure(o.coverage)
        )));
    }
    if o.method != Method::Cover && (o.coverage != 0.0 || o.cover != CoverOptions::default()) {
        return Err(Error::InvalidArgument(
            "coverage, ends, candidates, thinning_cells and cells_inside are options of the \
             method cover"
                .into(),
        ));
    }
    if !(0.0..=1.0).contains(&o.overlap) {
        return Err(Error::InvalidArgument(format!(
            "overlap is {}, not a number from 0 to 1",
            figure(o.overlap)
        )));
    }
    if o.overlap != OVERLAP && o.method != Method::Euclidean {
        return Err(Error::InvalidArgument(
            "overlap is an option of the method euclidean alone".into(),
        ));
    }
    if o.tolerance != 0.0 && !o.method.tolerates() {
        return Err(Error::InvalidArgument(
            "tolerance is an option of the methods inscribed, euclidean, ferellec-mcdowell, favier \
             and uniform-grid"
                .into(),
        ));
    }
    if o.effort != Effort::default() && !matches!(o.method, Method::Best | Method::Inscribed) {
        return Err(Error::InvalidArgument(
            "effort is an option of the methods best and inscribed".into(),
        ));
    }
    o.best.check(o.min_radius)?;
    if o.method != Method::Best && o.best != BestOptions::default() {
        return Err(Error::InvalidArgument(
            "overshoot_weight, max_protrusion, max_radius, half-spaces, connected, equal_volume, \
             smoothness and symmetry are options of the method best"
                .into(),
        ));
    }
    // Surface fitting ends by itself.
    let endless = o.method != Method::SurfaceFit;
    let criteria = [o.mismatch, o.min_radius, o.coverage];
    if endless && o.spheres == 0 && criteria == [0.0; 3] && !run.can_stop() {
        return Err(Error::InvalidArgument(
            "no criterion is given: spheres, mismatch, min_radius and coverage are all 0, and there is \
             neither a deadline nor a progress callback that could cancel"
                .into(),
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(options: &GenerateOptions, run: &Run) -> bool {
        matches!(check(options, run), Err(Error::InvalidArgument(_)))
    }

    #[test]
    fn each_criterion_stands_alone() {
        let none = GenerateOptions { spheres: 0, ..GenerateOptions::default() };
        assert!(refused(&none, &Run::serial()));
        let run = Run::serial().with_deadline(1.0);
        assert!(!refused(&none, &run));
        let run = Run::serial().with_progress(Box::new(|_| true));
        assert!(!refused(&none, &run));
        for one in [
            GenerateOptions { spheres: 1, ..none.clone() },
            GenerateOptions { mismatch: 0.1, ..none.clone() },
            GenerateOptions { min_radius: 0.1, ..none.clone() },
            GenerateOptions { method: Method::Cover, coverage: 0.9, ..none.clone() },
        ] {
            assert!(!refused(&one, &Run::serial()));
        }
    }

    #[test]
    fn values_that_are_no_numbers_are_refused() {
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            let o = GenerateOptions::default();
            assert!(refused(&GenerateOptions { mismatch: bad, ..o.clone() }, &Run::serial()));
            assert!(refused(&GenerateOptions { min_radius: bad, ..o.clone() }, &Run::serial()));
            let coverage = GenerateOptions { coverage: bad, method: Method::Cover, ..o.clone() };
            assert!(refused(&coverage, &Run::serial()));
            assert!(refused(&GenerateOptions { min_distance: bad, ..o.clone() }, &Run::serial()));
        }
        let o = GenerateOptions { radius_offset: f64::NAN, ..GenerateOptions::default() };
        assert!(refused(&o, &Run::serial()));
        let o = GenerateOptions { effort: Effort::Draft, ..GenerateOptions::default() };
        assert!(!refused(&o, &Run::serial()));
        assert!(refused(&GenerateOptions { method: Method::Mss, ..o }, &Run::serial()));
    }
}
