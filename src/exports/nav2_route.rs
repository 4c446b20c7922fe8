//! Route graph of Nav2 as GeoJSON.
//!
//! Source: Nav2, `nav2_route`, `geojson_graph_file_loader.cpp`, github.com/ros-navigation/navigation2.
//!
//! Method: a point for each node and for each bend of a lane, because Nav2 drives the straight line between nodes and
//! reads no course of an edge; a line for each straight edge. What the loader asks for: ids are unsigned numbers, unique
//! among nodes and edges; metadata holds texts and numbers alone, no null and no list; numbers are written with a
//! decimal point, because the scorers take an integer for another type and fail. Coordinates are metres of the frame
//! `map`, told as EPSG:3857 as Nav2's own graphs do. Limits: the loader refuses a graph without edges, so there is
//! none.

use serde::Serialize;
use stillage_core::graph::NodeKind;

use super::source::{ExportError, ExportSource};
use super::straight_graph::{StraightEdge, StraightGraph, StraightNode};
use crate::features::rounded;

/// Frame of the coordinates in ROS (REP 105).
const FRAME: &str = "map";

/// A route graph.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteGraph {
    r#type: &'static str,
    name: String,
    crs: RouteCrs,
    /// Nodes, then edges.
    pub features: Vec<RouteFeature>,
}

/// The system of the coordinates, as in GeoJSON of 2008.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteCrs {
    r#type: &'static str,
    properties: RouteCrsName,
}

/// Name of a system.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteCrsName {
    name: &'static str,
}

/// A node or an edge.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum RouteFeature {
    /// A point.
    Node(GeoFeature<RouteNodeProperties, [f64; 2]>),
    /// A line.
    Edge(GeoFeature<RouteEdgeProperties, [Vec<[f64; 2]>; 1]>),
}

/// A GeoJSON feature.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GeoFeature<P, C> {
    r#type: &'static str,
    properties: P,
    geometry: GeoShape<C>,
}

/// A GeoJSON geometry.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GeoShape<C> {
    r#type: &'static str,
    coordinates: C,
}

/// What Nav2 reads of a node.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteNodeProperties {
    id: usize,
    frame: &'static str,
    metadata: RouteNodeMetadata,
}

/// What plugins read of a node.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteNodeMetadata {
    name: String,
    class: &'static str,
    /// Code of the location that is served there.
    #[serde(skip_serializing_if = "Option::is_none")]
    location: Option<String>,
    /// Where a vehicle looks that serves it, radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    heading: Option<f64>,
}

/// What Nav2 reads of an edge.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteEdgeProperties {
    id: usize,
    startid: usize,
    endid: usize,
    /// Length, metres.
    cost: f64,
    overridable: bool,
    metadata: RouteEdgeMetadata,
}

/// What plugins read of an edge.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RouteEdgeMetadata {
    /// Id of the label of its ground, for the semantic scorer.
    class: String,
    /// Width of the free ground at its narrowest, metres.
    width: f64,
}

/// The graph of a map for Nav2.
///
/// # Errors
/// [`ExportError::NoLanes`]: Nav2 loads no graph without edges.
pub fn graph(source: &ExportSource<'_>) -> Result<RouteGraph, ExportError> {
    if source.graph.lanes.is_empty() {
        return Err(ExportError::NoLanes);
    }
    let graph = StraightGraph::of(source);
    let nodes = graph.nodes.iter().enumerate().map(|(id, each)| node(source, id, each));
    let edges = (graph.nodes.len()..).zip(&graph.edges).map(|(id, &each)| edge(source, &graph, id, each));
    Ok(RouteGraph {
        r#type: "FeatureCollection",
        name: source.name.to_owned(),
        crs: RouteCrs { r#type: "name", properties: RouteCrsName { name: "urn:ogc:def:crs:EPSG::3857" } },
        features: nodes.chain(edges).collect(),
    })
}

fn node(source: &ExportSource<'_>, id: usize, node: &StraightNode<'_>) -> RouteFeature {
    let location = node.node.and_then(|node| source.layout.locations.get(node.location?));
    let metadata = RouteNodeMetadata {
        name: node.name.to_string(),
        class: node.node.map_or("bend", |node| class(node.kind)),
        location: location.map(|location| location.code.clone()),
        heading: node.node.and_then(|node| node.heading).map(|angle| source.heading(angle)),
    };
    RouteFeature::Node(GeoFeature {
        r#type: "Feature",
        properties: RouteNodeProperties { id, frame: FRAME, metadata },
        geometry: GeoShape { r#type: "Point", coordinates: node.position },
    })
}

fn edge(source: &ExportSource<'_>, graph: &StraightGraph<'_>, id: usize, edge: StraightEdge<'_>) -> RouteFeature {
    let StraightEdge { from, to, lane } = edge;
    let metadata = RouteEdgeMetadata { class: source.lane_label(lane).to_owned(), width: rounded(lane.width) };
    let properties = RouteEdgeProperties {
        id,
        startid: from,
        endid: to,
        cost: rounded(graph.length(edge)),
        overridable: true,
        metadata,
    };
    let course = [from, to].map(|node| graph.nodes[node].position).into();
    RouteFeature::Edge(GeoFeature {
        r#type: "Feature",
        properties,
        geometry: GeoShape { r#type: "MultiLineString", coordinates: [course] },
    })
}

/// The word for what a node is for.
pub(super) const fn class(kind: NodeKind) -> &'static str {
    match kind {
        NodeKind::Junction => "junction",
        NodeKind::Waypoint => "waypoint",
        NodeKind::DeadEnd => "dead-end",
        NodeKind::Approach => "approach",
    }
}
