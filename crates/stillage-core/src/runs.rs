//! Maximal runs of a sequence, as ranges of indices.

use std::ops::Range;

/// Maximal runs of indices below `count` for which `is_in` holds, ascending.
pub(crate) fn runs_where(count: usize, is_in: impl Fn(usize) -> bool) -> impl Iterator<Item = Range<usize>> {
    let mut next = 0;
    std::iter::from_fn(move || {
        let start = (next..count).find(|&index| is_in(index))?;
        let end = (start + 1..count).find(|&index| !is_in(index)).unwrap_or(count);
        next = end;
        Some(start..end)
    })
}

/// Maximal runs of equal values, ascending; together they cover all values.
pub(crate) fn runs_of_equal<T: PartialEq>(values: &[T]) -> impl Iterator<Item = Range<usize>> {
    let mut next = 0;
    values.chunk_by(PartialEq::eq).map(move |run| {
        let start = next;
        next += run.len();
        start..next
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_as_long_as_they_can_be() {
        let is_set = [true, true, false, true, false, false];
        assert_eq!(runs_where(6, |index| is_set[index]).collect::<Vec<_>>(), [0..2, 3..4]);
        assert_eq!(runs_where(4, |_| true).collect::<Vec<_>>(), [0..4; 1]);
        assert_eq!(runs_where(0, |_| true).count(), 0);
        assert_eq!(runs_of_equal(&is_set).collect::<Vec<_>>(), [0..2, 2..3, 3..4, 4..6]);
        assert_eq!(runs_of_equal::<bool>(&[]).count(), 0);
    }
}
