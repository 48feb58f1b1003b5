//! What crosses over many breaks.

use super::breaks::{Random, parent, particles};
use morula::fragment::{CutOptions, Parent, ReclumpOptions, Region, Union, cut, reclump};
use morula::mass::single_precision;
use morula::math::Vec3;
use morula::{Error, Run, Sphere};

/// What crosses: how often, and by how much at most, in parents' sizes; not above 0 is none.
#[derive(Default)]
struct Crossing {
    seen: usize,
    count: usize,
    worst: Option<f64>,
}

impl Crossing {
    fn see(&mut self, by: f64, allowed: f64) {
        self.seen += 1;
        self.count += usize::from(by > allowed);
        self.worst = Some(self.worst.map_or(by, |w| w.max(by)));
    }
}

const WHATS: [&str; 5] = [
    "overlap of siblings",
    "beyond the surface",
    "beyond a cut",
    "beyond the union of the parent's spheres",
    "the same, of points on the sphere",
];
const HOWS: [&str; 3] = ["double", "single asked for", "rounded to single afterwards"];
/// Of so many spheres one is looked at by points.
const MEASURED: usize = 20;

/// How far points on a sphere lie outside all of some others: what the depth in their union is held
/// against, by other means.
fn outside(s: &Sphere, union: &[Sphere]) -> f64 {
    let out = |k: i32| {
        // Spread evenly: turned on by the golden angle from pole to pole.
        let (z, turn) = ((f64::from(k) + 0.5) / 150.0 - 1.0, 2.399_963_229_728_653 * f64::from(k));
        let way = Vec3::new(turn.cos(), turn.sin(), 0.0) * (1.0 - z * z).sqrt() + Vec3::z() * z;
        let p = s.center + way * s.radius;
        union.iter().map(|o| (p - o.center).norm() - o.radius).fold(f64::MAX, f64::min)
    };
    (0..300).map(out).fold(f64::MIN, f64::max)
}

/// Looks at the clumps of one break.
fn look(
    parent: &Parent,
    union: Option<&Union>,
    clumps: &[(&Region, Vec<Sphere>)],
    found: &mut [Crossing; 5],
) {
    let solid = parent.solid();
    let frame = *solid.frame();
    let surface = solid.surface(&Run::serial()).unwrap();
    for (i, (region, spheres)) in clumps.iter().enumerate() {
        let planes = region.half_spaces(&frame);
        for s in spheres {
            for t in clumps[..i].iter().flat_map(|(_, other)| other) {
                let deep = s.radius + t.radius - (s.center - t.center).norm();
                found[0].see(deep / frame.scale, 0.0);
            }
            let unit = frame.sphere_to_unit(s);
            let inside = surface.contains(&unit.center);
            let depth = surface.nearest(&unit.center).distance;
            found[1].see(unit.radius - if inside { depth } else { -depth }, 0.0);
            for p in &planes {
                let out = p.normal.dot(&s.center) + s.radius - p.offset;
                // The offset in the caller's frame is rounded too.
                found[2].see(out / frame.scale, 1e-14 + 4.0 * frame.noise());
            }
            if let Some(union) = union {
                found[3].see(unit.radius - union.depth(&unit.center), 0.0);
                if found[3].seen.is_multiple_of(MEASURED) {
                    found[4].see(outside(&unit, parent.unit_spheres()), 1e-12);
                }
            }
        }
    }
}

pub fn check(breaks: usize) {
    let particles = particles();
    let mut random = Random(2);
    let (mut pieces, mut dust, mut none, mut failed) = (0usize, 0usize, 0usize, 0usize);
    let mut spheres = [0usize; 3];
    let mut found: [[Crossing; 5]; 3] = Default::default();
    for (k, (_, solid)) in particles.iter().enumerate() {
        let parent = parent(solid);
        let around = Union::new(parent.unit_spheres()).unwrap();
        let run = Run::serial();
        for b in (k..breaks).step_by(particles.len()) {
            let made = cut(solid, &random.cut(solid), &CutOptions::default(), &run).unwrap();
            dust += made.dust.len();
            let (n, union) = ([5, 10, 25][b % 3], b % 4 != 0);
            let around = union.then_some(&around);
            for single in [false, true] {
                let options = ReclumpOptions {
                    spheres: n,
                    union,
                    single,
                    quality: false,
                    ..ReclumpOptions::default()
                };
                let mut clumps: Vec<(&Region, Vec<Sphere>)> = Vec::new();
                for region in &made.regions {
                    pieces += 1;
                    match reclump(&parent, region, &options, &run) {
                        Ok(made) => clumps.push((region, made.spheres)),
                        Err(Error::NoSpheres(_)) => none += 1,
                        Err(e) => {
                            failed += 1;
                            println!("{e}");
                        }
                    }
                }
                let count = |clumps: &[(&Region, Vec<Sphere>)]| {
                    clumps.iter().map(|(_, s)| s.len()).sum::<usize>()
                };
                if single {
                    let cast = |s: &Sphere| {
                        let c = s.center.map(|x| f64::from(x as f32));
                        Sphere::new(c, f64::from(s.radius as f32))
                    };
                    clumps.iter_mut().flat_map(|(_, c)| c).for_each(|s| *s = cast(s));
                    spheres[1] += count(&clumps);
                    look(&parent, around, &clumps, &mut found[1]);
                } else {
                    spheres[0] += count(&clumps);
                    look(&parent, around, &clumps, &mut found[0]);
                    for (_, c) in &mut clumps {
                        let of = |v: &[f32; 4]| {
                            let [x, y, z, r] = v.map(f64::from);
                            Sphere::new(Vec3::new(x, y, z), r)
                        };
                        *c = single_precision(c).unwrap_or_default().iter().map(of).collect();
                    }
                    spheres[2] += count(&clumps);
                    look(&parent, around, &clumps, &mut found[2]);
                }
            }
        }
    }
    println!(
        "{breaks} breaks, each in double and single precision: {pieces} pieces, {} and {} spheres, \
         {none} pieces without room for one, {failed} failed, {dust} crumbs; {} spheres after \
         rounding those of double precision. Three breaks of four are held within the union.",
        spheres[0], spheres[1], spheres[2]
    );
    println!();
    println!("| numbers | what | looked at | how often | worst, of the parent's size |");
    println!("| --- | --- | ---: | ---: | ---: |");
    for (how, all) in HOWS.iter().zip(found) {
        for (what, c) in WHATS.iter().zip(all) {
            let worst = c.worst.unwrap_or(0.0);
            println!("| {how} | {what} | {} | {} | {worst:.2e} |", c.seen, c.count);
        }
    }
}
