//! How vehicles drive through one face: along its middle where it is long, over one hub where it is not.
//!
//! Method: what a face is attached to (gates to the faces beside it, places where vehicles stand) is projected onto its
//! axis; at each projection a node lies where the free way is widest across the axis. Cost: O(attachments x samples).

use crate::arrangement::FaceId;
use crate::geometry::{OrientedBox, Point, Vector, direction, normal};
use crate::site_map::SiteMap;

/// A face is driven along its axis from this ratio of its sides on; rounder ones are crossed over a hub.
const LONG: f64 = 1.8;
/// Distance between two samples across the axis, metres.
const STEP_M: f64 = 0.1;

/// The course of vehicles through one face.
pub(super) enum Course {
    /// Along an axis.
    Axis {
        /// A point on it.
        origin: Point,
        /// Its unit vector.
        along: Vector,
        /// Half the extent across it, metres.
        half_width: f64,
    },
    /// Over one point.
    Hub(Point),
}

impl Course {
    pub fn of(map: &SiteMap<'_>, face: FaceId) -> Self {
        let outline = map.analysis.subdivision.rings(face).first().cloned().unwrap_or_default();
        let bounds = OrientedBox::smallest_around(&outline);
        if bounds.elongation() < LONG {
            return Self::Hub(map.analysis.graph.position(face));
        }
        Self::Axis { origin: bounds.center, along: direction(bounds.angle), half_width: bounds.half_extents[1] }
    }

    /// How far along the axis a point lies, metres; 0 at a hub.
    pub fn abscissa(&self, point: Point) -> f64 {
        match self {
            Self::Axis { origin, along, .. } => along.dot(&(point - origin)),
            Self::Hub(_) => 0.0,
        }
    }

    /// The point with the most room at a distance along the axis, of those on the face; `None` where a vehicle of a radius
    /// finds none.
    pub fn widest(&self, map: &SiteMap<'_>, face: FaceId, abscissa: f64, radius: f64) -> Option<Point> {
        let candidates: Vec<Point> = match *self {
            Self::Hub(point) => around(point),
            Self::Axis { origin, along, half_width } => {
                let across = normal(along.y.atan2(along.x));
                let steps = (half_width / STEP_M).floor() as i32;
                let middle = origin + along * abscissa;
                (-steps..=steps).map(|step| middle + across * (f64::from(step) * STEP_M)).collect()
            }
        };
        let fitting = candidates.into_iter().filter_map(|point| {
            let (column, row) = map.grid.cell_at(point)?;
            let clearance = map.clearance.at(point);
            (map.cells.at(column, row) == face && clearance >= radius)
                .then(|| (clearance, map.grid.center(column, row)))
        });
        // Of equals the first one.
        let best = fitting.reduce(|best, other| if other.0 > best.0 { other } else { best });
        best.map(|(_, point)| point)
    }
}

/// Points around a hub, the hub first.
fn around(hub: Point) -> Vec<Point> {
    let steps = [0, 1, -1, 2, -2, 4, -4, 8, -8, 16, -16];
    let points = steps.iter().flat_map(|&right| steps.iter().map(move |&up| (right, up)));
    let mut points: Vec<(i32, i32)> = points.collect();
    points.sort_by_key(|(right, up)| right * right + up * up);
    points.into_iter().map(|(right, up)| hub + Vector::new(f64::from(right), f64::from(up)) * STEP_M).collect()
}
