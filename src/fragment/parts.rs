//! The bodies that a closed surface encloses, and the exact moments of each.
//!
//! Faces that share vertices are one shell, and so are the outline and the holes of a cap. A shell
//! that encloses a negative volume is a cavity of the body around it.

use super::cap::Cap;
use super::clip::{CAP, Surface, View};
use crate::error::{Result, collected, filled, push};
use crate::math::{Moments, Vec3, solid_angle};
use crate::solid::moments::Sums;

/// One body.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub moments: Moments,
    pub lo: Vec3,
    pub hi: Vec3,
    /// A face of the parent that belongs to it, as far as any does: that of which most is there.
    pub anchor: Option<u32>,
}

/// The bodies of a surface, by their first vertices.
#[derive(Debug)]
pub(super) struct Parts {
    pub parts: Vec<Part>,
    /// The body of each vertex.
    of: Vec<u32>,
}

/// A shell while it is summed.
#[derive(Clone)]
struct Shell {
    lo: Vec3,
    hi: Vec3,
    sums: Sums,
    /// Whether it has a face in a plane.
    cut: bool,
    /// A vertex of it.
    vertex: u32,
    /// The body that it belongs to, by its outer shell.
    body: usize,
}

impl Parts {
    /// Of a surface closed by `caps`.
    pub fn of(view: View, caps: &[Cap]) -> Result<Parts> {
        let (mut of, count) = shells(view, caps)?;
        let empty = Shell {
            lo: Vec3::repeat(f64::MAX),
            hi: Vec3::repeat(f64::MIN),
            sums: Sums::default(),
            cut: false,
            vertex: 0,
            body: 0,
        };
        let mut shells = filled("shells of a piece", count, empty)?;
        for (i, (v, &s)) in view.vertices.iter().zip(&of).enumerate() {
            let Some(shell) = shells.get_mut(s as usize) else { continue };
            shell.lo = shell.lo.inf(v);
            shell.hi = shell.hi.sup(v);
            shell.vertex = i as u32;
        }
        integrate(view, caps, &of, &mut shells);
        gather(view, &of, &mut shells)?;
        let mut parts: Vec<Part> = Vec::new();
        let mut number = filled("shells of a piece", count, u32::MAX)?;
        for (i, shell) in shells.iter().enumerate().filter(|(i, s)| s.body == *i) {
            let middle = (shell.lo + shell.hi) * 0.5;
            let mut sums = shell.sums;
            for (j, _) in shells.iter().enumerate().filter(|(j, s)| s.body == i && *j != i) {
                sums.add(&summed(view, caps, &of, j as u32, &middle));
            }
            number[i] = parts.len() as u32;
            let moments = sums.moments(&middle);
            let (lo, hi) = (shell.lo, shell.hi);
            push("bodies of a piece", &mut parts, Part { moments, lo, hi, anchor: None })?;
        }
        for s in &mut of {
            *s = shells.get(*s as usize).map_or(u32::MAX, |shell| number[shell.body]);
        }
        Ok(Parts { parts, of })
    }

    /// The body of a face.
    pub fn body(&self, f: &[u32; 3]) -> u32 {
        self.of.get(f[0] as usize).copied().unwrap_or(u32::MAX)
    }

    /// Finds the face of the parent of which each body has most.
    pub fn find_anchors(&mut self, view: View) -> Result<()> {
        let mut most = filled("bodies of a piece", self.parts.len(), 0.0f64)?;
        for (i, f) in view.faces.iter().enumerate() {
            let (tag, body) = (view.tag(i), self.body(f) as usize);
            if tag & CAP != 0 || body >= self.parts.len() {
                continue;
            }
            let [a, b, c] = view.corners(f);
            let area = (b - a).cross(&(c - a)).norm_squared();
            if area > most[body] || self.parts[body].anchor.is_none() {
                most[body] = area;
                self.parts[body].anchor = Some(tag);
            }
        }
        Ok(())
    }

    /// The faces of one body, or of all but that.
    pub fn triangles<'a>(
        &'a self,
        view: View<'a>,
        body: usize,
        others: bool,
    ) -> impl Iterator<Item = [Vec3; 3]> + Clone + 'a {
        let own = view.faces.iter().filter(move |f| (self.body(f) as usize == body) != others);
        own.map(move |f| view.corners(f))
    }

    /// One body as a surface of its own.
    pub fn extract(&self, view: View, body: usize) -> Result<Surface> {
        let mut out = Surface::default();
        let mut index = filled("vertices of a piece", view.vertices.len(), u32::MAX)?;
        for (i, f) in view.faces.iter().enumerate() {
            if self.body(f) as usize != body {
                continue;
            }
            let mut face = *f;
            for v in &mut face {
                let new = &mut index[*v as usize];
                if *new == u32::MAX {
                    *new = out.vertices.len() as u32;
                    push("vertices of a piece", &mut out.vertices, view.vertices[*v as usize])?;
                }
                *v = *new;
            }
            push("faces of a piece", &mut out.faces, face)?;
            push("faces of a piece", &mut out.tags, view.tag(i))?;
        }
        Ok(out)
    }
}

/// The shell of each vertex, numbered by their first vertices, and their count.
fn shells(view: View, caps: &[Cap]) -> Result<(Vec<u32>, usize)> {
    let n = view.vertices.len();
    let mut up = collected("vertices of a piece", 0..n as u32)?;
    fn root(up: &mut [u32], mut v: u32) -> u32 {
        while up[v as usize] != v {
            let over = up[up[v as usize] as usize];
            up[v as usize] = over;
            v = over;
        }
        v
    }
    fn join(up: &mut [u32], a: u32, b: u32) {
        // Most faces join what is one already.
        if up[a as usize] == up[b as usize] {
            return;
        }
        let (a, b) = (root(up, a), root(up, b));
        up[a.max(b) as usize] = a.min(b);
    }
    for &[a, b, c] in view.faces {
        join(&mut up, a, b);
        join(&mut up, a, c);
    }
    for cap in caps {
        let mut firsts = cap.loops.iter().filter_map(|l| l.first());
        if let Some(&first) = firsts.next() {
            firsts.for_each(|&v| join(&mut up, first, v));
        }
    }
    // Vertices that no face has belong to nothing.
    let mut used = filled("vertices of a piece", n, false)?;
    for v in view.faces.iter().flatten() {
        used[*v as usize] = true;
    }
    let mut count = 0;
    for v in 0..n {
        if !used[v] {
            up[v] = u32::MAX;
        } else if up[v] as usize == v {
            up[v] = count;
            count += 1;
        } else {
            // The lesser ones have their numbers.
            up[v] = up[up[v] as usize];
        }
    }
    Ok((up, count as usize))
}

/// Adds what each face and cap encloses with the middle of its shell's box.
fn integrate(view: View, caps: &[Cap], of: &[u32], shells: &mut [Shell]) {
    // Faces of one shell follow each other: what is read of it stays at hand. By parts, so that the
    // rounding of long sums stays small.
    const TOGETHER: usize = 512;
    let mut at = u32::MAX;
    let (mut sums, mut middle) = (Sums::default(), Vec3::zeros());
    for (i, f) in view.faces.iter().enumerate() {
        let s = of[f[0] as usize];
        if s != at || i % TOGETHER == 0 {
            if let Some(shell) = shells.get_mut(at as usize) {
                shell.sums.add(&sums);
            }
            let Some(shell) = shells.get(s as usize) else { continue };
            (at, sums, middle) = (s, Sums::default(), (shell.lo + shell.hi) * 0.5);
        }
        sums.tetrahedron(view.corners(f).map(|p| p - middle));
        if view.tag(i) & CAP != 0
            && let Some(shell) = shells.get_mut(s as usize)
        {
            shell.cut = true;
        }
    }
    if let Some(shell) = shells.get_mut(at as usize) {
        shell.sums.add(&sums);
    }
    for cap in caps {
        for t in cap.fan() {
            let Some(shell) = shells.get_mut(of[t[0] as usize] as usize) else { continue };
            let middle = (shell.lo + shell.hi) * 0.5;
            shell.sums.tetrahedron(view.corners(&t).map(|p| p - middle));
            shell.cut = true;
        }
    }
}

/// The integrals of one shell about a point.
fn summed(view: View, caps: &[Cap], of: &[u32], shell: u32, about: &Vec3) -> Sums {
    let mut sums = Sums::default();
    let fans = caps.iter().flat_map(Cap::fan);
    let own = |f: &[u32; 3]| of[f[0] as usize] == shell;
    for f in view.faces.iter().copied().chain(fans).filter(own) {
        sums.tetrahedron(view.corners(&f).map(|p| p - about));
    }
    sums
}

/// Puts shells together: a cavity belongs to the smallest outer shell around it, an outer shell
/// within the solid of another to that.
fn gather(view: View, of: &[u32], shells: &mut [Shell]) -> Result<()> {
    let volume = |s: &Shell| s.sums.volume;
    (0..shells.len()).for_each(|i| shells[i].body = i);
    for i in 0..shells.len() {
        let own = volume(&shells[i]);
        // A shell that a plane cuts has the plane's cap as part of itself: no other holds it.
        if own > 0.0 && shells[i].cut || shells.len() == 1 {
            continue;
        }
        let point = view.vertices[shells[i].vertex as usize];
        let mut around = collected(
            "shells of a piece",
            (0..shells.len()).filter(|&j| j != i && holds(&shells[j], &shells[i])),
        )?;
        let mut outer = around.iter().filter(|&&j| volume(&shells[j]) > 0.0);
        if own <= 0.0 && outer.clone().count() == 1 {
            shells[i].body = outer.next().copied().unwrap_or(i);
            continue;
        }
        around.retain(|&j| within(view, of, j as u32, &point));
        around.sort_by(|&a, &b| {
            volume(&shells[a]).abs().total_cmp(&volume(&shells[b]).abs()).then(a.cmp(&b))
        });
        let solid: f64 = around.iter().map(|&j| volume(&shells[j]).signum()).sum();
        let next = around.iter().find(|&&j| volume(&shells[j]) > 0.0);
        if let Some(&j) = next.filter(|_| own <= 0.0 || solid > 0.0) {
            shells[i].body = j;
        } else if own <= 0.0 {
            // Rounding's: to the greatest, so that nothing is lost.
            let by = |a: &usize, b: &usize| volume(&shells[*a]).total_cmp(&volume(&shells[*b]));
            shells[i].body = (0..shells.len()).max_by(by).unwrap_or(i);
        }
    }
    // A filled shell in a filled shell is of the outermost.
    for i in 0..shells.len() {
        for _ in 0..shells.len() {
            let up = shells[i].body;
            if shells[up].body == up {
                break;
            }
            shells[i].body = shells[up].body;
        }
    }
    Ok(())
}

/// Whether the box of `a` holds that of `b`.
fn holds(a: &Shell, b: &Shell) -> bool {
    (0..3).all(|k| a.lo[k] <= b.lo[k] && b.hi[k] <= a.hi[k])
}

/// Whether a shell goes round a point. Its caps are flat and leave no more than half of a turn to
/// the point, so that they need not be seen unless the point lies beyond them, outside of the box.
fn within(view: View, of: &[u32], shell: u32, p: &Vec3) -> bool {
    let own = view.faces.iter().filter(|f| of[f[0] as usize] == shell);
    let turns: f64 = own.map(|f| solid_angle(&view.corners(f), p)).sum();
    turns.abs() > 2.0 * std::f64::consts::PI
}
