//! The options of the method cover.

use crate::input::parse::{not_negative, whole};
use clap::ValueEnum;
use morula::generate::cover::{Candidates, CoverOptions, Ends};

#[derive(clap::Args)]
#[command(next_help_heading = "Method cover")]
pub struct Covering {
    /// Stop when this share of the volume is covered, by the method's own cells
    #[arg(long, value_name = "SHARE", value_parser = not_negative)]
    pub coverage: Option<f64>,
    /// What thinning keeps
    #[arg(long, value_enum, default_value_t = EndsArg::Surface)]
    ends: EndsArg,
    /// Where candidates have their centres
    #[arg(long, value_enum, default_value_t = CandidatesArg::Thinned)]
    candidates: CandidatesArg,
    /// Voxels to be thinned, along the diameter of the sphere of equal volume
    #[arg(long, value_name = "N", default_value_t = CoverOptions::default().thinning_cells,
          value_parser = whole::<u32>)]
    thinning_cells: u32,
    /// Cells to be covered, along the same diameter within the body; half their size at its
    /// surface
    #[arg(long, value_name = "N", default_value_t = CoverOptions::default().cells_inside,
          value_parser = whole::<u32>)]
    cells_inside: u32,
}

#[derive(Clone, Copy, ValueEnum)]
enum EndsArg {
    /// A medial surface
    Surface,
    /// Curves, for shapes about an axis
    Curve,
}

#[derive(Clone, Copy, ValueEnum)]
enum CandidatesArg {
    /// At the voxels of the skeleton
    Thinned,
    /// Touching the vertices of a mesh from within
    Analytic,
}

impl Covering {
    pub fn options(&self) -> CoverOptions {
        CoverOptions {
            ends: match self.ends {
                EndsArg::Surface => Ends::Surface,
                EndsArg::Curve => Ends::Curve,
            },
            candidates: match self.candidates {
                CandidatesArg::Thinned => Candidates::Thinned,
                CandidatesArg::Analytic => Candidates::Analytic,
            },
            thinning_cells: self.thinning_cells,
            cells_inside: self.cells_inside,
        }
    }
}
