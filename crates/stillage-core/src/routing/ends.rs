//! The ends of a route: for each waypoint a point on a free cell of a drivable face.
//!
//! Cost: O(cells in the bounding box of the face). Limits: where the free cells of a face lie in several pieces, the
//! route ends on the largest one, although another may be nearer.

use super::no_route::{NoRoute, RouteEnd};
use super::window::window_of;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::grid::Occupancy;
use crate::layout::Location;
use crate::site_map::SiteMap;

/// Where a route begins or ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Waypoint {
    /// A point, grid frame, metres.
    Point(Point),
    /// A drivable face (the point well inside it).
    Face(FaceId),
    /// A storage location: the route ends at its storage-access edge.
    Location(Box<Location>),
}

/// One end of a route, on a free cell of a drivable face.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    /// First or last point of the path.
    pub point: Point,
    /// Its cell, row-major.
    pub cell: usize,
    /// The face of that cell.
    pub face: FaceId,
    /// The storage-access edge of a location.
    pub access: Option<EdgeId>,
}

impl End {
    pub fn find(map: &SiteMap<'_>, waypoint: &Waypoint, end: RouteEnd) -> Result<Self, NoRoute> {
        match waypoint {
            Waypoint::Point(point) => at_point(map, *point, end),
            Waypoint::Face(face) => in_face(map, *face, end),
            Waypoint::Location(location) => before_location(map, location, end),
        }
    }
}

fn at_point(map: &SiteMap<'_>, point: Point, end: RouteEnd) -> Result<End, NoRoute> {
    let (column, row) = map.grid.cell_at(point).ok_or(NoRoute::Outside(end))?;
    let cell = row * map.grid.width() + column;
    let face = map.cells.as_slice()[cell];
    check_drivable(map, face, end)?;
    let is_free = map.grid.cells()[cell] == Occupancy::Free;
    if is_free { Ok(End { point, cell, face, access: None }) } else { Err(NoRoute::Blocked(end)) }
}

fn in_face(map: &SiteMap<'_>, face: FaceId, end: RouteEnd) -> Result<End, NoRoute> {
    check_drivable(map, face, end)?;
    let point = map.analysis.graph.position(face);
    match at_point(map, point, end) {
        Ok(found) if found.face == face => Ok(found),
        _ => nearest_free_cell(map, face, point).ok_or(NoRoute::Blocked(end)),
    }
}

/// The end before the best access edge that has free ground in front.
fn before_location(map: &SiteMap<'_>, location: &Location, end: RouteEnd) -> Result<End, NoRoute> {
    let subdivision = &map.analysis.subdivision;
    let no_access = NoRoute::NoAccess { end, code: location.code.clone() };
    let mut problem = None;
    for &edge in location.access_edges.iter().filter(|edge| edge.index() < subdivision.edge_count()) {
        let Some(face) = subdivision.sides(edge).into_iter().find(|&side| side != location.face) else { continue };
        if let Err(not_drivable) = check_drivable(map, face, end) {
            problem.get_or_insert(not_drivable);
            continue;
        }
        let [first, second] = subdivision.segment(edge);
        match nearest_free_cell(map, face, nalgebra::center(&first, &second)) {
            Some(found) => return Ok(End { access: Some(edge), ..found }),
            None => problem = Some(NoRoute::Blocked(end)),
        }
    }
    Err(problem.unwrap_or(no_access))
}

fn check_drivable(map: &SiteMap<'_>, face: FaceId, end: RouteEnd) -> Result<(), NoRoute> {
    if face == FaceId::OUTER || face.index() >= map.semantic.labels.len() {
        return Err(NoRoute::Outside(end));
    }
    let label = map.semantic.label(face);
    if label.is_drivable() { Ok(()) } else { Err(NoRoute::NotDrivable { end, face, label: label.name.clone() }) }
}

/// The free cell of a face nearest to a point, on the largest piece of the face's free ground.
fn nearest_free_cell(map: &SiteMap<'_>, face: FaceId, point: Point) -> Option<End> {
    let pieces = free_pieces(map, face);
    // Of pieces of one size the first, that is, the lowest.
    let largest = pieces.into_iter().reduce(|best, piece| if piece.len() > best.len() { piece } else { best })?;
    let width = map.grid.width();
    let center = |cell: usize| map.grid.center(cell % width, cell / width);
    let distance = |cell: usize| (center(cell) - point).norm_squared();
    let cell = largest
        .into_iter()
        .min_by(|&first, &second| distance(first).total_cmp(&distance(second)).then(first.cmp(&second)))?;
    Some(End { point: center(cell), cell, face, access: None })
}

/// The free cells of a face, by pieces that are connected over cell sides.
fn free_pieces(map: &SiteMap<'_>, face: FaceId) -> Vec<Vec<usize>> {
    let mut members = vec![false; map.analysis.subdivision.face_count()];
    members[face.index()] = true;
    let window = window_of(map, &members);
    let (columns, width) = (window.columns.len(), map.grid.width());
    let mut waits = vec![false; columns * window.rows.len()];
    let index = |column: usize, row: usize| (row - window.rows.start) * columns + column - window.columns.start;
    for row in window.rows.clone() {
        for column in window.columns.clone() {
            let cell = row * width + column;
            waits[index(column, row)] = map.cells.as_slice()[cell] == face && map.grid.cells()[cell] == Occupancy::Free;
        }
    }
    let mut pieces = Vec::new();
    for (row, column) in window.rows.clone().flat_map(|row| window.columns.clone().map(move |column| (row, column))) {
        if !std::mem::take(&mut waits[index(column, row)]) {
            continue;
        }
        let (mut piece, mut open) = (Vec::new(), vec![(column, row)]);
        while let Some((column, row)) = open.pop() {
            piece.push(row * width + column);
            let sides = [(1, 0), (-1, 0), (0, 1), (0, -1)];
            for (right, up) in sides {
                let Some(side) = column.checked_add_signed(right).zip(row.checked_add_signed(up)) else { continue };
                let inside = window.columns.contains(&side.0) && window.rows.contains(&side.1);
                if inside && std::mem::take(&mut waits[index(side.0, side.1)]) {
                    open.push(side);
                }
            }
        }
        pieces.push(piece);
    }
    pieces
}
