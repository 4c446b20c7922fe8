//! Faces that people draw: a polygon, or a row of places.

use super::draft::{FaceClaim, MapDraft};
use super::snap::Snap;
use crate::geometry::Point;
use crate::plot::PlotKind;
use crate::watch::Stopped;

/// Makes what lies inside a polygon one face. It is in no room: it stands in one, or is one itself.
pub(super) fn draw(draft: &mut MapDraft<'_>, ring: &[Point], claim: FaceClaim) -> Result<(), Stopped> {
    let ring = Snap::near(draft.pieces(), draft.bounds, ring, draft.tolerance).ring(ring);
    let outline: Vec<[Point; 2]> = closed(&ring).collect();
    draft.paint(&outline, &[], ring, FaceClaim { kind: Some(PlotKind::Other), ..claim })
}

/// Cuts a rectangle into places: `places` along its first side, `layers` across it.
pub(super) fn row(
    draft: &mut MapDraft<'_>,
    rectangle: &[Point; 4],
    [places, layers]: [u32; 2],
    claim: FaceClaim,
) -> Result<(), Stopped> {
    let snap = Snap::near(draft.pieces(), draft.bounds, rectangle, draft.tolerance);
    let corners = snap.corners(rectangle);
    let at = |place: u32, layer: u32| {
        let (along, across) = (f64::from(place) / f64::from(places), f64::from(layer) / f64::from(layers));
        let front = corners[0] + (corners[1] - corners[0]) * along;
        let back = corners[3] + (corners[2] - corners[3]) * along;
        front + (back - front) * across
    };
    let along = |layer: u32| (0..places).map(move |place| [at(place, layer), at(place + 1, layer)]);
    let across = |place: u32| (0..layers).map(move |layer| [at(place, layer), at(place, layer + 1)]);
    let sides = along(0).chain(across(places)).chain(along(layers)).chain(across(0));
    let outline: Vec<[Point; 2]> = sides
        .flat_map(|[start, end]| {
            let mut points = snap.bent([start, end]);
            points.push(end);
            points.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>()
        })
        .collect();
    let within: Vec<[Point; 2]> = (1..layers).flat_map(along).chain((1..places).flat_map(across)).collect();
    let claim = FaceClaim { kind: Some(PlotKind::Place), is_drawn_place: true, ..claim };
    draft.paint(&outline, &within, corners, claim)
}

/// The sides of a ring.
fn closed(ring: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&start, &end)| [start, end])
}
