//! The picture in the end: pixels, rectangles, text, PNG.

use super::font;
use std::io::Write;

/// Linear RGB in [0, 1].
pub type Rgb = [f32; 3];

/// A colour from its usual 8-bit (sRGB) values.
pub fn srgb(r: u8, g: u8, b: u8) -> Rgb {
    [r, g, b].map(|v| {
        let v = f32::from(v) / 255.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    })
}

/// `a` where `t` = 0, `b` where `t` = 1.
pub fn mix(a: Rgb, b: Rgb, t: f32) -> Rgb {
    [0, 1, 2].map(|i| a[i] + t * (b[i] - a[i]))
}

/// The mean colour of the samples of a pixel that show something.
#[derive(Clone, Copy, Default)]
pub struct Mean {
    sum: Rgb,
    count: f32,
}

impl Mean {
    pub fn add(&mut self, colour: Rgb) {
        for (sum, v) in self.sum.iter_mut().zip(colour) {
            *sum += v;
        }
        self.count += 1.0;
    }
}

/// Where text stands relative to its x.
#[derive(Clone, Copy, PartialEq)]
pub enum Align {
    Left,
    Centre,
}

/// A picture, row by row from the top.
pub struct Canvas {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Rgb>,
}

impl Canvas {
    pub fn new(width: usize, height: usize) -> morula::Result<Canvas> {
        let pixels = morula::error::filled("the picture", width * height, [1.0; 3])?;
        Ok(Canvas { width, height, pixels })
    }

    /// Lays `colour` over a pixel; outside the picture nothing happens.
    pub fn blend(&mut self, x: i64, y: i64, colour: Rgb, alpha: f32) {
        if x >= 0 && y >= 0 && (x as usize) < self.width && (y as usize) < self.height {
            let at = x as usize + self.width * y as usize;
            self.pixels[at] = mix(self.pixels[at], colour, alpha.clamp(0.0, 1.0));
        }
    }

    /// Lays rows of pixels of `samples` samples each over the picture, with the
    /// upper left corner at `corner`.
    pub fn lay(&mut self, corner: [usize; 2], rows: &[Vec<Mean>], samples: usize) {
        for (j, row) in rows.iter().enumerate() {
            for (i, pixel) in row.iter().enumerate().filter(|(_, p)| p.count > 0.0) {
                let colour = pixel.sum.map(|v| v / pixel.count);
                let alpha = pixel.count / samples as f32;
                self.blend((corner[0] + i) as i64, (corner[1] + j) as i64, colour, alpha);
            }
        }
    }

    /// A filled rectangle, corners in pixels.
    pub fn rectangle(&mut self, x: [f32; 2], y: [f32; 2], colour: Rgb) {
        let covered = |i: i64, r: [f32; 2]| {
            ((i as f32 + 1.0).min(r[1]) - (i as f32).max(r[0])).clamp(0.0, 1.0)
        };
        for j in y[0].floor() as i64..y[1].ceil() as i64 {
            for i in x[0].floor() as i64..x[1].ceil() as i64 {
                self.blend(i, j, colour, covered(i, x) * covered(j, y));
            }
        }
    }

    /// A straight stroke with round ends.
    fn stroke(&mut self, a: [f32; 2], b: [f32; 2], half: f32, cover: &mut Cover) {
        let reach = half + 1.0;
        let range = |i: usize| {
            let (lo, hi) = (a[i].min(b[i]) - reach, a[i].max(b[i]) + reach);
            lo.floor() as i64..=hi.ceil() as i64
        };
        let d = [b[0] - a[0], b[1] - a[1]];
        let length2 = d[0] * d[0] + d[1] * d[1];
        for y in range(1) {
            for x in range(0) {
                let p = [x as f32 + 0.5 - a[0], y as f32 + 0.5 - a[1]];
                let t = if length2 > 0.0 { (p[0] * d[0] + p[1] * d[1]) / length2 } else { 0.0 };
                let t = t.clamp(0.0, 1.0);
                let away = (p[0] - t * d[0]).hypot(p[1] - t * d[1]);
                cover.raise(x, y, half + 0.5 - away);
            }
        }
    }

    /// One line of text; `size` is the height of capitals, (`x`, `y`) the baseline.
    pub fn text(&mut self, text: &str, x: f32, y: f32, size: f32, align: Align, colour: Rgb) {
        let unit = size / 6.0;
        let width = text_width(text, size);
        let mut pen = match align {
            Align::Left => x,
            Align::Centre => x - 0.5 * width,
        };
        let half = (0.075 * size).max(0.55);
        let mut cover = Cover::new([pen - size, y - 2.0 * size], [width + 2.0 * size, 3.0 * size]);
        for c in text.chars() {
            let (strokes, advance) = font::glyph(c);
            for stroke in strokes {
                for pair in stroke.windows(2) {
                    let [a, b] = [pair[0], pair[1]].map(|p| [pen + unit * p[0], y - unit * p[1]]);
                    self.stroke(a, b, half, &mut cover);
                }
            }
            pen += unit * (advance + SPACING);
        }
        for j in 0..cover.size[1] {
            for i in 0..cover.size[0] {
                let alpha = cover.alpha[i + cover.size[0] * j];
                if alpha > 0.0 {
                    self.blend(
                        cover.corner[0] + i as i64,
                        cover.corner[1] + j as i64,
                        colour,
                        alpha,
                    );
                }
            }
        }
    }

    /// 8-bit RGB PNG.
    pub fn write_png(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let mut bytes = Vec::with_capacity(3 * self.pixels.len());
        for p in &self.pixels {
            bytes.extend(p.map(|v| {
                let v = v.clamp(0.0, 1.0);
                let v =
                    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
                (255.0 * v + 0.5) as u8
            }));
        }
        let mut encoder = png::Encoder::new(out, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()?;
        Ok(())
    }
}

/// Space between letters, font units.
const SPACING: f32 = 1.6;

/// How wide a line of text is.
pub fn text_width(text: &str, size: f32) -> f32 {
    let units: f32 = text.chars().map(|c| font::glyph(c).1 + SPACING).sum();
    (units - SPACING).max(0.0) * size / 6.0
}

/// How much of each pixel the strokes of one line of text cover, so that
/// strokes that meet do not darken each other.
struct Cover {
    corner: [i64; 2],
    size: [usize; 2],
    alpha: Vec<f32>,
}

impl Cover {
    fn new(corner: [f32; 2], size: [f32; 2]) -> Cover {
        let size = size.map(|s| s.ceil().clamp(0.0, 16384.0) as usize + 1);
        Cover {
            corner: corner.map(|c| c.floor() as i64),
            size,
            alpha: vec![0.0; size[0] * size[1]],
        }
    }

    fn raise(&mut self, x: i64, y: i64, alpha: f32) {
        let (i, j) = (x - self.corner[0], y - self.corner[1]);
        if i >= 0 && j >= 0 && (i as usize) < self.size[0] && (j as usize) < self.size[1] {
            let a = &mut self.alpha[i as usize + self.size[0] * j as usize];
            *a = a.max(alpha.clamp(0.0, 1.0));
        }
    }
}
