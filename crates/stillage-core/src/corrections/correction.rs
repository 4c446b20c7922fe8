//! One correction as data.

use serde::{Deserialize, Serialize};

use crate::geometry::{Point, RigidMotion};

/// What a person says about a map. Points are metres of the map frame.
///
/// As JSON: `{"kind": "split", "line": [[0, 1.5], [4, 1.5]]}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "camelCase", rename_all_fields = "camelCase", deny_unknown_fields)]
pub enum Correction {
    /// What lies inside a polygon is one face.
    Draw {
        /// The corners; the first one may be repeated at the end.
        ring: Vec<Point>,
        /// Id of its label.
        label: String,
        /// Its name.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        name: Option<String>,
    },
    /// The faces that a line crosses are cut along it.
    Split {
        /// Two points or more.
        line: Vec<Point>,
    },
    /// Faces become one.
    Merge {
        /// A point inside each of them. The whole has the first label and the first name that people gave one of them, in
        /// this order.
        at: Vec<Point>,
    },
    /// A rectangle is cut into places.
    Row {
        /// Its corners; the first side, from the first corner to the second, runs along the row.
        rectangle: [Point; 4],
        /// How many places there are side by side; this or the pitch is given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        places: Option<u32>,
        /// Distance from place to place, metres; the number of places is the nearest whole one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pitch_m: Option<f64>,
        /// How many places there are one behind the other.
        #[serde(default = "one_layer")]
        layers: u32,
        /// Id of their label. Without one they have the label of their category.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        label: Option<String>,
    },
    /// What was found inside a polygon is nothing: it joins the ground around it.
    Erase {
        /// The corners; the first one may be repeated at the end.
        ring: Vec<Point>,
    },
    /// A face has a label.
    Label {
        /// A point inside it.
        at: Point,
        /// Id of its label.
        label: String,
    },
    /// The border along a line is a door, or is shut.
    Door {
        /// From jamb to jamb.
        line: [Point; 2],
        /// Whether vehicles may pass.
        is_open: bool,
    },
    /// A face has a name.
    Name {
        /// A point inside it.
        at: Point,
        /// Its name.
        name: String,
    },
}

const fn one_layer() -> u32 {
    1
}

impl Correction {
    /// The correction in another frame.
    #[must_use]
    pub fn moved(mut self, motion: &RigidMotion) -> Self {
        for point in self.points_mut() {
            *point = motion.apply(*point);
        }
        self
    }

    /// All its points.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        match self {
            Self::Draw { ring, .. } | Self::Erase { ring } => ring,
            Self::Split { line } => line,
            Self::Merge { at } => at,
            Self::Row { rectangle, .. } => rectangle,
            Self::Label { at, .. } | Self::Name { at, .. } => std::slice::from_ref(at),
            Self::Door { line, .. } => line,
        }
    }

    pub(super) fn points_mut(&mut self) -> &mut [Point] {
        match self {
            Self::Draw { ring, .. } | Self::Erase { ring } => ring,
            Self::Split { line } => line,
            Self::Merge { at } => at,
            Self::Row { rectangle, .. } => rectangle,
            Self::Label { at, .. } | Self::Name { at, .. } => std::slice::from_mut(at),
            Self::Door { line, .. } => line,
        }
    }

    /// JSON pointer to one of its points.
    pub(super) fn pointer(&self, point: usize) -> String {
        match self {
            Self::Draw { .. } | Self::Erase { .. } => format!("/ring/{point}"),
            Self::Split { .. } | Self::Door { .. } => format!("/line/{point}"),
            Self::Merge { .. } => format!("/at/{point}"),
            Self::Row { .. } => format!("/rectangle/{point}"),
            Self::Label { .. } | Self::Name { .. } => "/at".to_owned(),
        }
    }

    /// Id of the label that it gives.
    #[must_use]
    pub fn label(&self) -> Option<&str> {
        match self {
            Self::Draw { label, .. } | Self::Label { label, .. } => Some(label),
            Self::Row { label, .. } => label.as_deref(),
            _ => None,
        }
    }

    /// The name that it gives.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Draw { name, .. } => name.as_deref(),
            Self::Name { name, .. } => Some(name),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    fn read(json: &str) -> Correction {
        serde_json::from_str(json).expect("it is a correction")
    }

    #[test]
    fn a_correction_is_written_as_it_is_read() {
        for json in [
            r#"{"kind":"draw","ring":[[0.0,0.0],[1.0,0.0],[1.0,1.0]],"label":"pc","name":"Rack 12"}"#,
            r#"{"kind":"split","line":[[0.0,0.5],[1.0,0.5]]}"#,
            r#"{"kind":"merge","at":[[0.0,0.5],[1.0,0.5]]}"#,
            r#"{"kind":"row","rectangle":[[0.0,0.0],[9.0,0.0],[9.0,1.0],[0.0,1.0]],"pitchM":1.2,"layers":1}"#,
            r#"{"kind":"erase","ring":[[0.0,0.0],[1.0,0.0],[1.0,1.0]]}"#,
            r#"{"kind":"label","at":[3.0,4.0],"label":"co"}"#,
            r#"{"kind":"door","line":[[0.0,0.0],[0.0,1.0]],"isOpen":true}"#,
            r#"{"kind":"name","at":[3.0,4.0],"name":"Cold store"}"#,
        ] {
            assert_eq!(serde_json::to_string(&read(json)).expect("it can be written"), json);
        }
        let whole_numbers = read(r#"{"kind":"row","rectangle":[[0,0],[9,0],[9,1],[0,1]],"places":12}"#);
        assert!(matches!(whole_numbers, Correction::Row { places: Some(12), layers: 1, .. }));
        assert!(serde_json::from_str::<Correction>(r#"{"kind":"label","at":[3,4],"label":"co","colour":1}"#).is_err());
    }

    #[test]
    fn a_correction_is_carried_to_another_frame() {
        let motion = RigidMotion { shift: Vector::new(1.0, 2.0), turn: std::f64::consts::FRAC_PI_2 };
        let moved = read(r#"{"kind":"split","line":[[1,0],[3,0]]}"#).moved(&motion);
        let expected = [Point::new(1.0, 3.0), Point::new(1.0, 5.0)];
        assert!(moved.points().iter().zip(expected).all(|(point, expected)| (point - expected).norm() < 1e-12));
    }
}
