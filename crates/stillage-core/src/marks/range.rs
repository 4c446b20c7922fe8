//! Ranges along a direction, metres.

/// Middle of a range.
pub(super) fn middle([low, high]: [f64; 2]) -> f64 {
    f64::midpoint(low, high)
}

/// Length of a range.
pub(super) fn length([low, high]: [f64; 2]) -> f64 {
    high - low
}

/// The value in the middle.
pub(super) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
