//! A clump that a file holds, and the target that it is held against.

use crate::clump::Frame;
use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::input::{self, Fineness, Reading};
use morula::export::read::{Template, read};
use morula::{Run, Shape, Solid};

/// How both are read, and how hard to work.
#[derive(clap::Args)]
pub struct Given {
    /// Frame that the clump's spheres are given in [default: what the file says, else input]
    #[arg(long, value_enum)]
    frame: Option<Frame>,
    /// Threads; 0: all cores
    #[arg(long, default_value_t = 0, value_parser = whole::<usize>)]
    pub threads: usize,
    /// No progress bar
    #[arg(short, long)]
    pub quiet: bool,
    #[command(flatten)]
    fineness: Fineness,
    #[command(flatten)]
    reading: Reading,
}

impl Given {
    /// The clump of a file, and the frame of its spheres: as a flag says, as the file says, else the
    /// input's.
    pub fn clump(&self, path: &str) -> Done<(Template, Frame)> {
        let template = read(input::file(path)?).about(path)?;
        let said = template.body_frame.map(|body| if body { Frame::Body } else { Frame::Input });
        match (self.frame, said) {
            (Some(flag), Some(said)) if flag != said => Err(Fail::Usage(format!(
                "{path} says that its spheres are in the frame {}, --frame says otherwise",
                said.name()
            ))),
            (flag, said) => Ok((template, flag.or(said).unwrap_or(Frame::Input))),
        }
    }

    /// The target, with the clump's spheres brought into its frame.
    pub fn target(
        &self,
        input: &str,
        (template, frame): (&mut Template, Frame),
        run: &Run,
    ) -> Done<(Shape, Solid)> {
        self.reading.seed_is_of_stone(input)?;
        let shape = self.reading.shape(input, run)?;
        let solid = self.fineness.solid(&shape, input, &self.reading, run)?;
        if frame == Frame::Body {
            let (frame, axes) = (solid.frame(), solid.principal().axes);
            for s in &mut template.spheres {
                let unit = axes * s.center / frame.scale + solid.unit_moments().centroid;
                s.center = frame.to_input(&unit);
            }
        }
        Ok((shape, solid))
    }

    /// Refuses what is said of a target where there is none.
    pub fn unread(&self) -> Done {
        self.reading.unread()?;
        self.fineness.unread()
    }
}
