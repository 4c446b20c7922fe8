//! Place categories: features, scaled and clustered (paper, II-A; doi 10.1109/ECMR.2015.7324207).
//!
//! A clustering is fitted to the features (of a sample of the measured cells) and gives every measured cell a category,
//! and its memberships where they are asked for; relaxation, an option, lets neighbours settle on one. A free cell that was not measured takes the category of the nearest
//! measured one, going through free space, and through walls only where there is no other way. The paper stops at the
//! clusters; here they are numbered by their mean beam length, from the narrowest places to the widest, so that the
//! same map has the same numbers whatever the seed.
//!
//! Cost: that of the clustering, and O(cells) for the cells between. Limits: 32 categories by the checked options, 253 by the
//! type.

use std::collections::VecDeque;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::clustering::{self, FitOptions, FitReport, Method, PlaceModel};
use crate::features::CellFeatures;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::relaxation::{Lattice, Memberships, RelaxationReport, relax_cells};
use crate::spec::{CategorizationOptions, ClusteringMethod, FeatureProfile};
use crate::watch::{Stopped, Watch};

/// Cells that categories are fitted to: the standard error of a centroid is then below half a percent of the spread.
const FIT_CELLS: usize = 200_000;
/// When centroids rest. On flat ground a looser one moves thousands of cells by the seed.
const TOLERANCE: f64 = 1e-6;
/// The same of the author, who fitted to all cells (the default of scikit-learn).
const AUTHORS_TOLERANCE: f64 = 1e-4;

/// Measured cells that a task gives their clusters.
const ROWS_PER_BLOCK: usize = 1 << 14;

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
    /// How the clusters were found.
    pub fit: FitReport,
    /// What the relaxation of the cells did, where it was asked for.
    pub relaxation: Option<RelaxationReport>,
}

/// One cluster of places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Category {
    /// How many free cells carry it.
    pub cells: usize,
    /// Mean of each feature over the measured cells of the cluster (before any relaxation), unscaled, in the order of
    /// [`CategoryMap::feature_names`].
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

/// The categories of a map, and how sure they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Categorization {
    /// The category of every cell.
    pub map: CategoryMap,
    /// The distribution of every measured cell over the categories; absent where no one asked for it, since then a cell
    /// is of its category and no other.
    pub memberships: Option<CellMemberships>,
}

/// Distributions of the measured cells over the categories.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellMemberships {
    /// Number (row-major) of each measured cell, ascending.
    pub cells: Vec<u32>,
    /// Their distributions.
    pub shares: Memberships,
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
) -> Result<Categorization, Stopped> {
    let (model, fit) = clustering::fit(&features.values, features.names.len(), &fit_options(options, seed), watch)?;
    let mut labels = vec![0; features.cells.len()];
    let is_graded = options.clustering == ClusteringMethod::GaussianMixture || options.relaxation.is_some();
    let mut shares = is_graded.then(|| Memberships::new(features.cells.len(), model.len()));
    assign(&model, &features.values, &mut labels, shares.as_mut(), watch)?;
    let mut categories = describe(&model, features, &labels);
    let mut relaxation = None;
    if let (Some(wanted), Some(shares)) = (options.relaxation, &mut shares) {
        let lattice = Lattice::new(&features.cells, grid.width(), options.stride);
        relaxation = Some(relax_cells(&lattice, shares, wanted, watch)?);
        labels = shares.categories();
    }
    let mut cells = vec![CategoryMap::NONE; grid.cells().len()];
    for (&cell, &label) in features.cells.iter().zip(&labels) {
        cells[cell as usize] = label;
    }
    spread(grid, &features.cells, &mut cells, watch)?;
    for &category in cells.iter().filter(|&&category| category != CategoryMap::NONE) {
        categories[usize::from(category)].cells += 1;
    }
    let feature_names = features.names.iter().map(|&name| name.to_owned()).collect();
    let memberships = shares.map(|shares| CellMemberships { cells: features.cells.clone(), shares });
    Ok(Categorization { map: CategoryMap { cells, categories, feature_names, fit, relaxation }, memberships })
}

/// What the options mean for the clustering.
fn fit_options(options: &CategorizationOptions, seed: u64) -> FitOptions {
    let (tolerance, fit_rows) = match options.profile {
        FeatureProfile::Paper13 => (TOLERANCE, FIT_CELLS),
        FeatureProfile::Halmstad2017 => (AUTHORS_TOLERANCE, usize::MAX),
    };
    FitOptions {
        method: match options.clustering {
            ClusteringMethod::KMeans => Method::KMeans,
            ClusteringMethod::GaussianMixture => Method::GaussianMixture(options.covariance),
        },
        count: options.k,
        max_count: options.max_k,
        scaling: options.scaling,
        restarts: options.restarts,
        max_iterations: options.max_iterations,
        tolerance,
        fit_rows,
        seed,
    }
}

/// Gives every row its cluster, block by block, and its memberships where there is room for them.
fn assign(
    model: &PlaceModel,
    rows: &[f32],
    labels: &mut [u8],
    memberships: Option<&mut Memberships>,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let blocks = rows.par_chunks(ROWS_PER_BLOCK * model.columns()).zip(labels.par_chunks_mut(ROWS_PER_BLOCK));
    let Some(memberships) = memberships.filter(|_| !model.is_empty()) else {
        return blocks.try_for_each(|(rows, labels)| {
            watch.check()?;
            model.assign(rows, labels);
            Ok(())
        });
    };
    blocks.zip(memberships.values_mut().par_chunks_mut(ROWS_PER_BLOCK * model.len())).try_for_each(
        |((rows, labels), packed)| {
            watch.check()?;
            let mut shares = vec![0.0; packed.len()];
            model.memberships(rows, labels, &mut shares);
            Memberships::pack(&shares, packed);
            Ok(())
        },
    )
}

/// The categories with the means of their features, their cells yet to be counted.
fn describe(model: &PlaceModel, features: &CellFeatures, labels: &[u8]) -> Vec<Category> {
    let columns = features.names.len();
    let mut counts = vec![0_usize; model.len()];
    let mut sums = vec![vec![0.0_f64; columns]; model.len()];
    for (row, &label) in features.values.chunks_exact(columns).zip(labels) {
        counts[usize::from(label)] += 1;
        sums[usize::from(label)].iter_mut().zip(row).for_each(|(sum, &value)| *sum += f64::from(value));
    }
    let mean = |(sums, count): (Vec<f64>, usize)| Category {
        cells: 0,
        mean_features: sums.into_iter().map(|sum| sum / count.max(1) as f64).collect(),
    };
    sums.into_iter().zip(counts).map(mean).collect()
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
    use crate::features;
    use crate::spec::{CategoryCount, Scaling};
    use crate::test_maps::real_maps::{self, Picture};
    use expect_test::{Expect, expect};
    use proptest::prelude::*;

    fn categories(grid: &OccupancyGrid, options: &CategorizationOptions) -> CategoryMap {
        let watch = Watch::unwatched();
        let features = features::extract(grid, options, &watch).expect("nobody stops it");
        categorize(grid, &features, options, 1, &watch).expect("nobody stops it").map
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
        let options =
            CategorizationOptions { k: CategoryCount::Fixed(2), stride: 3, ..CategorizationOptions::default() };
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
        let options =
            CategorizationOptions { k: CategoryCount::Fixed(2), stride: 4, ..CategorizationOptions::default() };
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
            k: CategoryCount::Fixed(k),
            stride,
            restarts: 20,
            max_iterations: 500,
            ..CategorizationOptions::default()
        };
        let watch = Watch::unwatched();
        let features = features::extract(&grid, &options, &watch).expect("nobody stops it");
        let found = categorize(&grid, &features, &options, 1, &watch).expect("nobody stops it").map;
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
}
