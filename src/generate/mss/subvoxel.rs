//! Local maxima between cell centres (Buchele et al. 2026, equations 11 to 24).

/// Where two lines through four of five equidistant values meet, and the value there: one line
/// through positions −1 and 0, one through 1 and 2 (equations 17 to 21). Lines that are parallel
/// leave the cell centre. The offset is limited to one cell; the value is then that of the
/// lower line.
fn right(e: &[f64; 5]) -> (f64, f64) {
    let [_, before, here, after, far] = *e;
    let (rise, fall) = (here - before, far - after);
    if rise <= fall {
        return (0.0, here);
    }
    let offset = ((after - fall) - here) / (rise - fall);
    let limited = offset.clamp(-1.0, 1.0);
    (limited, (here + rise * limited).min(after + fall * (limited - 1.0)))
}

/// Offset in cells, and value, of the maximum near the middle of five values (equation 22). The
/// paper takes the first pair of lines whose value is greater than the middle one, which holds
/// for exact cones only and breaks mirror symmetry: here the greater of the two counts.
pub(super) fn along_axis(e: &[f64; 5]) -> (f64, f64) {
    let (b, value_b) = right(e);
    let (a, value_a) = right(&[e[4], e[3], e[2], e[1], e[0]]);
    let (offset, value) = if value_a == value_b {
        ((b - a) / 2.0, value_a)
    } else if value_a > value_b {
        (-a, value_a)
    } else {
        (b, value_b)
    };
    // No smaller than the value at the cell centre.
    if value < e[2] { (0.0, e[2]) } else { (offset, value) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn exact_on_cones(peak in -0.5f64..0.5, height in 3.0f64..50.0, left in 0.05f64..1.0, right in 0.05f64..1.0) {
            let cone = |x: f64| height - if x < peak { left * (peak - x) } else { right * (x - peak) };
            let e = [cone(-2.0), cone(-1.0), cone(0.0), cone(1.0), cone(2.0)];
            // The middle value is the greatest of its neighbours, as for a maximum in cells.
            prop_assume!(e[2] >= e[1] && e[2] >= e[3]);
            let (offset, value) = along_axis(&e);
            prop_assert!((offset - peak).abs() < 1e-9);
            prop_assert!((value - height).abs() < 1e-9);
        }

        #[test]
        fn mirror_images_have_mirrored_maxima(e in [0f64..9.0, 0f64..9.0, 9f64..10.0, 0f64..9.0, 0f64..9.0]) {
            let (offset, value) = along_axis(&e);
            let (back, same) = along_axis(&[e[4], e[3], e[2], e[1], e[0]]);
            prop_assert_eq!((offset, value), (-back, same));
            prop_assert!(offset.abs() <= 1.0 && value >= e[2]);
        }
    }

    #[test]
    fn paraboloids_plateaus_and_slopes() {
        // On a paraboloid the lines meet half a cell off the centre, on the side of the peak.
        for t in [-0.4, -0.3, -0.1, 0.1, 0.2, 0.4] {
            let e: [f64; 5] = std::array::from_fn(|n| 30.0 - (n as f64 - 2.0 - t).powi(2));
            let offset = along_axis(&e).0;
            assert!((offset - 0.5 * f64::signum(t)).abs() < 1e-9, "{t}: {offset}");
        }
        assert_eq!(along_axis(&[5.0; 5]), (0.0, 5.0));
        assert_eq!(along_axis(&[3.0, 4.0, 5.0, 5.0, 4.0]), (0.5, 5.5));
        assert_eq!(along_axis(&[4.0, 5.0, 5.0, 4.0, 3.0]), (-0.5, 5.5));
        assert_eq!(along_axis(&[3.0, 4.0, 5.0, 4.0, 3.0]), (0.0, 5.0));
    }
}
