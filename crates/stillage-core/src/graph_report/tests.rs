//! Reports on drawn warehouses.

use super::*;
use crate::arrangement::FaceId;
use crate::geometry::{Point, Vector};
use crate::graph::{GraphNode, Lane, LaneKind, NavigationGraph, NodeKind, navigation_graph};
use crate::layout::Layout;
use crate::routing::Router;
use crate::semantics::pictures::{DrawnMap, RESOLUTION};
use crate::semantics::{LabelId, RuleSet, RuleSetDraft, SemanticMap};
use crate::watch::Watch;
use expect_test::expect;

fn reported(map: &DrawnMap, semantic: &SemanticMap, radius: f64) -> (GraphReport, NavigationGraph, Layout) {
    let (site, layout) = (map.site(semantic), map.layout(semantic));
    let router = Router::new(&site, radius);
    let graph = navigation_graph(&site, &layout, &router);
    let options = ReportOptions::for_radius(radius);
    let report = graph_report(&site, &layout, &router, &graph, &options, &Watch::unwatched()).unwrap();
    (report, graph, layout)
}

fn report(map: &DrawnMap, radius: f64) -> GraphReport {
    reported(map, &map.semantic(&RuleSet::warehouse()), radius).0
}

fn told(point: Point) -> String {
    format!("{:.2},{:.2}", point.x, point.y)
}

/// An aisle that a column narrows, with a way out at one end only.
fn blind_aisle() -> DrawnMap {
    DrawnMap::new(
        "
        ############....
        ############....
        ................
        ......#.........
        ................
        ############....
        ############....
        ",
        "
        ppppqqqqppppjjjj
        ppppqqqqppppjjjj
        ccccccccccccjjjj
        ccccccccccccjjjj
        ccccccccccccjjjj
        ppppqqqqppppjjjj
        ppppqqqqppppjjjj
        ",
    )
}

#[test]
fn a_blind_aisle_is_a_dead_end_with_its_locations() {
    let (report, graph, _) = reported(&blind_aisle(), &blind_aisle().semantic(&RuleSet::warehouse()), 0.2);
    let end = |dead_end: &DeadEnd| {
        let node = &graph.nodes[dead_end.node];
        format!("{} {:.1} m, {} approaches", told(node.position), dead_end.length, dead_end.approaches.len())
    };
    expect![[r#"
        6.90,1.75 7.1 m, 6 approaches
        1.00,1.75 7.1 m, 6 approaches"#]]
    .assert_eq(&report.dead_ends.iter().map(end).collect::<Vec<_>>().join("\n"));
    assert_eq!((report.components.len(), report.unreachable.len(), report.face_components.len()), (1, 0, 1));
}

#[test]
fn a_passage_is_narrow_where_no_wider_way_leads_around() {
    let narrow = |least: f64| {
        let map = blind_aisle();
        let semantic = map.semantic(&RuleSet::warehouse());
        let (site, layout) = (map.site(&semantic), map.layout(&semantic));
        let router = Router::new(&site, 0.2);
        let graph = navigation_graph(&site, &layout, &router);
        let options = ReportOptions { min_passage_width: least, ..ReportOptions::for_radius(0.2) };
        let report = graph_report(&site, &layout, &router, &graph, &options, &Watch::unwatched()).unwrap();
        let line = |passage: &NarrowPassage| format!("{:.1} m wide at {}", passage.width, told(passage.at));
        report.narrow_passages.iter().map(line).collect::<Vec<_>>()
    };
    // Beside the column one cell is left on either side.
    assert_eq!(narrow(0.5), [""; 0]);
    expect![[r#"["0.5 m wide at 3.25,1.25"]"#]].assert_eq(&format!("{:?}", narrow(0.6)));
}

#[test]
fn what_obstacles_close_is_told_with_its_width_and_place() {
    // Goods block the only way to the right, but for a gap of one cell.
    let map = DrawnMap::new(
        "
        ####..####..####
        ####..####..####
        ......#.........
        ......#.........
        ......#.........
        ................
        ",
        "
        ppppjjqqqqjjpppp
        ppppjjqqqqjjpppp
        ccccccdddddddddd
        ccccccdddddddddd
        ccccccdddddddddd
        ccccccdddddddddd
        ",
    );
    let semantic = map.semantic(&RuleSet::warehouse());
    let (report, _, layout) = reported(&map, &semantic, 0.3);
    assert_eq!((report.components.len(), report.face_components.len()), (2, 1));
    let line = |missed: &UnreachableLocation| format!("{} {:?}", layout.locations[missed.location].code, missed.reason);
    expect!["01-001 TooNarrow { width: 0.5, at: [4.25, 0.25] }"]
        .assert_eq(&report.unreachable.iter().map(line).collect::<Vec<_>>().join("\n"));
    let closed: Vec<_> =
        report.disagreements.iter().map(|border| (border.kind, border.width, told(border.at))).collect();
    expect![[r#"[(ConnectedButClosed, 0.5, "3.00,0.00"), (ConnectedButClosed, 0.5, "2.00,2.00"), (ConnectedButClosed, 0.5, "5.00,2.00")]"#]].assert_eq(&format!("{closed:?}"));
    let open = reported(&map, &semantic, 0.2).0;
    assert_eq!((open.components.len(), open.unreachable.len(), open.disagreements.len()), (1, 0, 0));
    assert_eq!(open.figures.validation.connectivity, Some(true));
}

#[test]
fn locations_say_why_they_are_not_reached() {
    let map = DrawnMap::new(
        "
        ##..##..
        ##..##..
        ##......
        ##..####
        .#......
        ##......
        ",
        "
        pp  qqcc
        pp  qqcc
        pp  cccc
        pp  pppp
        qp  dddd
        qp  dddd
        ",
    );
    let semantic = map.semantic(&RuleSet::warehouse());
    let (report, _, layout) = reported(&map, &semantic, 0.2);
    let line = |missed: &UnreachableLocation| format!("{} {:?}", layout.locations[missed.location].code, missed.reason);
    expect![[r#"
        00-001 NoAccess
        00-002 NoAccess
        02-001 Disconnected { face: FaceId(5) }"#]]
    .assert_eq(&report.unreachable.iter().map(line).collect::<Vec<_>>().join("\n"));
    assert_eq!(report.face_components.len(), 2);
}

#[test]
fn open_floor_that_the_rules_call_disconnected_is_told() {
    let map = DrawnMap::new("......\n......\n......", "cccjjj\ncccjjj\ncccjjj");
    let mut draft: RuleSetDraft = RuleSet::warehouse().draft().clone();
    for label in &mut draft.labels {
        label.connects_to.retain(|other| other != "co");
    }
    let semantic = map.semantic(&draft.check().unwrap());
    let report = reported(&map, &semantic, 0.3).0;
    let kinds: Vec<_> = report.disagreements.iter().map(|border| (border.kind, border.width)).collect();
    assert_eq!(kinds, [(LinkDisagreementKind::DisconnectedButOpen, 1.5)]);
    assert_eq!(report.face_components.len(), 2);
}

#[test]
fn a_map_without_drivable_ground_gives_an_empty_report() {
    let report = report(&DrawnMap::new("##", "pp"), 0.2);
    assert_eq!((report.components.len(), report.dead_ends.len(), report.narrow_passages.len()), (0, 0, 0));
    assert_eq!(report.unreachable, [UnreachableLocation { location: 0, reason: UnreachableReason::NoAccess }]);
    let figures = report.figures;
    assert_eq!((figures.coverage.free_space_coverage, figures.coverage.average_distance_to_node), (0.0, None));
    assert_eq!((figures.paths.path_success_rate, figures.validation.connectivity), (None, None));
    assert_eq!((figures.structure.nodes, figures.structure.graph_diameter), (0, 0));
}

/// A graph on an empty floor of 4 m x 4 m: nodes at these places, straight lanes both ways between these pairs.
fn figures_of(nodes: &[[f64; 2]], pairs: &[[usize; 2]], options: &ReportOptions) -> GraphFigures {
    let floor = vec!["c".repeat(8); 8].join("\n");
    let map = DrawnMap::new(&floor.replace('c', "."), &floor);
    let semantic = map.semantic(&RuleSet::warehouse());
    let site = map.site(&semantic);
    let place = |&[x, y]: &[f64; 2]| Point::new(x, y) + Vector::new(RESOLUTION, RESOLUTION) / 2.0;
    let node = |(index, at): (usize, &[f64; 2])| GraphNode {
        name: format!("N{index}"),
        position: place(at),
        kind: NodeKind::Waypoint,
        face: FaceId(1),
        location: None,
        heading: None,
        clearance: site.clearance.at(place(at)),
    };
    let mut lanes: Vec<Lane> = pairs
        .iter()
        .flat_map(|&[from, to]| [[from, to], [to, from]])
        .map(|[from, to]| Lane {
            from,
            to,
            path: vec![place(&nodes[from]), place(&nodes[to])],
            kind: LaneKind::Way,
            label: LabelId(0),
            width: 1.0,
            twin: None,
        })
        .collect();
    lanes.sort_by_key(|lane| (lane.from, lane.to));
    let index = |from: usize, to: usize| lanes.iter().position(|lane| (lane.from, lane.to) == (from, to));
    let twins: Vec<Option<usize>> = lanes.iter().map(|lane| index(lane.to, lane.from)).collect();
    lanes.iter_mut().zip(twins).for_each(|(lane, twin)| lane.twin = twin);
    let graph =
        NavigationGraph { nodes: nodes.iter().enumerate().map(node).collect(), lanes, unmatched_rules: Vec::new() };
    let (router, layout) = (Router::new(&site, 0.2), Layout::default());
    graph_report(&site, &layout, &router, &graph, options, &Watch::unwatched()).unwrap().figures
}

#[test]
fn the_figures_of_a_triangle_with_a_tail_can_be_reckoned_by_hand() {
    // A right triangle of 1.5 m, 2 m and 2.5 m, and a node 1 m on from one of its corners.
    let options = ReportOptions { samples: 200, ..ReportOptions::for_radius(0.2) };
    let nodes = [[0.5, 0.5], [2.0, 0.5], [0.5, 2.5], [3.0, 0.5]];
    let figures = figures_of(&nodes, &[[0, 1], [0, 2], [1, 2], [1, 3]], &options);
    let GraphFigures { coverage, structure, paths, validation } = figures.clone();
    assert_eq!((coverage.free_space_coverage, coverage.coverage_efficiency), (1.0, 0.25));
    // The corner of the floor opposite to the right angle.
    let corner = Point::new(3.5, 3.5) - Point::new(3.0, 0.5);
    assert!((coverage.max_distance_to_node.unwrap() - corner.norm()).abs() < 1e-9, "{coverage:?}");
    assert_eq!((structure.nodes, structure.edges, structure.average_degree, structure.graph_diameter), (4, 4, 2.0, 2));
    assert!((structure.average_edge_length.unwrap() - (1.5 + 2.0 + 2.5 + 1.0) / 4.0).abs() < 1e-9);
    // Two corners of the triangle have both pairs joined; the third has one of three.
    assert!((structure.average_clustering - (1.0 + 1.0 + 1.0 / 3.0) / 4.0).abs() < 1e-9);
    assert_eq!(paths.path_success_rate, Some(1.0));
    // Six pairs, equally likely: 1.5, 2, 2.5, 1, 2.5 and 3.5 m.
    assert!((paths.average_path_length.unwrap() - 13.0 / 6.0).abs() < 0.15, "{paths:?}");
    assert!((0.9..1.0).contains(&paths.average_path_smoothness.unwrap()));
    assert!((0.2..2.0).contains(&paths.average_path_clearance.unwrap()));
    assert_eq!(
        (validation.collision_free, validation.node_validity, validation.connectivity, validation.subgraphs),
        (Some(true), Some(true), Some(true), 1)
    );
    assert_eq!(validation.edge_length_validity, Some(true));
    assert_eq!(figures_of(&nodes, &[[0, 1], [0, 2], [1, 2], [1, 3]], &options), figures, "the seed fixes the pairs");
}

#[test]
fn a_graph_in_two_pieces_joins_few_pairs() {
    let figures = figures_of(
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 3.0], [1.0, 3.0]],
        &[[0, 1], [2, 3]],
        &ReportOptions::for_radius(0.2),
    );
    assert_eq!((figures.validation.connectivity, figures.validation.subgraphs), (Some(false), 2));
    let success = figures.paths.path_success_rate.unwrap();
    assert!((success - 1.0 / 3.0).abs() < 0.05, "{success}");
    assert_eq!(figures.structure.graph_diameter, 1);
    // The nodes in the corner are nearer to the wall than a vehicle of 0.3 m.
    assert_eq!(figures.validation.node_validity, Some(true));
}

#[test]
fn a_report_can_be_stopped() {
    struct Nobody;
    impl crate::watch::Observer for Nobody {
        fn progress(&self, _: crate::watch::Stage, _: f64) {}
    }
    let map = blind_aisle();
    let semantic = map.semantic(&RuleSet::warehouse());
    let (site, layout) = (map.site(&semantic), map.layout(&semantic));
    let router = Router::new(&site, 0.2);
    let graph = navigation_graph(&site, &layout, &router);
    let stop = crate::watch::StopFlag::default();
    stop.raise();
    let watch = Watch::new(&stop, &Nobody);
    assert!(graph_report(&site, &layout, &router, &graph, &ReportOptions::for_radius(0.2), &watch).is_err());
}
