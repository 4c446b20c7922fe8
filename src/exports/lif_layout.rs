//! What versions 1 and 2 of the Layout Interchange Format share: the document, its nodes and its stations.
//!
//! Source: VDMA, Layout Interchange Format, github.com/Intralogistics-2X-LIF/Layout-Interchange-Format.
//!
//! Method: a node for each node of the graph and for each bend of a lane, straight edges between them, a station for each
//! location that a node serves. A trajectory with a sharp bend would need a vehicle that turns on the edge, and fleet
//! managers may leave trajectories out; between nodes every vehicle drives the same straight line. The id of a station is
//! the code of its location, as version 2 recommends, so that warehouse and fleet management name the same thing by the
//! same word. A location that no node serves is no station: the list of its nodes must not be empty. Limits: one layout,
//! one type of vehicle; vehicles drive forwards.

use serde::Serialize;
use stillage_core::graph::Lane;

use super::source::{CREATOR, ExportSource};
use super::straight_graph::{StraightEdge, StraightGraph, StraightNode};

/// The one type of vehicle that layouts are written for. Fleet managers replace it by `manufacturer.series`.
pub(super) const VEHICLE_TYPE: &str = "generic";

/// The one storey of a map.
const LEVEL: &str = "0";

/// A LIF document; `E` is what a version says of an edge.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifDocument<E> {
    /// Whose layout it is.
    pub meta_information: LifMetaInformation,
    /// One layout.
    pub layouts: Vec<LifLayout<E>>,
}

/// Whose layout it is, and of when.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifMetaInformation {
    project_identification: String,
    creator: &'static str,
    export_timestamp: String,
    lif_version: &'static str,
}

/// Nodes, edges and stations.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifLayout<E> {
    layout_id: String,
    layout_name: String,
    layout_version: String,
    layout_level_id: &'static str,
    /// Where vehicles may stop.
    pub nodes: Vec<LifNode>,
    /// Where they may drive.
    pub edges: Vec<LifEdge<E>>,
    /// Where they interact.
    pub stations: Vec<LifStation>,
}

/// Where a vehicle may stop or turn.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifNode {
    node_id: String,
    map_id: String,
    node_position: LifPosition,
    vehicle_type_node_properties: [LifNodeProperties; 1],
}

/// Metres, map frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LifPosition {
    x: f64,
    y: f64,
}

/// What a node means to a type of vehicle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifNodeProperties {
    vehicle_type_id: &'static str,
    /// Where it looks, radians; free where absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    theta: Option<f64>,
}

/// A way in one direction.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifEdge<E> {
    edge_id: String,
    start_node_id: String,
    end_node_id: String,
    /// What it means to the one type of vehicle.
    pub vehicle_type_edge_properties: [E; 1],
}

/// A place where vehicles interact with the site: a storage location.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifStation {
    station_id: String,
    interaction_node_ids: [String; 1],
    station_name: String,
    station_position: LifStationPosition,
}

/// Centre of a station, and the direction from its access into it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LifStationPosition {
    x: f64,
    y: f64,
    theta: f64,
}

/// The document of a version of the format; `properties` says what that version tells of a lane.
pub(super) fn document<E>(
    source: &ExportSource<'_>,
    lif_version: &'static str,
    properties: impl Fn(&Lane) -> E,
) -> LifDocument<E> {
    let graph = StraightGraph::of(source);
    let edge = |edge: &StraightEdge<'_>| {
        let [start, end] = [edge.from, edge.to].map(|node| graph.nodes[node].name.to_string());
        LifEdge {
            edge_id: format!("{start}>{end}"),
            start_node_id: start,
            end_node_id: end,
            vehicle_type_edge_properties: [properties(edge.lane)],
        }
    };
    let layout = LifLayout {
        layout_id: source.map_id.to_owned(),
        layout_name: source.name.to_owned(),
        layout_version: source.version.to_owned(),
        layout_level_id: LEVEL,
        nodes: graph.nodes.iter().map(|each| node(source, each)).collect(),
        edges: graph.edges.iter().map(edge).collect(),
        stations: stations(source),
    };
    LifDocument {
        meta_information: LifMetaInformation {
            project_identification: source.name.to_owned(),
            creator: CREATOR,
            export_timestamp: source.created_text(),
            lif_version,
        },
        layouts: vec![layout],
    }
}

fn node(source: &ExportSource<'_>, node: &StraightNode<'_>) -> LifNode {
    let [x, y] = node.position;
    LifNode {
        node_id: node.name.to_string(),
        map_id: source.map_id.to_owned(),
        node_position: LifPosition { x, y },
        vehicle_type_node_properties: [LifNodeProperties {
            vehicle_type_id: VEHICLE_TYPE,
            theta: node.node.and_then(|node| node.heading).map(|angle| source.heading(angle)),
        }],
    }
}

fn stations(source: &ExportSource<'_>) -> Vec<LifStation> {
    let station = |(location, node): (&stillage_core::layout::Location, Option<usize>)| {
        let [x, y] = source.position(location.center);
        Some(LifStation {
            station_id: location.code.clone(),
            interaction_node_ids: [source.graph.nodes[node?].name.clone()],
            station_name: format!("{} {}", source.location_label(location), location.code),
            station_position: LifStationPosition { x, y, theta: source.heading(location.heading) },
        })
    };
    source.layout.locations.iter().zip(source.serving_nodes()).filter_map(station).collect()
}
