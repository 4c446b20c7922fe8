//! Whether a correction makes sense on its own, before it meets a map.

use super::correction::Correction;
use crate::geometry::{Point, polygon, ring_area};
use crate::registry::checked_name;

/// Most faces that one correction may make, and most points that it may have: a row of all places of the largest
/// warehouses (about 100,000 places). Callers may allow fewer.
pub(super) const MOST_FACES: usize = 100_000;
/// Least area of a polygon or rectangle, square metres: 1 cm by 1 cm, far below the smallest place.
const LEAST_AREA_M2: f64 = 1e-4;
/// Greatest coordinate, metres: a quarter of the way around the Earth, as far as projected coordinates reach.
const FARTHEST_M: f64 = 1e7;

/// Why a correction cannot be applied, in plain words.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{pointer}: {message}")]
pub struct CorrectionProblem {
    /// JSON pointer into the correction; empty for the whole of it.
    pub pointer: String,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl CorrectionProblem {
    pub(super) fn new(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), message: message.into() }
    }
}

impl Correction {
    /// Checks what can be checked without a map: points that are numbers, polygons that do not cross themselves, rows of
    /// at most `most_faces` places, names.
    ///
    /// # Errors
    /// The first problem, with its place in the correction.
    pub fn check(&self, most_faces: usize) -> Result<(), CorrectionProblem> {
        let most_faces = most_faces.min(MOST_FACES);
        if self.points().len() > MOST_FACES {
            let message = format!(
                "{} points are more than {MOST_FACES}: leave out points that lie on straight sides",
                self.points().len()
            );
            return Err(CorrectionProblem::new(self.member(), message));
        }
        let is_far = |point: &Point| !point.iter().all(|side| side.abs() <= FARTHEST_M);
        if let Some(far) = self.points().iter().position(is_far) {
            let message = "must be metres of the map frame, [x, y], within 10,000 km";
            return Err(CorrectionProblem::new(self.pointer(far), message));
        }
        match self {
            Self::Draw { ring, .. } | Self::Erase { ring } => check_ring(open_ring(ring), "/ring")?,
            Self::Split { line } if line.len() < 2 => {
                return Err(CorrectionProblem::new("/line", "a line has two points or more"));
            }
            Self::Merge { at } if at.len() < 2 => {
                return Err(CorrectionProblem::new("/at", "name a point in each of two faces or more"));
            }
            Self::Door { line: [start, end], .. } if start == end => {
                return Err(CorrectionProblem::new("/line", "the two jambs of a door lie apart"));
            }
            Self::Row { rectangle, .. } => {
                check_ring(rectangle, "/rectangle")?;
                if !is_convex(rectangle) {
                    return Err(CorrectionProblem::new("/rectangle", "the four corners are those of no rectangle"));
                }
                self.check_row(most_faces)?;
            }
            _ => {}
        }
        self.name().map_or(Ok(()), |name| {
            checked_name(name).map(drop).map_err(|demand| CorrectionProblem::new("/name", format!("a name {demand}")))
        })
    }

    fn check_row(&self, most_faces: usize) -> Result<(), CorrectionProblem> {
        let &Self::Row { places, pitch_m, layers, .. } = self else { return Ok(()) };
        match (places, pitch_m) {
            (Some(0), _) => return Err(CorrectionProblem::new("/places", "a row has one place or more")),
            (Some(_), Some(_)) | (None, None) => {
                let message = "say either how many places the row has (places) or how far apart they are (pitchM)";
                return Err(CorrectionProblem::new("", message));
            }
            (None, Some(pitch)) if !(pitch.is_finite() && pitch > 0.0) => {
                return Err(CorrectionProblem::new("/pitchM", "the pitch must be more than 0 m"));
            }
            _ => {}
        }
        if layers == 0 {
            return Err(CorrectionProblem::new("/layers", "a row has one layer or more"));
        }
        let faces = u64::from(self.places_of_row()) * u64::from(layers);
        if faces > most_faces as u64 {
            let pointer = if places.is_some() { "/places" } else { "/pitchM" };
            let message = format!("{faces} places are more than the {most_faces} that one correction may make");
            return Err(CorrectionProblem::new(pointer, message));
        }
        Ok(())
    }

    /// How many places a row has side by side; 0 for what is no row.
    pub(super) fn places_of_row(&self) -> u32 {
        match self {
            Self::Row { places: Some(places), .. } => *places,
            // Saturates.
            Self::Row { rectangle, pitch_m: Some(pitch), .. } => {
                ((rectangle[1] - rectangle[0]).norm() / pitch).round().max(1.0) as u32
            }
            _ => 0,
        }
    }

    /// JSON pointer to the member that holds its points.
    fn member(&self) -> String {
        let first = self.pointer(0);
        first.strip_suffix("/0").map_or_else(|| first.clone(), str::to_owned)
    }
}

/// Whether a simple ring turns in one direction at all corners.
fn is_convex(ring: &[Point; 4]) -> bool {
    let turn = |corner: usize| {
        let [before, at, after] = [corner, corner + 1, corner + 2].map(|corner| ring[corner % 4]);
        (at - before).perp(&(after - at))
    };
    (0..4).all(|corner| turn(corner) > 0.0) || (0..4).all(|corner| turn(corner) < 0.0)
}

/// The corners of a ring without the first one repeated at the end.
pub(super) fn open_ring(ring: &[Point]) -> &[Point] {
    match ring {
        [first, between @ .., last] if !between.is_empty() && first == last => &ring[..ring.len() - 1],
        _ => ring,
    }
}

/// Checks that a ring is a polygon.
pub(super) fn check_ring(ring: &[Point], member: &str) -> Result<(), CorrectionProblem> {
    if ring.len() < 3 {
        return Err(CorrectionProblem::new(member, "a polygon has three corners or more"));
    }
    if let Some([one, other]) = polygon::crossing_sides(ring) {
        let message =
            format!("sides {one} and {other} cross or touch: put the corners in their order around the polygon");
        return Err(CorrectionProblem::new(member, message));
    }
    if ring_area(ring).abs() < LEAST_AREA_M2 {
        return Err(CorrectionProblem::new(member, "the polygon has no area: its corners lie on one line"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::*;

    #[test]
    fn what_makes_no_sense_is_told_with_its_place() {
        let problem = |json: &str| {
            serde_json::from_str::<Correction>(json)
                .expect("it is a correction")
                .check(5_000)
                .map_or_else(|problem| problem.to_string(), |()| "fine".to_owned())
        };
        let told: Vec<String> = [
            r#"{"kind":"draw","ring":[[0,0],[2,2],[2,0],[0,2]],"label":"pc"}"#,
            r#"{"kind":"draw","ring":[[0,0],[2,2]],"label":"pc"}"#,
            r#"{"kind":"draw","ring":[[0,0],[1,0],[2,0.00000001]],"label":"pc"}"#,
            r#"{"kind":"draw","ring":[[0,0],[1,0],[1,1]],"label":"pc","name":""}"#,
            r#"{"kind":"label","at":[1e9,1],"label":"pc"}"#,
            r#"{"kind":"split","line":[[0,0]]}"#,
            r#"{"kind":"merge","at":[[0,0]]}"#,
            r#"{"kind":"door","line":[[0,0],[0,0]],"isOpen":true}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":1000000}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"pitchM":0.000001}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"pitchM":0}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":0}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":3,"layers":0}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":3,"pitchM":3}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[1,1],[0,9]],"places":3}"#,
            r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":3}"#,
        ]
        .map(problem)
        .into();
        expect![[r#"
            /ring: sides 0 and 2 cross or touch: put the corners in their order around the polygon
            /ring: a polygon has three corners or more
            /ring: the polygon has no area: its corners lie on one line
            /name: a name must have 1 to 200 characters, none of them a control character
            /at: must be metres of the map frame, [x, y], within 10,000 km
            /line: a line has two points or more
            /at: name a point in each of two faces or more
            /line: the two jambs of a door lie apart
            /places: 1000000 places are more than the 5000 that one correction may make
            /pitchM: 9000000 places are more than the 5000 that one correction may make
            /pitchM: the pitch must be more than 0 m
            /places: a row has one place or more
            /layers: a row has one layer or more
            : say either how many places the row has (places) or how far apart they are (pitchM)
            /rectangle: the four corners are those of no rectangle
            fine
        "#]]
        .assert_eq(&(told.join("\n") + "\n"));
        let not_a_number = Correction::Label { at: Point::new(f64::NAN, 0.0), label: "pc".to_owned() };
        assert!(not_a_number.check(5_000).is_err());
    }
}
