//! What every export reads, and how its numbers are written.

use std::f64::consts::PI;

use jiff::Timestamp;
use stillage_core::arrangement::CellFaces;
use stillage_core::graph::{Lane, NavigationGraph};
use stillage_core::layout::{Layout, Location};
use stillage_core::semantics::SemanticMap;
use stillage_core::{Analysis, OccupancyGrid, Point};
use thiserror::Error;

use crate::coordinates::Georeference;
use crate::features::{AnalysedMap, MapNames, rounded};

/// Name of this program, where a format asks for the author of a file.
pub(super) const CREATOR: &str = "stillage";

/// Decimals that angles are rounded to: a millionth of a radian moves the end of a 100 m lane by a tenth of a
/// millimetre.
const ANGLE_STEPS: f64 = 1e6;

/// A map with all that its exports tell.
#[derive(Debug, Clone, Copy)]
pub struct ExportSource<'a> {
    /// Name of the map, for people.
    pub name: &'a str,
    /// Id of the map.
    pub map_id: &'a str,
    /// Version of the map and its labels: another text with every change.
    pub version: &'a str,
    /// When that version was made. Exports tell this time, not that of the export: the same version gives the same
    /// bytes.
    pub created: Timestamp,
    /// Its cells.
    pub grid: &'a OccupancyGrid,
    /// The geometric level.
    pub analysis: &'a Analysis,
    /// The human level.
    pub semantic: &'a SemanticMap,
    /// The face of every cell.
    pub cells: &'a CellFaces,
    /// Storage locations, aisles and rows.
    pub layout: &'a Layout,
    /// What people call its things.
    pub names: &'a MapNames,
    /// Nodes and lanes; not read by exports that have no option `footprintRadiusM`.
    pub graph: &'a NavigationGraph,
    /// Where the map lies on Earth.
    pub georeference: Option<Georeference>,
}

/// Why a map cannot be exported in some format.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ExportError {
    /// The format has no empty graph.
    #[error("the map has no lanes: label its corridors and junctions first")]
    NoLanes,
    /// The map has more rows than a sheet of the format holds.
    #[error("the map has {rows} locations, a sheet holds {most}")]
    TooManyRows {
        /// Locations of the map.
        rows: usize,
        /// The most that fit.
        most: usize,
    },
    /// A vehicle needs an address to fetch the bundle from.
    #[error("link is missing: say where vehicles fetch bundle.zip")]
    NoLink,
    /// An option is about a label that the map does not have.
    #[error("no label has the id {label}; there are {known}")]
    UnknownLabel {
        /// The option.
        option: &'static str,
        /// The id.
        label: String,
        /// The ids that there are.
        known: String,
    },
}

impl<'a> ExportSource<'a> {
    /// The map as [`crate::features`] reads it.
    pub(super) const fn view(&self) -> AnalysedMap<'a> {
        AnalysedMap { analysis: self.analysis, semantic: self.semantic, layout: self.layout, names: self.names }
    }

    /// When the version was made, ISO 8601 in UTC with milliseconds: the form that VDA 5050 asks for.
    pub(super) fn created_text(&self) -> String {
        format!("{:.3}", self.created)
    }

    /// A point of the grid frame -> x and y in the map frame, metres, rounded to a tenth of a millimetre.
    pub(super) fn position(&self, point: Point) -> [f64; 2] {
        let point = self.analysis.frame.to_map(point);
        [rounded(point.x), rounded(point.y)]
    }

    /// A direction in the grid frame -> radians in the map frame, within `[-pi, pi]`.
    pub(super) fn heading(&self, angle: f64) -> f64 {
        let turned = (self.analysis.frame.angle_to_map(angle) + PI).rem_euclid(2.0 * PI) - PI;
        // Adding 0 turns -0 into 0; rounding must not lead beyond pi.
        ((turned * ANGLE_STEPS).round() / ANGLE_STEPS + 0.0).clamp(-PI, PI)
    }

    /// A direction in the grid frame -> degrees in the map frame, within `[-180, 180)`.
    pub(super) fn heading_degrees(&self, angle: f64) -> f64 {
        let degrees = rounded(self.heading(angle).to_degrees());
        if degrees >= 180.0 { degrees - 360.0 } else { degrees }
    }

    /// Id of the label of the ground that a lane begins on.
    pub(super) fn lane_label(&self, lane: &Lane) -> &'a str {
        &self.semantic.rule_set.label(lane.label).id
    }

    /// Name of the label of a location.
    pub(super) fn location_label(&self, location: &Location) -> &'a str {
        &self.semantic.rule_set.label(location.label).name
    }

    /// The node where each location is served, by location. A location behind others is served where the one in front
    /// of it is; `None` where no node serves it.
    pub(super) fn serving_nodes(&self) -> Vec<Option<usize>> {
        let locations = &self.layout.locations;
        let mut serving = vec![None; locations.len()];
        for (index, node) in self.graph.nodes.iter().enumerate() {
            if let Some(entry) = node.location.and_then(|location| serving.get_mut(location)) {
                *entry = Some(index);
            }
        }
        // Locations are sorted by aisle, bay and depth: the one in front comes just before.
        for index in 1..locations.len() {
            let (front, own) = (&locations[index - 1], &locations[index]);
            let is_behind = own.depth_in_row > 1 && own.aisle > 0 && (front.aisle, front.bay) == (own.aisle, own.bay);
            if serving[index].is_none() && is_behind {
                serving[index] = serving[index - 1];
            }
        }
        serving
    }
}
