//! The hall of the tests of [`crate::features`] with a graph drawn by hand.

use std::sync::OnceLock;

use stillage_core::arrangement::{CellFaces, FaceId};
use stillage_core::graph::{GraphNode, Lane, LaneKind, NavigationGraph, NodeKind};
use stillage_core::layout::{Layout, Location};
use stillage_core::semantics::LabelId;
use stillage_core::{OccupancyGrid, Point};

use crate::exports::ExportSource;
use crate::features::MapNames;
use crate::features::tests::{hall, hall_view};

/// What the exports of a test read.
pub(crate) struct Site {
    pub name: &'static str,
    pub grid: OccupancyGrid,
    pub cells: CellFaces,
    pub layout: Layout,
    pub graph: NavigationGraph,
}

impl Site {
    /// All locations; along each aisle a lane both ways, and a spur to each location.
    pub fn whole() -> &'static Self {
        static WHOLE: OnceLock<Site> = OnceLock::new();
        WHOLE.get_or_init(|| Self::new("Hall <1> & \"2\": #3", hall_view().layout.clone()))
    }

    /// The first three locations of the first aisle.
    pub fn small() -> &'static Self {
        static SMALL: OnceLock<Site> = OnceLock::new();
        SMALL.get_or_init(|| {
            let mut layout = hall_view().layout.clone();
            layout.locations.truncate(3);
            layout.aisles.truncate(1);
            layout.rows.clear();
            for list in layout.aisles.iter_mut().flat_map(|aisle| [&mut aisle.left, &mut aisle.right]) {
                list.retain(|&index| index < 3);
            }
            Self::new("Hall", layout)
        })
    }

    fn new(name: &'static str, layout: Layout) -> Self {
        let grid = hall();
        let cells = CellFaces::of_grid(&hall_view().analysis.subdivision, &grid);
        let graph = drawn_graph(&layout);
        Self { name, grid, cells, layout, graph }
    }

    pub fn source(&self) -> ExportSource<'_> {
        let Self { name, grid, cells, layout, graph } = self;
        let view = hall_view();
        ExportSource {
            name,
            map_id: "hall",
            version: "7",
            created: "2026-01-15T08:00:00Z".parse().unwrap(),
            grid,
            analysis: view.analysis,
            semantic: view.semantic,
            cells,
            layout,
            names: MapNames::none(),
            graph,
            georeference: None,
        }
    }
}

/// The ends of each aisle with a bend between them, joined at their starts, and a spur from the nearest end to each
/// location with an approach.
fn drawn_graph(layout: &Layout) -> NavigationGraph {
    let mut graph = NavigationGraph::default();
    for aisle in &layout.aisles {
        let [start, end] = aisle.center_line;
        let first = graph.nodes.len();
        for position in [start, end] {
            let kind = if position == start { NodeKind::Junction } else { NodeKind::DeadEnd };
            graph.nodes.push(node(format!("N{:04}", graph.nodes.len() + 1), position, kind));
        }
        let bend = Point::from((start.coords + end.coords) / 2.0) + stillage_core::Vector::new(0.0, 0.25);
        join(&mut graph, first, first + 1, vec![start, bend, end], LaneKind::Way);
        if first > 0 {
            let before = graph.nodes[0].position;
            join(&mut graph, 0, first, vec![before, start], LaneKind::Way);
        }
        for &index in aisle.left.iter().chain(&aisle.right) {
            approach(&mut graph, first, index, &layout.locations[index]);
        }
    }
    graph.lanes.sort_by_key(|lane| (lane.from, lane.to));
    let ends: Vec<(usize, usize)> = graph.lanes.iter().map(|lane| (lane.from, lane.to)).collect();
    for lane in &mut graph.lanes {
        lane.twin = ends.iter().position(|&ends| ends == (lane.to, lane.from));
    }
    graph
}

fn approach(graph: &mut NavigationGraph, from: usize, index: usize, location: &Location) {
    if let (Some(pose), 1) = (location.approach, location.depth_in_row) {
        let at = graph.nodes.len();
        let served = node(location.code.clone(), pose.position, NodeKind::Approach);
        graph.nodes.push(GraphNode { location: Some(index), heading: Some(pose.heading), ..served });
        let start = graph.nodes[from].position;
        join(graph, from, at, vec![start, pose.position], LaneKind::Spur);
    }
}

fn node(name: String, position: Point, kind: NodeKind) -> GraphNode {
    GraphNode { name, position, kind, face: FaceId(1), location: None, heading: None, clearance: 1.0 }
}

/// Lanes both ways.
fn join(graph: &mut NavigationGraph, from: usize, to: usize, path: Vec<Point>, kind: LaneKind) {
    let back: Vec<Point> = path.iter().rev().copied().collect();
    for (from, to, path) in [(from, to, path), (to, from, back)] {
        graph.lanes.push(Lane { from, to, path, kind, label: LabelId(0), width: 2.5, twin: None });
    }
}
