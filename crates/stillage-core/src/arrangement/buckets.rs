//! A uniform grid of buckets over the lattice, to find the items near a segment.
//!
//! Cost: O(items) to build; a query visits the buckets along the segment. Fast where items are spread evenly, as the
//! crossings of a decomposition are; elsewhere slower, with the same result.

use super::lattice::{LatticePoint, LatticeSegment};

/// Lattice steps by which a segment is widened on its way through the buckets: half a pixel, and the rounding of `f64`.
const MARGIN: i64 = 2;

/// The layout of the buckets: square, about as many as there are items.
#[derive(Debug, Clone, Copy)]
pub(super) struct BucketGrid {
    origin: LatticePoint,
    /// Side of a bucket, lattice steps.
    side: i64,
    columns: usize,
    rows: usize,
}

impl BucketGrid {
    /// A grid over the box from `low` to `high` with about `items` buckets.
    pub fn over(low: LatticePoint, high: LatticePoint, items: usize) -> Self {
        let (width, height) = low.to(high);
        // As many buckets as items by area; in a box without area as many by length.
        let by_area = (width as f64 * height as f64 / items.max(1) as f64).sqrt();
        let by_length = width.max(height) as f64 / items.max(1) as f64;
        let side = by_area.max(by_length).ceil().max(1.0) as i64;
        let count = |extent: i64| (extent / side + 1) as usize;
        Self { origin: low, side, columns: count(width), rows: count(height) }
    }

    pub fn bucket_count(&self) -> usize {
        self.columns * self.rows
    }

    fn column(&self, x: i64) -> usize {
        ((x - self.origin.x).div_euclid(self.side).max(0) as usize).min(self.columns - 1)
    }

    fn row(&self, y: i64) -> usize {
        ((y - self.origin.y).div_euclid(self.side).max(0) as usize).min(self.rows - 1)
    }

    /// The bucket of a point.
    pub fn bucket_of(&self, point: LatticePoint) -> usize {
        self.row(point.y) * self.columns + self.column(point.x)
    }

    /// Visits every bucket that holds a point of the segment or of a pixel that it meets, each once, ascending.
    pub fn along(&self, segment: LatticeSegment, mut visit: impl FnMut(usize)) {
        let (dx, dy) = segment.direction();
        let (left, right) = segment.x_range();
        let slope = if dy == 0 { 0.0 } else { dx as f64 / dy as f64 };
        for row in self.row(segment.low.y - MARGIN)..=self.row(segment.high.y + MARGIN) {
            let (from, to) = if dy == 0 {
                (left, right)
            } else {
                let bottom = self.origin.y + row as i64 * self.side - MARGIN;
                let top = bottom + self.side + 2 * MARGIN;
                let x_at = |y: i64| segment.low.x + ((y - segment.low.y) as f64 * slope) as i64;
                let (first, last) = (x_at(bottom.max(segment.low.y)), x_at(top.min(segment.high.y)));
                (first.min(last), first.max(last))
            };
            for column in self.column(from - MARGIN)..=self.column(to + MARGIN) {
                visit(row * self.columns + column);
            }
        }
    }
}

/// Items by bucket, packed: the items of bucket `b` are `items[starts[b]..starts[b + 1]]`.
#[derive(Debug)]
pub(super) struct Buckets {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Buckets {
    /// Packs (bucket, item) pairs; items keep their order within a bucket.
    pub fn pack(bucket_count: usize, pairs: &[(u32, u32)]) -> Self {
        let mut starts = vec![0_u32; bucket_count + 1];
        for &(bucket, _) in pairs {
            starts[bucket as usize + 1] += 1;
        }
        for bucket in 0..bucket_count {
            starts[bucket + 1] += starts[bucket];
        }
        let mut next = starts.clone();
        let mut items = vec![0; pairs.len()];
        for &(bucket, item) in pairs {
            items[next[bucket as usize] as usize] = item;
            next[bucket as usize] += 1;
        }
        Self { starts, items }
    }

    /// The items of a bucket.
    pub fn of(&self, bucket: usize) -> &[u32] {
        &self.items[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    /// The items of a bucket, to be sorted.
    pub fn of_mut(&mut self, bucket: usize) -> &mut [u32] {
        &mut self.items[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }
}
