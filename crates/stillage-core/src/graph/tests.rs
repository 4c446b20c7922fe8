//! Navigation graphs of drawn warehouses.

use super::*;
use crate::geometry::{Point, Vector};
use crate::lane_rule::LaneRule;
use crate::routing::Router;
use crate::semantics::RuleSet;
use crate::semantics::pictures::DrawnMap;
use expect_test::expect;

fn graph_of(map: &DrawnMap, radius: f64) -> NavigationGraph {
    let semantic = map.semantic(&RuleSet::warehouse());
    let site = map.site(&semantic);
    navigation_graph(&site, &map.layout(&semantic), &Router::new(&site, radius))
}

fn told(graph: &NavigationGraph) -> String {
    let node =
        |node: &GraphNode| format!("{} {:?} at {:.1},{:.1}\n", node.name, node.kind, node.position.x, node.position.y);
    let lane = |lane: &Lane| {
        let [from, to] = [lane.from, lane.to].map(|node| graph.nodes[node].name.as_str());
        format!("{from} -> {to} {:?} {:.1} m, {:.1} m wide\n", lane.kind, lane.length(), lane.width)
    };
    // Each way once.
    let lanes = graph.lanes.iter().filter(|lane| lane.from < lane.to);
    graph.nodes.iter().map(node).chain(lanes.map(lane)).collect()
}

/// An aisle between two rows of two places, and a junction.
fn aisle() -> DrawnMap {
    DrawnMap::new(
        "
        ########....
        ########....
        ............
        ............
        ............
        ########....
        ########....
        ",
        "
        ppppqqqqjjjj
        ppppqqqqjjjj
        ccccccccjjjj
        ccccccccjjjj
        ccccccccjjjj
        qqqqppppjjjj
        qqqqppppjjjj
        ",
    )
}

#[test]
fn an_aisle_is_driven_along_its_middle_with_spurs_to_its_places() {
    let map = aisle();
    let graph = graph_of(&map, 0.2);
    expect![[r#"
        N0000 Waypoint at 4.2,1.8
        01-001 Approach at 1.2,2.2
        01-002 Approach at 1.0,1.5
        01-003 Approach at 2.8,2.2
        01-004 Approach at 3.0,1.5
        N0005 DeadEnd at 4.8,1.8
        N0006 Junction at 1.2,1.8
        N0007 Junction at 2.8,1.8
        N0000 -> N0005 Way 0.5 m, 1.6 m wide
        N0000 -> N0007 Way 1.5 m, 1.5 m wide
        01-001 -> N0006 Spur 0.5 m, 0.5 m wide
        01-002 -> N0006 Spur 0.4 m, 1.5 m wide
        01-003 -> N0007 Spur 0.5 m, 0.5 m wide
        01-004 -> N0007 Spur 0.4 m, 1.5 m wide
        N0006 -> N0007 Way 1.5 m, 1.5 m wide
    "#]]
    .assert_eq(&told(&graph));
}

#[test]
fn every_lane_is_clear_and_has_its_twin() {
    let map = DrawnMap::new(
        "
        ####....####
        ####....####
        ............
        ....#.......
        ............
        ####....####
        ",
        "
        ppppjjjjqqqq
        ppppjjjjqqqq
        ccccjjjjdddd
        ccccjjjjdddd
        ccccjjjjdddd
        qqqqjjjjpppp
        ",
    );
    let graph = graph_of(&map, 0.25);
    assert!(!graph.lanes.is_empty());
    for lane in &graph.lanes {
        assert!(lane.width >= 0.5, "{lane:?}");
        let twin = &graph.lanes[lane.twin.expect("ways are driven both ways")];
        assert_eq!((twin.from, twin.to), (lane.to, lane.from));
        assert_eq!(lane.path[0], graph.nodes[lane.from].position);
    }
}

#[test]
fn rules_of_people_take_nodes_and_lanes_away() {
    let graph = graph_of(&aisle(), 0.2);
    let lane = &graph.lanes[0];
    let [from, to] = [lane.from, lane.to].map(|node| graph.nodes[node].position);
    let joins = |graph: &NavigationGraph, start: Point, end: Point| {
        graph.lanes.iter().any(|lane| graph.nodes[lane.from].position == start && graph.nodes[lane.to].position == end)
    };
    let near = |point: Point| point + Vector::new(0.1, 0.1);
    let one_way = graph.clone().ruled(&[LaneRule::OneWay { from: near(from), to }]);
    assert!(joins(&one_way, from, to) && !joins(&one_way, to, from));
    assert_eq!(one_way.lanes.iter().find(|lane| one_way.nodes[lane.from].position == from).unwrap().twin, None);
    let closed = graph.clone().ruled(&[LaneRule::NoLane { from: to, to: from }]);
    assert!(!joins(&closed, from, to) && !joins(&closed, to, from) && closed.nodes.len() == graph.nodes.len());
    let dropped = graph.clone().ruled(&[LaneRule::NoNode { at: near(from) }]);
    assert_eq!(dropped.nodes.len(), graph.nodes.len() - 1);
    assert!(dropped.nodes.iter().all(|node| node.position != from) && !joins(&dropped, from, to));
    let away = Point::new(50.0, 50.0);
    let far = graph.clone().ruled(&[LaneRule::NoNode { at: away }, LaneRule::OneWay { from, to: away }]);
    assert_eq!((far.lanes.len(), far.unmatched_rules), (graph.lanes.len(), vec![0, 1]));
}

#[test]
fn a_map_without_drivable_ground_has_an_empty_graph() {
    assert_eq!(graph_of(&DrawnMap::new("##", "pp"), 0.2), NavigationGraph::default());
}
