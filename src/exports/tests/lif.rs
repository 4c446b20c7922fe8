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
    expect![[""]].assert_eq(&lines);
}

#[test]
fn lif_2_tells_the_ground_beside_a_lane() {
    let document = lif_2::layout(&Site::small().source());
    expect![[""]].assert_eq(&json(&document.layouts[0].edges[0]));
}
