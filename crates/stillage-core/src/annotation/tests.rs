//! Faces and edges of small maps; one cell is one metre.

use expect_test::expect;

use super::*;
use crate::adjacency::AdjacencyGraph;
use crate::arrangement::{CellFaces, Subdivision};
use crate::categorization::{Categorization, Category, CategoryMap};
use crate::clustering::FitReport;
use crate::geometry::{OrientedBox, Point};
use crate::grid::OccupancyGrid;
use crate::segmentation::{Region, RegionMap};
use crate::spec::{AnnotationMethod, AnnotationOptions};
use crate::test_maps::segments::{boxed, subdivide};
use crate::watch::Watch;

/// One region over the whole grid, in tiles of 4 cells.
fn one_region(grid: &OccupancyGrid) -> RegionMap {
    let (columns, rows) = (grid.width().div_ceil(4), grid.height().div_ceil(4));
    let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
    let region = Region { orientations: vec![], bounds, share: 1.0 };
    RegionMap { tile_cells: 4, columns, rows, tiles: vec![0; columns * rows], regions: vec![region] }
}

/// Digits are free cells of that category, the rest as in [`OccupancyGrid::from_ascii`].
fn read(picture: &str) -> (OccupancyGrid, CategoryMap) {
    let free = picture.replace(|symbol: char| symbol.is_ascii_digit(), ".");
    let grid = OccupancyGrid::from_ascii(&free, 1.0);
    let rows: Vec<&str> = picture.lines().map(str::trim).filter(|row| !row.is_empty()).collect();
    let category = |symbol: char| symbol.to_digit(10).map_or(CategoryMap::NONE, |digit| digit as u8);
    let cells = rows.iter().rev().flat_map(|row| row.chars().map(category)).collect();
    let categories = vec![Category { cells: 0, mean_features: vec![] }; 3];
    (grid, CategoryMap { cells, categories, feature_names: vec![], fit: FitReport::default(), relaxation: None })
}

fn annotated(picture: &str, subdivision: &Subdivision) -> (Vec<FaceAnnotation>, Vec<EdgeAnnotation>) {
    let options = AnnotationOptions { method: AnnotationMethod::Vote, ..AnnotationOptions::default() };
    let found = annotated_with(picture, subdivision, &options);
    (found.faces, found.edges)
}

fn annotated_with(picture: &str, subdivision: &Subdivision, options: &AnnotationOptions) -> Annotations {
    let (grid, categories) = read(picture);
    let cells = CellFaces::rasterize(subdivision, grid.width(), grid.height(), grid.resolution());
    let watch = Watch::unwatched();
    let subject = Subject {
        grid: &grid,
        categorization: &Categorization { map: categories, memberships: None },
        regions: &one_region(&grid),
        subdivision,
        graph: &AdjacencyGraph::dual(subdivision, &watch).expect("nobody stops it"),
        cells: &cells,
        plots: &[],
        grounds: &[],
    };
    annotate(&subject, options, 1, &watch).expect("nobody stops it")
}

#[test]
fn faces_that_differ_have_categories_of_their_own_and_none_is_outside() {
    // Strips of growing width: more kinds of faces than categories of cells.
    let cuts = [0.0, 1.0, 3.0, 6.0, 10.0, 15.0, 21.0, 28.0];
    let subdivision = boxed([0.0, 0.0, 36.0, 2.0], &cuts[1..].iter().map(|&x| [x, 0.0, x, 2.0]).collect::<Vec<_>>());
    let picture = ["0".repeat(36), "0".repeat(36)].join("\n");
    let options = AnnotationOptions { method: AnnotationMethod::Faces, categories: 8, ..AnnotationOptions::default() };
    let mut found = annotated_with(&picture, &subdivision, &options);
    let mut categories: Vec<u8> = found.faces.drain(1..).map(|face| face.category).collect();
    categories.sort_unstable();
    assert_eq!((found.categories.clusters, categories), (8, (0..8).collect()));
}

#[test]
fn relaxation_has_the_last_word_on_the_categories_of_faces() {
    let subdivision = boxed([0.0, 0.0, 12.0, 2.0], &[[4.0, 0.0, 4.0, 2.0], [8.0, 0.0, 8.0, 2.0]]);
    for method in [AnnotationMethod::Vote, AnnotationMethod::Faces] {
        let relaxation = Some(crate::spec::RelaxationOptions::default());
        let options = AnnotationOptions { method, categories: 2, relaxation, ..AnnotationOptions::default() };
        let found = annotated_with("000011110000\n000000110000", &subdivision, &options);
        assert!(found.relaxation.is_some());
        for face in &found.faces[1..] {
            let distribution = face.membership.as_ref().expect("a relaxed face has a distribution");
            assert!(distribution.iter().all(|&share| share <= distribution[usize::from(face.category)]), "{face:?}");
            assert_eq!(face.confidence, f64::from(distribution[usize::from(face.category)]));
        }
    }
}

/// Four rooms: a vote with a tie, a majority, one of obstacles alone, one never seen.
#[test]
fn cells_vote_and_ties_go_to_the_lower_category() {
    let subdivision =
        boxed([0.0, 0.0, 16.0, 4.0], &[[4.0, 0.0, 4.0, 4.0], [8.0, 0.0, 8.0, 4.0], [12.0, 0.0, 12.0, 4.0]]);
    let (faces, _) = annotated(
        "
        ####222######???
        #21#2022########
        #12#2222########
        ####2222########
        ",
        &subdivision,
    );
    let (blank, _) = annotated(&"????????????????\n".repeat(4), &subdivision);
    let line = |face: &FaceAnnotation| {
        format!(
            "category {} {:.2} of {:?}, free {} occupied {} unknown {}, region {}, {:?}\n",
            face.category,
            face.confidence,
            face.category_shares,
            face.free_fraction,
            face.occupied_fraction,
            face.unknown_fraction,
            face.region,
            face.evidence
        )
    };
    expect![[r#"
        category 4 0.00 of [0.0, 0.0, 0.0], free 0 occupied 0 unknown 1, region 255, Interpolated
        category 1 0.50 of [0.0, 0.5, 0.5], free 0.25 occupied 0.75 unknown 0, region 0, Observed
        category 2 0.93 of [0.06666667, 0.0, 0.93333334], free 0.9375 occupied 0.0625 unknown 0, region 0, Observed
        category 3 1.00 of [0.0, 0.0, 0.0], free 0 occupied 1 unknown 0, region 0, Observed
        category 3 1.00 of [0.0, 0.0, 0.0], free 0 occupied 0.8125 unknown 0.1875, region 0, Observed
        category 5 1.00 of [0.0, 0.0, 0.0], free 0 occupied 0 unknown 1, region 0, Interpolated
    "#]]
    .assert_eq(&faces.iter().chain(&blank[1..2]).map(line).collect::<String>());
}

#[test]
fn faces_are_measured() {
    let subdivision = boxed(
        [0.0, 0.0, 8.0, 4.0],
        &[[0.0, 0.0, 8.0, 4.0], [0.1, 3.9, 0.2, 3.9], [0.1, 3.9, 0.1, 3.8], [0.2, 3.9, 0.1, 3.8]],
    );
    let (faces, _) = annotated(&"00000000\n".repeat(4), &subdivision);
    let line = |face: &FaceAnnotation| {
        let FaceAnnotation { cells, area, extent: [long, short], heading, elongation, region, .. } = face;
        format!(
            "{cells} cells, {area:.3} m2, {long:.2} x {short:.2} m at {heading:.2}, {elongation:.2}:1, region {region}\n"
        )
    };
    expect![[r#"
        0 cells, 0.000 m2, 0.00 x 0.00 m at 0.00, 1.00:1, region 255
        16 cells, 16.000 m2, 8.00 x 4.00 m at 0.00, 2.00:1, region 0
        16 cells, 15.995 m2, 8.00 x 4.00 m at 0.00, 2.00:1, region 0
        0 cells, 0.005 m2, 0.10 x 0.10 m at 0.00, 1.00:1, region 0
    "#]]
    .assert_eq(&faces.iter().map(line).collect::<String>());
}

/// The door in the wall between two rooms: half of the wall stands, a quarter is open, a quarter was never seen.
#[test]
fn edges_are_supported_open_or_unknown() {
    let subdivision = boxed([1.0, 1.0, 9.0, 9.0], &[[5.5, 1.0, 5.5, 9.0]]);
    let (_, edges) = annotated(
        "
        ###########
        #0000#0000#
        #0000#0000#
        #0000#0000#
        #0000#0000#
        #000000000#
        #000000000#
        #000??0000#
        #000??0000#
        ###########
        ",
        &subdivision,
    );
    let wall = subdivision.edges().find(|&edge| subdivision.segment(edge).iter().all(|end| end.x == 5.5));
    let wall = &edges[wall.expect("the wall is an edge").index()];
    assert_eq!((wall.support, wall.open), (0.5, 0.25));
    assert_eq!(wall.evidence, Evidence::Observed);
    assert!(wall.confidence > 0.75 && wall.confidence < 1.0);
    // Edges along the middle of walls are supported all the way, the outer ones here on one side.
    assert!(edges.iter().all(|edge| (0.0..=1.0).contains(&edge.support)));
}

/// A hall with walls all around, and a rectangle cut out of its open floor.
#[test]
fn what_nothing_stands_along_follows_from_its_surroundings() {
    let cut_out = [[6.0, 3.0, 12.0, 3.0], [12.0, 3.0, 12.0, 6.0], [12.0, 6.0, 6.0, 6.0], [6.0, 6.0, 6.0, 3.0]];
    let subdivision = boxed([0.5, 0.5, 21.5, 8.5], &cut_out);
    let wall = "#".repeat(22) + "\n";
    let picture = wall.clone() + &format!("#{}#\n", "0".repeat(20)).repeat(7) + &wall;
    let (faces, edges) = annotated(&picture, &subdivision);
    let observed = edges.iter().filter(|edge| edge.evidence == Evidence::Observed).count();
    assert_eq!((edges.len(), observed), (8, 4));
    let evidence: Vec<(f64, Evidence)> = faces[1..].iter().map(|face| (face.area, face.evidence)).collect();
    assert!(evidence.contains(&(18.0, Evidence::Interpolated)), "{evidence:?}");
    assert!(evidence.contains(&(150.0, Evidence::Observed)), "{evidence:?}");
}

#[test]
fn the_number_of_threads_is_of_no_consequence() {
    let slant: Vec<_> = (0..30).map(|line| [f64::from(line) - 9.0, 0.0, f64::from(line), 20.0]).collect();
    let subdivision = boxed([0.0, 0.0, 20.0, 20.0], &slant);
    let picture = "0120#12?011221#01200\n".repeat(20);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
        pool.install(|| annotated(&picture, &subdivision))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn nothing_is_annotated_without_faces() {
    let (faces, edges) = annotated("??\n??\n", &subdivide(&[]));
    assert_eq!((faces.len(), edges.len()), (1, 0));
}
