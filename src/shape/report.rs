//! The report on an input.

/// What was found in an input and what was done about it. Lengths, areas and
/// volumes are in the caller's unit and frame.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Report {
    /// Vertices as handed in.
    pub input_vertices: u64,
    /// Faces (triangles) as handed in, after polygons were cut into triangles.
    pub input_faces: u64,
    /// Vertices after welding; 0 for voxels.
    pub vertices: u64,
    /// Faces kept; 0 for voxels.
    pub faces: u64,
    /// Solid cells; 0 for meshes.
    pub solid_cells: u64,
    /// Connected surface components (meshes) or face-connected bodies (voxels), before the choice of bodies.
    pub components: u64,
    /// Disconnected bodies (a cavity belongs to the body around it), before the choice of bodies.
    pub bodies: u64,
    /// Whether every edge has exactly two faces after repair.
    pub watertight: bool,
    /// Whether neighbouring faces agree in orientation after repair.
    pub oriented: bool,
    /// Whether the whole input was inside out, and was turned.
    pub inverted: bool,
    /// Faces turned by the repair of orientation (not counting a whole inversion).
    pub faces_turned: u64,
    /// Edges with one face, after welding and before the choice of bodies.
    pub boundary_edges: u64,
    /// Edges with more than two faces, after welding and before the choice of bodies.
    pub nonmanifold_edges: u64,
    /// Faces without area, dropped.
    pub degenerate_faces: u64,
    /// Faces present more than once, dropped.
    pub duplicate_faces: u64,
    /// Vertices welded to another.
    pub welded_vertices: u64,
    /// Whether solid cells touch the border of the array (voxels).
    pub touches_border: bool,
    /// Bodies dropped by the choice `Largest`.
    pub bodies_dropped: u64,
    /// Signed volume of the surface after repair: each opening closed by a fan to its middle,
    /// overlapping parts counted as often as they overlap; or of the solid cells.
    ///
    /// Equal to the volume of the moments ([`crate::solid`]) for voxels and for a closed surface
    /// that does not cross itself. Otherwise the two may differ, and that of the moments holds for the
    /// particle: it has lids over the openings, and where none can be it integrates where the winding
    /// number is above ½, with a stated error.
    pub volume: f64,
    /// Surface area, or area of the cells' outer faces.
    pub area: f64,
    /// Lower corner of the bounding box.
    pub box_min: [f64; 3],
    /// Upper corner of the bounding box.
    pub box_max: [f64; 3],
    /// The length unit that was applied to the coordinates.
    pub length_unit: f64,
    /// Threshold used on a grey volume (Otsu's, or the caller's); 0 when none was.
    pub threshold: f64,
    /// How many different values a volume holds that was cut by Otsu's threshold unasked although
    /// its values may be labels: whole numbers, at most 64 different ones. 0 for all others.
    pub label_like: u64,
    /// One sentence for each thing a user should know; empty when all is well.
    pub notes: Vec<String>,
}
