//! How much area faces and true areas have in common, exactly ([`crate::geometry::common_area`]).
//!
//! Cost: O(points of the area) for each convex piece of a face whose box meets the area's.

use super::box_index::BoxIndex;
use crate::arrangement::{FaceId, Subdivision};
use crate::geometry::common_area::{Clip, ConvexPiece, pieces};
use crate::geometry::{Bounds, Point, polygon};

/// Intersection over union above which a face fits a place: above one half at most one face can.
const SAME: f64 = 0.5;

/// Shapes (the faces of a subdivision, the locations of a layout), ready to be measured against areas.
#[derive(Debug)]
pub(super) struct ShapeAreas {
    /// By shape.
    pieces: Vec<Vec<ConvexPiece>>,
    rings: Vec<Vec<Vec<Point>>>,
    pub(super) areas: Vec<f64>,
    index: BoxIndex,
}

impl ShapeAreas {
    /// The faces of a subdivision; that of the unbounded face is empty.
    pub(super) fn of_faces(subdivision: &Subdivision) -> Self {
        let rings = |face| if face == FaceId::OUTER.0 { Vec::new() } else { subdivision.rings(FaceId(face)) };
        Self::of((0..subdivision.face_count() as u32).map(rings).collect())
    }

    /// Shapes by their rings: outlines counter-clockwise, holes clockwise.
    pub(super) fn of(rings: Vec<Vec<Vec<Point>>>) -> Self {
        let areas = rings.iter().map(|rings| polygon::area(rings)).collect();
        let index = BoxIndex::new(rings.iter().map(|rings| Bounds::around(rings.iter().flatten())).collect());
        Self { pieces: rings.iter().map(|rings| pieces(rings)).collect(), rings, areas, index }
    }

    /// The shapes that an area lies in, ascending, with the area in common.
    pub(super) fn overlaps(&self, rings: &[Vec<Point>]) -> Vec<(u32, f64)> {
        let mut clip = Clip::default();
        let overlap = |face: u32| {
            let piece =
                |piece: &ConvexPiece| piece.sign * rings.iter().map(|ring| clip.area(ring, &piece.window)).sum::<f64>();
            (face, self.pieces[face as usize].iter().map(piece).sum::<f64>())
        };
        let candidates = self.index.meeting(&Bounds::around(rings.iter().flatten()));
        candidates.into_iter().map(overlap).filter(|&(_, area)| area > 0.0).collect()
    }

    /// Whether a face holds a point (even-odd rule over its rings).
    pub(super) fn holds(&self, face: u32, point: Point) -> bool {
        polygon::contains(&self.rings[face as usize], point)
    }
}

/// One true place and the faces it lies in.
#[derive(Debug)]
pub(super) struct Match {
    pub area: f64,
    /// The face that holds its centre.
    pub holder: Option<u32>,
    /// Faces with the area in common, ascending.
    pub overlaps: Vec<(u32, f64)>,
}

impl Match {
    /// Whether a face with this area in common fits the place.
    pub(super) fn fits(&self, (face, common): (u32, f64), face_areas: &[f64]) -> bool {
        common / (face_areas[face as usize] + self.area - common) > SAME
    }

    /// The face that fits the place.
    pub(super) fn fitting(&self, face_areas: &[f64]) -> Option<u32> {
        let found = self.overlaps.iter().find(|&&overlap| self.fits(overlap, face_areas));
        found.map(|&(face, _)| face)
    }
}
