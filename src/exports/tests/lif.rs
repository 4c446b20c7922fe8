//! The layout interchange format.

use super::Site;
use crate::exports::{lif_1, lif_2};
use expect_test::expect;

fn json(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).unwrap() + "\n"
}

#[test]
fn lif_1_of_a_small_graph() {
    let document = lif_1::layout(&Site::small().source());
    let layout = &document.layouts[0];
    let lines: String = [json(&document.meta_information)]
        .into_iter()
        .chain(layout.nodes.iter().map(json))
        .chain(layout.edges.iter().map(json))
        .chain(layout.stations.iter().map(json))
        .collect();
    expect![[r#"
        {"projectIdentification":"Hall","creator":"stillage","exportTimestamp":"2026-01-15T08:00:00.000Z","lifVersion":"1.0.0"}
        {"nodeId":"N0001","mapId":"hall","nodePosition":{"x":-1.0404,"y":14.2007},"vehicleTypeNodeProperties":[{"vehicleTypeId":"generic"}]}
        {"nodeId":"N0002","mapId":"hall","nodePosition":{"x":14.245,"y":18.929},"vehicleTypeNodeProperties":[{"vehicleTypeId":"generic"}]}
        {"nodeId":"01-001","mapId":"hall","nodePosition":{"x":6.3363,"y":17.4247},"vehicleTypeNodeProperties":[{"vehicleTypeId":"generic","theta":1.870796}]}
        {"nodeId":"01-002","mapId":"hall","nodePosition":{"x":6.8682,"y":15.705},"vehicleTypeNodeProperties":[{"vehicleTypeId":"generic","theta":-1.270796}]}
        {"nodeId":"N0001/N0002/1","mapId":"hall","nodePosition":{"x":6.5284,"y":16.8037},"vehicleTypeNodeProperties":[{"vehicleTypeId":"generic"}]}
        {"edgeId":"N0001>N0001/N0002/1","startNodeId":"N0001","endNodeId":"N0001/N0002/1","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"N0001/N0002/1>N0002","startNodeId":"N0001/N0002/1","endNodeId":"N0002","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"N0001>01-001","startNodeId":"N0001","endNodeId":"01-001","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"N0001>01-002","startNodeId":"N0001","endNodeId":"01-002","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"N0002>N0001/N0002/1","startNodeId":"N0002","endNodeId":"N0001/N0002/1","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"N0001/N0002/1>N0001","startNodeId":"N0001/N0002/1","endNodeId":"N0001","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"01-001>N0001","startNodeId":"01-001","endNodeId":"N0001","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"edgeId":"01-002>N0001","startNodeId":"01-002","endNodeId":"N0001","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientation":0.0,"orientationType":"TANGENTIAL","rotationAllowed":false}]}
        {"stationId":"01-001","interactionNodeIds":["01-001"],"stationName":"pallet cell 01-001","stationPosition":{"x":5.8635,"y":18.9532,"theta":1.870796}}
        {"stationId":"01-002","interactionNodeIds":["01-002"],"stationName":"pallet cell 01-002","stationPosition":{"x":7.3411,"y":14.1765,"theta":-1.270796}}
    "#]].assert_eq(&lines);
}

#[test]
fn lif_2_tells_the_ground_beside_a_lane() {
    let document = lif_2::layout(&Site::small().source());
    expect![[r#"
        {"edgeId":"N0001>N0001/N0002/1","startNodeId":"N0001","endNodeId":"N0001/N0002/1","vehicleTypeEdgeProperties":[{"vehicleTypeId":"generic","vehicleOrientations":[0.0],"orientationType":"TANGENTIAL","corridor":{"maximumLeftWidth":1.25,"maximumRightWidth":1.25,"corridorReferencePoint":"CONTOUR"}}]}
    "#]].assert_eq(&json(&document.layouts[0].edges[0]));
}
