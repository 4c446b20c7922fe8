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
        N0005 DeadEnd at 4.9,1.8
        N0006 Junction at 1.0,1.8
        N0007 Junction at 2.8,1.8
        N0000 -> N0005 Way 0.7 m, 1.6 m wide
        N0000 -> N0007 Way 1.5 m, 1.5 m wide
        01-001 -> N0006 Spur 0.8 m, 0.5 m wide
        01-002 -> N0006 Spur 0.2 m, 1.5 m wide
        01-003 -> N0007 Spur 0.5 m, 0.5 m wide
        01-004 -> N0007 Spur 0.4 m, 1.5 m wide
        N0006 -> N0007 Way 1.8 m, 1.5 m wide
    "#]]
    .assert_eq(&told(&graph));
}

/// A corridor of 8 m between two rows of places, with a way out at both ends.
fn wide_corridor() -> DrawnMap {
    let row = |cells: &str, side: &str| format!("{side}{cells}{side}\n");
    let free = row(&".".repeat(32), "....");
    let racks = row(&"#".repeat(32), "....");
    let occupancy = [racks.repeat(2), free.repeat(16), racks.repeat(2)].concat();
    let places = row(&format!("{}{}", "p".repeat(16), "q".repeat(16)), "jjjj");
    let swapped = row(&format!("{}{}", "q".repeat(16), "p".repeat(16)), "jjjj");
    let corridor = row(&"c".repeat(32), "jjjj");
    DrawnMap::new(&occupancy, &[places.repeat(2), corridor.repeat(16), swapped.repeat(2)].concat())
}

#[test]
fn where_two_vehicles_pass_the_lanes_of_both_directions_lie_side_by_side() {
    let map = wide_corridor();
    let graph = graph_of(&map, 0.4);
    let in_the_middle =
        |lane: &&Lane| lane.kind == LaneKind::Way && lane.path.iter().all(|point| (4.0..16.0).contains(&point.x));
    let lanes: Vec<&Lane> = graph.lanes.iter().filter(in_the_middle).collect();
    let (eastwards, westwards): (Vec<&&Lane>, Vec<&&Lane>) =
        lanes.iter().partition(|lane| lane.path[lane.path.len() - 1].x > lane.path[0].x);
    assert!(!eastwards.is_empty() && !westwards.is_empty());
    // Vehicles keep to the right, and are 0.4 m apart where they pass: twice 0.4 m of radius and the gap between two courses.
    let height = |lanes: &[&&Lane]| lanes[0].path[0].y;
    assert!((height(&westwards) - height(&eastwards) - 1.2).abs() < 0.05);
    for lane in &lanes {
        assert!(lane.twin.is_none() && lane.width >= 0.8 && (lane.path[0].y - lane.path[1].y).abs() < 0.05, "{lane:?}");
    }
    // Each place is served from both directions.
    let served = graph.nodes.iter().enumerate().filter(|(_, node)| node.location.is_some());
    for (index, node) in served {
        let ways_out: Vec<&Lane> = graph.lanes.iter().filter(|lane| lane.from == index).collect();
        assert_eq!(ways_out.len(), 2, "{}: {ways_out:?}", node.name);
    }
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

/// A hall of 20 m by 20 m with a rack of 2 m by 10 m, and nothing beside it that a vehicle drives to.
#[test]
fn lanes_on_open_ground_go_around_what_stands_there() {
    let row = |rack: std::ops::Range<usize>| {
        (0..40).map(|column| if rack.contains(&column) { '#' } else { '.' }).collect::<String>() + "\n"
    };
    let picture = [row(0..0).repeat(10), row(18..22).repeat(20), row(0..0).repeat(10)].concat();
    let map = DrawnMap::new(&picture, &("j".repeat(40) + "\n").repeat(40));
    let graph = graph_of(&map, 0.4);
    let from_the_middle = |point: &Point| (point.x - 10.0).hypot(point.y - 10.0);
    assert!(graph.nodes.len() >= 4, "{}", told(&graph));
    assert!(graph.nodes.iter().all(|node| node.clearance > 1.5), "{}", told(&graph));
    assert!(graph.nodes.iter().all(|node| from_the_middle(&node.position) < 9.0), "{}", told(&graph));
    let length: f64 = graph.lanes.iter().map(Lane::length).sum();
    assert!((40.0..120.0).contains(&length), "{length} m of lanes, each way counted");
}
