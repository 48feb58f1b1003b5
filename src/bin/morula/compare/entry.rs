//! What is compared: a method and how long it looks, and what came of it.

use crate::cpu;
use crate::fail::{About, Done, Fail};
use clap::ValueEnum;
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::measure::{Quality, QualityOptions, quality};
use morula::{Clump, Run, Solid};
use std::time::Instant;

/// A method with its effort.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Entry {
    /// Local maxima of the distance transform
    Mss,
    /// Method best, effort draft
    BestDraft,
    /// Method best, effort normal
    Best,
    /// Method best, effort thorough
    BestThorough,
    /// Most coverage with no sphere beyond the surface
    Inscribed,
    /// Medial balls by greedy set cover
    Cover,
    /// Spheres fitted to the surface; in a number of their own, at most N
    SurfaceFit,
    /// The greatest ball in what is left, again and again
    Euclidean,
    /// The greatest balls that touch the surface at its points
    #[value(name = "ferellec-mcdowell")]
    FerellecMcDowell,
    /// Balls about the axis of a body of revolution
    Favier,
    /// Balls about the cells of the grid
    UniformGrid,
    /// Equal spheres that do not overlap
    Packed,
}

impl Entry {
    /// All of them, in the order of the table; those that take seconds if they are wanted.
    pub fn all(thorough: bool) -> Vec<Entry> {
        let slow = |e: &Entry| *e == Entry::BestThorough;
        Entry::value_variants().iter().copied().filter(|e| thorough || !slow(e)).collect()
    }

    /// As it is typed and printed.
    pub fn name(self) -> String {
        self.to_possible_value().map_or(String::new(), |v| v.get_name().to_string())
    }

    /// What the library is asked for.
    pub fn options(self, spheres: usize) -> GenerateOptions {
        let (method, effort) = match self {
            Entry::Mss => (Method::Mss, Effort::Normal),
            Entry::BestDraft => (Method::Best, Effort::Draft),
            Entry::Best => (Method::Best, Effort::Normal),
            Entry::BestThorough => (Method::Best, Effort::Thorough),
            Entry::Inscribed => (Method::Inscribed, Effort::Normal),
            Entry::Cover => (Method::Cover, Effort::Normal),
            Entry::SurfaceFit => (Method::SurfaceFit, Effort::Normal),
            Entry::Euclidean => (Method::Euclidean, Effort::Normal),
            Entry::FerellecMcDowell => (Method::FerellecMcDowell, Effort::Normal),
            Entry::Favier => (Method::Favier, Effort::Normal),
            Entry::UniformGrid => (Method::UniformGrid, Effort::Normal),
            Entry::Packed => (Method::Packed, Effort::Normal),
        };
        GenerateOptions { method, effort, spheres, ..GenerateOptions::default() }
    }
}

/// A line of the table.
pub struct Row {
    pub entry: Entry,
    /// How many spheres were asked for.
    pub asked: usize,
    pub made: Done<Made>,
}

/// A clump, how good it is and what it took.
pub struct Made {
    pub clump: Clump,
    pub quality: Quality,
    /// Of all threads; where the system keeps account of it.
    pub cpu_seconds: Option<f64>,
    pub wall_seconds: f64,
}

impl Row {
    /// Makes the clump and measures it.
    pub fn make(entry: Entry, asked: usize, solid: &Solid, run: &Run) -> Row {
        Row { entry, asked, made: made(&entry.options(asked), solid, run).about("") }
    }

    /// The sentence of a failure.
    pub fn failure(&self) -> Option<String> {
        self.made.as_ref().err().map(Fail::to_string)
    }
}

fn made(options: &GenerateOptions, solid: &Solid, run: &Run) -> morula::Result<Made> {
    let (worked, start) = (cpu::seconds(), Instant::now());
    let clump = generate(solid, options, run)?;
    let wall_seconds = start.elapsed().as_secs_f64();
    let cpu_seconds = cpu::seconds().zip(worked).map(|(after, before)| (after - before).max(0.0));
    let quality = quality(solid, &clump.spheres, &QualityOptions::default(), run)?;
    Ok(Made { clump, quality, cpu_seconds, wall_seconds })
}
