/// A format of a DEM code, or a general one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// MercuryDPM: a folder with `Clump/Clump.txt` and `Inertia/{Mass,TOI,PD}.txt`.
    Mercury,
    /// LAMMPS: a molecule template.
    Lammps,
    /// LAMMPS: the `infile` of `fix rigid/small`.
    LammpsRigid,
    /// LIGGGHTS: the spheres of `fix particletemplate/multisphere`, and that command beside it (`.in`).
    Liggghts,
    /// YADE: a Python module.
    Yade,
    /// Chrono DEM-Engine: the spheres of `LoadClumpType`, with its numbers as comments.
    Deme,
    /// MFiX: `gsp_config.csv` of glued-sphere particles.
    Mfix,
    /// Kratos: `.clu`.
    Kratos,
    /// PFC: a command file that makes a clump template.
    Pfc,
    /// EDEM: a table of spheres, to be pasted.
    Edem,
    /// A table with the header `x,y,z,r,mass`.
    Csv,
    /// The whole record.
    Json,
    /// VTK: points with radii and masses.
    Vtp,
    /// The surface of the spheres, PLY.
    Ply,
    /// The surface of the spheres, STL.
    Stl,
}

impl Format {
    /// All.
    pub const ALL: [Format; 15] = [
        Format::Mercury,
        Format::Lammps,
        Format::LammpsRigid,
        Format::Liggghts,
        Format::Yade,
        Format::Deme,
        Format::Mfix,
        Format::Kratos,
        Format::Pfc,
        Format::Edem,
        Format::Csv,
        Format::Json,
        Format::Vtp,
        Format::Ply,
        Format::Stl,
    ];

    /// The word of the command line and the C ABI.
    pub fn name(self) -> &'static str {
        match self {
            Format::Mercury => "mercury",
            Format::Lammps => "lammps",
            Format::LammpsRigid => "lammps-rigid",
            Format::Liggghts => "liggghts",
            Format::Yade => "yade",
            Format::Deme => "deme",
            Format::Mfix => "mfix",
            Format::Kratos => "kratos",
            Format::Pfc => "pfc",
            Format::Edem => "edem",
            Format::Csv => "csv",
            Format::Json => "json",
            Format::Vtp => "vtp",
            Format::Ply => "ply",
            Format::Stl => "stl",
        }
    }

    /// The format of that name.
    pub fn from_name(name: &str) -> Option<Format> {
        Format::ALL.into_iter().find(|f| f.name() == name)
    }

    /// Whether its coordinates may be in the caller's frame.
    pub fn can_be_placed(self) -> bool {
        matches!(
            self,
            Format::LammpsRigid
                | Format::Edem
                | Format::Csv
                | Format::Json
                | Format::Vtp
                | Format::Ply
                | Format::Stl
        )
    }
}
