//! The dual of small subdivisions, and of any.

use std::collections::BTreeMap;

use expect_test::expect;
use proptest::prelude::*;

use super::*;
use crate::test_maps::segments::subdivide;

fn dual(subdivision: &Subdivision) -> AdjacencyGraph {
    AdjacencyGraph::dual(subdivision, &Watch::unwatched()).expect("nobody stops it")
}

/// A ring as closed segments.
fn ring(corners: &[[f64; 2]]) -> Vec<[f64; 4]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(start, end)| [start[0], start[1], end[0], end[1]]).collect()
}

/// `+--+--+` over a wider cell: three faces, of which the lower one meets each upper one in one edge.
#[test]
fn links_join_the_faces_of_inner_edges_only() {
    let mut ends = ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    ends.extend([[0.0, 2.0, 4.0, 2.0], [2.0, 2.0, 2.0, 4.0]]);
    let graph = dual(&subdivide(&ends));
    let links: Vec<String> = graph.neighbors.iter().map(|links| format!("{links:?}")).collect();
    expect![[r#"
        []
        [(EdgeId(3), FaceId(2)), (EdgeId(5), FaceId(3))]
        [(EdgeId(3), FaceId(1)), (EdgeId(6), FaceId(3))]
        [(EdgeId(5), FaceId(1)), (EdgeId(6), FaceId(2))]"#]]
    .assert_eq(&links.join("\n"));
    assert_eq!(graph.position(FaceId(1)), Point::new(2.0, 1.0));
}

/// A cell in a corner of another shares two edges with it: two links.
#[test]
fn faces_that_share_several_edges_have_several_links() {
    let mut ends = ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    ends.extend([[2.0, 0.0, 2.0, 2.0], [2.0, 2.0, 4.0, 2.0]]);
    let graph = dual(&subdivide(&ends));
    let behind: Vec<_> = graph.links(FaceId(1)).iter().map(|&(_, face)| face).collect();
    assert_eq!(behind, [FaceId(2), FaceId(2)]);
}

#[test]
fn nodes_lie_well_inside_bent_and_holed_faces() {
    let bent = ring(&[[0.0, 0.0], [10.0, 0.0], [10.0, 2.0], [2.0, 2.0], [2.0, 10.0], [0.0, 10.0]]);
    let holed = [
        ring(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]),
        ring(&[[2.0, 2.0], [6.0, 2.0], [6.0, 6.0], [2.0, 6.0]]),
    ]
    .concat();
    let sliver = ring(&[[0.0, 0.0], [100.0, 100.0], [100.0, 100.001], [0.0, 0.001]]);
    for (shape, least) in [(bent, 1.0), (holed, 1.5), (sliver, 3e-4)] {
        let subdivision = subdivide(&shape);
        let node = dual(&subdivision).position(FaceId(1));
        let distance = subdivision
            .boundary(FaceId(1))
            .map(|half| {
                let [start, end] = subdivision.segment(half.edge());
                let along = (end - start).normalize();
                let share = (node - start).dot(&along).clamp(0.0, subdivision.length(half.edge()));
                (start + along * share - node).norm()
            })
            .fold(f64::INFINITY, f64::min);
        assert!(distance >= least, "{node} is {distance} m from the boundary of {shape:?}");
    }
}

#[test]
fn the_unbounded_face_alone_has_no_links() {
    let graph = dual(&subdivide(&[]));
    assert_eq!((graph.positions.len(), graph.links(FaceId::OUTER).len()), (1, 0));
}

fn crossing_lines() -> impl Strategy<Value = Vec<[f64; 4]>> {
    let anywhere = prop::array::uniform4(-9.0..9.0);
    let level = (-9_i8..9).prop_map(|y| [-9.0, f64::from(y), 9.0, f64::from(y)]);
    let upright = (-9_i8..9).prop_map(|x| [f64::from(x), -9.0, f64::from(x), 9.0]);
    prop::collection::vec(prop_oneof![anywhere, level, upright], 0..24)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// D(D(x)) = x: from the graph alone, the faces of every inner edge come back, and no other edge has a link.
    #[test]
    fn the_dual_of_the_dual_is_the_subdivision(ends in crossing_lines()) {
        let subdivision = subdivide(&ends);
        let graph = dual(&subdivision);
        let mut faces_by_link: BTreeMap<EdgeId, Vec<FaceId>> = BTreeMap::new();
        for face in subdivision.faces() {
            prop_assert!(graph.links(face).is_sorted());
            for &(link, behind) in graph.links(face) {
                prop_assert_ne!(behind, face);
                prop_assert!(graph.links(behind).contains(&(link, face)));
                faces_by_link.entry(link).or_default().push(face);
            }
        }
        for edge in subdivision.edges() {
            let mut sides = subdivision.sides(edge);
            sides.sort_unstable();
            let expected = (sides[0] != FaceId::OUTER).then(|| sides.to_vec());
            prop_assert_eq!(faces_by_link.remove(&edge), expected);
        }
        prop_assert!(faces_by_link.is_empty());
    }

    /// Every node lies inside its face and inside no other: rings are counted by parity.
    #[test]
    fn every_node_lies_in_its_own_face(ends in crossing_lines()) {
        let subdivision = subdivide(&ends);
        let graph = dual(&subdivision);
        for face in subdivision.faces() {
            let node = graph.position(face);
            for other in subdivision.faces() {
                let crossings = subdivision.boundary(other).filter(|half| {
                    let [start, end] = subdivision.segment(half.edge());
                    (start.y > node.y) != (end.y > node.y)
                        && node.x < start.x + (node.y - start.y) / (end.y - start.y) * (end.x - start.x)
                });
                prop_assert_eq!(crossings.count() % 2 == 1, face == other);
            }
        }
    }
}
