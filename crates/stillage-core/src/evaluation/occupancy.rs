//! Whether goods stand on a place: what was found against what is true. Cost: O(places).

use crate::annotation::FaceAnnotation;
use crate::layout::{OccupancyState, occupancy};

/// How the occupancy of places agrees with the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OccupancyScores {
    /// Places that count and that one face fits.
    pub places: usize,
    /// Share of them that were read right; not to know is wrong.
    pub accuracy: f64,
    /// Of those that hold goods: read as occupied, empty, unknown.
    pub occupied: [usize; 3],
    /// Of those that are empty: read as occupied, empty, unknown.
    pub empty: [usize; 3],
}

impl OccupancyScores {
    /// Compares places, each with its truth (whether goods stand there) and its face; `None` without any.
    pub(super) fn of<'a>(places: impl Iterator<Item = (bool, &'a FaceAnnotation)>) -> Option<Self> {
        let mut found = [[0; 3]; 2];
        for (is_occupied, face) in places {
            let read = match occupancy(face).state {
                OccupancyState::Occupied => 0,
                OccupancyState::Empty => 1,
                OccupancyState::Unknown => 2,
            };
            found[usize::from(!is_occupied)][read] += 1;
        }
        let [occupied, empty] = found;
        let places: usize = found.iter().flatten().sum();
        let accuracy = (occupied[0] + empty[1]) as f64 / places as f64;
        (places > 0).then_some(Self { places, accuracy, occupied, empty })
    }
}
