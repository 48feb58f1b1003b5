//! Refinement: all balls at once take a Gauss–Newton step towards the place where the exposed
//! surface lies on the target's, in the sense of Huber's loss; its width falls from iteration to
//! iteration, so that least squares of distances become least volume between the surfaces.

use super::limits::Limits;
use super::symmetry::Orbits;
use crate::generate::ball::Ball;
use crate::generate::balls::among::Hiders;
use crate::generate::balls::directions::Directions;
use crate::generate::balls::drawn::Drawn;
use crate::generate::balls::exposed::{Normal, Sampler, Scratch, Weights};
use crate::generate::balls::field::Field;
use crate::generate::balls::near::Near;
use crate::generate::balls::random::Random;
use crate::generate::balls::smooth::Pull;
use crate::run::Pool;
use wide::f32x8;

/// Part of the step that is taken.
const STEP: f64 = 0.8;
/// Part of the last change that is added.
const MOMENTUM: f32 = 0.6;
/// Damping of the normal equations, for each direction.
const DAMPING: f64 = 0.003;
/// Balls worked on together when threads share them.
const CHUNK: usize = 16;
/// Of the mean radius: how far balls may move before lists are made anew. One in so many may be
/// farther off: those are looked at with all balls.
const SLACK: f32 = 0.3;
const LOOSE: usize = 64;

/// How many iterations, and Huber's width at the first and the last.
#[derive(Debug, Clone, Copy)]
pub(super) struct Schedule {
    pub iterations: usize,
    pub from: f32,
    pub to: f32,
}

/// What radii may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Radii {
    pub least: f32,
    pub most: f32,
}

/// What does not change while balls are refined.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub field: &'a Field,
    pub directions: &'a Directions,
    pub weights: Weights,
    pub radii: Radii,
    pub limits: &'a Limits<'a>,
    pub orbits: &'a Orbits<'a>,
    /// What draws balls beside the volumes.
    pub pull: Option<Pull<'a>>,
}

/// Buffers.
#[derive(Debug, Default, Clone)]
pub(super) struct Refiner {
    near: Near,
    scratch: Scratch,
    drawn: Drawn,
    turned: Vec<[f32x8; 3]>,
    /// Change of centre and radius of each ball in the last iteration.
    speed: Vec<[f32; 4]>,
    step: Vec<([f32; 5], Hiders)>,
    /// How far each ball, with its images, may have moved since lists were made, and those that
    /// are not bound by the lists any more.
    path: Vec<f32>,
    loose: Vec<u32>,
    all: Vec<u32>,
    /// Exposed area at the last iteration.
    pub area: f64,
}

impl Refiner {
    /// Bytes of its large arrays.
    pub(super) fn bytes(&self) -> u64 {
        let each = size_of::<([f32; 5], Hiders)>() * self.step.capacity()
            + 16 * self.speed.capacity()
            + 4 * (self.path.capacity() + self.all.capacity());
        self.near.bytes() + self.drawn.bytes() + each as u64
    }

    /// Refines the balls `of`, which lead their orbits; balls of other orbits stay. `pool`: threads that share the balls; the result
    /// does not depend on it. `go` is asked after every iteration whether to go on.
    #[expect(clippy::too_many_arguments)]
    pub(super) fn refine(
        &mut self,
        task: &Task,
        schedule: &Schedule,
        balls: &mut [Ball],
        of: &[u32],
        random: &mut Random,
        pool: Option<&Pool>,
        go: &mut dyn FnMut() -> bool,
    ) {
        let Refiner { near, scratch, drawn, turned, speed, step, path, loose, all, area } = self;
        speed.clear();
        speed.resize(of.len(), [0.0; 4]);
        step.clear();
        step.resize(of.len(), ([0.0; 5], Hiders::default()));
        all.clear();
        all.extend(0..balls.len() as u32);
        let sum: f64 = of.iter().map(|&i| f64::from(balls[i as usize].radius)).sum();
        let slack = SLACK * (sum / of.len().max(1) as f64) as f32;
        if let Some(pull) = &task.pull {
            drawn.begin(pull, balls, of, task.orbits.balls(of));
        }
        // What points draw goes by the lists.
        let bound = if task.pull.is_some() { 0 } else { of.len() / LOOSE };
        let (mut anew, mut moved) = (true, 0.0);
        let shrink = schedule.to / schedule.from;
        for k in 0..schedule.iterations {
            let done = k as f32 / (schedule.iterations.max(2) - 1) as f32;
            let width = schedule.from * shrink.powf(done);
            if anew {
                match task.pull {
                    Some(_) => near.make(balls, of, slack),
                    None => near.short(balls, of, slack),
                }
                path.clear();
                path.resize(of.len(), 0.0);
                loose.clear();
                moved = 0.0;
            }
            task.directions.turned(&random.rotation(), turned);
            if task.pull.is_some() {
                drawn.draw(balls, of, near, anew);
            }
            let sampler =
                Sampler { field: task.field, directions: turned, weights: task.weights, width };
            let one = |k: usize, (step, hiders): &mut ([f32; 5], Hiders), scratch: &mut Scratch| {
                let ball = &balls[of[k] as usize];
                let free = path[k] >= 0.5 * slack || near.all(k);
                let among = if free {
                    [&all[..of[k] as usize], &all[of[k] as usize + 1..]]
                } else {
                    [near.of(k), &loose[..]]
                };
                let mut normal = sampler.normal_among((of[k], balls), among, hiders, scratch);
                if let Some(pull) = &task.pull {
                    let sphere = 4.0 * std::f64::consts::PI * f64::from(ball.radius).powi(2);
                    let area = sphere / task.directions.len() as f64;
                    drawn.add(pull, k, width, area, &mut normal);
                }
                let solve = |n: &Normal| solve(n, DAMPING * task.directions.len() as f64);
                let found = if task.limits.none() {
                    solve(&normal)
                } else {
                    task.limits.step(task.field, ball, &mut normal, solve)
                };
                let [x, y, z, r] =
                    found.map(|x| ((STEP * x) as f32).clamp(-2.0 * width, 2.0 * width));
                let area = ball.radius * ball.radius * normal.exposed as f32;
                *step = [x, y, z, r, area * task.orbits.size(of[k]) as f32];
            };
            match pool {
                Some(pool) => pool.chunks_mut(step, CHUNK, |c, steps| {
                    let mut scratch = Scratch::default();
                    for (k, step) in steps.iter_mut().enumerate() {
                        one(c * CHUNK + k, step, &mut scratch);
                    }
                }),
                None => step.iter_mut().enumerate().for_each(|(k, s)| one(k, s, scratch)),
            }
            loose.clear();
            let mut most = 0.0f32;
            let steps = step.iter().zip(path.iter_mut());
            for ((&i, speed), ((step, _), path)) in of.iter().zip(speed.iter_mut()).zip(steps) {
                let ball = &mut balls[i as usize];
                for (speed, step) in speed.iter_mut().zip(step) {
                    *speed = MOMENTUM * *speed + step;
                }
                task.orbits.hold(i, speed);
                for (x, by) in ball.center.iter_mut().zip(speed.iter()) {
                    *x += by;
                }
                let radius = ball.radius + speed[3];
                ball.radius = radius.max(task.radii.least).min(task.radii.most);
                if ball.radius != radius {
                    speed[3] = 0.0;
                }
                if !task.limits.none() {
                    let free = *ball;
                    task.limits.hold(task.field, &task.radii, ball);
                    for (speed, by) in speed.iter_mut().zip(free.way(ball)) {
                        *speed += by;
                    }
                    speed[3] += ball.radius - free.radius;
                }
                let [x, y, z, r] = *speed;
                let by = (x * x + y * y + z * z).sqrt() + r.abs();
                most = most.max(by);
                *path += by;
                if *path >= 0.5 * slack {
                    loose.extend(task.orbits.balls(&[i]));
                }
            }
            task.orbits.follow(of, balls);
            moved += most;
            anew = moved >= 0.5 * slack && (task.pull.is_some() || loose.len() > bound);
            let sum: f64 = step.iter().map(|s| f64::from(s.0[4])).sum();
            *area = 4.0 * std::f64::consts::PI * sum / task.directions.len() as f64;
            if !go() {
                break;
            }
        }
    }
}

/// `(M + damping · diag(⅓, ⅓, ⅓, 1))⁻¹ b` by Cholesky's method.
pub(super) fn solve(normal: &Normal, damping: f64) -> [f64; 4] {
    let m = &normal.m;
    let d = damping / 3.0;
    let a = [
        [m[0] + d, 0.0, 0.0, 0.0],
        [m[1], m[4] + d, 0.0, 0.0],
        [m[2], m[5], m[7] + d, 0.0],
        [m[3], m[6], m[8], m[9] + damping],
    ];
    let mut l = [[0.0f64; 4]; 4];
    for i in 0..4 {
        for j in 0..=i {
            let sum: f64 = a[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            if i == j {
                // Rounding cannot make it vanish: the damping is a thousandth of the trace.
                l[i][i] = sum.max(1e-3 * d).sqrt();
            } else {
                l[i][j] = sum / l[j][j];
            }
        }
    }
    let mut x = normal.b;
    for i in 0..4 {
        x[i] = (x[i] - (0..i).map(|k| l[i][k] * x[k]).sum::<f64>()) / l[i][i];
    }
    for i in (0..4).rev() {
        x[i] = (x[i] - (i + 1..4).map(|k| l[k][i] * x[k]).sum::<f64>()) / l[i][i];
    }
    x
}
