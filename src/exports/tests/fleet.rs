//! Exports for fleet managers.

use expect_test::expect;
use stillage_core::Point;
use stillage_core::geometry::ring_area;
use stillage_core::graph::NavigationGraph;

use super::Site;
use crate::exports::vda5050_zone_rules::ZoneRules;
use crate::exports::{ExportError, ExportSource, Recipient, nav2_route, rmf_building, rmf_nav_graph, vda5050_zone_set};

#[test]
fn a_nav2_graph_is_written_as_its_loader_reads_it() {
    let graph = nav2_route::graph(&Site::small().source()).unwrap();
    let lines: String = graph.features.iter().map(|each| serde_json::to_string(each).unwrap() + "\n").collect();
    expect![[r#"
        {"type":"Feature","properties":{"id":0,"frame":"map","metadata":{"name":"N0001","class":"junction"}},"geometry":{"type":"Point","coordinates":[-1.0404,14.2007]}}
        {"type":"Feature","properties":{"id":1,"frame":"map","metadata":{"name":"N0002","class":"dead-end"}},"geometry":{"type":"Point","coordinates":[14.245,18.929]}}
        {"type":"Feature","properties":{"id":2,"frame":"map","metadata":{"name":"01-001","class":"approach","location":"01-001","heading":1.870796}},"geometry":{"type":"Point","coordinates":[6.3363,17.4247]}}
        {"type":"Feature","properties":{"id":3,"frame":"map","metadata":{"name":"01-002","class":"approach","location":"01-002","heading":-1.270796}},"geometry":{"type":"Point","coordinates":[6.8682,15.705]}}
        {"type":"Feature","properties":{"id":4,"frame":"map","metadata":{"name":"N0001/N0002/1","class":"bend"}},"geometry":{"type":"Point","coordinates":[6.5284,16.8037]}}
        {"type":"Feature","properties":{"id":5,"startid":0,"endid":4,"cost":8.0039,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[-1.0404,14.2007],[6.5284,16.8037]]]}}
        {"type":"Feature","properties":{"id":6,"startid":4,"endid":1,"cost":8.0039,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[6.5284,16.8037],[14.245,18.929]]]}}
        {"type":"Feature","properties":{"id":7,"startid":0,"endid":2,"cost":8.0505,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[-1.0404,14.2007],[6.3363,17.4247]]]}}
        {"type":"Feature","properties":{"id":8,"startid":0,"endid":3,"cost":8.0504,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[-1.0404,14.2007],[6.8682,15.705]]]}}
        {"type":"Feature","properties":{"id":9,"startid":1,"endid":4,"cost":8.0039,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[14.245,18.929],[6.5284,16.8037]]]}}
        {"type":"Feature","properties":{"id":10,"startid":4,"endid":0,"cost":8.0039,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[6.5284,16.8037],[-1.0404,14.2007]]]}}
        {"type":"Feature","properties":{"id":11,"startid":2,"endid":0,"cost":8.0505,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[6.3363,17.4247],[-1.0404,14.2007]]]}}
        {"type":"Feature","properties":{"id":12,"startid":3,"endid":0,"cost":8.0504,"overridable":true,"metadata":{"class":"co","width":2.5}},"geometry":{"type":"MultiLineString","coordinates":[[[6.8682,15.705],[-1.0404,14.2007]]]}}
    "#]].assert_eq(&lines);
}

#[test]
fn a_nav2_graph_without_edges_is_refused() {
    let empty = NavigationGraph::default();
    let source = ExportSource { graph: &empty, ..Site::small().source() };
    assert_eq!(nav2_route::graph(&source), Err(ExportError::NoLanes));
}

#[test]
fn zones_cover_every_face_once() {
    let source = Site::whole().source();
    let message = vda5050_zone_set::zone_set(&source, &ZoneRules::default(), &Recipient::default()).unwrap();
    let zones = &message.zone_set.zones;
    let area = |zone: &vda5050_zone_set::Zone| {
        ring_area(&zone.vertices.iter().map(|corner| Point::new(corner.x, corner.y)).collect::<Vec<_>>())
    };
    let whole: f64 = source.analysis.subdivision.faces().map(|face| source.analysis.subdivision.area(face)).sum();
    let covered: f64 = zones.iter().map(area).sum();
    assert!((whole - covered).abs() < 0.1, "{covered} of {whole} m2");
    assert!(zones.iter().all(|zone| area(zone) > 0.0));
    let first: String = zones.iter().take(3).map(|zone| serde_json::to_string(zone).unwrap() + "\n").collect();
    expect![[r#"
        {"zoneId":"face-1-1","zoneType":"SPEED_LIMIT","maximumSpeed":1.0,"zoneDescriptor":"junction","vertices":[{"x":-7.6544,"y":22.0465},{"x":-3.0,"y":7.0},{"x":19.9281,"y":14.0925},{"x":15.2736,"y":29.139},{"x":15.0348,"y":29.0652},{"x":15.2225,"y":28.9662},{"x":18.9982,"y":16.4217},{"x":19.6779,"y":14.2245},{"x":16.1431,"y":13.131},{"x":16.0476,"y":13.1015},{"x":0.7918,"y":8.2776},{"x":-0.0061,"y":10.857},{"x":-0.5971,"y":12.7677},{"x":-1.4837,"y":15.6337},{"x":-2.0747,"y":17.5444},{"x":-2.9613,"y":20.4104},{"x":-3.5523,"y":22.321},{"x":-3.8331,"y":23.2286}]}
        {"zoneId":"face-1-2","zoneType":"SPEED_LIMIT","maximumSpeed":1.0,"zoneDescriptor":"junction","vertices":[{"x":15.2736,"y":29.139},{"x":15.1998,"y":29.3779},{"x":-7.7283,"y":22.2854},{"x":-7.6544,"y":22.0465},{"x":-3.8331,"y":23.2286},{"x":-3.8774,"y":23.372},{"x":11.408,"y":28.1003},{"x":14.8471,"y":29.1641},{"x":15.0348,"y":29.0652}]}
        {"zoneId":"face-2","zoneType":"BIDIRECTED","direction":0.3,"bidirectedLimitation":"SOFT","limitation":"SOFT","zoneDescriptor":"corridor","vertices":[{"x":0.7918,"y":8.2776},{"x":16.0476,"y":13.1015},{"x":15.2793,"y":15.5853},{"x":-0.0061,"y":10.857}]}
    "#]].assert_eq(&first);
}

#[test]
fn the_id_of_a_zone_set_changes_with_its_content_alone() {
    let id = |source: &ExportSource<'_>, speed: &str| {
        let rules = ZoneRules::read(&format!("ju:SPEED_LIMIT:{speed}")).unwrap();
        vda5050_zone_set::zone_set(source, &rules, &Recipient::default()).unwrap().zone_set.zone_set_id
    };
    let source = Site::whole().source();
    assert_eq!(id(&source, "1"), id(&ExportSource { version: "8", ..source }, "1"));
    assert_ne!(id(&source, "1"), id(&source, "0.5"));
}

#[test]
fn rmf_graphs_pass_through_the_bends_of_a_lane() {
    let text = String::from_utf8(rmf_nav_graph::nav_graph(&Site::small().source())).unwrap();
    expect![[r#"
        building_name: "Hall"
        doors: {}
        lifts: {}
        levels:
          L1:
            vertices:
            - [-1.0404, 14.2007, {name: "N0001"}]
            - [14.245, 18.929, {name: "N0002", is_holding_point: true}]
            - [6.3363, 17.4247, {name: "01-001"}]
            - [6.8682, 15.705, {name: "01-002"}]
            - [6.5284, 16.8037, {}]
            lanes:
            - [0, 4, {}]
            - [4, 1, {}]
            - [0, 2, {}]
            - [0, 3, {}]
            - [1, 4, {}]
            - [4, 0, {}]
            - [2, 0, {}]
            - [3, 0, {}]
    "#]]
    .assert_eq(&text);
}

#[test]
fn an_rmf_building_has_one_lane_for_both_directions() {
    let text = String::from_utf8(rmf_building::building(&Site::small().source())).unwrap();
    expect![[r#"
        name: "Hall"
        coordinate_system: cartesian_meters
        crowd_sim: {agent_groups: [], agent_profiles: [], enable: 0, goal_sets: [], model_types: [], obstacle_set: {}, states: [], transitions: [], update_time_step: 0.1}
        graphs: {}
        levels:
          L1:
            elevation: 0
            layers: {}
            x_meters: 24.0
            y_meters: 16.0
            flattened_x_offset: 0
            flattened_y_offset: 0
            fiducials: []
            vertices:
              - [-1.0404, 14.2007, 0, "N0001", {}]
              - [14.245, 18.929, 0, "N0002", {is_holding_point: [4, true]}]
              - [6.3363, 17.4247, 0, "01-001", {}]
              - [6.8682, 15.705, 0, "01-002", {}]
              - [6.5284, 16.8037, 0, "", {}]
            lanes:
              - [0, 2, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, ""]}]
              - [0, 3, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, ""]}]
              - [0, 4, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, ""]}]
              - [1, 4, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, ""]}]
            walls: []
            floors: []
            doors: []
            models: []
            measurements: []
        lifts: {}
    "#]].assert_eq(&text);
}
