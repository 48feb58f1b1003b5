//! What crosses over many breaks.

use super::breaks::{Random, parent, particles};
use morula::fragment::{CutOptions, ReclumpOptions, cut, reclump};
use morula::mass::single_precision;
use morula::math::Vec3;
use morula::{Error, Run, Sphere};

/// What crosses: how often, and by how much at most, in parents' sizes; not above 0 is none.
#[derive(Default)]
struct Crossing {
    name: &'static str,
    count: usize,
    worst: Option<f64>,
}

impl Crossing {
    fn see(&mut self, by: f64, allowed: f64) {
        self.count += usize::from(by > allowed);
        self.worst = Some(self.worst.map_or(by, |w| w.max(by)));
    }
}

pub fn check(breaks: usize) {
    let particles = particles();
    let mut random = Random(2);
    let (mut pieces, mut spheres, mut dust, mut none) = (0usize, 0usize, 0usize, 0usize);
    let mut found = [
        "overlap of siblings",
        "protrusion",
        "beyond a cut",
        "overlap, as numbers of single precision",
        "overlap, rounded within",
    ]
    .map(|name| Crossing { name, ..Crossing::default() });
    for (k, (_, solid)) in particles.iter().enumerate() {
        let parent = parent(solid);
        let run = Run::serial();
        let frame = *solid.frame();
        let surface = solid.surface(&run).unwrap();
        for b in (k..breaks).step_by(particles.len()) {
            let made = cut(solid, &random.cut(solid), &CutOptions::default(), &run).unwrap();
            dust += made.dust.len();
            let (n, union) = ([5, 10, 25][b % 3], b % 2 == 0);
            for single in [false, true] {
                let options = ReclumpOptions {
                    spheres: n,
                    union,
                    single,
                    quality: false,
                    ..ReclumpOptions::default()
                };
                let mut clumps: Vec<Vec<Sphere>> = Vec::new();
                for region in &made.regions {
                    pieces += 1;
                    match reclump(&parent, region, &options, &run) {
                        Ok(made) => clumps.push(made.spheres),
                        Err(Error::NoSpheres(_)) => {
                            none += 1;
                            continue;
                        }
                        Err(e) => {
                            println!("{e}");
                            continue;
                        }
                    }
                    let planes = region.half_spaces(&frame);
                    let Some(last) = clumps.last() else { continue };
                    for s in last {
                        spheres += 1;
                        let unit = frame.sphere_to_unit(s);
                        let inside = surface.contains(&unit.center);
                        let depth = surface.nearest(&unit.center).distance;
                        let depth = if inside { depth } else { -depth };
                        found[1].see(unit.radius - depth, 0.0);
                        for p in &planes {
                            let out = p.normal.dot(&s.center) + s.radius - p.offset;
                            // The offset in the caller's frame is rounded too.
                            found[2].see(out / frame.scale, 1e-14 + 4.0 * frame.noise());
                        }
                    }
                }
                let mut overlaps = |clumps: &[Vec<Sphere>], which: usize| {
                    for (i, a) in clumps.iter().enumerate() {
                        for (s, t) in
                            a.iter().flat_map(|s| clumps[..i].iter().flatten().map(move |t| (s, t)))
                        {
                            let deep = s.radius + t.radius - (s.center - t.center).norm();
                            found[which].see(deep / frame.scale, 0.0);
                        }
                    }
                };
                if single {
                    let cast = |s: &Sphere| {
                        let c = s.center.map(|x| f64::from(x as f32));
                        Sphere::new(c, f64::from(s.radius as f32))
                    };
                    let cast: Vec<Vec<Sphere>> =
                        clumps.iter().map(|c| c.iter().map(cast).collect()).collect();
                    overlaps(&cast, 3);
                } else {
                    let within = |c: &Vec<Sphere>| -> Vec<Sphere> {
                        let of = |v: &[f32; 4]| {
                            let [x, y, z, r] = v.map(f64::from);
                            Sphere::new(Vec3::new(x, y, z), r)
                        };
                        single_precision(c).unwrap_or_default().iter().map(of).collect()
                    };
                    let within: Vec<Vec<Sphere>> = clumps.iter().map(within).collect();
                    overlaps(&clumps, 0);
                    overlaps(&within, 4);
                }
            }
        }
    }
    println!(
        "{breaks} breaks, each in double and single precision: {pieces} pieces, {spheres} spheres, \
         {none} pieces without room for one, {dust} crumbs"
    );
    println!("| what | how often | worst, of the parent's size |");
    println!("| --- | ---: | ---: |");
    for c in found {
        println!("| {} | {} | {:.2e} |", c.name, c.count, c.worst.unwrap_or(0.0));
    }
}
