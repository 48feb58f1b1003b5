//! The transform against every pair of cells.

use super::*;
use proptest::prelude::*;

/// Every pair of cells.
fn brute_force(mask: &[u8], dims: [usize; 3], spacing: [f64; 3]) -> Vec<f32> {
    let [nx, ny, _] = dims;
    let at = |c: usize| [c % nx, c / nx % ny, c / nx / ny];
    let squared = |c: usize, b: usize| {
        let (c, b) = (at(c), at(b));
        if spacing[0] == spacing[1] && spacing[1] == spacing[2] {
            let n: usize = (0..3).map(|a| c[a].abs_diff(b[a]).pow(2)).sum();
            n as f64 * (spacing[0] * spacing[0])
        } else {
            (0..3).map(|a| (c[a].abs_diff(b[a]) as f64 * spacing[a]).powi(2)).sum()
        }
    };
    let diagonal: f64 = (0..3).map(|a| (dims[a] as f64 * spacing[a]).powi(2)).sum();
    (0..mask.len())
        .map(|c| {
            (0..mask.len())
                .filter(|&b| mask[b] == 0)
                .map(|b| if mask[c] == 0 { 0.0 } else { squared(c, b) })
                .min_by(f64::total_cmp)
                .unwrap_or(diagonal) as f32
        })
        .collect()
}

fn masks() -> impl Strategy<Value = (Vec<u8>, [usize; 3])> {
    ([1usize..12, 1usize..12, 1usize..12], 0u32..=100).prop_flat_map(|(dims, percent)| {
        let cell = (0u32..100).prop_map(move |v| u8::from(v < percent) * 7);
        (prop::collection::vec(cell, dims.iter().product::<usize>()), Just(dims))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn equal_spacing_is_bit_for_bit((mask, dims) in masks(), h in 0.001f64..10.0) {
        let d = squared_distance(&mask, dims, [h; 3], &Pool::serial()).unwrap();
        prop_assert_eq!(d, brute_force(&mask, dims, [h; 3]));
    }

    #[test]
    fn unequal_spacing_is_within_one_ulp(
        (mask, dims) in masks(),
        spacing in [0.1f64..3.0, 0.1f64..3.0, 0.1f64..3.0],
    ) {
        let d = squared_distance(&mask, dims, spacing, &Pool::serial()).unwrap();
        for (c, (a, b)) in d.iter().zip(brute_force(&mask, dims, spacing)).enumerate() {
            prop_assert!(a.to_bits().abs_diff(b.to_bits()) <= 1, "cell {c}: {a} and {b}");
        }
    }

    #[test]
    fn steps_lead_to_the_nearest_background((mask, dims) in masks()) {
        let spacing = [0.7, 1.0, 1.9];
        let metric = Metric::new(dims, spacing).unwrap();
        let mut out = Vec::new();
        transform::<true>(&mask, false, dims, &metric, &Pool::serial(), &mut out,
            &mut Scratch::default(), |squared, to| match squared {
                Some(_) => (0..3).map(|a| (to[a] as f64 * spacing[a]).powi(2)).sum::<f64>() as f32,
                None => metric.diagonal_squared as f32,
            }).unwrap();
        for (c, (a, b)) in out.iter().zip(brute_force(&mask, dims, spacing)).enumerate() {
            prop_assert!((a - b).abs() <= 1e-6 * b, "cell {c}: {a} and {b}");
        }
    }
}

#[test]
fn one_background_cell_far_away() {
    let n = 4096;
    let mut mask = vec![1; 2 * n];
    mask[0] = 0;
    let d = squared_distance(&mask, [n, 1, 2], [1.0; 3], &Pool::serial()).unwrap();
    assert_eq!(d[n - 1], (4095.0f32).powi(2));
    assert_eq!(d[2 * n - 1], 4095.0f32.powi(2) + 1.0);
    let d = squared_distance(&mask, [2, 1, n], [1.0; 3], &Pool::serial()).unwrap();
    assert_eq!(d[2 * n - 1], 4095.0f32.powi(2) + 1.0);
}

#[test]
fn threads_and_used_memory_change_nothing() {
    let dims = [33, 40, 57];
    let mask: Vec<u8> = (0..dims.iter().product())
        .map(|i: usize| u8::from(i.wrapping_mul(2654435761) >> 7 & 15 != 0))
        .collect();
    let spacing = [1.0, 1.5, 0.8];
    let one = squared_distance(&mask, dims, spacing, &Pool::serial()).unwrap();
    let mut out = vec![9.0; 1000];
    let mut scratch = Scratch { steps: vec![5; 9] };
    for threads in [1, 2, 8] {
        let pool = Pool::new(threads).unwrap();
        squared_distance_into(&mask, dims, spacing, &pool, &mut out, &mut scratch).unwrap();
        assert!(one.iter().zip(&out).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

#[test]
fn bad_input_is_refused() {
    let go = |n: usize, dims, spacing| {
        squared_distance(&vec![1; n], dims, spacing, &Pool::serial()).unwrap_err().status()
    };
    assert_eq!(go(7, [2, 2, 2], [1.0; 3]), 2);
    assert_eq!(go(0, [usize::MAX, 2, 2], [1.0; 3]), 17);
    assert_eq!(go(70000, [70000, 1, 1], [1.0; 3]), 17);
    assert_eq!(go(8, [2, 2, 2], [1.0, f64::NAN, 1.0]), 2);
    assert_eq!(go(8, [2, 2, 2], [1.0, 0.0, 1.0]), 2);
    assert!(squared_distance(&[], [0, 3, 3], [1.0; 3], &Pool::serial()).unwrap().is_empty());
    assert!(squared_distance(&[], [65000, 65000, 0], [1.0; 3], &Pool::serial()).is_ok());
}
