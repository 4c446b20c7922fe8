//! Which of many axis-parallel boxes meet a box.

use crate::geometry::{Bounds, Point};

/// Least side of a bucket, metres: a few pallets.
const BUCKET: f64 = 2.0;

/// Most buckets along one axis, so that the memory is bounded for maps of any size.
const MOST_BUCKETS: usize = 1024;

/// Which of many boxes meet a box: a uniform grid of buckets.
///
/// Cost: O(buckets that a box covers) to insert it, O(boxes in the buckets it covers) for a query.
#[derive(Debug)]
pub(super) struct BoxIndex {
    boxes: Vec<Bounds>,
    low: Point,
    /// Side of a bucket by axis, metres.
    side: [f64; 2],
    count: [usize; 2],
    buckets: Vec<Vec<u32>>,
}

impl BoxIndex {
    pub(super) fn new(boxes: Vec<Bounds>) -> Self {
        let corners = boxes.iter().filter(|bounds| !bounds.is_empty());
        let Bounds { low, high } = Bounds::around(corners.flat_map(|bounds| [&bounds.low, &bounds.high]));
        let extent = [high.x - low.x, high.y - low.y].map(|extent| if extent.is_finite() { extent } else { 0.0 });
        let count = extent.map(|extent| ((extent / BUCKET) as usize + 1).min(MOST_BUCKETS));
        let side = [0, 1].map(|axis| (extent[axis] / count[axis] as f64).max(BUCKET));
        let mut index = Self { boxes: Vec::new(), low, side, count, buckets: vec![Vec::new(); count[0] * count[1]] };
        for (number, bounds) in boxes.iter().enumerate() {
            for bucket in index.covered(bounds) {
                index.buckets[bucket].push(number as u32);
            }
        }
        index.boxes = boxes;
        index
    }

    /// The buckets that a box covers.
    fn covered(&self, bounds: &Bounds) -> impl Iterator<Item = usize> + use<> {
        let columns = self.count[0];
        let bucket = |value: f64, low: f64, axis: usize| {
            ((((value - low) / self.side[axis]).max(0.0)) as usize).min(self.count[axis] - 1)
        };
        let range = |from: f64, to: f64, low: f64, axis: usize| {
            // A box without points covers nothing.
            if from <= to { bucket(from, low, axis)..bucket(to, low, axis) + 1 } else { 0..0 }
        };
        let x = range(bounds.low.x, bounds.high.x, self.low.x, 0);
        let y = range(bounds.low.y, bounds.high.y, self.low.y, 1);
        y.flat_map(move |row| x.clone().map(move |column| row * columns + column))
    }

    /// The boxes that meet a box, ascending.
    pub(super) fn meeting(&self, bounds: &Bounds) -> Vec<u32> {
        let mut found: Vec<u32> = self
            .covered(bounds)
            .flat_map(|bucket| self.buckets[bucket].iter().copied())
            .filter(|&number| self.boxes[number as usize].meets(bounds))
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn boxes_are_found_as_by_comparing_all(
            boxes in prop::collection::vec((-20.0..20.0, -20.0..20.0, 0.0..9.0, 0.0..9.0), 0..40),
            (x, y, size) in (-25.0..25.0, -25.0..25.0, 0.0..8.0)
        ) {
            let bounds = |&(x, y, width, height): &(f64, f64, f64, f64)| {
                Bounds { low: Point::new(x, y), high: Point::new(x + width, y + height) }
            };
            let boxes: Vec<Bounds> = boxes.iter().map(bounds).collect();
            let asked = bounds(&(x, y, size, size));
            let expected: Vec<u32> = (0..boxes.len() as u32).filter(|&number| boxes[number as usize].meets(&asked)).collect();
            prop_assert_eq!(BoxIndex::new(boxes).meeting(&asked), expected);
        }
    }
}
