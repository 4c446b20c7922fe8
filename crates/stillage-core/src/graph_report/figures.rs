//! The nineteen figures of a graph that NVIDIA's SWAGGER defines.

use super::components::GraphComponent;
use super::coverage::{self, CoverageFigures};
use super::lane_network::LaneNetwork;
use super::options::ReportOptions;
use super::paths::{self, PathFigures};
use super::structure::{self, StructureFigures};
use super::validation::{self, ValidationFigures};
use crate::routing::Router;
use crate::site_map::SiteMap;
use crate::watch::{Stopped, Watch};

/// Nineteen figures of a graph, in the four groups of SWAGGER's `WaypointGraphEvaluator.evaluate_all`.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphFigures {
    /// How well the graph covers the free ground (`coverage`).
    pub coverage: CoverageFigures,
    /// Its size and form (`graph_structure`).
    pub structure: StructureFigures,
    /// The ways between random pairs of its nodes (`path_planning`).
    pub paths: PathFigures,
    /// Whether it can be driven (`validation`).
    pub validation: ValidationFigures,
}

impl GraphFigures {
    pub(super) fn of(
        map: &SiteMap<'_>,
        router: &Router,
        network: &LaneNetwork<'_>,
        components: &[GraphComponent],
        options: &ReportOptions,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        Ok(Self {
            coverage: coverage::coverage(map, network, watch)?,
            structure: structure::structure(network, components, watch)?,
            paths: paths::paths(map, network, options, watch)?,
            validation: validation::validation(map, router, network, components),
        })
    }
}
