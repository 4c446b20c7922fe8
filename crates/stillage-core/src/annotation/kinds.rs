//! Categories of faces: faces that look alike, are alike in shape, and lie alike among their neighbours.
//!
//! A face is described by what its cells hold, by its shape, by the plot it was cut out for and by what stands along its
//! border; k-means finds the categories. One look at a whole face tells more than the votes of its cells, which see
//! through open racks (accuracy study: 11 points of correct places, corridors 0.69 to 0.90 by area).
//!
//! Cost: O(faces x categories x iterations). Limits: faces of unexplored ground around the site are not clustered.

use super::roles::Role;
use super::{FaceAnnotation, FaceCategories};
use crate::categorization::CategoryMap;
use crate::clustering::{KMeansOptions, k_means};
use crate::decomposition::PlotKind;
use crate::spec::AnnotationOptions;
use crate::watch::{Stopped, Watch};

/// Numbers per face.
const COLUMNS: usize = 11;
/// Weight of what a face was cut out for: no category holds faces of two kinds, unless there are very few of one.
const ROLE_WEIGHT: f32 = 3.0;
/// Weights of the shares of cells (accuracy study).
const OCCUPIED_WEIGHT: f32 = 2.0;
const UNKNOWN_WEIGHT: f32 = 2.0;
/// Weights of size and shape, per factor e (accuracy study).
const AREA_WEIGHT: f32 = 1.0;
const ELONGATION_WEIGHT: f32 = 0.8;
/// Area that counts as none, square metres (accuracy study).
const NO_AREA: f64 = 0.05;
/// Weight of lying along the fronts of places.
const FRONT_WEIGHT: f32 = 3.0;
/// Share of its length that a corridor has fronts along (accuracy study).
pub(super) const FRONT_SHARE: f64 = 0.3;
/// Runs of k-means and their length: thousands of rows of a few numbers.
const RESTARTS: usize = 8;
const MAX_ITERATIONS: usize = 200;
const TOLERANCE: f64 = 1e-6;

/// Gives every face that is not outside its category.
pub(super) fn categorize(
    faces: &mut [FaceAnnotation],
    roles: &[Role],
    categories: &CategoryMap,
    options: &AnnotationOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<FaceCategories, Stopped> {
    let (members, outside): (Vec<usize>, Vec<usize>) =
        (1..faces.len()).partition(|&face| faces[face].category != categories.outside());
    let rows: Vec<f32> = members.iter().flat_map(|&face| describe(&faces[face], &roles[face])).collect();
    let search = KMeansOptions {
        k: options.categories,
        restarts: RESTARTS,
        max_iterations: MAX_ITERATIONS,
        tolerance: TOLERANCE,
        fit_rows: usize::MAX,
        seed,
    };
    let labels = k_means(&rows, COLUMNS, &search, watch)?;
    let centroids = centroids(&rows, &labels);
    let count = centroids.len() / COLUMNS;
    let numbers = canonical_numbers(&centroids, count);
    let kinds = FaceCategories { clusters: count };
    let spread = mean_squared_distance(&rows, &centroids).max(1e-6);
    for (face, row) in members.iter().zip(rows.chunks_exact(COLUMNS)) {
        let shares = memberships(row, &centroids, &numbers, spread);
        let best = (0..shares.len()).fold(0, |best, at| if shares[at] > shares[best] { at } else { best });
        faces[*face].category = best as u8;
        faces[*face].confidence = f64::from(shares[best]);
        faces[*face].category_shares = shares;
    }
    for face in outside {
        faces[face].category = kinds.outside();
        faces[face].category_shares = vec![0.0; kinds.clusters];
    }
    Ok(kinds)
}

/// A face in numbers.
fn describe(face: &FaceAnnotation, role: &Role) -> [f32; COLUMNS] {
    let kind = role.plot.map(|plot| plot.kind);
    let is = |wanted: &[PlotKind]| kind.is_some_and(|kind| wanted.contains(&kind));
    let flag = |holds: bool| if holds { ROLE_WEIGHT } else { 0.0 };
    let along_fronts = role.fronts >= FRONT_SHARE * face.extent[0];
    let is_drivable = is(&[PlotKind::Aisle, PlotKind::Lane, PlotKind::Gap]);
    let inside = 1.0 - face.unknown_fraction;
    [
        flag(is(&[PlotKind::Place])),
        flag(is_drivable),
        flag(is(&[PlotKind::Gap])) / 2.0,
        flag(kind.is_none()),
        OCCUPIED_WEIGHT * (face.occupied_fraction.sqrt() as f32),
        UNKNOWN_WEIGHT * face.unknown_fraction as f32,
        face.free_fraction as f32,
        AREA_WEIGHT * ((face.area + NO_AREA).ln() as f32),
        ELONGATION_WEIGHT * (face.elongation.ln() as f32),
        if is_drivable && along_fronts { FRONT_WEIGHT } else { 0.0 },
        inside as f32,
    ]
}

/// Means of the rows of each cluster, clusters without rows left out.
fn centroids(rows: &[f32], labels: &[u8]) -> Vec<f32> {
    let clusters = labels.iter().max().map_or(0, |&last| usize::from(last) + 1);
    let mut sums = vec![[0.0_f64; COLUMNS]; clusters];
    let mut counts = vec![0_usize; clusters];
    for (row, &label) in rows.chunks_exact(COLUMNS).zip(labels) {
        counts[usize::from(label)] += 1;
        sums[usize::from(label)].iter_mut().zip(row).for_each(|(sum, &value)| *sum += f64::from(value));
    }
    let filled = sums.iter().zip(&counts).filter(|&(_, &count)| count > 0);
    filled.flat_map(|(sum, &count)| sum.map(|sum| (sum / count as f64) as f32)).collect()
}

fn squared_distance(row: &[f32], centroid: &[f32]) -> f64 {
    row.iter().zip(centroid).map(|(a, b)| f64::from(a - b).powi(2)).sum()
}

/// Mean over the rows of the squared distance to the nearest centroid.
fn mean_squared_distance(rows: &[f32], centroids: &[f32]) -> f64 {
    let nearest = |row: &[f32]| {
        let distances = centroids.chunks_exact(COLUMNS).map(|centroid| squared_distance(row, centroid));
        distances.fold(f64::INFINITY, f64::min)
    };
    let count = (rows.len() / COLUMNS).max(1);
    rows.chunks_exact(COLUMNS).map(nearest).sum::<f64>() / count as f64
}

/// Numbers clusters by their centroids, so that the numbers do not depend on the luck of the seed.
fn canonical_numbers(centroids: &[f32], count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let centroid = |cluster: usize| &centroids[cluster * COLUMNS..(cluster + 1) * COLUMNS];
    order.sort_by(|&one, &other| {
        let pairs = centroid(one).iter().zip(centroid(other));
        pairs.map(|(a, b)| b.total_cmp(a)).find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut numbers = vec![0; count];
    for (number, cluster) in order.into_iter().enumerate() {
        numbers[cluster] = number;
    }
    numbers
}

/// How far a face belongs to each category: the densities of equally wide bells around the centroids.
fn memberships(row: &[f32], centroids: &[f32], numbers: &[usize], spread: f64) -> Vec<f32> {
    let distances: Vec<f64> = centroids.chunks_exact(COLUMNS).map(|centroid| squared_distance(row, centroid)).collect();
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let bells: Vec<f64> = distances.iter().map(|distance| (-0.5 * (distance - nearest) / spread).exp()).collect();
    let total: f64 = bells.iter().sum();
    let mut shares = vec![0.0; numbers.len()];
    for (&number, bell) in numbers.iter().zip(bells) {
        shares[number] = (bell / total) as f32;
    }
    shares
}
