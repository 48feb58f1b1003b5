//! `morula sample`: the built-in analytic particles as meshes.

use crate::fail::{About, Done, Fail};
use crate::input::parse::whole;
use crate::{input, write};
use morula::error::count;
use morula::shape::Primitive;

#[derive(clap::Args)]
pub struct Args {
    /// Name of the particle (see --list)
    #[arg(required_unless_present = "list")]
    name: Option<String>,
    /// Set a parameter; may be given more than once
    #[arg(long = "set", value_name = "KEY=VALUE", allow_hyphen_values = true)]
    set: Vec<String>,
    /// Which stone, 0 to 2^53: shorthand for --set seed=N
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=1 << 53))]
    seed: Option<u64>,
    /// Edges around the body
    #[arg(long, default_value_t = 64, value_parser = whole::<usize>)]
    segments: usize,
    /// File to write: .stl, .ply, .off or .obj
    #[arg(short, long, value_name = "FILE", required_unless_present = "list")]
    output: Option<String>,
    /// List the particles with their parameters and defaults
    #[arg(long)]
    list: bool,
    /// Print nothing
    #[arg(short, long)]
    quiet: bool,
}

pub fn run(args: &Args) -> Done {
    if args.list {
        return list();
    }
    let (Some(name), Some(output)) = (&args.name, &args.output) else {
        return Err(Fail::Usage("a particle and a file are needed".into()));
    };
    input::keep(&[], output)?;
    let mut particle = Primitive::from_name(name).about("")?;
    for pair in &args.set {
        input::set(&mut particle, pair)?;
    }
    if let Some(seed) = args.seed {
        // Above 2^53 a seed would be rounded: the parser refuses it.
        particle.set("seed", seed as f64).about(name)?;
    }
    let (vertices, faces) = particle.mesh(args.segments).about(name)?;
    write::mesh::write(output, &vertices, &faces)?;
    if args.quiet {
        return Ok(());
    }
    write::to_terminal(|out| {
        let (vertices, faces) = (vertices.len() as u64, faces.len() as u64);
        write!(out, "{output}: {name}, {}, {}", count(vertices, "vertex"), count(faces, "face"))?;
        for p in particle.parameters() {
            write!(out, ", {} {:?}", p.key, p.value)?;
        }
        if let Some(m) = particle.moments() {
            write!(out, "; volume of the ideal body {:?}", m.volume)?;
        }
        writeln!(out)
    })
}

fn list() -> Done {
    write::to_stdout(|out| {
        for name in Primitive::NAMES {
            writeln!(out, "{name}")?;
            if let Ok(particle) = Primitive::from_name(name) {
                for p in particle.parameters() {
                    let set = format!("{}={:?}", p.key, p.value);
                    writeln!(out, "  {set:<24}{}", p.meaning)?;
                }
            }
        }
        Ok(())
    })
}
