use super::*;
use crate::spec::{CategoryCount, RelaxationOptions, Scaling};
use crate::test_maps::real_maps::{self, Picture};
use expect_test::{Expect, expect};
use proptest::prelude::*;

fn categories(grid: &OccupancyGrid, options: &CategorizationOptions) -> CategoryMap {
    let watch = Watch::unwatched();
    categorize(grid, options, 1, &watch).expect("nobody stops it").map
}

/// The categories of a map as digits, first row on top.
fn check(picture: &str, options: &CategorizationOptions, expected: &Expect) {
    let grid = OccupancyGrid::from_ascii(picture, 0.1);
    let map = categories(&grid, options);
    let digit = |&category: &u8| if category == CategoryMap::NONE { '#' } else { char::from(b'0' + category) };
    let rows: Vec<String> = map.cells.chunks(grid.width()).rev().map(|row| row.iter().map(digit).collect()).collect();
    expected.assert_eq(&rows.join("\n"));
}

const CORRIDOR_AND_HALL: &str = "
    ########################
    #############..........#
    #############..........#
    #............#.........#
    ###.####.#####.........#
    #...##...#####.........#
    #...##...#####.........#
    #...##...#####.........#
    ########################
    ";

#[test]
fn narrow_places_come_before_wide_ones() {
    let options = CategorizationOptions { k: CategoryCount::Fixed(2), ..CategorizationOptions::default() };
    check(
        CORRIDOR_AND_HALL,
        &options,
        &expect![[r#"
            ########################
            #############1111111111#
            #############1111111111#
            #000000000000#111111111#
            ###0####0#####111111111#
            #000##000#####111111111#
            #000##000#####111111111#
            #000##000#####111111111#
            ########################"#]],
    );
}

#[test]
fn cells_between_the_measured_ones_take_the_nearest_category() {
    let options = CategorizationOptions { k: CategoryCount::Fixed(2), stride: 3, ..CategorizationOptions::default() };
    check(
        CORRIDOR_AND_HALL,
        &options,
        &expect![[r#"
        ########################
        #############1111111111#
        #############1111111111#
        #000000000011#111111111#
        ###0####0#####111111111#
        #000##000#####111111111#
        #000##000#####111111111#
        #000##000#####111111111#
        ########################"#]],
    );
}

#[test]
fn free_cells_behind_walls_have_a_category_too() {
    let picture = "
        ...#....
        ...#.##.
        ####.#.#
        .....###
        ";
    let options = CategorizationOptions { k: CategoryCount::Fixed(2), stride: 4, ..CategorizationOptions::default() };
    check(
        picture,
        &options,
        &expect![[r#"
        001#1111
        000#1##1
        ####1#1#
        00011###"#]],
    );
}

#[test]
fn a_map_without_free_cells_has_no_categories() {
    for relaxation in [None, Some(RelaxationOptions::default())] {
        let options = CategorizationOptions { relaxation, ..CategorizationOptions::default() };
        for picture in ["", "#", "?#\n#?"] {
            let map = categories(&OccupancyGrid::from_ascii(picture, 0.1), &options);
            assert!(map.categories.is_empty());
            assert!(map.cells.iter().all(|&category| category == CategoryMap::NONE));
        }
    }
}

#[test]
fn equal_places_share_their_categories() {
    let map = categories(&OccupancyGrid::from_ascii(".#.", 0.1), &CategorizationOptions::default());
    assert_eq!(map.cells, [0, CategoryMap::NONE, 0]);
}

/// Agreement of two labellings, 1 for equal ones and 0 for chance (L. Hubert and P. Arabie 1985).
fn adjusted_rand_index(pairs: &[(usize, usize)]) -> f64 {
    let mut table = std::collections::BTreeMap::<(usize, usize), f64>::new();
    let (mut rows, mut columns) = (std::collections::BTreeMap::new(), std::collections::BTreeMap::new());
    for &(a, b) in pairs {
        *table.entry((a, b)).or_default() += 1.0;
        *rows.entry(a).or_insert(0.0) += 1.0;
        *columns.entry(b).or_insert(0.0) += 1.0;
    }
    let choose = |count: &f64| count * (count - 1.0) / 2.0;
    let [index, a, b]: [f64; 3] =
        [table.values().map(choose).sum(), rows.values().map(choose).sum(), columns.values().map(choose).sum()];
    let expected = a * b / choose(&(pairs.len() as f64));
    (index - expected) / (0.5 * (a + b) - expected)
}

/// Agreement with the author's own categories of one of his maps, over the measured cells.
fn agreement_with_the_author(map: &str, k: usize, stride: usize) -> Option<f64> {
    let path = |name: String| real_maps::find(&format!("golden/categories-2017/{name}.png"));
    let (labels, map) = (path(format!("{map}_labels_km{k}"))?, path(map.to_owned())?);
    // The author's cells are free above grey 210, and he took every map for one of 0.02 m per pixel.
    let grid = Picture::read(&map).grid(0.02, 210, 211);
    let options = CategorizationOptions {
        profile: FeatureProfile::Halmstad2017,
        scaling: Scaling::DivideByMean,
        k: CategoryCount::Fixed(k),
        stride,
        restarts: 20,
        max_iterations: 500,
        ..CategorizationOptions::default()
    };
    let watch = Watch::unwatched();
    let found = categorize(&grid, &options, 1, &watch).expect("nobody stops it").map;
    let is_measured = |&cell: &usize| {
        let on_lattice = (cell % grid.width()).is_multiple_of(stride) && (cell / grid.width()).is_multiple_of(stride);
        on_lattice && found.cells[cell] != CategoryMap::NONE
    };
    let colours: Vec<usize> = Picture::read(&labels)
        .pixels()
        .map(|pixel| pixel.iter().fold(0, |colour, &channel| colour << 8 | usize::from(channel)))
        .collect();
    let cells = (0..found.cells.len()).filter(is_measured);
    let pairs: Vec<_> = cells.map(|cell| (usize::from(found.cells[cell]), colours[cell])).collect();
    let agreement = adjusted_rand_index(&pairs);
    println!("k = {k}, {} cells: adjusted Rand index {agreement:.4}", pairs.len());
    Some(agreement)
}

#[test]
fn the_authors_categories_of_a_layout_are_reproduced() {
    if let Some(agreement) = agreement_with_the_author("E5_layout", 2, 4) {
        assert!(agreement >= 0.995, "{agreement}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn free_cells_and_no_others_have_a_category(
        rows in proptest::collection::vec("[.# ]{1,30}", 1..30),
        stride in 1_usize..9,
        k in 2_usize..9,
    ) {
        let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.05);
        let options = CategorizationOptions { stride, k: CategoryCount::Fixed(k), beams: 16, ..CategorizationOptions::default() };
        let map = categories(&grid, &options);
        prop_assert!(map.categories.len() <= k);
        for (&cell, &category) in grid.cells().iter().zip(&map.cells) {
            prop_assert_eq!(cell == Occupancy::Free, usize::from(category) < map.categories.len());
        }
        let means: Vec<f64> = map.categories.iter().map(|category| category.mean_features[0]).collect();
        prop_assert!(means.is_sorted());
    }
}
