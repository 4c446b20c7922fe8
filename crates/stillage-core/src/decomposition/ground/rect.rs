//! Rectangles of cells, and the two directions of a frame.

use std::ops::Range;

/// One of the two directions of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axis {
    U,
    V,
}

impl Axis {
    pub const BOTH: [Self; 2] = [Self::U, Self::V];

    pub const fn other(self) -> Self {
        match self {
            Self::U => Self::V,
            Self::V => Self::U,
        }
    }
}

/// A rectangle of cells of a frame: columns along u, rows along v.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Rect {
    pub u: Range<usize>,
    pub v: Range<usize>,
}

impl Rect {
    pub fn range(&self, axis: Axis) -> &Range<usize> {
        match axis {
            Axis::U => &self.u,
            Axis::V => &self.v,
        }
    }

    pub fn with(&self, axis: Axis, range: Range<usize>) -> Self {
        match axis {
            Axis::U => Self { u: range, v: self.v.clone() },
            Axis::V => Self { u: self.u.clone(), v: range },
        }
    }

    /// What a hole leaves of it: the parts beside the hole along `axis`, full width, then those on its other two sides.
    pub fn without(&self, hole: &Self, axis: Axis) -> Vec<Self> {
        let common = |axis: Axis| {
            let (own, other) = (self.range(axis), hole.range(axis));
            own.start.max(other.start)..own.end.min(other.end)
        };
        let (along, across) = (common(axis), common(axis.other()));
        if along.is_empty() || across.is_empty() {
            return vec![self.clone()];
        }
        let beside = |axis: Axis, range: &Range<usize>| {
            let own = self.range(axis);
            [own.start..range.start, range.end..own.end]
        };
        let within = self.with(axis, along.clone());
        let full = beside(axis, &along).map(|part| self.with(axis, part));
        let parts = beside(axis.other(), &across).map(|part| within.with(axis.other(), part));
        full.into_iter().chain(parts).filter(|rect| !rect.u.is_empty() && !rect.v.is_empty()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_leaves_what_is_beside_it() {
        let rect = Rect { u: 0..10, v: 0..4 };
        let left = |hole: Rect| {
            let parts = rect.without(&hole, Axis::U).into_iter();
            parts.map(|part| format!("{:?}x{:?}", part.u, part.v)).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(left(Rect { u: 3..5, v: 2..9 }), "0..3x0..4 5..10x0..4 3..5x0..2");
        assert_eq!(left(Rect { u: 3..5, v: 1..2 }), "0..3x0..4 5..10x0..4 3..5x0..1 3..5x2..4");
        assert_eq!(left(Rect { u: 0..99, v: 0..99 }), "");
        assert_eq!(left(Rect { u: 3..5, v: 4..5 }), "0..10x0..4");
    }
}
