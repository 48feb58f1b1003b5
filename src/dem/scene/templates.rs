//! The clumps of a scene.

use super::file::{EffortName, MethodName, TargetName, TemplatePart, edges};
use super::given::given;
use crate::dem::Template;
use crate::error::{Error, Result, figure, push};
use crate::generate::{Effort, GenerateOptions, Method, generate};
use crate::mass::{Body, Target};
use crate::math::{Inertia, Moments, Sphere};
use crate::run::Run;
use crate::shape::{ImportOptions, Primitive, Shape};
use crate::solid::{Resolution, Solid, SolidOptions};
use std::path::Path;
use std::sync::Arc;

/// A template with what it stands for.
#[derive(Clone)]
pub struct Made {
    /// Its name in the scene.
    pub name: String,
    /// What the engine holds of it.
    pub template: Arc<Template>,
    /// Its spheres in the frame of the body.
    pub spheres: Vec<Sphere>,
    /// The body.
    pub body: Body,
    /// The solid and the spheres, both in the frame of the shape: kept where an effect asks for them.
    pub source: Option<(Arc<Solid>, Vec<Sphere>)>,
}

/// Clumps that were made: a run that asks for the same ones again gets them.
#[derive(Clone, Default)]
pub struct Makes(Vec<(TemplatePart, u64, Made)>);

impl Makes {
    /// Makes the template of this name; `folder` is where its file is looked for. With `keep` its solid stays.
    pub(super) fn make(
        &mut self,
        name: &str,
        part: &TemplatePart,
        keep: bool,
        folder: &Path,
        run: &Run,
    ) -> Result<Made> {
        let seed = run.seed();
        let like = |m: &&(TemplatePart, u64, Made)| {
            m.0 == *part && m.1 == seed && (m.2.source.is_some() || !keep)
        };
        if let Some((.., made)) = self.0.iter().find(like) {
            return Ok(Made { name: name.to_owned(), ..made.clone() });
        }
        let made = make(name, part, keep, folder, run)?;
        push("clumps", &mut self.0, (part.clone(), seed, made.clone()))?;
        Ok(made)
    }
}

/// A key that means nothing where the spheres are given.
fn idle(part: &TemplatePart) -> Option<&'static str> {
    if part.shape.is_some() || part.file.is_some() {
        return None;
    }
    let keys = [
        ("spheres", part.spheres.is_some()),
        ("method", part.method.is_some()),
        ("effort", part.effort.is_some()),
        ("cells", part.cells.is_some()),
        ("segments", part.segments.is_some()),
        ("set", !part.set.is_empty()),
        ("stretch", part.stretch.is_some()),
        ("equal_volume", part.equal_volume),
    ];
    keys.iter().find(|k| k.1).map(|k| k.0)
}

fn make(name: &str, part: &TemplatePart, keep: bool, folder: &Path, run: &Run) -> Result<Made> {
    let bad = |what: String| Err(Error::InvalidArgument(format!("the template {name} {what}")));
    let choices = [
        part.ball.is_some(),
        part.shape.is_some(),
        part.file.is_some(),
        part.spheres_file.is_some(),
        part.grid.is_some(),
    ];
    if choices.iter().filter(|c| **c).count() != 1 {
        return bad("needs one of ball, shape, file, spheres_file and grid".into());
    }
    if !(part.density.is_finite() && part.density > 0.0) {
        return bad(format!("has the density {}, not a number above 0", figure(part.density)));
    }
    let whose = |e: Error| e.about(&format!("template {name}"));
    if let Some(radius) = part.ball.filter(|r| !(r.is_finite() && *r > 0.0)) {
        return bad(format!("is a ball of radius {}, not a number above 0", figure(radius)));
    }
    if let Some(key) = idle(part) {
        return bad(format!("has {key}, which does nothing: its spheres are given, not made"));
    }
    if let Some((spheres, body)) = given(part, folder, run).map_err(whose)? {
        if keep {
            return bad("is of given spheres, not of a shape that could break or wear".into());
        }
        let template = match part.ball {
            Some(radius) => Template::ball(radius, part.density),
            None => Template::of_body(&spheres, &body),
        };
        let template = Arc::new(template.map_err(whose)?);
        let spheres = body.to_body(&spheres);
        return Ok(Made { name: name.to_owned(), template, spheres, body, source: None });
    }
    let source = Source {
        shape: part.shape.as_deref(),
        set: &part.set,
        segments: part.segments.unwrap_or_else(edges),
        file: part.file.as_deref(),
        scale: part.scale,
        stretch: part.stretch,
    };
    let shape = source.shape(folder, run).map_err(whose)?;
    let resolution = Resolution::CellsLongest(part.cells.unwrap_or(128));
    let solid = SolidOptions { resolution, ..SolidOptions::default() };
    let solid = Solid::new(&shape, &solid, run).map_err(whose)?;
    let mut options = GenerateOptions {
        method: match part.method.unwrap_or_default() {
            MethodName::Best => Method::Best,
            MethodName::Mss => Method::Mss,
            MethodName::Inscribed => Method::Inscribed,
            MethodName::Cover => Method::Cover,
        },
        effort: match part.effort.unwrap_or_default() {
            EffortName::Draft => Effort::Draft,
            EffortName::Normal => Effort::Normal,
            EffortName::Thorough => Effort::Thorough,
        },
        spheres: part.spheres.unwrap_or(50),
        ..GenerateOptions::default()
    };
    options.best.equal_volume = part.equal_volume;
    if part.equal_volume && part.method.unwrap_or_default() != MethodName::Best {
        return bad("is of equal volume, which the method best alone makes".into());
    }
    let clump = generate(&solid, &options, run).map_err(whose)?;
    let target = match part.inertia {
        TargetName::Solid | TargetName::Exact => Target::Solid,
        TargetName::Union => Target::Union,
    };
    let body = match part.inertia {
        TargetName::Exact => source.exact(part.density).map_err(whose)?,
        _ => Body::new(target, &solid, &clump.spheres, part.density, run).map_err(whose)?,
    };
    let template = Arc::new(Template::of_body(&clump.spheres, &body).map_err(whose)?);
    let spheres = body.to_body(&clump.spheres);
    let source = keep.then(|| (Arc::new(solid), clump.spheres));
    Ok(Made { name: name.to_owned(), template, spheres, body, source })
}

/// A file or a built-in particle.
pub(super) struct Source<'a> {
    pub shape: Option<&'a str>,
    pub set: &'a std::collections::BTreeMap<String, f64>,
    pub segments: usize,
    pub file: Option<&'a str>,
    pub scale: f64,
    pub stretch: Option<[f64; 3]>,
}

impl Source<'_> {
    pub(super) fn shape(&self, folder: &Path, run: &Run) -> Result<Shape> {
        let import = ImportOptions { length_unit: self.scale, ..ImportOptions::default() };
        let Some(name) = self.shape else {
            if self.stretch.is_some() {
                return Err(Error::Unsupported("only built-in particles are stretched".into()));
            }
            return from_file(&folder.join(self.file.unwrap_or_default()), &import, run);
        };
        let Some(stretch) = self.stretch else {
            return Shape::from_primitive(&self.particle(name)?, self.segments, &import, run);
        };
        if let Some(f) = stretch.iter().find(|f| !(f.is_finite() && **f > 0.0)) {
            let f = figure(*f);
            return Err(Error::InvalidArgument(format!("stretch has {f}, not a number above 0")));
        }
        let (mut vertices, faces) = self.particle(name)?.mesh(self.segments)?;
        for v in &mut vertices {
            (0..3).for_each(|k| v[k] *= stretch[k]);
        }
        Shape::from_mesh(&vertices, &faces, &import, run)
    }

    fn particle(&self, name: &str) -> Result<Primitive> {
        let mut particle = Primitive::from_name(name)?;
        for (key, value) in self.set {
            particle.set(key, *value)?;
        }
        Ok(particle)
    }

    /// The body by the formulas of its shape.
    fn exact(&self, density: f64) -> Result<Body> {
        let moments = match self.shape {
            Some(name) if self.stretch.is_none() => self.particle(name)?.moments(),
            _ => None,
        };
        let Some(m) = moments else {
            return Err(Error::Unsupported("there are no formulas for its inertia".into()));
        };
        let scale = self.scale;
        let inertia = Inertia::from_matrix(&(m.inertia.matrix() * scale.powi(5)));
        let (volume, centroid) = (m.volume * scale.powi(3), m.centroid * scale);
        Body::of_moments(&Moments { volume, centroid, inertia, ..m }, density)
    }
}

fn from_file(file: &Path, import: &ImportOptions, run: &Run) -> Result<Shape> {
    use crate::shape::read::FileOptions;
    let options = FileOptions { import: import.clone(), ..FileOptions::default() };
    Shape::from_file(file, &options, run)
}
