//! Pictures of a scene: one panel for each that its file names.

use super::Shown;
use crate::cost::picture::colour;
use crate::sweep::Table;
use morula::dem::scene::shows::PlotPart;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::{Shift, combinators::LogCoord, types::RangedCoordf64};
use plotters::prelude::*;
use std::error::Error;

type Drawing<T = ()> = Result<T, Box<dyn Error>>;
type Points = Vec<(f64, f64)>;

/// All panels, two in a row.
pub fn svg(shown: &Shown) -> Drawing<String> {
    let plots = &shown.file.plots;
    let columns = plots.len().min(2);
    let rows = plots.len().div_ceil(2);
    let size = (700 * columns as u32, 40 + 460 * rows as u32);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        let root = root.titled(&shown.file.title, ("sans-serif", 20).into_font())?;
        for (area, plot) in root.split_evenly((rows, columns)).iter().zip(plots) {
            draw(area, &lines(shown, plot)?, plot)?;
        }
        root.present()?;
    }
    Ok(text)
}

/// The lines of a picture by their names.
fn lines(shown: &Shown, plot: &PlotPart) -> Drawing<Vec<(String, Points)>> {
    if !shown.many {
        let find = |name: &String| {
            let k = shown.table.figures.iter().position(|f| f == name);
            k.ok_or_else(|| format!("a plot names {name}, which is not measured"))
        };
        let (x, y) = (find(&plot.x)?, find(&plot.y)?);
        let points = shown.lines.iter().filter_map(|l| Some(((*l.get(x)?)?, (*l.get(y)?)?)));
        return Ok(vec![(plot.y.clone(), points.collect())]);
    }
    let table: Table = shown.means();
    let apart: Vec<usize> = match &plot.lines {
        Some(names) => {
            let find = |n: &String| {
                let k = table.keys.iter().position(|k| k == n);
                k.ok_or_else(|| format!("a plot names {n}, which nothing sweeps over"))
            };
            names.iter().map(find).collect::<Result<_, _>>()?
        }
        None => (0..table.keys.len()).filter(|k| table.keys[*k] != plot.x).collect(),
    };
    let mut out: Vec<(String, Points)> = Vec::new();
    for row in table.rows.iter().filter(|r| table.is(r, &plot.only)) {
        let name: Vec<&str> = apart.iter().map(|k| row.labels[*k].as_str()).collect();
        let name = name.join(" ");
        let at = table.number(row, &plot.x).zip(table.number(row, &plot.y));
        let Some(at) = at else {
            return Err(format!("a plot of {} over {} finds no numbers", plot.y, plot.x).into());
        };
        match out.iter_mut().find(|l| l.0 == name) {
            Some(line) => line.1.push(at),
            None => out.push((name, vec![at])),
        }
    }
    Ok(out)
}

/// The least and greatest of what is drawn, with room.
fn range(values: impl Iterator<Item = f64>, even: bool) -> [f64; 2] {
    let good = values.filter(|v| v.is_finite() && (even || *v > 0.0));
    let [low, high] = good.fold([f64::MAX, f64::MIN], |[a, b], v| [a.min(v), b.max(v)]);
    if low > high {
        return [0.1, 1.0];
    }
    if even {
        let room = (0.05 * (high - low)).max(1e-9 * high.abs().max(1e-9));
        [low - room, high + room]
    } else {
        [low / 1.2, high * 1.2]
    }
}

/// An axis, even or logarithmic: one type for both.
enum Axis {
    Even(RangedCoordf64),
    Log(LogCoord<f64>),
}

impl Axis {
    fn new([low, high]: [f64; 2], even: bool) -> Axis {
        if even {
            Axis::Even((low..high).into())
        } else {
            Axis::Log((low..high).log_scale().into())
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        match self {
            Axis::Even(a) => a.map(value, limit),
            Axis::Log(a) => a.map(value, limit),
        }
    }

    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        match self {
            Axis::Even(a) => a.key_points(hint),
            Axis::Log(a) => a.key_points(hint),
        }
    }

    fn range(&self) -> std::ops::Range<f64> {
        match self {
            Axis::Even(a) => a.range(),
            Axis::Log(a) => a.range(),
        }
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        tick(*value)
    }
}

/// A number at an axis: four digits, without zeros at its end.
fn tick(v: f64) -> String {
    if v == 0.0 {
        return "0".into();
    }
    let size = v.abs().log10().floor();
    if !(-4.0..5.0).contains(&size) {
        return format!("{v:.1e}").replace(".0e", "e");
    }
    let text = format!("{v:.*}", (3.0 - size).max(0.0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn draw(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    lines: &[(String, Points)],
    plot: &PlotPart,
) -> Drawing {
    let shown = |p: &&(f64, f64)| plot.even || (p.0 > 0.0 && p.1 > 0.0);
    let points = || lines.iter().flat_map(|l| &l.1).filter(shown);
    let across = Axis::new(range(points().map(|p| p.0), plot.even), plot.even);
    let up = Axis::new(range(points().map(|p| p.1), plot.even), plot.even);
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .x_label_area_size(48)
        .y_label_area_size(72)
        .build_cartesian_2d(across, up)?;
    chart
        .configure_mesh()
        .x_desc(plot.x.as_str())
        .y_desc(plot.y.as_str())
        .axis_desc_style(("sans-serif", 17))
        .label_style(("sans-serif", 14))
        .light_line_style(RGBColor(240, 240, 240))
        .bold_line_style(RGBColor(214, 214, 214))
        .draw()?;
    for (i, (name, points)) in lines.iter().enumerate() {
        let stroke = colour(i).stroke_width(2);
        chart
            .draw_series(LineSeries::new(points.iter().filter(shown).copied(), stroke))?
            .label(name.clone())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], stroke));
        if points.len() < 100 {
            let dots = points.iter().filter(shown).map(|p| Circle::new(*p, 3, colour(i).filled()));
            chart.draw_series(dots)?;
        }
    }
    if lines.len() > 1 {
        chart
            .configure_series_labels()
            .background_style(WHITE.mix(0.85))
            .border_style(RGBColor(190, 190, 190))
            .label_font(("sans-serif", 14))
            .draw()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::tick;

    #[test]
    fn numbers_at_an_axis() {
        let read = [0.0, 1e-17, 0.25, 1.2, 10.0, 1000.0, 130.05, -0.5, 0.00125, 2e-7, 3.4e6];
        let said = [
            "0", "1e-17", "0.25", "1.2", "10", "1000", "130.1", "-0.5", "0.00125", "2e-7", "3.4e6",
        ];
        assert_eq!(read.map(tick), said);
    }
}
