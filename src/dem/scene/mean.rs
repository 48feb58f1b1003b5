//! Means of what a run measures, with an error that knows how long the run remembers.

/// A mean and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Its standard error; `None` of fewer than two values.
    pub error: Option<f64>,
    /// How many values there were.
    pub count: usize,
}

/// Blocks below which their scatter says too little.
const BLOCKS: usize = 6;

/// Mean of values that follow each other in time. They are joined two by two, again and again, while at least six blocks
/// are left; the greatest of the errors that the scatter of the blocks tells is taken (after Flyvbjerg and Petersen 1989,
/// J. Chem. Phys. 91, 461). `None` of no values.
pub fn block_mean(values: &[f64]) -> Option<Mean> {
    let count = values.len();
    if count == 0 {
        return None;
    }
    let mut blocks = values.to_vec();
    let mean = blocks.iter().sum::<f64>() / count as f64;
    let mut error = scatter(&blocks);
    while blocks.len() >= 2 * BLOCKS {
        blocks = blocks.chunks_exact(2).map(|b| 0.5 * b.iter().sum::<f64>()).collect();
        error = error.zip(scatter(&blocks)).map(|(a, b)| a.max(b));
    }
    Some(Mean { mean, error, count })
}

/// Standard error of the mean of independent values.
fn scatter(values: &[f64]) -> Option<f64> {
    let n = values.len() as f64;
    if values.len() < 2 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
    Some((squares / (n - 1.0) / n).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::random::Random;

    #[test]
    fn no_value_one_value_and_equal_values() {
        assert_eq!(block_mean(&[]), None);
        assert_eq!(block_mean(&[3.0]), Some(Mean { mean: 3.0, error: None, count: 1 }));
        assert_eq!(block_mean(&[3.0; 40]), Some(Mean { mean: 3.0, error: Some(0.0), count: 40 }));
    }

    /// Values that remember have a greater error than the same ones shuffled: of x' = ρ x + noise the mean has
    /// √((1 + ρ)/(1 − ρ)) times the error of independent values.
    #[test]
    fn values_that_remember_have_a_greater_error() {
        let mut random = Random::of(&[5]);
        let (mut x, rho) = (0.0, 0.9);
        let values: Vec<f64> = (0..20_000)
            .map(|_| {
                x = rho * x + random.unit() - 0.5;
                x
            })
            .collect();
        let found = block_mean(&values).unwrap().error.unwrap();
        let alone = scatter(&values).unwrap();
        let wanted = ((1.0 + rho) / (1.0 - rho)).sqrt();
        assert!((found / alone / wanted - 1.0).abs() < 0.5, "{} {wanted}", found / alone);
    }
}
