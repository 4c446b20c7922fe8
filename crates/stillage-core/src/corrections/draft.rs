//! A map while it is corrected.
//!
//! What is drawn is drawn into the pieces of the arrangement at once; the arrangement itself is made anew when a
//! correction asks for its faces, so that a thousand racks cost little more than one. Beside each face stands what people
//! said of it and what it was cut out for. A face that was redrawn without being drawn itself takes that from the face
//! which held a point well inside it.

use rayon::prelude::*;

use super::failure::Failure;
use super::snap::TOLERANCE_CELLS;
use crate::adjacency::pole;
use crate::analysis::Analysis;
use crate::annotation::FaceAnnotation;
use crate::arrangement::{FaceId, KeptParts, Redrawing, Subdivision};
use crate::geometry::{Bounds, Point, polygon};
use crate::grid::OccupancyGrid;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// What is said of a face.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct FaceClaim {
    /// Id of the label that a person gave it.
    pub label: Option<String>,
    /// Name that a person gave it.
    pub name: Option<String>,
    /// What it was cut out for.
    pub kind: Option<PlotKind>,
    /// Number of its room.
    pub room: Option<u32>,
    /// Whether it is a place of a row that a person drew.
    pub is_drawn_place: bool,
    /// The face of the analysis that its ground was; none where it was drawn.
    pub origin: Option<FaceId>,
    /// The face of the analysis whose category it has, whatever ground was added.
    pub category_of: Option<FaceId>,
    /// The corrections that made or touched it, ascending.
    pub corrections: Vec<u32>,
}

impl FaceClaim {
    /// Notes that a correction touched the face.
    pub fn touch(&mut self, correction: u32) {
        if self.corrections.last() != Some(&correction) {
            self.corrections.push(correction);
        }
    }
}

/// A polygon that was drawn, and what its faces are.
struct Painting {
    ring: Vec<Point>,
    bounds: Bounds,
    claim: FaceClaim,
}

/// A door that a person drew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DoorMark {
    /// From jamb to jamb.
    pub line: [Point; 2],
    /// Whether vehicles may pass.
    pub is_open: bool,
    /// Number of the correction.
    pub correction: u32,
}

/// What is left of a draft beside its arrangement: enough to go on with it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Said {
    /// By face.
    pub(super) claims: Vec<FaceClaim>,
    /// Doors in the order in which they were drawn.
    pub(super) doors: Vec<DoorMark>,
}

/// A map while it is corrected; points in the grid frame.
pub(super) struct MapDraft<'a> {
    /// From the lower left to the upper right corner of the grid.
    pub bounds: Bounds,
    /// How near points join what is there, metres.
    pub tolerance: f64,
    /// The arrangement without what was painted since.
    pub subdivision: Subdivision,
    /// What is said of its faces, by id, and of its doors.
    pub claims: Vec<FaceClaim>,
    pub doors: Vec<DoorMark>,
    pub watch: Watch<'a>,
    pieces: Redrawing,
    paintings: Vec<Painting>,
}

impl<'a> MapDraft<'a> {
    /// The map as it was analysed.
    pub fn of(grid: &OccupancyGrid, analysis: &Analysis, watch: Watch<'a>) -> Self {
        let claim = |(face, known): (u32, &FaceAnnotation)| FaceClaim {
            kind: known.kind,
            room: analysis.rooms.room(FaceId(face)),
            origin: Some(FaceId(face)),
            ..FaceClaim::default()
        };
        let claims = (0..).zip(&analysis.faces).map(claim).collect();
        Self::after(grid, &analysis.subdivision, Said { claims, doors: Vec::new() }, watch)
    }

    /// The map as it was left.
    pub fn after(grid: &OccupancyGrid, subdivision: &Subdivision, said: Said, watch: Watch<'a>) -> Self {
        let size = [grid.width(), grid.height()].map(|cells| cells as f64 * grid.resolution());
        Self {
            bounds: Bounds { low: Point::origin(), high: Point::new(size[0], size[1]) },
            tolerance: TOLERANCE_CELLS * grid.resolution(),
            subdivision: subdivision.clone(),
            claims: said.claims,
            doors: said.doors,
            watch,
            pieces: Redrawing::of(subdivision, size[0].max(size[1])),
            paintings: Vec::new(),
        }
    }

    /// The pieces of the arrangement, with what was painted.
    pub const fn pieces(&self) -> &Redrawing {
        &self.pieces
    }

    /// Makes what lies inside an outline, by its segments, faces that are cut by other segments.
    pub fn paint(
        &mut self,
        outline: &[[Point; 2]],
        within: &[[Point; 2]],
        ring: Vec<Point>,
        claim: FaceClaim,
    ) -> Result<(), Stopped> {
        self.pieces.draw_within(outline, within, &self.watch)?;
        self.paintings.push(Painting { bounds: Bounds::around(&ring), ring, claim });
        Ok(())
    }

    /// Makes the arrangement anew where something was painted.
    pub fn settle(&mut self) -> Result<(), Stopped> {
        if !self.paintings.is_empty() {
            let drawn = self.pieces.subdivision(&self.watch)?;
            self.adopt(drawn, |face| face)?;
        }
        Ok(())
    }

    /// The face at a point, told under a pointer where there is none.
    pub fn face_at(&mut self, point: Point, pointer: &str) -> Result<FaceId, Failure> {
        self.settle()?;
        match self.subdivision.face_at(point) {
            FaceId::OUTER => Err(Failure::unfit(pointer, "no face lies at this point: the map was not divided there")),
            face => Ok(face),
        }
    }

    /// Takes another arrangement. `heir` is, for a face until now, the face whose claim its ground takes. Gives for each
    /// face that is new and was not painted the face until now that held a point inside it.
    pub fn adopt(&mut self, new: Subdivision, heir: impl Fn(FaceId) -> FaceId) -> Result<Vec<Option<FaceId>>, Stopped> {
        let kept = KeptParts::between(&self.subdivision, &new);
        let changed: Vec<FaceId> = kept.changed_faces().collect();
        let ground = changed.par_iter().map(|&face| {
            self.watch.check()?;
            let inside = pole(&new.rings(face));
            let painted = self.painted_at(inside);
            let before = if painted.is_some() { FaceId::OUTER } else { self.subdivision.face_at(inside) };
            Ok((face, painted, before))
        });
        let ground: Vec<(FaceId, Option<usize>, FaceId)> = ground.collect::<Result<_, Stopped>>()?;
        let mut claims = vec![FaceClaim::default(); new.face_count()];
        let mut origins = vec![None; new.face_count()];
        for (face, painted, before) in ground {
            claims[face.index()] = match painted {
                Some(painting) => self.paintings[painting].claim.clone(),
                None => self.claims[heir(before).index()].clone(),
            };
            origins[face.index()] = painted.is_none().then_some(before);
        }
        for (claim, before) in claims.iter_mut().zip(&kept.faces) {
            if let Some(before) = before {
                *claim = std::mem::take(&mut self.claims[before.index()]);
            }
        }
        self.claims = claims;
        self.paintings.clear();
        self.pieces = Redrawing::of(&new, self.bounds.high.coords.max());
        self.subdivision = new;
        Ok(origins)
    }

    /// The last painting that holds a point.
    fn painted_at(&self, point: Point) -> Option<usize> {
        let holds = |painting: &Painting| {
            painting.bounds.contains(point) && polygon::contains(std::slice::from_ref(&painting.ring), point)
        };
        self.paintings.iter().rposition(holds)
    }
}
