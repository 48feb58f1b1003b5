//! How the effects of each scene share the time of a step: one bar a scene.

use super::Shown;
use crate::cost::picture::colour;
use plotters::prelude::*;
use std::error::Error;

/// The effects that any scene measured, in the order in which they come.
pub fn effects(all: &[Shown]) -> Vec<&'static str> {
    let mut named = Vec::new();
    for share in all.iter().flat_map(|s| &s.shares) {
        if !named.contains(&share.name) {
            named.push(share.name);
        }
    }
    named
}

/// The picture.
pub fn svg(all: &[Shown]) -> Result<String, Box<dyn Error>> {
    let named = effects(all);
    let shown: Vec<&Shown> = all.iter().filter(|s| !s.shares.is_empty()).collect();
    let (left, width, row) = (150, 620, 30);
    let high = 40 + row * shown.len() as i32;
    let size = (960, (high + 20).max(60 + 20 * named.len() as i32) as u32);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        let font = ("sans-serif", 15).into_font();
        let title = ("sans-serif", 18).into_font();
        root.draw(&Text::new("Where the time of a step goes", (left, 8), title))?;
        for (k, scene) in shown.iter().enumerate() {
            let top = 36 + row * k as i32;
            root.draw(&Text::new(scene.name.clone(), (8, top + 5), font.clone()))?;
            let mut from = 0.0;
            for share in &scene.shares {
                let at = |part: f64| left + (f64::from(width) * part).round() as i32;
                let ends = [(at(from), top), (at(from + share.part), top + row - 8)];
                let which = named.iter().position(|n| *n == share.name).unwrap_or(0);
                root.draw(&Rectangle::new(ends, colour(which).filled()))?;
                from += share.part;
            }
        }
        for (k, name) in named.iter().enumerate() {
            let (x, y) = (left + width + 20, 36 + 20 * k as i32);
            root.draw(&Rectangle::new([(x, y), (x + 14, y + 14)], colour(k).filled()))?;
            root.draw(&Text::new((*name).to_owned(), (x + 22, y), font.clone()))?;
        }
        root.present()?;
    }
    Ok(text)
}
