//! What there is to say of the navigation graph of a map.

use serde::Serialize;
use stillage_core::Point;
use stillage_core::graph::NavigationGraph;
use stillage_core::graph_report::{
    DeadEnd, GraphComponent, GraphFigures, GraphReport, LinkDisagreement, LinkDisagreementKind, NarrowPassage,
    UnreachableLocation, UnreachableReason,
};
use utoipa::ToSchema;

use crate::app::MapContext;
use crate::features::rounded;

/// What there is to say of the navigation graph of a map. Positions are x and y, metres of the map frame.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = GraphReport)]
#[serde(rename_all = "camelCase")]
pub struct GraphReportView {
    /// Distance that the middle of the vehicle keeps from obstacles, metres.
    footprint_radius_m: f64,
    /// Passages narrower than this are told, metres.
    min_passage_width_m: f64,
    /// Random pairs of nodes between which ways were looked for.
    samples: usize,
    /// The number that the pairs follow from.
    seed: u64,
    /// Drivable faces that links join, the largest area first.
    face_components: Vec<FaceComponentView>,
    /// Nodes of the graph that lanes join: the first serves the most locations.
    graph_components: Vec<GraphComponentView>,
    /// Lanes that a vehicle leaves the way it came, the longest first.
    dead_ends: Vec<DeadEndView>,
    /// Locations that no lane of the first component leads to, by code.
    unreachable_locations: Vec<UnreachableLocationView>,
    /// Stretches of lanes narrower than the width asked for, the narrowest first.
    narrow_passages: Vec<NarrowPassageView>,
    /// Borders between drivable faces where labels and obstacles disagree.
    disagreements: Vec<LinkDisagreementView>,
    figures: GraphFiguresView,
}

/// Drivable faces that links join.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FaceComponent)]
#[serde(rename_all = "camelCase")]
pub struct FaceComponentView {
    /// Ids of its faces.
    faces: Vec<u32>,
    area_m2: f64,
    /// How many locations are reached from it.
    locations: usize,
}

/// Nodes of the graph that lanes join.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = GraphComponent)]
#[serde(rename_all = "camelCase")]
pub struct GraphComponentView {
    /// How many nodes it has.
    nodes: usize,
    /// How many pairs of them lanes join.
    edges: usize,
    /// Length of the lanes, both directions once, metres.
    length_m: f64,
    /// How many of its nodes serve locations.
    approaches: usize,
    /// Name of one of its nodes.
    #[schema(example = "N0012")]
    node: String,
    /// Where that node lies.
    position: [f64; 2],
}

/// A stretch of lanes that ends.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = DeadEnd)]
#[serde(rename_all = "camelCase")]
pub struct DeadEndView {
    /// The node it ends at.
    node: String,
    position: [f64; 2],
    /// Length back to where lanes meet, metres.
    length_m: f64,
    /// The node where they meet; null where they never do.
    meets_at: Option<String>,
    /// Codes of the locations that are served along it.
    locations: Vec<String>,
}

/// A location that no lane leads to.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = UnreachableLocation)]
#[serde(rename_all = "camelCase")]
pub struct UnreachableLocationView {
    #[schema(example = "03-012")]
    code: String,
    /// Its centre.
    centre: [f64; 2],
    reason: UnreachableReasonName,
    /// What is wrong, for people.
    detail: String,
    /// Width of the widest vehicle that would find room before it or a way to it, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    width_m: Option<f64>,
    /// Where the way to it is too narrow.
    #[serde(skip_serializing_if = "Option::is_none")]
    position: Option<[f64; 2]>,
}

/// Why a location is not reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[schema(as = UnreachableReason)]
#[serde(rename_all = "kebab-case")]
pub enum UnreachableReasonName {
    /// No drivable ground borders it.
    NoAccess,
    /// The vehicle cannot stand before it.
    NoRoom,
    /// No link joins the ground before it with that of most locations.
    Disconnected,
    /// Obstacles leave too narrow a way.
    TooNarrow,
    /// A vehicle gets there, but the graph does not.
    NoLane,
}

/// A stretch of lanes narrower than the width asked for.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = NarrowPassage)]
#[serde(rename_all = "camelCase")]
pub struct NarrowPassageView {
    /// Width at its narrowest place, metres.
    width_m: f64,
    /// That place.
    position: [f64; 2],
    /// Length of the lanes, metres.
    length_m: f64,
    /// The nodes that each of its lanes joins.
    lanes: Vec<[String; 2]>,
}

/// A border between two drivable faces where labels and obstacles disagree.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LinkDisagreement)]
#[serde(rename_all = "camelCase")]
pub struct LinkDisagreementView {
    kind: LinkDisagreementName,
    /// Ids of the faces.
    faces: [u32; 2],
    /// Ids of the edges between them.
    edges: Vec<u32>,
    /// Length of the edges, metres.
    length_m: f64,
    /// Width of the widest vehicle that could cross it, metres.
    width_m: f64,
    /// Where that is.
    position: [f64; 2],
}

/// How labels and obstacles disagree about a border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[schema(as = LinkDisagreementKind)]
#[serde(rename_all = "kebab-case")]
pub enum LinkDisagreementName {
    /// The rules join the faces, and obstacles close the border to the vehicle.
    ConnectedButClosed,
    /// The rules part the faces, and the vehicle could cross the border.
    DisconnectedButOpen,
}

/// The nineteen figures of the evaluation of NVIDIA's SWAGGER, in metres. Null where there is nothing to measure.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = GraphFigures)]
#[serde(rename_all = "camelCase")]
pub struct GraphFiguresView {
    /// Share of the free ground whose connected piece holds a node, 0 to 1.
    free_space_coverage: f64,
    /// Mean distance from a free cell to the nearest node, metres.
    average_distance_to_node_m: Option<f64>,
    /// Largest such distance, metres.
    max_distance_to_node_m: Option<f64>,
    /// Coverage over the number of nodes.
    coverage_efficiency: f64,
    /// Nodes.
    num_nodes: usize,
    /// Pairs of nodes that lanes join.
    num_edges: usize,
    /// Mean number of edges at a node.
    average_degree: f64,
    /// Mean length of an edge along its course, metres.
    average_edge_length_m: Option<f64>,
    /// Edges on the longest shortest way, in the component with the most nodes.
    graph_diameter: usize,
    /// Mean share of the pairs of a node's neighbours that are neighbours themselves.
    average_clustering: f64,
    /// Mean length of the shortest ways between random pairs of nodes, metres.
    average_path_length_m: Option<f64>,
    /// 1 for straight ways, 0 for ways there and back.
    average_path_smoothness: Option<f64>,
    /// Share of the pairs between which a way leads.
    path_success_rate: Option<f64>,
    /// Mean distance to the nearest obstacle along the ways, metres.
    average_path_clearance_m: Option<f64>,
    /// Whether every lane keeps the footprint radius from obstacles.
    collision_free: Option<bool>,
    /// Whether every node does.
    node_validity: Option<bool>,
    /// Whether all nodes are joined.
    connectivity: Option<bool>,
    /// Components of the graph.
    num_subgraphs: usize,
    /// Whether every lane is longer than nothing and no longer than the diagonal of the map.
    edge_length_validity: Option<bool>,
}

impl GraphReportView {
    /// The view of a report on the graph of an analysed map.
    #[must_use]
    pub fn new(context: &MapContext, graph: &NavigationGraph, report: &GraphReport) -> Self {
        let reader = Reader { context, graph };
        Self {
            footprint_radius_m: report.radius,
            min_passage_width_m: report.options.min_passage_width,
            samples: report.options.samples,
            seed: report.options.seed,
            face_components: report
                .face_components
                .iter()
                .map(|component| FaceComponentView {
                    faces: component.faces.iter().map(|face| face.0).collect(),
                    area_m2: rounded(component.area),
                    locations: component.locations,
                })
                .collect(),
            graph_components: report.components.iter().map(|component| reader.component(component)).collect(),
            dead_ends: report.dead_ends.iter().map(|end| reader.dead_end(end)).collect(),
            unreachable_locations: report.unreachable.iter().map(|missed| reader.unreachable(*missed)).collect(),
            narrow_passages: report.narrow_passages.iter().map(|passage| reader.passage(passage)).collect(),
            disagreements: report.disagreements.iter().map(|border| reader.disagreement(border)).collect(),
            figures: GraphFiguresView::new(&report.figures),
        }
    }
}

/// What names and positions are read from.
struct Reader<'a> {
    context: &'a MapContext,
    graph: &'a NavigationGraph,
}

impl Reader<'_> {
    fn position(&self, point: Point) -> [f64; 2] {
        let point = self.context.analysis.frame.to_map(point);
        [rounded(point.x), rounded(point.y)]
    }

    fn name(&self, node: usize) -> String {
        self.graph.nodes[node].name.clone()
    }

    fn component(&self, component: &GraphComponent) -> GraphComponentView {
        let node = component.nodes[0];
        GraphComponentView {
            nodes: component.nodes.len(),
            edges: component.pairs,
            length_m: rounded(component.length),
            approaches: component.approaches,
            node: self.name(node),
            position: self.position(self.graph.nodes[node].position),
        }
    }

    fn dead_end(&self, end: &DeadEnd) -> DeadEndView {
        let locations = end.approaches.iter().filter_map(|&node| self.graph.nodes[node].location);
        DeadEndView {
            node: self.name(end.node),
            position: self.position(self.graph.nodes[end.node].position),
            length_m: rounded(end.length),
            meets_at: end.meets_at.map(|node| self.name(node)),
            locations: locations.map(|location| self.context.layout.locations[location].code.clone()).collect(),
        }
    }

    fn unreachable(&self, missed: UnreachableLocation) -> UnreachableLocationView {
        let location = &self.context.layout.locations[missed.location];
        let view = |reason, detail: String| UnreachableLocationView {
            code: location.code.clone(),
            centre: self.position(location.center),
            reason,
            detail,
            width_m: None,
            position: None,
        };
        match missed.reason {
            UnreachableReason::NoAccess => {
                view(UnreachableReasonName::NoAccess, "no drivable ground borders it, nor a place before it".to_owned())
            }
            UnreachableReason::NoRoom { width } => UnreachableLocationView {
                width_m: Some(rounded(width)),
                ..view(
                    UnreachableReasonName::NoRoom,
                    format!("before it there is room for a vehicle {width:.2} m wide"),
                )
            },
            UnreachableReason::Disconnected { face } => view(
                UnreachableReasonName::Disconnected,
                format!("no drivable link joins face {face} before it with the ground of most locations"),
            ),
            UnreachableReason::TooNarrow { width, at } => {
                let [x, y] = self.position(at);
                UnreachableLocationView {
                    width_m: Some(rounded(width)),
                    position: Some([x, y]),
                    ..view(
                        UnreachableReasonName::TooNarrow,
                        format!("the widest way to it is {width:.2} m wide at {x:.2}, {y:.2}"),
                    )
                }
            }
            UnreachableReason::NoLane => {
                view(UnreachableReasonName::NoLane, "a vehicle finds a way to it, but the graph has no lane".to_owned())
            }
        }
    }

    fn passage(&self, passage: &NarrowPassage) -> NarrowPassageView {
        let lanes = passage.lanes.iter().map(|&lane| &self.graph.lanes[lane]);
        NarrowPassageView {
            width_m: rounded(passage.width),
            position: self.position(passage.at),
            length_m: rounded(passage.length),
            lanes: lanes.map(|lane| [self.name(lane.from), self.name(lane.to)]).collect(),
        }
    }

    fn disagreement(&self, border: &LinkDisagreement) -> LinkDisagreementView {
        LinkDisagreementView {
            kind: match border.kind {
                LinkDisagreementKind::ConnectedButClosed => LinkDisagreementName::ConnectedButClosed,
                LinkDisagreementKind::DisconnectedButOpen => LinkDisagreementName::DisconnectedButOpen,
            },
            faces: border.faces.map(|face| face.0),
            edges: border.edges.iter().map(|edge| edge.0).collect(),
            length_m: rounded(border.length),
            width_m: rounded(border.width),
            position: self.position(border.at),
        }
    }
}

impl GraphFiguresView {
    fn new(figures: &GraphFigures) -> Self {
        let GraphFigures { coverage, structure, paths, validation } = figures;
        // Few nodes cover a share of the ground to a small part of a thousandth each.
        let small = |value: f64| (value * 1e8).round() / 1e8;
        Self {
            free_space_coverage: rounded(coverage.free_space_coverage),
            average_distance_to_node_m: coverage.average_distance_to_node.map(rounded),
            max_distance_to_node_m: coverage.max_distance_to_node.map(rounded),
            coverage_efficiency: small(coverage.coverage_efficiency),
            num_nodes: structure.nodes,
            num_edges: structure.edges,
            average_degree: rounded(structure.average_degree),
            average_edge_length_m: structure.average_edge_length.map(rounded),
            graph_diameter: structure.graph_diameter,
            average_clustering: rounded(structure.average_clustering),
            average_path_length_m: paths.average_path_length.map(rounded),
            average_path_smoothness: paths.average_path_smoothness.map(rounded),
            path_success_rate: paths.path_success_rate.map(rounded),
            average_path_clearance_m: paths.average_path_clearance.map(rounded),
            collision_free: validation.collision_free,
            node_validity: validation.node_validity,
            connectivity: validation.connectivity,
            num_subgraphs: validation.subgraphs,
            edge_length_validity: validation.edge_length_validity,
        }
    }
}
