//! The picture: D against the number of spheres, the time of generation and the cost of a step.

use super::list::List;
use morula::cost::Point;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::error::Error;

const SIZE: (u32, u32) = (1500, 560);
/// One for each line, told apart by people who do not tell red from green.
pub const COLOURS: [(u8, u8, u8); 13] = [
    (31, 95, 160),
    (230, 126, 34),
    (0, 140, 120),
    (170, 60, 130),
    (110, 110, 110),
    (150, 110, 60),
    (90, 160, 220),
    (200, 60, 60),
    (240, 190, 40),
    (90, 60, 160),
    (120, 170, 60),
    (240, 150, 180),
    (30, 60, 60),
];

type Drawing<T = ()> = Result<T, Box<dyn Error>>;

/// The colour of the line with this number.
pub fn colour(i: usize) -> RGBColor {
    let (r, g, b) = COLOURS[i % COLOURS.len()];
    RGBColor(r, g, b)
}

/// A panel: its title, and what it is drawn against.
type Panel = (&'static str, fn(&Point) -> f64);

/// The whole picture.
pub fn svg(list: &List) -> Drawing<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let root = root.titled(
            &format!("{}: what accuracy costs", list.title),
            ("sans-serif", 22).into_font(),
        )?;
        let panels: [Panel; 3] = [
            ("spheres", |p| p.spheres as f64),
            ("generation time, ms", |p| 1e3 * p.seconds),
            ("cost of a solver's step, in steps with single spheres", |p| p.step_cost),
        ];
        for (i, (area, panel)) in root.split_evenly((1, 3)).iter().zip(panels).enumerate() {
            draw(area, list, panel, i)?;
        }
        root.present()?;
    }
    Ok(text)
}

/// The least and greatest of what is drawn, with room.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (mut low, mut high) = (f64::MAX, 0.0f64);
    for v in values.filter(|v| v.is_finite() && *v > 0.0) {
        (low, high) = (low.min(v), high.max(v));
    }
    if high == 0.0 { [0.1, 1.0] } else { [low / 1.3, high * 1.3] }
}

fn draw(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    list: &List,
    (title, x): Panel,
    number: usize,
) -> Drawing {
    let points = || list.lines.iter().flat_map(|l| &l.curve.points);
    let marks = if number == 0 { &list.marks[..] } else { &[] };
    let across = range(points().map(x).chain(marks.iter().map(|m| m.spheres as f64)));
    let up = range(points().map(|p| p.mismatch).chain(marks.iter().map(|m| m.mismatch)));
    let mut chart =
        ChartBuilder::on(area)
            .margin(14)
            .x_label_area_size(48)
            .y_label_area_size(64)
            .build_cartesian_2d((across[0]..across[1]).log_scale(), (up[0]..up[1]).log_scale())?;
    chart
        .configure_mesh()
        .x_desc(title)
        .y_desc("mismatch D")
        .axis_desc_style(("sans-serif", 17))
        .label_style(("sans-serif", 15))
        .light_line_style(RGBColor(240, 240, 240))
        .bold_line_style(RGBColor(214, 214, 214))
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .draw()?;
    for (i, line) in list.lines.iter().enumerate() {
        let at = || line.curve.points.iter().map(|p| (x(p), p.mismatch.max(1e-9)));
        let stroke = colour(i).stroke_width(2);
        chart
            .draw_series(LineSeries::new(at(), stroke))?
            .label(line.name.clone())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], stroke));
        chart.draw_series(at().map(|p| Circle::new(p, 3, colour(i).filled())))?;
    }
    if let Some(first) = marks.first() {
        let place = |m: &super::papers::Mark| (m.spheres as f64, m.mismatch);
        let cross = |p| Cross::new(p, 6, BLACK.stroke_width(2));
        chart
            .draw_series(marks.iter().map(place).map(cross))?
            .label(format!("{} (stated)", first.what))
            .legend(|(x, y)| Cross::new((x + 11, y), 5, BLACK.stroke_width(2)));
    }
    if number == 0 {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .background_style(WHITE.mix(0.85))
            .border_style(RGBColor(190, 190, 190))
            .label_font(("sans-serif", 15))
            .draw()?;
    }
    Ok(())
}

/// A number as it is read best.
pub fn label(x: &f64) -> String {
    if *x >= 0.001 && *x < 1e6 {
        let digits = (-x.log10().floor()).max(0.0) as usize;
        format!("{x:.digits$}")
    } else {
        format!("{x:.0e}")
    }
}
