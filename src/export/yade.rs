//! YADE: a Python module with the spheres, and a function that makes a clump of them.
//!
//! YADE adds up whole spheres of their materials' densities (38 % too heavy on a clump of three), or
//! counts cells of a grid, which is as slow as it is fine. Here each sphere has a material of its
//! own, with the density that gives it its corrected mass, and the sum is the body's; where no masses
//! have its inertia, the moments are set after.

use super::Record;
use std::fmt::Write;

pub(super) fn script(r: &Record) -> String {
    let mut out = format!(
        "\"\"\"{}: clump of {} spheres, centre of mass at the origin, principal axes.\n\n\
         x, y, z, r, mass of each; the whole body's mass and principal moments.\n\"\"\"\n",
        r.name.replace('\\', "/").replace('"', "'"),
        r.spheres.len()
    );
    out.push_str("spheres = [\n");
    for (s, m) in r.spheres.iter().zip(&r.masses) {
        let c = &s.center;
        let _ = writeln!(out, "    ({:?}, {:?}, {:?}, {:?}, {m:?}),", c.x, c.y, c.z, s.radius);
    }
    let [a, b, c] = r.moments;
    let _ = write!(
        out,
        "]\nmass = {:?}\nmoments = ({a:?}, {b:?}, {c:?})\nvolume = {:?}\n{}",
        r.mass, r.volume, APPEND
    );
    out
}

/// A material for each sphere, made once for each material that is asked for.
const APPEND: &str = r#"
_materials = {}


def append(material, position=(0, 0, 0), orientation=None, color=None):
    """Appends the clump, turned by a Quaternion, with copies of a material of the simulation that
    differ in density alone. Returns the clump's id and those of its spheres."""
    import itertools
    import math
    from yade import Omega, utils
    from yade.minieigenHP import Quaternion, Vector3
    simulation = Omega()
    key = (id(simulation.bodies), material)
    numbers = _materials.get(key)
    if numbers is None:
        like = simulation.materials[material]
        numbers = []
        for _, _, _, r, m in spheres:
            own = like.dict()
            own.update(density=m / (4 / 3 * math.pi * r ** 3), id=-1, label="")
            numbers.append(simulation.materials.append(type(like)(**own)))
        _materials[key] = numbers
    turn = orientation if orientation is not None else Quaternion.Identity
    clump, members = simulation.bodies.appendClumped(
        [utils.sphere(Vector3(position) + turn * Vector3(x, y, z), r, material=number, color=color)
         for (x, y, z, r, _), number in zip(spheres, numbers)],
        discretization=0)
    # Few spheres may have no masses with the body's inertia: then its moments are set here, about the
    # spheres' own axes, each for the one that lies nearest.
    state = simulation.bodies[clump].state
    axes = (turn.conjugate() * state.ori).toRotationMatrix()
    order = max(itertools.permutations(range(3)),
                key=lambda order: sum(axes[k, j] ** 2 for j, k in enumerate(order)))
    state.mass = mass
    state.inertia = Vector3(*(moments[k] for k in order))
    return clump, members
"#;
