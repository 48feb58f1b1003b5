//! The names of methods and efforts.

use clap::ValueEnum;
use morula::generate::{Effort, Method};

#[derive(Clone, Copy, ValueEnum)]
pub enum MethodArg {
    /// Local maxima of the distance transform (paper of Buchele, Pöschel and Müller)
    Mss,
    /// Least mismatch for the number of spheres
    Best,
    /// Spheres fitted to the surface (paper of Price, Murariu and Morrison); finds its own number
    SurfaceFit,
    /// Most coverage with no sphere beyond the surface
    Inscribed,
    /// Largest inscribed spheres by thinning and greedy set cover (paper of Yuan): none reaches
    /// beyond the surface
    Cover,
    /// Equal spheres (within 5 %) that do not overlap, within the surface, for bodies that break;
    /// they cover about half of the volume
    Packed,
    /// The greatest ball in what is left, again and again (CLUMP)
    Euclidean,
    /// The greatest balls that touch the surface from inside at its points
    #[value(name = "ferellec-mcdowell")]
    FerellecMcDowell,
    /// Balls about the axis of a body of revolution
    Favier,
    /// Balls about the cells of the grid, those that cover most first (Garcia; Li, Xu and Meng)
    UniformGrid,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum EffortArg {
    /// Milliseconds
    Draft,
    /// About a tenth of a second for a hundred spheres
    Normal,
    /// Seconds
    Thorough,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Method {
        match method {
            MethodArg::Mss => Method::Mss,
            MethodArg::Best => Method::Best,
            MethodArg::SurfaceFit => Method::SurfaceFit,
            MethodArg::Inscribed => Method::Inscribed,
            MethodArg::Cover => Method::Cover,
            MethodArg::Packed => Method::Packed,
            MethodArg::Euclidean => Method::Euclidean,
            MethodArg::FerellecMcDowell => Method::FerellecMcDowell,
            MethodArg::Favier => Method::Favier,
            MethodArg::UniformGrid => Method::UniformGrid,
        }
    }
}

impl From<EffortArg> for Effort {
    fn from(effort: EffortArg) -> Effort {
        match effort {
            EffortArg::Draft => Effort::Draft,
            EffortArg::Normal => Effort::Normal,
            EffortArg::Thorough => Effort::Thorough,
        }
    }
}
