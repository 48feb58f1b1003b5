//! A clump that a file holds, and the target that it is held against.

use crate::clump::Frame;
use crate::fail::{About, Done, Fail};
use crate::input::{self, Fineness, Reading};
use morula::export::read::{Template, read};
use morula::{Run, Shape, Solid};

/// The clump of a file, and the frame of its spheres: as a flag says, as the file says, else the
/// input's.
pub fn clump(path: &str, flag: Option<Frame>) -> Done<(Template, Frame)> {
    let template = read(input::file(path)?).about(path)?;
    let said = template.body_frame.map(|body| if body { Frame::Body } else { Frame::Input });
    match (flag, said) {
        (Some(flag), Some(said)) if flag != said => Err(Fail::Usage(format!(
            "{path} says that its spheres are in the frame {}, --frame says otherwise",
            said.name()
        ))),
        (flag, said) => Ok((template, flag.or(said).unwrap_or(Frame::Input))),
    }
}

/// The target, with the clump's spheres brought into its frame.
pub fn target(
    input: &str,
    (reading, fineness): (&Reading, &Fineness),
    (template, frame): (&mut Template, Frame),
    run: &Run,
) -> Done<(Shape, Solid)> {
    reading.seed_is_of_stone(input)?;
    let shape = reading.shape(input, run)?;
    let solid = fineness.solid(&shape, input, reading, run)?;
    if frame == Frame::Body {
        let (frame, axes) = (solid.frame(), solid.principal().axes);
        for s in &mut template.spheres {
            let unit = axes * s.center / frame.scale + solid.unit_moments().centroid;
            s.center = frame.to_input(&unit);
        }
    }
    Ok((shape, solid))
}
