//! Means with intervals.

/// A mean over all runs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Half of its 95 % interval.
    pub half: f64,
}

impl Mean {
    /// The mean of these values.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        let mean = values.clone().sum::<f64>() / count;
        let variance = values.map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0).max(1.0);
        Self { mean, half: 1.959_964 * (variance / count).sqrt() }
    }
}

/// Wilson's 95 % interval of a share.
pub fn wilson(right: usize, all: usize) -> (f64, f64) {
    if all == 0 {
        return (0.0, 1.0);
    }
    let (n, z) = (all as f64, 1.959_964);
    let p = right as f64 / n;
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    // Rounding must not lead outside 0 to 1.
    (((middle - half) / whole).max(0.0), ((middle + half) / whole).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::wilson;

    #[test]
    fn the_interval_of_a_share_is_of_shares() {
        for all in 0..2_000 {
            let ((least, _), (_, most)) = (wilson(0, all), wilson(all, all));
            assert!(least >= 0.0 && most <= 1.0, "of {all}: {least}, {most}");
        }
    }
}
