//! How vehicles drive through one face: along its middle where it is long, over one hub where it is
//! short, around what stands there where it is wide.
//!
//! Method: what a face is attached to (gates to the faces beside it, places where vehicles stand) is projected onto its
//! axis. The middle line of a face is parallel to its axis, through the median of the points with the most room across it.
//! At each projection a node lies on the middle line, or where obstacles leave little room there, at the point with the most
//! room across the axis. Cost: O((length + attachments) x width), in samples.

use crate::arrangement::FaceId;
use crate::geometry::{OrientedBox, Point, Vector, direction, normal};
use crate::site_map::SiteMap;

/// A face is driven along its axis from this ratio of its sides on; rounder ones are crossed over a hub.
const LONG: f64 = 1.8;
/// A face that is wider than twice this in every direction is open ground, metres: lanes on it go around what stands there.
const WIDE_M: f64 = 4.0;
/// Distance between two samples across the axis, metres.
const STEP_M: f64 = 0.1;
/// Distance between two sections across the axis that tell the middle line, metres.
const SECTION_M: f64 = 0.5;
/// A course stays on its middle line where that has this share of the room that it has as a rule: less, and an obstacle
/// stands there.
const LEAST_ROOM: f64 = 0.8;

/// The course of vehicles through one face.
pub(super) enum Course {
    /// Along an axis.
    Axis(FaceAxis),
    /// Over one point.
    Hub(Point),
    /// Around what stands there.
    OpenGround,
}

/// The axis of a long face.
pub(super) struct FaceAxis {
    /// A point on it.
    origin: Point,
    /// Its unit vector.
    along: Vector,
    /// Half the extent across it, metres.
    half_width: f64,
    /// The middle line of the free ground; `None` where no vehicle fits.
    middle: Option<MiddleLine>,
}

/// A line along an axis.
struct MiddleLine {
    /// How far left of the axis it lies, metres.
    offset: f64,
    /// Distance from it to the nearest obstacle as a rule, metres.
    room: f64,
}

impl Course {
    /// The course through a face for vehicles of a radius.
    pub fn of(map: &SiteMap<'_>, face: FaceId, radius: f64) -> Self {
        let outline = map.analysis.subdivision.rings(face).first().cloned().unwrap_or_default();
        let bounds = OrientedBox::smallest_around(&outline);
        if bounds.half_extents[1] > WIDE_M {
            return Self::OpenGround;
        }
        if bounds.elongation() < LONG {
            return Self::Hub(map.analysis.graph.position(face));
        }
        let [half_length, half_width] = bounds.half_extents;
        let mut axis = FaceAxis { origin: bounds.center, along: direction(bounds.angle), half_width, middle: None };
        axis.middle = axis.middle_line(map, face, half_length, radius);
        Self::Axis(axis)
    }

    /// How far along the axis a point lies, metres; 0 at a hub.
    pub fn abscissa(&self, point: Point) -> f64 {
        match self {
            Self::Axis(axis) => axis.along.dot(&(point - axis.origin)),
            Self::Hub(_) | Self::OpenGround => 0.0,
        }
    }

    /// The point of the course at a distance along the axis, on the face; `None` where a vehicle of a radius finds no room.
    pub fn at(&self, map: &SiteMap<'_>, face: FaceId, abscissa: f64, radius: f64) -> Option<Point> {
        match self {
            Self::OpenGround => None,
            Self::Hub(hub) => {
                let points = around(*hub);
                widest(map, face, points.iter().copied(), radius).map(|stretch| points[stretch.first])
            }
            Self::Axis(axis) => {
                let on_middle_line = axis.middle.as_ref().and_then(|middle| {
                    let point = axis.point(abscissa, middle.offset);
                    let least = radius.max(LEAST_ROOM * middle.room);
                    (map.face_at(point) == face && map.clearance.at(point) >= least).then_some(point)
                });
                let offset = || axis.widest(map, face, abscissa, radius).map(|(_, offset)| offset);
                on_middle_line.or_else(|| Some(axis.point(abscissa, offset()?)))
            }
        }
    }
}

impl FaceAxis {
    fn point(&self, abscissa: f64, offset: f64) -> Point {
        self.origin + self.along * abscissa + normal(self.along.y.atan2(self.along.x)) * offset
    }

    /// The most room across the axis at a distance along it, and how far left of the axis it is, metres.
    fn widest(&self, map: &SiteMap<'_>, face: FaceId, abscissa: f64, radius: f64) -> Option<(f64, f64)> {
        let steps = (self.half_width / STEP_M).floor() as i32;
        let offset = |step: i32| f64::from(step) * STEP_M;
        let section = (-steps..=steps).map(|step| self.point(abscissa, offset(step)));
        let stretch = widest(map, face, section, radius)?;
        Some((stretch.clearance, offset(usize::midpoint(stretch.first, stretch.last) as i32 - steps)))
    }

    fn middle_line(&self, map: &SiteMap<'_>, face: FaceId, half_length: f64, radius: f64) -> Option<MiddleLine> {
        let sections = (half_length / SECTION_M).floor() as i32;
        let at = |section: i32| self.widest(map, face, f64::from(section) * SECTION_M, radius);
        let (mut rooms, mut offsets): (Vec<f64>, Vec<f64>) = (-sections..=sections).filter_map(at).unzip();
        Some(MiddleLine { offset: median(&mut offsets)?, room: median(&mut rooms)? })
    }
}

/// Points one after the other with the same room.
struct Stretch {
    /// Distance to the nearest obstacle, metres.
    clearance: f64,
    /// Index of its first point.
    first: usize,
    /// Index of its last point.
    last: usize,
}

/// The first stretch with the most room, of the points on a face where a vehicle of a radius fits.
fn widest(map: &SiteMap<'_>, face: FaceId, points: impl Iterator<Item = Point>, radius: f64) -> Option<Stretch> {
    let mut best: Option<Stretch> = None;
    for (index, point) in points.enumerate() {
        let clearance = map.clearance.at(point);
        if clearance < radius || map.face_at(point) != face {
            continue;
        }
        match &mut best {
            Some(stretch) if clearance == stretch.clearance && index == stretch.last + 1 => stretch.last = index,
            Some(stretch) if clearance <= stretch.clearance => {}
            _ => best = Some(Stretch { clearance, first: index, last: index }),
        }
    }
    best
}

/// The middle one of some values; `None` of none.
fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Points around a hub, the hub first.
fn around(hub: Point) -> Vec<Point> {
    let steps = [0, 1, -1, 2, -2, 4, -4, 8, -8, 16, -16];
    let points = steps.iter().flat_map(|&right| steps.iter().map(move |&up| (right, up)));
    let mut points: Vec<(i32, i32)> = points.collect();
    points.sort_by_key(|(right, up)| right * right + up * up);
    points.into_iter().map(|(right, up)| hub + Vector::new(f64::from(right), f64::from(up)) * STEP_M).collect()
}
