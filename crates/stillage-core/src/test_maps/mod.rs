//! Maps for tests: drawn rack halls, real maps that lie outside the repository, and subdivisions of a few segments.

pub(crate) mod real_maps;
pub(crate) mod segments;

use real_maps::Picture;

use crate::geometry::{Point, direction, normal};
use crate::grid::{GridFrame, Occupancy, OccupancyGrid};

/// A rectangle of floor with rows of racks, at any angle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hall {
    /// Middle of the floor, metres.
    pub center: [f64; 2],
    /// Length along the racks and width across them, metres.
    pub size: [f64; 2],
    /// Direction of the racks, degrees.
    pub angle_deg: f64,
}

impl Hall {
    /// What the hall has at a point: walls of 0.2 m, racks 1.1 m deep every 4 m, posts in them every 2.7 m.
    fn at(&self, point: Point) -> Option<Occupancy> {
        let angle = self.angle_deg.to_radians();
        let offset = point - Point::from(self.center);
        let (along, across) = (direction(angle).dot(&offset), normal(angle).dot(&offset));
        let [length, width] = self.size.map(|side| side / 2.0);
        if along.abs() > length || across.abs() > width {
            return None;
        }
        let wall = along.abs() > length - 0.2 || across.abs() > width - 0.2;
        let in_rack =
            along.abs() < length - 3.0 && (across + width - 2.0).rem_euclid(4.0) < 1.1 && across < width - 2.0;
        let on_face = {
            let depth = (across + width - 2.0).rem_euclid(4.0);
            !(0.1..=1.0).contains(&depth)
        };
        let post = (along + length).rem_euclid(2.7) < 0.1;
        Some(match (wall, in_rack) {
            (true, _) => Occupancy::Occupied,
            (false, true) if on_face || post => Occupancy::Occupied,
            (false, true) => Occupancy::Unknown,
            (false, false) => Occupancy::Free,
        })
    }
}

/// Draws halls on a grid of `width` x `height` metres; the first hall that has a point decides.
pub(crate) fn draw(halls: &[Hall], [width, height]: [f64; 2], resolution: f64) -> OccupancyGrid {
    let (columns, rows) = ((width / resolution).round() as usize, (height / resolution).round() as usize);
    let frame = GridFrame { resolution, origin: Point::origin(), yaw: 0.0 };
    let cells = (0..rows * columns)
        .map(|index| {
            let (column, row) = (index % columns, index / columns);
            let center = Point::new((column as f64 + 0.5) * resolution, (row as f64 + 0.5) * resolution);
            halls.iter().find_map(|hall| hall.at(center)).unwrap_or(Occupancy::Unknown)
        })
        .collect();
    OccupancyGrid::new(columns, rows, frame, cells)
}

/// A real map by the name of its folder, under the usual thresholds; `None`, with a printed line, where there are no
/// maps.
///
/// # Panics
/// Where there are no maps although `CI` is `true`.
pub(crate) fn real(name: &str, resolution: f64) -> Option<OccupancyGrid> {
    let path = real_maps::find_folder(&format!("dev/{name}"))?;
    let file = ["map.png", "map.pgm"].map(|file| path.join(file)).into_iter().find(|file| file.is_file());
    // Thresholds 0.65 and 0.196, under which grey 205 stays unknown.
    Some(Picture::read(&file.expect("a map has a picture")).grid(resolution, 89, 206))
}
