//! A drawn warehouse of the paper's size: 190 m x 270 m, 3800 x 5400 cells of 0.05 m, about two thirds of them free.
//!
//! Three rack regions in three directions, offices along one wall, pillars, speckle and places that the robot never
//! saw. Pallets show their outline to the aisle; what is behind it is unknown, as a laser scanner leaves it. The same
//! bytes on every machine.

use std::collections::HashSet;
use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use stillage_core::grid::{GridFrame, Occupancy, OccupancyGrid};
use stillage_core::{Point, Vector};

/// Columns and rows.
pub const SIZE: [usize; 2] = [3800, 5400];
/// Metres per cell.
pub const RESOLUTION: f64 = 0.05;
/// Free cells next to nothing that a scanner reported as occupied.
const SPECKLE: usize = 20_000;
/// Discs that were never seen: how many, and their largest radius in metres.
const UNSEEN: (usize, f64) = (12, 8.0);

/// A field of pallet racks.
struct RackField {
    /// Its middle, metres.
    center: Point,
    /// Length along the rows and across them, metres.
    size: [f64; 2],
    /// Direction of its rows, degrees.
    degrees: f64,
    /// Depth and width of a place, width of an aisle, metres.
    place: [f64; 2],
    aisle: f64,
}

/// Metres between two cross aisles, and their width.
const CROSS_AISLE: [f64; 2] = [36.0, 4.0];
/// Metres between the backs of two rows.
const FLUE: f64 = 0.2;
/// Thickness of walls and outlines, metres.
const OUTLINE: f64 = 0.1;

/// Draws some columns and rows of the warehouse.
pub fn warehouse([columns, rows]: [Range<usize>; 2]) -> OccupancyGrid {
    let (fields, unseen, speckle) = (fields(), unseen(), speckle());
    let mut cells = Vec::with_capacity(columns.len() * rows.len());
    for row in rows.clone() {
        for column in columns.clone() {
            let point = Point::new(column as f64 + 0.5, row as f64 + 0.5) * RESOLUTION;
            cells.push(if unseen.iter().any(|&(center, radius)| (point - center).norm() < radius) {
                Occupancy::Unknown
            } else {
                match fields.iter().find_map(|field| field.at(point)).unwrap_or_else(|| building(point)) {
                    Occupancy::Free if speckle.contains(&[column, row]) => Occupancy::Occupied,
                    seen => seen,
                }
            });
        }
    }
    let frame = GridFrame { resolution: RESOLUTION, origin: Point::origin(), yaw: 0.0 };
    OccupancyGrid::new(columns.len(), rows.len(), frame, cells)
}

/// Columns and rows of the speckle.
fn speckle() -> HashSet<[usize; 2]> {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    (0..SPECKLE).map(|_| SIZE.map(|end| (random.next_u64() % end as u64) as usize)).collect()
}

fn fields() -> [RackField; 3] {
    let field = |center: [f64; 2], size, degrees, place, aisle| RackField {
        center: Point::from(center),
        size,
        degrees,
        place,
        aisle,
    };
    [
        field([95.0, 66.0], [174.0, 112.0], 0.0, [1.2, 0.9], 2.0),
        field([51.0, 172.0], [88.0, 78.0], 90.0, [1.2, 1.3], 2.6),
        field([137.0, 172.0], [78.0, 74.0], 13.0, [1.2, 1.0], 2.2),
    ]
}

/// Centers and radii of the places that were never seen.
fn unseen() -> Vec<(Point, f64)> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut share = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let [width, height] = SIZE.map(|cells| cells as f64 * RESOLUTION);
    (0..UNSEEN.0).map(|_| (Point::new(share() * width, share() * height), share() * UNSEEN.1)).collect()
}

impl RackField {
    /// What is at a point, if the point is in this field.
    fn at(&self, point: Point) -> Option<Occupancy> {
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let from_center = point - self.center;
        let local = Vector::new(
            from_center.x * cos + from_center.y * sin + self.size[0] / 2.0,
            from_center.y * cos - from_center.x * sin + self.size[1] / 2.0,
        );
        let inside = (0.0..self.size[0]).contains(&local.x) && (0.0..self.size[1]).contains(&local.y);
        inside.then(|| self.in_rows(local))
    }

    /// What is at a place in the frame of the field: aisle, row, flue, row, and again.
    fn in_rows(&self, local: Vector) -> Occupancy {
        let [depth, width] = self.place;
        let period = self.aisle + 2.0 * depth + FLUE;
        let (pair, across) = ((local.y / period).floor(), local.y.rem_euclid(period) - self.aisle);
        let along = local.x.rem_euclid(CROSS_AISLE[0]) - CROSS_AISLE[1];
        let places = ((CROSS_AISLE[0] - CROSS_AISLE[1]) / width).floor();
        if across < 0.0 || along < 0.0 || along >= places * width {
            return Occupancy::Free;
        }
        let behind = if across < depth { across } else { across - depth - FLUE };
        if !(0.0..depth).contains(&behind) {
            return Occupancy::Unknown;
        }
        let from_aisle = if across < depth { behind } else { depth - behind };
        let (place, beside) = ((along / width).floor(), along.rem_euclid(width));
        let post = beside < OUTLINE && (from_aisle < OUTLINE || from_aisle > depth - OUTLINE);
        let block = (local.x / CROSS_AISLE[0]).floor();
        if !is_taken([pair, block, place, f64::from(across < depth)]) {
            return if post { Occupancy::Occupied } else { Occupancy::Free };
        }
        match (beside - width / 2.0).abs() {
            from_middle if from_middle > width / 2.0 - 0.08 => Occupancy::Free,
            from_middle if from_aisle < OUTLINE || from_middle > width / 2.0 - 0.08 - OUTLINE => Occupancy::Occupied,
            _ => Occupancy::Unknown,
        }
    }
}

/// Whether a pallet stands on a place: four of five do.
fn is_taken(place: [f64; 4]) -> bool {
    let number = place.iter().fold(1_u64, |number, &part| {
        let mixed = (number ^ part as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed ^ (mixed >> 29)
    });
    number % 5 != 0
}

/// Walls, offices and pillars: everything outside the rack fields.
fn building(point: Point) -> Occupancy {
    let [width, height] = SIZE.map(|cells| cells as f64 * RESOLUTION);
    let to_wall = [point.x - 9.0, width - 9.0 - point.x, point.y - 9.0, height - 9.0 - point.y]
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    if to_wall < 0.0 {
        return Occupancy::Unknown;
    }
    let office = point.y > height - 45.0;
    let in_room = (point.x.rem_euclid(8.0), (point.y - height + 45.0).rem_euclid(10.0));
    let office_wall = office && (in_room.0 < OUTLINE || in_room.1 < OUTLINE);
    let door = (3.0..4.2).contains(&in_room.0) || (3.0..4.0).contains(&in_room.1);
    let pillar = point.x.rem_euclid(24.0) < 0.4 && point.y.rem_euclid(24.0) < 0.4;
    let wall = to_wall < OUTLINE || (office_wall && !door) || pillar;
    if wall { Occupancy::Occupied } else { Occupancy::Free }
}
