//! LIGGGHTS: `x y z r` a line, and beside it the command that reads it with the body's own mass and inertia
//! (`use_density`: the volume is mass over density, nothing is drawn at random).

use super::{Place, Record, table};

pub(super) fn files(r: &Record) -> Vec<(Place, String)> {
    let spheres = table::bare(&r.spheres, " ");
    let [a, b, c] = r.moments;
    let command = format!(
        "# {}: set clump_file to the file of spheres, clump_type to the number of the template\n\
         fix clump all particletemplate/multisphere 15485863 atom_type 1 volume_limit 1e-300 \
         density constant {:?} nspheres {} ntry 1000000 spheres file ${{clump_file}} scale 1.0 \
         type ${{clump_type}} mass {:?} inertia_tensor {a:?} 0.0 0.0 {b:?} 0.0 {c:?} use_density\n",
        r.title(),
        r.density(),
        r.spheres.len(),
        r.mass
    );
    vec![(Place::At, spheres), (Place::Beside("in"), command)]
}
