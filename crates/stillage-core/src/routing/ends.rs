//! The ends of a route: for each waypoint a point on which the vehicle may stand.
//!
//! A vehicle that stands on free ground beside the drivable faces (in a room, on a sliver before a rack, in an empty place)
//! first drives [out to them](super::ways_out).

use super::drive_grid::DriveGrid;
use super::face_steps::Blocked;
use super::no_route::{EndGround, NoRoute, RouteEnd};
use super::sight::Sight;
use super::ways_out::WaysOut;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::grid::Occupancy;
use crate::layout::{Location, approach_before};
use crate::site_map::SiteMap;

/// How far a point that would do is looked for, metres: half the width of a wide aisle and a place.
const NEAR_M: f64 = 5.0;

/// Where a route begins or ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Waypoint<'a> {
    /// A point, grid frame, metres.
    Point(Point),
    /// A drivable face (a point well inside it).
    Face(FaceId),
    /// A storage location: the point where a vehicle stands to serve it.
    Location(&'a Location),
}

/// One end of a route.
#[derive(Debug, Clone)]
pub(super) struct End {
    /// From the end itself to the cell at which the drivable ground begins.
    pub lead: Vec<Point>,
    /// That cell.
    pub cell: usize,
    /// Where the vehicle looks there, radians; at locations only.
    pub heading: Option<f64>,
}

/// What the ends of a route are looked up in.
pub(super) struct EndFinder<'a> {
    pub map: &'a SiteMap<'a>,
    pub grid: &'a DriveGrid,
    /// All floor on which the vehicle fits, whatever its label.
    pub floor: &'a DriveGrid,
    pub ways_out: &'a WaysOut,
    pub radius: f64,
    pub blocked: &'a Blocked,
}

impl EndFinder<'_> {
    pub fn find(&self, waypoint: &Waypoint<'_>, end: RouteEnd) -> Result<End, NoRoute> {
        match waypoint {
            Waypoint::Point(point) => self.at_point(*point, end),
            Waypoint::Face(face) => self.in_face(*face, end),
            Waypoint::Location(location) => self.before_location(location, end),
        }
    }

    fn at_point(&self, point: Point, end: RouteEnd) -> Result<End, NoRoute> {
        let cannot_stand = |ground| NoRoute::CannotStand { end, ground, nearest: self.nearest(point) };
        let cell = self.grid.cell_at(point).ok_or_else(|| cannot_stand(EndGround::Outside))?;
        if self.grid.fits(cell) {
            let lead = self.onto(point, cell);
            return Ok(End { lead, cell, heading: None });
        }
        if let Some(beside) = self.fitting_beside(point, cell) {
            return Ok(End { lead: vec![point, self.grid.center(beside)], cell: beside, heading: None });
        }
        match self.map.grid.cells()[cell] {
            Occupancy::Occupied => return Err(cannot_stand(EndGround::Occupied)),
            Occupancy::Unknown => return Err(cannot_stand(EndGround::Unknown)),
            Occupancy::Free => {}
        }
        if !self.stands(cell) {
            return Err(cannot_stand(EndGround::Narrow(self.map.clearance.of_cell(cell))));
        }
        let face = self.map.cells.of_cell(cell);
        if self.blocked.faces.contains(&face) {
            return Err(NoRoute::EndBlocked { end, face });
        }
        let lead = self.ways_out.from(self.map, self.grid, cell, |cell| self.stands(cell)).ok_or_else(|| {
            let label = self.map.semantic.label(face).name.clone();
            NoRoute::NotDrivable { end, face, label, nearest: self.nearest(point) }
        })?;
        let last = *lead.last().expect("a lead has a cell");
        let points: Vec<Point> = lead.into_iter().map(|cell| self.grid.center(cell)).collect();
        let sight = Sight { grid: self.floor, clearance: &[], preferred: 0 };
        let mut lead = sight.pull_tight(&points);
        if point != lead[0] && self.map.clearance.of_cell(cell) - (point - lead[0]).norm() >= self.radius {
            lead.insert(0, point);
        }
        Ok(End { lead, cell: last, heading: None })
    }

    /// The point itself and the middle of its cell; the middle alone where the vehicle fits there only.
    fn onto(&self, point: Point, cell: usize) -> Vec<Point> {
        let middle = self.grid.center(cell);
        if self.grid.is_whole(cell) && point != middle { vec![point, middle] } else { vec![middle] }
    }

    /// The nearest fitting cell around a point at which the vehicle fits although it does not on the middle of the point's
    /// cell.
    fn fitting_beside(&self, point: Point, cell: usize) -> Option<usize> {
        let face = self.map.cells.of_cell(cell);
        let is_ground = self.map.grid.cells()[cell] == Occupancy::Free && self.map.is_drivable(face);
        if !is_ground || self.blocked.faces.contains(&face) || !self.is_clear(point) {
            return None;
        }
        let (column, row) = (cell % self.grid.width, cell / self.grid.width);
        let range = |place: usize, count: usize| place.saturating_sub(1)..(place + 2).min(count);
        let columns = range(column, self.grid.width);
        let around = range(row, self.grid.height)
            .flat_map(|row| columns.clone().map(move |column| row * self.grid.width + column));
        let distance = |cell: &usize| (self.grid.center(*cell) - point).norm_squared();
        let fitting = around.filter(|&cell| self.grid.fits(cell) && self.map.cells.of_cell(cell) == face);
        fitting.min_by(|one, other| distance(one).total_cmp(&distance(other)).then(one.cmp(other)))
    }

    /// Whether the vehicle touches nothing at a point: cell by cell. O(cells under the vehicle).
    fn is_clear(&self, point: Point) -> bool {
        let resolution = self.grid.resolution;
        let range = |place: f64| {
            ((place - self.radius) / resolution).floor() as i64..=((place + self.radius) / resolution).floor() as i64
        };
        let gap = |place: f64, cell: i64| {
            let low = cell as f64 * resolution;
            (low - place).max(place - low - resolution).max(0.0)
        };
        range(point.y).all(|row| {
            range(point.x).all(|column| {
                self.map.grid.at(column, row) == Occupancy::Free
                    || gap(point.x, column).hypot(gap(point.y, row)) >= self.radius
            })
        })
    }

    fn in_face(&self, face: FaceId, end: RouteEnd) -> Result<End, NoRoute> {
        if self.blocked.faces.contains(&face) {
            return Err(NoRoute::EndBlocked { end, face });
        }
        if face == FaceId::OUTER || face.index() >= self.map.semantic.labels.len() {
            return Err(NoRoute::CannotStand { end, ground: EndGround::Outside, nearest: None });
        }
        let point = self.map.analysis.graph.position(face);
        if !self.map.is_drivable(face) {
            let label = self.map.semantic.label(face).name.clone();
            return Err(NoRoute::NotDrivable { end, face, label, nearest: self.nearest(point) });
        }
        let is_there = |cell: usize| self.grid.fits(cell) && self.map.cells.of_cell(cell) == face;
        let cell =
            self.grid.cell_at(point).filter(|&cell| is_there(cell)).or_else(|| self.ring_search(point, is_there));
        let narrow = || EndGround::Narrow(self.map.clearance.at(point));
        let cell = cell.ok_or_else(|| NoRoute::CannotStand { end, ground: narrow(), nearest: self.nearest(point) })?;
        Ok(End { lead: vec![self.grid.center(cell)], cell, heading: None })
    }

    fn before_location(&self, location: &Location, end: RouteEnd) -> Result<End, NoRoute> {
        let fits = |point: Point| self.grid.cell_at(point).is_some_and(|cell| self.grid.fits(cell));
        let known = location.approach.filter(|pose| fits(pose.position));
        let pose = known.or_else(|| approach_before(self.map, location, self.radius));
        let no_approach = || NoRoute::NoApproach { end, code: location.code.clone() };
        let pose = pose.ok_or_else(no_approach)?;
        let cell = self.grid.cell_at(pose.position).ok_or_else(no_approach)?;
        let face = self.map.cells.of_cell(cell);
        if self.blocked.faces.contains(&face) {
            return Err(NoRoute::EndBlocked { end, face });
        }
        if !self.grid.fits(cell) {
            return Err(no_approach());
        }
        Ok(End { lead: self.onto(pose.position, cell), cell, heading: Some(pose.heading) })
    }

    /// Whether the vehicle touches nothing on the middle of a cell, however that is labelled.
    fn stands(&self, cell: usize) -> bool {
        let is_free = self.map.grid.cells()[cell] == Occupancy::Free;
        is_free && self.map.clearance.of_cell(cell) >= self.radius
    }

    /// The nearest point at which the vehicle could begin or end, within [`NEAR_M`].
    fn nearest(&self, point: Point) -> Option<Point> {
        self.ring_search(point, |cell| self.grid.fits(cell)).map(|cell| self.grid.center(cell))
    }

    /// The nearest cell within [`NEAR_M`] of a point that will do.
    fn ring_search(&self, point: Point, will_do: impl Fn(usize) -> bool) -> Option<usize> {
        let resolution = self.grid.resolution;
        let range = |place: f64, count: usize| {
            let at = |place: f64| ((place / resolution).floor().max(0.0) as usize).min(count);
            at(place - NEAR_M)..at(place + NEAR_M + resolution)
        };
        let (columns, rows) = (range(point.x, self.grid.width), range(point.y, self.grid.height));
        let cells = rows.flat_map(|row| columns.clone().map(move |column| row * self.grid.width + column));
        let distance = |cell: &usize| (self.grid.center(*cell) - point).norm_squared();
        let fitting = cells.filter(|&cell| will_do(cell));
        fitting.min_by(|one, other| distance(one).total_cmp(&distance(other)).then(one.cmp(other)))
    }
}
