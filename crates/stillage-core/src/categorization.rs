//! Place categories: features, scaled and clustered (paper, II-A; doi 10.1109/ECMR.2015.7324207).
//!
//! k-means over the features of the measured cells; a free cell that was not measured takes the category of the nearest
//! measured one, going through free space, and through walls only where there is no other way. The paper stops at the
//! clusters; here they are numbered by their mean beam length, from the narrowest places to the widest, so that the
//! same map has the same numbers whatever the seed.
//!
//! Cost: that of k-means, and O(cells) for the cells between. Limits: 32 categories by the checked options, 253 by the
//! type.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::clustering::{Clusters, KMeansOptions, ScaledRows, k_means};
use crate::features::CellFeatures;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::{CategorizationOptions, FeatureProfile};
use crate::watch::{Stopped, Watch};

/// Cells that categories are fitted to: the standard error of a centroid is then below half a percent of the spread.
const FIT_CELLS: usize = 200_000;
/// When centroids rest. On flat ground a looser one moves thousands of cells by the seed.
const TOLERANCE: f64 = 1e-6;
/// The same of the author, who fitted to all cells (the default of scikit-learn).
const AUTHORS_TOLERANCE: f64 = 1e-4;

/// Cells between two looks at the stop flag.
const CELLS_PER_CHECK: usize = 1 << 16;

/// The category of every cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CategoryMap {
    /// Category of each cell, row-major; [`CategoryMap::NONE`] where the cell is not free.
    pub cells: Vec<u8>,
    /// The clusters, by category. Numbered in a canonical order (ascending mean beam length of the cluster).
    pub categories: Vec<Category>,
    /// Names of the features behind [`Category::mean_features`].
    pub feature_names: Vec<String>,
}

/// One cluster of places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Category {
    /// How many free cells carry it.
    pub cells: usize,
    /// Mean of each feature over the measured cells, unscaled, in the order of [`CategoryMap::feature_names`].
    pub mean_features: Vec<f64>,
}

impl CategoryMap {
    /// No category: the cell is not free.
    pub const NONE: u8 = u8::MAX;

    /// The face-level category of faces that hold no free cell but occupied ones.
    #[must_use]
    pub fn occupied(&self) -> u8 {
        self.categories.len() as u8
    }

    /// The face-level category of faces among known places that hold no known cell at all.
    #[must_use]
    pub fn unknown(&self) -> u8 {
        self.categories.len() as u8 + 1
    }

    /// The face-level category of unexplored faces that are joined with the ground outside the map.
    #[must_use]
    pub fn outside(&self) -> u8 {
        self.categories.len() as u8 + 2
    }

    /// Number of categories a face may have: the clusters, `occupied`, `unknown` and `outside`.
    #[must_use]
    pub fn face_categories(&self) -> usize {
        self.categories.len() + 3
    }
}

/// Clusters the features into place categories and gives every free cell one.
///
/// There are fewer categories than asked for where there are fewer distinct places, and none without free cells.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn categorize(
    grid: &OccupancyGrid,
    features: &CellFeatures,
    options: &CategorizationOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<CategoryMap, Stopped> {
    let rows = ScaledRows::new(&features.values, features.names.len(), options.scaling);
    let (tolerance, fit_rows) = match options.profile {
        FeatureProfile::Paper13 => (TOLERANCE, FIT_CELLS),
        FeatureProfile::Halmstad2017 => (AUTHORS_TOLERANCE, usize::MAX),
    };
    let search = KMeansOptions {
        k: options.k,
        restarts: options.restarts,
        max_iterations: options.max_iterations,
        tolerance,
        fit_rows,
        seed,
    };
    let clusters = k_means(&rows, &search, watch)?;
    let (numbers, mut categories) = number(&clusters, features);
    let mut cells = vec![CategoryMap::NONE; grid.cells().len()];
    for (&cell, &label) in features.cells.iter().zip(&clusters.labels) {
        cells[cell as usize] = numbers[usize::from(label)];
    }
    spread(grid, &features.cells, &mut cells, watch)?;
    for &category in cells.iter().filter(|&&category| category != CategoryMap::NONE) {
        categories[usize::from(category)].cells += 1;
    }
    let feature_names = features.names.iter().map(|&name| name.to_owned()).collect();
    Ok(CategoryMap { cells, categories, feature_names })
}

/// Numbers the clusters by ascending mean beam length, the first feature. Gives the number of each cluster, and the
/// categories with their cells yet to be counted; clusters without cells have no category.
fn number(clusters: &Clusters, features: &CellFeatures) -> (Vec<u8>, Vec<Category>) {
    let columns = features.names.len();
    let mut counts = vec![0_usize; clusters.count];
    let mut sums = vec![vec![0.0_f64; columns]; clusters.count];
    for (row, &label) in features.values.chunks_exact(columns).zip(&clusters.labels) {
        counts[usize::from(label)] += 1;
        sums[usize::from(label)].iter_mut().zip(row).for_each(|(sum, &value)| *sum += f64::from(value));
    }
    let mut order: Vec<(usize, Vec<f64>)> = sums
        .into_iter()
        .zip(&counts)
        .map(|(sums, &count)| sums.into_iter().map(|sum| sum / count as f64).collect())
        .enumerate()
        .filter(|&(cluster, _)| counts[cluster] > 0)
        .collect();
    order.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    let mut numbers = vec![CategoryMap::NONE; clusters.count];
    for (number, (cluster, _)) in order.iter().enumerate() {
        numbers[*cluster] = number as u8;
    }
    (numbers, order.into_iter().map(|(_, mean_features)| Category { cells: 0, mean_features }).collect())
}

/// Spreads the categories of the measured cells to the other free cells, to the nearest first.
fn spread(grid: &OccupancyGrid, measured: &[u32], cells: &mut [u8], watch: &Watch<'_>) -> Result<(), Stopped> {
    let free = grid.count(Occupancy::Free);
    if free == measured.len() {
        return Ok(());
    }
    let is_free = |cell: usize| grid.cells()[cell] == Occupancy::Free;
    flood(grid.width(), measured, cells, is_free, watch)?;
    if grid
        .cells()
        .iter()
        .zip(&*cells)
        .all(|(&cell, &category)| cell != Occupancy::Free || category != CategoryMap::NONE)
    {
        return Ok(());
    }
    // Some free space is cut off from every measured cell: look through the walls.
    let reached: Vec<u32> =
        (0..cells.len()).filter(|&cell| cells[cell] != CategoryMap::NONE).map(|cell| cell as u32).collect();
    flood(grid.width(), &reached, cells, |_| true, watch)?;
    for (category, _) in cells.iter_mut().zip(grid.cells()).filter(|(_, cell)| **cell != Occupancy::Free) {
        *category = CategoryMap::NONE;
    }
    Ok(())
}

/// Gives the category of the nearest source to every cell that may be entered, in chessboard steps; of equally near
/// sources the one whose wave comes first, the lower cell.
fn flood(
    width: usize,
    sources: &[u32],
    cells: &mut [u8],
    enters: impl Fn(usize) -> bool,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let height = cells.len() / width;
    let mut wave: VecDeque<u32> = sources.iter().copied().collect();
    let mut steps = 0_usize;
    while let Some(cell) = wave.pop_front() {
        steps += 1;
        if steps.is_multiple_of(CELLS_PER_CHECK) {
            watch.check()?;
        }
        let cell = cell as usize;
        let (column, row) = (cell % width, cell / width);
        for near_row in row.saturating_sub(1)..height.min(row + 2) {
            for near_column in column.saturating_sub(1)..width.min(column + 2) {
                let near = near_row * width + near_column;
                if cells[near] == CategoryMap::NONE && enters(near) {
                    cells[near] = cells[cell];
                    wave.push_back(near as u32);
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::FeatureSource;
    use crate::vectors::Vectors;
    use crate::spec::Scaling;
    use crate::test_maps::real_maps::{self, Picture};
    use expect_test::{Expect, expect};
    use proptest::prelude::*;

    fn all_features(grid: &OccupancyGrid, options: &CategorizationOptions) -> Result<CellFeatures, Stopped> {
        let watch = Watch::unwatched();
        FeatureSource::new(grid, options, Vectors::widest(), &watch)?.all(&watch)
    }

    fn categories(grid: &OccupancyGrid, options: &CategorizationOptions) -> CategoryMap {
        let watch = Watch::unwatched();
        let features = all_features(grid, options).expect("nobody stops it");
        categorize(grid, &features, options, 1, &watch).expect("nobody stops it")
    }

    /// The categories of a map as digits, first row on top.
    fn check(picture: &str, options: &CategorizationOptions, expected: &Expect) {
        let grid = OccupancyGrid::from_ascii(picture, 0.1);
        let map = categories(&grid, options);
        let digit = |&category: &u8| if category == CategoryMap::NONE { '#' } else { char::from(b'0' + category) };
        let rows: Vec<String> =
            map.cells.chunks(grid.width()).rev().map(|row| row.iter().map(digit).collect()).collect();
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
        let options = CategorizationOptions { k: 2, ..CategorizationOptions::default() };
        check(
            CORRIDOR_AND_HALL,
            &options,
            &expect![[r#"
            ########################
            #############1111111111#
            #############0111111111#
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
        let options = CategorizationOptions { k: 2, stride: 3, ..CategorizationOptions::default() };
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
        let options = CategorizationOptions { k: 2, stride: 4, ..CategorizationOptions::default() };
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
        for picture in ["", "#", "?#\n#?"] {
            let map = categories(&OccupancyGrid::from_ascii(picture, 0.1), &CategorizationOptions::default());
            assert!(map.categories.is_empty());
            assert!(map.cells.iter().all(|&category| category == CategoryMap::NONE));
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
            k,
            stride,
            restarts: 20,
            max_iterations: 500,
            ..CategorizationOptions::default()
        };
        let watch = Watch::unwatched();
        let features = all_features(&grid, &options).expect("nobody stops it");
        let found = categorize(&grid, &features, &options, 1, &watch).expect("nobody stops it");
        let colours: Vec<usize> = Picture::read(&labels)
            .pixels()
            .map(|pixel| pixel.iter().fold(0, |colour, &channel| colour << 8 | usize::from(channel)))
            .collect();
        let cells = features.cells.iter().map(|&cell| cell as usize);
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

    #[test]
    #[ignore = "minutes in a debug build: cargo test --release -- --ignored"]
    fn the_authors_categories_of_every_cell_are_reproduced() {
        for (map, k) in [("E5_layout", 2), ("E5_layout", 4), ("E5_06", 2), ("F5_04", 2), ("F5_04", 3), ("F5_04", 4)] {
            if let Some(agreement) = agreement_with_the_author(map, k, 1) {
                assert!(agreement >= 0.995, "{map}, k = {k}: {agreement}");
            }
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
            let options = CategorizationOptions { stride, k, beams: 16, ..CategorizationOptions::default() };
            let map = categories(&grid, &options);
            prop_assert!(map.categories.len() <= k);
            for (&cell, &category) in grid.cells().iter().zip(&map.cells) {
                prop_assert_eq!(cell == Occupancy::Free, usize::from(category) < map.categories.len());
            }
            let means: Vec<f64> = map.categories.iter().map(|category| category.mean_features[0]).collect();
            prop_assert!(means.is_sorted());
        }
    }
}
