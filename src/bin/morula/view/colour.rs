//! Colours of the picture and the scale of the surface error.

use super::canvas::{Rgb, mix, srgb};

/// A plain body.
pub fn body() -> Rgb {
    srgb(206, 196, 178)
}

/// One of many things, told from those of the numbers before and after.
pub fn of_number(i: usize) -> Rgb {
    // Hues a golden angle apart; each third one lighter.
    let hue = (0.56 + 0.618_034 * i as f32).fract();
    let (low, high) = [(96.0, 206.0), (74.0, 176.0), (140.0, 226.0)][i % 3];
    let part = |shift: f32| {
        let t = ((hue + shift).fract() * 6.0 - 3.0).abs() - 1.0;
        (low + (high - low) * t.clamp(0.0, 1.0)) as u8
    };
    srgb(part(0.0), part(2.0 / 3.0), part(1.0 / 3.0))
}

/// What is read first.
pub fn dark() -> Rgb {
    srgb(28, 30, 36)
}

/// What is read second.
pub fn soft() -> Rgb {
    srgb(96, 100, 110)
}

/// Blue below zero (the clump stays inside the surface), light grey at zero,
/// red above (it reaches beyond); `t` in [−1, 1].
pub fn diverging(t: f32) -> Rgb {
    let stops = [
        srgb(24, 50, 120),
        srgb(58, 118, 186),
        srgb(150, 194, 224),
        srgb(236, 236, 232),
        srgb(244, 176, 138),
        srgb(206, 84, 68),
        srgb(122, 14, 38),
    ];
    let x = (t.clamp(-1.0, 1.0) + 1.0) * 3.0;
    let i = (x as usize).min(5);
    mix(stops[i], stops[i + 1], x - i as f32)
}

/// The least of 1, 2, 3, 5 × 10^k at or above `x`.
pub fn round_up(x: f64) -> f64 {
    if !(x.is_finite() && x > 0.0) {
        return 1.0;
    }
    let power = 10f64.powi(x.log10().floor() as i32);
    for step in [1.0, 2.0, 3.0, 5.0] {
        if step * power >= x * (1.0 - 1e-9) {
            return step * power;
        }
    }
    10.0 * power
}

/// A number with two or three digits, plain.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = (1.0 - x.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        text
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round_and_cover() {
        for (x, up) in [(0.3, 0.3), (0.31, 0.5), (1.2, 2.0), (7.0, 10.0), (2e-4, 2e-4), (0.0, 1.0)]
        {
            assert!((round_up(x) - up).abs() < 1e-12, "{x} {}", round_up(x));
        }
        assert_eq!(short(0.5), "0.5");
        assert_eq!(short(-12.0), "\u{2212}12");
        assert_eq!(short(1.25), "1.2");
    }

    #[test]
    fn the_middle_is_neutral_and_the_ends_differ() {
        let [r, g, b] = diverging(0.0);
        assert!((r - g).abs() < 0.02 && (g - b).abs() < 0.05);
        assert!(diverging(-1.0)[2] > diverging(-1.0)[0]);
        assert!(diverging(1.0)[0] > diverging(1.0)[2]);
    }
}
