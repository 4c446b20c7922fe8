//! Which of many rectangles overlap another one.
//!
//! Every rectangle is listed in the square buckets that it touches (a uniform grid, J. Bentley and J. Friedman 1979,
//! doi 10.1145/356789.356797). Cost: O(rectangles + buckets touched) to build, O(buckets touched + rectangles in them)
//! for a question. Rectangles that do not overlap one another and are not much smaller than a bucket, as the places of
//! a site are, leave a few in each.

use super::rect::{Axis, Rect};
use crate::watch::{Stopped, Watch};

/// Side of a bucket, cells: a place of 1.6 m is as long in cells of 0.05 m.
const BUCKET: usize = 32;

/// Rectangles by the buckets that they touch.
pub(crate) struct RectIndex {
    rects: Vec<Rect>,
    /// Columns and rows of buckets.
    size: [usize; 2],
    /// End of the numbers of each bucket in `numbers`, buckets row-major.
    ends: Vec<usize>,
    /// Numbers of rectangles, ascending in each bucket.
    numbers: Vec<u32>,
}

impl RectIndex {
    pub fn of(rects: Vec<Rect>, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let side = |axis: Axis| rects.iter().map(|rect| rect.range(axis).end).max().unwrap_or(0).div_ceil(BUCKET);
        let size = Axis::BOTH.map(side);
        let mut ends = vec![0; size[0] * size[1]];
        for rect in &rects {
            watch.check()?;
            buckets(rect, size).for_each(|bucket| ends[bucket] += 1);
        }
        let mut sum = 0;
        for end in &mut ends {
            // Where the bucket starts; filling it makes that its end.
            sum += std::mem::replace(end, sum);
        }
        let mut numbers = vec![0; sum];
        for (number, rect) in (0..).zip(&rects) {
            watch.check()?;
            for bucket in buckets(rect, size) {
                numbers[ends[bucket]] = number;
                ends[bucket] += 1;
            }
        }
        Ok(Self { rects, size, ends, numbers })
    }

    /// The rectangles, in the order in which they were given.
    pub fn rects(&self) -> &[Rect] {
        &self.rects
    }

    /// Numbers of the rectangles that share a cell with another one, ascending.
    pub fn overlapping(&self, rect: &Rect) -> Vec<usize> {
        let mut found: Vec<usize> = buckets(rect, self.size)
            .flat_map(|bucket| self.of_bucket(bucket).iter().map(move |&number| (bucket, number as usize)))
            .filter(|&(bucket, number)| self.first_shared_bucket(rect, &self.rects[number]) == Some(bucket))
            .map(|(_, number)| number)
            .collect();
        found.sort_unstable();
        found
    }

    fn of_bucket(&self, bucket: usize) -> &[u32] {
        let start = bucket.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.numbers[start..self.ends[bucket]]
    }

    /// The bucket of the lowest cell that two rectangles share, so that each pair is found in one bucket only.
    fn first_shared_bucket(&self, one: &Rect, other: &Rect) -> Option<usize> {
        let [column, row] = Axis::BOTH.map(|axis| {
            let (one, other) = (one.range(axis), other.range(axis));
            let start = one.start.max(other.start);
            (start < one.end.min(other.end)).then_some(start / BUCKET)
        });
        Some(row? * self.size[0] + column?)
    }
}

/// The buckets that a rectangle touches, those beyond the last column and row left out.
fn buckets(rect: &Rect, [columns, rows]: [usize; 2]) -> impl Iterator<Item = usize> + use<> {
    let [across, down] = [(Axis::U, columns), (Axis::V, rows)].map(|(axis, count)| {
        let range = rect.range(axis);
        let end = if range.is_empty() { range.start } else { range.end.div_ceil(BUCKET) };
        range.start / BUCKET..end.min(count)
    });
    down.flat_map(move |row| across.clone().map(move |column| row * columns + column))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rect() -> impl Strategy<Value = Rect> {
        let range = || (0_usize..200, 0_usize..90).prop_map(|(start, length)| start..start + length);
        (range(), range()).prop_map(|(u, v)| Rect { u, v })
    }

    proptest! {
        #[test]
        fn those_that_share_a_cell_are_found(rects in proptest::collection::vec(rect(), 0..40), other in rect()) {
            let shares = |axis: Axis, one: &Rect| {
                one.range(axis).start.max(other.range(axis).start) < one.range(axis).end.min(other.range(axis).end)
            };
            let is_wanted = |&number: &usize| Axis::BOTH.iter().all(|&axis| shares(axis, &rects[number]));
            let wanted: Vec<usize> = (0..rects.len()).filter(is_wanted).collect();
            let index = RectIndex::of(rects.clone(), &Watch::unwatched()).expect("nobody stops it");
            prop_assert_eq!(index.overlapping(&other), wanted);
        }
    }
}
