//! The whole report.

use super::components::{self, FaceComponent, GraphComponent};
use super::dead_ends::{self, DeadEnd};
use super::disagreements::{self, LinkDisagreement};
use super::figures::GraphFigures;
use super::lane_network::LaneNetwork;
use super::options::ReportOptions;
use super::passages::{self, NarrowPassage};
use super::unreachable::{self, UnreachableLocation};
use crate::graph::NavigationGraph;
use crate::layout::Layout;
use crate::routing::Router;
use crate::site_map::SiteMap;
use crate::watch::{Stopped, Watch};

/// What there is to say of the navigation graph of a map. Points lie in the grid frame; nodes, lanes and locations are
/// named by their index.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphReport {
    /// Radius of the vehicles, metres.
    pub radius: f64,
    /// What was asked for.
    pub options: ReportOptions,
    /// Drivable faces that drivable links join, the largest area first.
    pub face_components: Vec<FaceComponent>,
    /// Nodes that lanes join: the first serves the most locations, or else has the most nodes.
    pub components: Vec<GraphComponent>,
    /// Lanes that a vehicle leaves the way it came, the longest first.
    pub dead_ends: Vec<DeadEnd>,
    /// Locations that no lane of the first component leads to, by index.
    pub unreachable: Vec<UnreachableLocation>,
    /// Stretches narrower than the width asked for, the narrowest first.
    pub narrow_passages: Vec<NarrowPassage>,
    /// Borders between drivable faces where labels and obstacles disagree, by faces.
    pub disagreements: Vec<LinkDisagreement>,
    /// Nineteen figures.
    pub figures: GraphFigures,
}

/// Reports on the navigation graph of a map, for the vehicles of a router.
///
/// A map without drivable ground gives an empty report.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn graph_report(
    map: &SiteMap<'_>,
    layout: &Layout,
    router: &Router,
    graph: &NavigationGraph,
    options: &ReportOptions,
    watch: &Watch<'_>,
) -> Result<GraphReport, Stopped> {
    let network = LaneNetwork::new(graph);
    let radius = router.radius();
    let face_components = components::of_faces(map, layout);
    let components = components::of_graph(&network);
    watch.check()?;
    let unreachable = unreachable::unreachable(map, layout, &network, &components, radius);
    watch.check()?;
    let narrow_passages = passages::narrow(map, &network, options.min_passage_width);
    watch.check()?;
    let figures = GraphFigures::of(map, router, &network, &components, options, watch)?;
    Ok(GraphReport {
        radius,
        options: *options,
        dead_ends: dead_ends::dead_ends(&network),
        disagreements: disagreements::disagreements(map, radius),
        face_components,
        components,
        unreachable,
        narrow_passages,
        figures,
    })
}
