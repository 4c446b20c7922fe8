//! Joins faces that nothing divides.
//!
//! Lines of a decomposition run on through open floor and cut it into pieces. Two faces that were cut out for the same
//! kind of ground are joined when no obstacles stand along the edge between them and its two sides are both open or
//! both unknown; places are never joined. All faces of a room become one. A face that is too small or too narrow then
//! joins the neighbour with which it shares most of its border. (The author's later work undoes over-segmentation
//! likewise: it prunes edges without support.)
//!
//! Joining changes the subdivision only ([`Subdivision::dissolve`]); faces are measured afterwards. Cost: O(cells along
//! edges + faces + edges), and the points inside the faces. Limits: faces of two regions are never joined.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::edges::annotate_edge;
use super::faces::region_at;
use super::plot_kinds::PlotIndex;
use crate::adjacency::AdjacencyGraph;
use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::{DisjointSets, line_angle_between};
use crate::grid::OccupancyGrid;
use crate::plot::{Plot, PlotKind};
use crate::rooms::FaceGround;
use crate::segmentation::RegionMap;
use crate::spec::AnnotationOptions;
use crate::watch::{Stopped, Watch};

/// Share of the length of an edge that decides what it is: supported, open or unknown. The majority.
const MAJORITY: f64 = 0.5;
/// Aisles are parallel when their directions differ by less than this, radians: half the angle between the directions
/// of a site that are 45 degrees apart.
const PARALLEL: f64 = std::f64::consts::FRAC_PI_8;
/// Least area of a face, square metres: half the smallest place (0.8 by 0.6 m).
const LEAST_AREA_M2: f64 = 0.24;
/// Least mean width of a face, metres. No measurement is recorded for this value.
const LEAST_WIDTH_M: f64 = 0.15;

/// What the ground of a subdivision was planned to be.
#[derive(Debug, Clone, Copy)]
pub struct PlannedGround<'a> {
    /// The plots of rows, and the stacks in rooms.
    pub plots: &'a [Plot],
    /// Room of each face or part of one, by face id; empty without rooms.
    pub grounds: &'a [FaceGround],
}

/// Joins the faces of a decomposition that nothing divides.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn merge_alike(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    subdivision: Subdivision,
    planned: PlannedGround<'_>,
    options: &AnnotationOptions,
    watch: &Watch<'_>,
) -> Result<Subdivision, Stopped> {
    if planned.plots.is_empty() && planned.grounds.is_empty() {
        return Ok(subdivision);
    }
    let faces = purposes(grid, regions, &subdivision, planned, watch)?;
    let inner: Vec<EdgeId> = subdivision.edges().filter(|&edge| is_alike(&faces, subdivision.sides(edge))).collect();
    let divides_nothing = |edge: &EdgeId| {
        let found = annotate_edge(grid, &subdivision, *edge, options.support_width_m);
        found.support < MAJORITY && (found.open > MAJORITY || found.confidence < MAJORITY)
    };
    let open = inner.into_par_iter().map(|edge| {
        watch.check()?;
        Ok(divides_nothing(&edge).then_some(edge))
    });
    let open: Vec<Option<EdgeId>> = open.collect::<Result<_, Stopped>>()?;
    let mut sets = DisjointSets::new(subdivision.face_count());
    let is_in_room = |&edge: &EdgeId| {
        let [left, right] = subdivision.sides(edge).map(|face| faces[face.index()].ground);
        left.is_planned() && left == right
    };
    for edge in subdivision.edges().filter(is_in_room).chain(open.into_iter().flatten()) {
        let [left, right] = subdivision.sides(edge).map(FaceId::index);
        sets.join(left, right);
    }
    join_slivers(&subdivision, &mut sets);
    let roots: Vec<usize> = (0..subdivision.face_count()).map(|face| sets.find(face)).collect();
    let is_inside = |edge| {
        let [left, right] = subdivision.sides(edge).map(FaceId::index);
        roots[left] == roots[right]
    };
    subdivision.dissolve(is_inside, watch)
}

/// What a face was cut out for, and where it lies.
#[derive(Debug, Clone, Copy)]
struct Purpose {
    ground: FaceGround,
    region: u8,
    plot: Option<Plot>,
}

fn purposes(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    subdivision: &Subdivision,
    planned: PlannedGround<'_>,
    watch: &Watch<'_>,
) -> Result<Vec<Purpose>, Stopped> {
    let index = PlotIndex::new(planned.plots);
    let graph = AdjacencyGraph::dual(subdivision, watch)?;
    let purpose = |face: FaceId| {
        if face == FaceId::OUTER {
            return Purpose { ground: FaceGround::default(), region: RegionMap::NONE, plot: None };
        }
        let inside = graph.position(face);
        let region = region_at(grid, regions, inside);
        let ground = planned.grounds.get(face.index()).copied().unwrap_or_default();
        Purpose { ground, region, plot: index.at(inside, region) }
    };
    Ok((0..subdivision.face_count() as u32).map(|face| purpose(FaceId(face))).collect())
}

/// Whether the faces on both sides of an edge were cut out for the same, and may be one.
fn is_alike(faces: &[Purpose], [left, right]: [FaceId; 2]) -> bool {
    if left == FaceId::OUTER || right == FaceId::OUTER {
        return false;
    }
    let (left, right) = (faces[left.index()], faces[right.index()]);
    let same_purpose = match (left.plot, right.plot) {
        (None, None) => true,
        (Some(one), Some(other)) => match one.kind {
            PlotKind::Place => false,
            PlotKind::Aisle => {
                other.kind == one.kind && line_angle_between(one.bounds.angle, other.bounds.angle) < PARALLEL
            }
            _ => other.kind == one.kind,
        },
        _ => false,
    };
    let is_hall = !left.ground.is_planned() && !right.ground.is_planned();
    is_hall && left.region == right.region && same_purpose
}

/// Joins faces that are too small or too narrow with the neighbour they share most of their border with.
fn join_slivers(subdivision: &Subdivision, sets: &mut DisjointSets) {
    let roots: Vec<usize> = (0..subdivision.face_count()).map(|face| sets.find(face)).collect();
    let mut areas = vec![0.0; roots.len()];
    let mut borders: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); roots.len()];
    for face in subdivision.faces() {
        areas[roots[face.index()]] += subdivision.area(face);
    }
    for edge in subdivision.edges() {
        let [left, right] = subdivision.sides(edge).map(|face| roots[face.index()]);
        if left != right {
            *borders[left].entry(right).or_default() += subdivision.length(edge);
            *borders[right].entry(left).or_default() += subdivision.length(edge);
        }
    }
    let is_sliver = |set: usize| {
        let width = 2.0 * areas[set] / borders[set].values().sum::<f64>();
        areas[set] < LEAST_AREA_M2 || width < LEAST_WIDTH_M
    };
    for set in (1..roots.len()).filter(|&set| roots[set] == set && is_sliver(set)) {
        let inside = borders[set].iter().filter(|&(&other, _)| other != FaceId::OUTER.index());
        if let Some((&other, _)) = inside.max_by(|one, other| one.1.total_cmp(other.1)) {
            sets.join(set, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::arrangement::{EdgeSource, SourceSegment, arrange};
    use crate::geometry::{OrientedBox, Point};
    use crate::segmentation::Region;

    /// Cuts a map, one cell is one metre, into strips at some x, each with its kind, and joins them again.
    fn check(picture: &str, cuts: &[f64], kinds: &[PlotKind], expected: &Expect) {
        let grid = OccupancyGrid::from_ascii(picture, 1.0);
        let (width, height) = (grid.width() as f64, grid.height() as f64);
        let segment = |ends: [f64; 4]| SourceSegment {
            start: Point::new(ends[0], ends[1]),
            end: Point::new(ends[2], ends[3]),
            source: EdgeSource::Boundary,
        };
        let bounds: Vec<f64> = [&[0.0], cuts, &[width]].concat();
        let sides = [[0.0, 0.0, width, 0.0], [0.0, height, width, height]].map(segment);
        let segments: Vec<SourceSegment> =
            sides.into_iter().chain(bounds.iter().map(|&x| segment([x, 0.0, x, height]))).collect();
        let subdivision = arrange(&segments, &Watch::unwatched()).expect("nobody stops it");
        let strip = |x: &[f64]| OrientedBox {
            center: Point::new(f64::midpoint(x[0], x[1]), height / 2.0),
            half_extents: [(x[1] - x[0]) / 2.0, height / 2.0],
            angle: 0.0,
        };
        let plots: Vec<Plot> =
            bounds.windows(2).zip(kinds).map(|(x, &kind)| Plot { bounds: strip(x), kind, region: 0 }).collect();
        let regions = RegionMap {
            tile_cells: 64,
            columns: 1,
            rows: 1,
            tiles: vec![0],
            regions: vec![Region { orientations: vec![0.0], bounds: strip(&[0.0, width]), share: 1.0 }],
        };
        let options = AnnotationOptions::default();
        let merged = merge_alike(
            &grid,
            &regions,
            subdivision,
            PlannedGround { plots: &plots, grounds: &[] },
            &options,
            &Watch::unwatched(),
        );
        let merged = merged.expect("nobody stops it");
        merged.check_invariants().expect("the subdivision is sound");
        let extent = |face: FaceId| {
            let ring = merged.rings(face).remove(0);
            let x = |pick: fn(f64, f64) -> f64| ring.iter().map(|corner| corner.x).reduce(pick).unwrap_or(0.0);
            format!("{:.1}..{:.1}", x(f64::min), x(f64::max))
        };
        expected.assert_eq(&merged.faces().map(extent).collect::<Vec<_>>().join(" "));
    }

    #[test]
    fn open_floor_is_one_face_and_a_wall_keeps_it_two() {
        use PlotKind::OpenFloor;
        check("........\n........", &[3.0, 5.0], &[OpenFloor; 3], &expect!["0.0..8.0"]);
        check("...#....\n...#....", &[3.0, 5.0], &[OpenFloor; 3], &expect!["0.0..3.0 3.0..8.0"]);
        check("...?????\n...?????", &[3.0, 5.0], &[OpenFloor; 3], &expect!["0.0..3.0 3.0..8.0"]);
    }

    #[test]
    fn places_stay_places_and_aisles_are_no_floor() {
        use PlotKind::{Aisle, OpenFloor, Place};
        check("........\n........", &[3.0, 5.0], &[Place; 3], &expect!["0.0..3.0 3.0..5.0 5.0..8.0"]);
        check("........\n........", &[3.0, 5.0], &[Aisle, OpenFloor, OpenFloor], &expect!["0.0..3.0 3.0..8.0"]);
    }

    #[test]
    fn a_sliver_goes_to_the_neighbour_it_shares_most_with() {
        use PlotKind::{OpenFloor, Place};
        check("........\n........", &[3.0, 3.1], &[Place, OpenFloor, Place], &expect!["0.0..3.0 3.0..8.0"]);
    }
}
