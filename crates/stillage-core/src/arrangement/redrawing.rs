//! A subdivision while it is redrawn, piece by piece.
//!
//! New segments are noded together with the pieces near them only. That is exact as long as no piece is bent that does
//! not lie near them itself; where one is (a vertex comes within a step of the lattice), all pieces are noded again. So
//! at any time the pieces meet only in their ends, and the same drawing gives the same pieces.
//!
//! Cost: O(pieces) for a drawing, O(pieces log pieces) for the subdivision.

use super::builder;
use super::lattice::{self, LatticePoint, LatticeSegment};
use super::noding::{self, Piece};
use super::subdivision::{EdgeSource, Subdivision};
use crate::geometry::{Bounds, Point, polygon};
use crate::watch::{Stopped, Watch};

/// With more pieces near a drawing, all pieces are noded: looking for what lies near them would cost more.
const MOST_NEAR: usize = 200;

/// The pieces of a subdivision that is redrawn. Two segments are near one another when the boxes around them meet.
#[derive(Debug, Clone)]
pub(crate) struct Redrawing {
    pieces: Vec<Piece>,
    step: f64,
}

/// Where a piece comes from while it is noded. What is drawn takes precedence where both lie at one place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    Drawn,
    Kept(u32),
}

impl Redrawing {
    /// The pieces of a subdivision of a map that reaches up to `extent` metres.
    pub fn of(subdivision: &Subdivision, extent: f64) -> Self {
        let step = if subdivision.step > 0.0 { subdivision.step } else { lattice::step_for(extent) };
        Self { pieces: subdivision.edges().map(|edge| subdivision.piece(edge)).collect(), step }
    }

    /// The subdivision by these pieces.
    pub fn subdivision(&self, watch: &Watch<'_>) -> Result<Subdivision, Stopped> {
        let mut pieces = self.pieces.clone();
        pieces.sort_unstable();
        builder::build(pieces, self.step, watch)
    }

    /// The segments that meet a box.
    pub fn near(&self, bounds: &Bounds) -> Vec<[Point; 2]> {
        let segments = self.pieces.iter().map(|piece| self.ends(piece.segment));
        segments.filter(|ends| Bounds::around(ends).meets(bounds)).collect()
    }

    /// Draws segments. Those without length are left out.
    pub fn draw(&mut self, segments: &[[Point; 2]], watch: &Watch<'_>) -> Result<(), Stopped> {
        self.noded(segments, watch).map(drop)
    }

    /// Draws the outline of a polygon, and within it nothing but some segments.
    pub fn draw_within(
        &mut self,
        outline: &[[Point; 2]],
        within: &[[Point; 2]],
        watch: &Watch<'_>,
    ) -> Result<(), Stopped> {
        let drawn = self.noded(outline, watch)?;
        let sides: Vec<[Point; 2]> = drawn.iter().map(|&segment| self.ends(segment)).collect();
        let bounds = Bounds::around(sides.iter().flatten());
        let is_inside = |segment: LatticeSegment| {
            let [low, high] = self.ends(segment);
            let middle = nalgebra::center(&low, &high);
            bounds.contains(middle) && polygon::is_within(&sides, middle) && drawn.binary_search(&segment).is_err()
        };
        let kept = self.pieces.iter().copied().filter(|piece| !is_inside(piece.segment)).collect();
        self.pieces = kept;
        self.draw(within, watch)
    }

    fn ends(&self, segment: LatticeSegment) -> [Point; 2] {
        [segment.low, segment.high].map(|end| end.position(self.step))
    }

    /// Draws segments and gives the pieces that they became, ascending.
    fn noded(&mut self, segments: &[[Point; 2]], watch: &Watch<'_>) -> Result<Vec<LatticeSegment>, Stopped> {
        let on_lattice = |ends: &[Point; 2]| {
            let [first, second] = ends.map(|end| LatticePoint::nearest(end, self.step));
            LatticeSegment::between(first, second)
        };
        let drawn: Vec<LatticeSegment> = segments.iter().filter_map(on_lattice).collect();
        let (touched, near) = self.neighbourhood(&drawn);
        let all: Vec<u32> = (0..self.pieces.len() as u32).collect();
        let (members, noded) = match self.noded_among(&drawn, &near, watch)? {
            noded if self.bends_only(&touched, &noded) => (near, noded),
            _ => (all.clone(), self.noded_among(&drawn, &all, watch)?),
        };
        let mut is_member = vec![false; self.pieces.len()];
        for member in members {
            is_member[member as usize] = true;
        }
        let mut pieces: Vec<Piece> = Vec::with_capacity(self.pieces.len() + noded.len());
        pieces.extend(self.pieces.iter().zip(is_member).filter(|(_, is_member)| !is_member).map(|(piece, _)| *piece));
        pieces.extend(noded.iter().map(|piece| Piece {
            segment: piece.segment,
            source: match piece.source {
                Origin::Drawn => EdgeSource::Drawn,
                Origin::Kept(number) => self.pieces[number as usize].source,
            },
        }));
        self.pieces = pieces;
        Ok(noded.iter().filter(|piece| piece.source == Origin::Drawn).map(|piece| piece.segment).collect())
    }

    /// The numbers of the pieces near some segments, and of all pieces near these or the segments; both ascend.
    fn neighbourhood(&self, drawn: &[LatticeSegment]) -> (Vec<u32>, Vec<u32>) {
        let boxes: Vec<LatticeBox> = drawn.iter().copied().map(LatticeBox::around).collect();
        let touched = self.meeting(boxes.clone());
        let around = touched.iter().map(|&number| LatticeBox::around(self.pieces[number as usize].segment));
        let near = self.meeting(boxes.into_iter().chain(around).collect());
        (touched, near)
    }

    /// The numbers of the pieces that meet one of some boxes; those that meet the box around all where there are many.
    fn meeting(&self, mut boxes: Vec<LatticeBox>) -> Vec<u32> {
        let Some(whole) = boxes.iter().copied().reduce(LatticeBox::with) else { return Vec::new() };
        if boxes.len() > MOST_NEAR {
            boxes = vec![whole];
        }
        let is_near = |piece: &Piece| {
            let own = LatticeBox::around(piece.segment);
            own.meets(whole) && boxes.iter().any(|other| own.meets(*other))
        };
        (0..).zip(&self.pieces).filter(|(_, piece)| is_near(piece)).map(|(number, _)| number).collect()
    }

    fn noded_among(
        &self,
        drawn: &[LatticeSegment],
        members: &[u32],
        watch: &Watch<'_>,
    ) -> Result<Vec<Piece<Origin>>, Stopped> {
        let drawn = drawn.iter().map(|&segment| Piece { segment, source: Origin::Drawn });
        let kept = members
            .iter()
            .map(|&number| Piece { segment: self.pieces[number as usize].segment, source: Origin::Kept(number) });
        noding::node(drawn.chain(kept).collect(), watch)
    }

    /// Whether no pieces but some, ascending, were bent.
    fn bends_only(&self, touched: &[u32], noded: &[Piece<Origin>]) -> bool {
        noded.iter().all(|piece| match piece.source {
            Origin::Kept(number) if touched.binary_search(&number).is_err() => {
                let before = self.pieces[number as usize].segment;
                [piece.segment.low, piece.segment.high].iter().all(|&end| before.side(end) == 0)
            }
            _ => true,
        })
    }
}

/// A box of the lattice, grown by a step: bent pieces lie in it, too.
#[derive(Debug, Clone, Copy)]
struct LatticeBox {
    low: [i64; 2],
    high: [i64; 2],
}

impl LatticeBox {
    fn around(segment: LatticeSegment) -> Self {
        let (left, right) = segment.x_range();
        Self { low: [left - 1, segment.low.y - 1], high: [right + 1, segment.high.y + 1] }
    }

    fn with(self, other: Self) -> Self {
        let each = |pick: fn(i64, i64) -> i64, one: [i64; 2], other: [i64; 2]| {
            [pick(one[0], other[0]), pick(one[1], other[1])]
        };
        Self { low: each(i64::min, self.low, other.low), high: each(i64::max, self.high, other.high) }
    }

    fn meets(self, other: Self) -> bool {
        (0..2).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::arrangement::SourceSegment;
    use crate::test_maps::segments::boxed;

    fn ends([x0, y0, x1, y1]: [f64; 4]) -> [Point; 2] {
        [Point::new(x0, y0), Point::new(x1, y1)]
    }

    #[test]
    fn within_an_outline_only_what_is_drawn_is_left() {
        let old = boxed([0.0, 0.0, 8.0, 8.0], &[[4.0, 0.0, 4.0, 8.0], [0.0, 3.0, 8.0, 3.0]]);
        let mut redrawing = Redrawing::of(&old, 8.0);
        let outline =
            [[2.0, 2.0, 6.0, 2.0], [6.0, 2.0, 6.0, 6.0], [6.0, 6.0, 2.0, 6.0], [2.0, 6.0, 2.0, 2.0]].map(ends);
        redrawing.draw_within(&outline, &[ends([2.0, 4.0, 6.0, 4.0])], &Watch::unwatched()).expect("nobody stops it");
        let new = redrawing.subdivision(&Watch::unwatched()).expect("nobody stops it");
        new.check_invariants().expect("it is sound");
        let mut areas: Vec<f64> = new.faces().map(|face| new.area(face)).collect();
        areas.sort_by(f64::total_cmp);
        assert_eq!(areas, [8.0, 8.0, 10.0, 10.0, 14.0, 14.0]);
    }

    proptest! {
        /// Noding what lies near is as good as noding everything.
        #[test]
        fn any_drawing_is_sound(
            lines in prop::collection::vec([0.0..8.0, 0.0..8.0, 0.0..8.0, 0.0..8.0], 0..12),
            drawn in prop::collection::vec([0.0..8.0, 0.0..8.0, 0.0..8.0, 0.0..8.0], 1..12),
        ) {
            let watch = Watch::unwatched();
            let mut redrawing = Redrawing::of(&boxed([0.0, 0.0, 8.0, 8.0], &lines), 8.0);
            for line in &drawn {
                redrawing.draw(&[ends(*line)], &watch).expect("nobody stops it");
            }
            let new = redrawing.subdivision(&watch).expect("nobody stops it");
            prop_assert_eq!(new.check_invariants(), Ok(()));
            // Noded once more, nothing changes.
            let segments: Vec<SourceSegment> = new.edges().map(|edge| {
                let [start, end] = new.segment(edge);
                SourceSegment { start, end, source: new.source(edge) }
            }).collect();
            prop_assert_eq!(crate::arrangement::arrange(&segments, &watch).expect("nobody stops it"), new);
        }
    }
}
