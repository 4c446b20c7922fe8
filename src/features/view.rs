//! What features are made from, and how its numbers are written.

use std::sync::Arc;

use stillage_core::arrangement::EdgeId;
use stillage_core::geometry::fold_half_turn;
use stillage_core::layout::Layout;
use stillage_core::semantics::{LabelId, SemanticMap};
use stillage_core::{Analysis, Point};

use super::names::MapNames;
use super::words;

/// An analysed map with its labels and its storage layout.
#[derive(Debug, Clone, Copy)]
pub struct AnalysedMap<'a> {
    /// The geometric level.
    pub analysis: &'a Analysis,
    /// The human level.
    pub semantic: &'a SemanticMap,
    /// Storage locations, aisles and rows.
    pub layout: &'a Layout,
    /// What people call its things.
    pub names: &'a MapNames,
}

/// What a label says of a face, place or location.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabelWords {
    /// Its id in the rule set.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// What it is for, in the words of [`words::FUNCTIONALITIES`].
    pub functionality: Vec<&'static str>,
}

impl AnalysedMap<'_> {
    /// What each label of the rule set says, by [`LabelId`].
    pub(super) fn labels(&self) -> Labels {
        let words = |label: &stillage_core::semantics::Label| {
            Arc::new(LabelWords {
                id: label.id.clone(),
                name: label.name.clone(),
                functionality: label.functionality.iter().copied().map(words::functionality).collect(),
            })
        };
        Labels(self.semantic.rule_set.labels().iter().map(words).collect())
    }

    /// A point of the grid frame in the map frame.
    pub(super) fn position(&self, point: Point) -> Point {
        self.analysis.frame.to_map(point)
    }

    /// A point of the grid frame as a property: x and y in the map frame.
    pub(super) fn rounded_position(&self, point: Point) -> [f64; 2] {
        let point = self.position(point);
        [rounded(point.x), rounded(point.y)]
    }

    /// An undirected line's angle in the grid frame -> degrees in the map frame, `[-90, 90)`.
    pub(super) fn orientation_degrees(&self, angle: f64) -> f64 {
        let degrees = rounded(fold_half_turn(self.analysis.frame.angle_to_map(angle)).to_degrees());
        if degrees >= 90.0 { degrees - 180.0 } else { degrees }
    }

    /// A direction in the grid frame -> degrees in the map frame, `[-180, 180)`.
    #[must_use]
    pub fn heading_degrees(&self, angle: f64) -> f64 {
        let turned = (self.analysis.frame.angle_to_map(angle).to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
        let degrees = rounded(turned);
        if degrees >= 180.0 { degrees - 360.0 } else { degrees }
    }

    /// The codes of some locations, by their indices.
    pub(super) fn codes(&self, locations: &[usize]) -> Vec<String> {
        locations.iter().map(|&index| self.layout.locations[index].code.clone()).collect()
    }

    /// Whether an edge has a dual: edges on the outer boundary have none.
    pub(super) fn has_link(&self, edge: EdgeId) -> bool {
        self.semantic.connectivity[edge.index()].is_some()
    }
}

/// What the labels of a rule set say.
#[derive(Debug)]
pub struct Labels(Vec<Arc<LabelWords>>);

impl Labels {
    /// What a label says.
    pub(super) fn of(&self, label: LabelId) -> Arc<LabelWords> {
        Arc::clone(&self.0[usize::from(label.0)])
    }
}

/// Rounds to four decimals: a tenth of a millimetre.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    (value * 1e4).round() / 1e4 + 0.0
}
