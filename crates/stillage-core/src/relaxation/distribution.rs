//! Distributions over categories: shares of sum 1.

/// Least share of a category in a distribution before the first iteration. A share of 0 would stay 0. No
/// measurement is recorded for this value.
pub(super) const LEAST_SHARE: f32 = 0.01;

/// Largest change of a share in one iteration below which relaxation ends (1e-3 in earlier work on place labelling).
pub(super) const SETTLED: f32 = 1e-3;

/// Entropy of shares, bits.
pub(super) fn entropy(shares: impl Iterator<Item = f32>) -> f64 {
    shares.filter(|&share| share > 0.0).map(|share| f64::from(-share * share.log2())).fold(0.0, |sum, part| sum + part)
}

/// Raises every share to the least one, and the sum to 1.
pub(super) fn soften(shares: &mut [f32]) {
    let sum: f32 = shares.iter().map(|share| share.max(LEAST_SHARE)).sum();
    for share in shares {
        *share = share.max(LEAST_SHARE) / sum;
    }
}

/// The greatest share, the first of equals.
pub(super) fn greatest<T: PartialOrd + Copy>(shares: impl Iterator<Item = T>) -> usize {
    let greatest = shares.enumerate().reduce(|best, other| if other.1 > best.1 { other } else { best });
    greatest.map_or(0, |(category, _)| category)
}
