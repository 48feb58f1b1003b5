//! How a shape is cut, as it is typed or as a file has it.

use crate::fail::{Done, Fail};
use crate::input;
use crate::input::parse::{finite, numbers, whole};
use morula::fragment::Cut;
use morula::generate::HalfSpace;
use morula::math::Vec3;

/// One of them.
#[derive(clap::Args)]
#[group(required = true, multiple = false)]
pub struct How {
    /// Voronoi cells of N points spread evenly over the shape, by --seed
    #[arg(long, value_name = "N", value_parser = whole::<usize>)]
    voronoi: Option<usize>,
    /// Voronoi cells of N points that are the denser the nearer to a hit at x,y,z along dx,dy,dz,
    /// by --seed
    #[arg(long, value_name = "X,Y,Z,DX,DY,DZ,N", allow_hyphen_values = true, value_parser = impact)]
    impact: Option<([f64; 6], usize)>,
    /// Both sides of each plane of a file, one a line: nx,ny,nz,offset, the plane's points being
    /// those with n · p = offset
    #[arg(long, value_name = "FILE")]
    planes: Option<String>,
    /// Voronoi cells of the points of a file, one a line: x,y,z, or x,y,z,weight for power cells
    /// (a weight is the square of a length)
    #[arg(long, value_name = "FILE")]
    points: Option<String>,
}

impl How {
    /// The file that it is read from.
    pub fn file(&self) -> Option<&str> {
        self.planes.as_deref().or(self.points.as_deref())
    }

    /// What it is called in the figures.
    pub fn name(&self) -> &'static str {
        match (self.voronoi, &self.impact, &self.planes) {
            (Some(_), ..) => "voronoi",
            (_, Some(_), _) => "impact",
            (.., Some(_)) => "planes",
            _ => "points",
        }
    }

    /// The library's.
    pub fn cut(&self) -> Done<Cut> {
        if let Some(count) = self.voronoi {
            return Ok(Cut::Seeded { count });
        }
        if let Some(([x, y, z, dx, dy, dz], count)) = self.impact {
            let (point, direction) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
            return Ok(Cut::Impact { point, direction, count });
        }
        if let Some(path) = &self.planes {
            let rows = rows(path, &[4], "nx,ny,nz,offset")?;
            let plane = |r: &[f64]| HalfSpace { normal: xyz(r), offset: r[3] };
            return Ok(Cut::Planes(rows.iter().map(|r| plane(r)).collect()));
        }
        let path = self.points.as_deref().unwrap_or_default();
        let rows = rows(path, &[3, 4], "x,y,z or x,y,z,weight")?;
        let points = rows.iter().map(|r| xyz(r)).collect();
        Ok(Cut::Points { points, weights: rows.iter().filter_map(|r| r.get(3).copied()).collect() })
    }
}

fn xyz(row: &[f64]) -> Vec3 {
    Vec3::new(row[0], row[1], row[2])
}

/// Six numbers and a count.
fn impact(text: &str) -> Result<([f64; 6], usize), String> {
    let (six, count) = text.rsplit_once(',').unwrap_or((text, ""));
    Ok((numbers::<6>(six)?, whole::<usize>(count.trim())?))
}

/// The lines of a file of numbers with commas or blanks between them; lines that are empty or begin
/// with #, and names of columns in the first, are left out. All have as many numbers as the first.
fn rows(path: &str, counts: &[usize], form: &str) -> Done<Vec<Vec<f64>>> {
    let path = input::file(path)?;
    let text = std::fs::read_to_string(path).map_err(|e| Fail::file(path, e))?;
    let said = |line: usize, what: &str| Fail::Library {
        error: morula::Error::Format(format!("line {}: {what}", line + 1)),
        about: path.display().to_string(),
    };
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut first = true;
    for (i, line) in text.lines().enumerate() {
        let words = line.split(|c: char| c == ',' || c.is_whitespace());
        let words: Vec<&str> = words.filter(|w| !w.is_empty()).collect();
        if words.is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let names = words.iter().all(|w| w.parse::<f64>().is_err());
        if std::mem::take(&mut first) && names {
            continue;
        }
        let row = words.iter().map(|w| finite(w)).collect::<Result<Vec<_>, _>>();
        let row = row.map_err(|e| said(i, &e))?;
        if !counts.contains(&row.len()) || rows.first().is_some_and(|r| r.len() != row.len()) {
            return Err(said(i, &format!("{} numbers, not {form} as all lines", row.len())));
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Err(said(0, &format!("no line of the form {form}")));
    }
    Ok(rows)
}
