//! Categories of faces by clustering the faces.
//!
//! Faces that were cut out for different ground never share a category: each kind of ground gets its part of the
//! categories, more where its faces differ more, and k-means finds them by the occupancy of the cells and the shape of
//! the faces. Its model ([`PlaceModel`]) gives the membership of a face in each. The features of cells are not used:
//! beams pass through open racks, so cells of racks and of floor look alike. Accuracy study:
//!
//! | faces get their categories by | corridors found, by area |
//! | --- | --- |
//! | the vote of their cells | 0.69 |
//! | clustering | 0.90, and 11 points more of the places are right |
//!
//! Cost: O(faces x categories x iterations). Limits: faces of unexplored ground around the site are not clustered; a
//! site with more kinds of ground than categories were asked for gets one for each kind.

use std::collections::BTreeMap;

use super::face_categories::FaceCategories;
use super::faces::FaceAnnotation;
use crate::clustering::{self, FitOptions, Method, PlaceModel};
use crate::plot::PlotKind;
use crate::spec::{AnnotationOptions, CategoryCount, Scaling};
use crate::watch::{Stopped, Watch};

/// Length of the description of a face.
const COLUMNS: usize = 5;
/// Weight of the square root of the share of occupied cells (accuracy study).
const OCCUPIED_WEIGHT: f32 = 2.0;
/// Weight of the share of unknown cells (accuracy study).
const UNKNOWN_WEIGHT: f32 = 2.0;
/// Weight of the natural logarithm of the area (accuracy study).
const AREA_WEIGHT: f32 = 1.0;
/// Weight of the natural logarithm of long over short side (accuracy study).
const ELONGATION_WEIGHT: f32 = 0.8;
/// Added to every area before its logarithm is taken, square metres (accuracy study).
const AREA_OFFSET_M2: f64 = 0.05;
/// Times that k-means begins anew: cheap for thousands of short rows.
const RESTARTS: usize = 8;
/// Greatest number of iterations of k-means.
const MAX_ITERATIONS: usize = 200;
/// k-means ends when an iteration moves the centroids by less than this, in units of the description.
const TOLERANCE: f64 = 1e-6;

/// Gives every face that is not outside its category, and its distribution over all.
pub(super) fn categorize(
    faces: &mut [FaceAnnotation],
    votes: FaceCategories,
    options: &AnnotationOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<FaceCategories, Stopped> {
    let (members, outside): (Vec<usize>, Vec<usize>) =
        (1..faces.len()).partition(|&face| faces[face].category != votes.outside());
    let mut grounds: BTreeMap<Option<PlotKind>, Vec<usize>> = BTreeMap::new();
    for face in members {
        grounds.entry(ground(faces[face].kind)).or_default().push(face);
    }
    let describe_all = |members: &Vec<usize>| members.iter().flat_map(|&face| describe(&faces[face])).collect();
    let rows: Vec<Vec<f32>> = grounds.values().map(describe_all).collect();
    let counts = counts_of_grounds(&rows, options.categories);
    let fitted = rows.iter().zip(counts).map(|(rows, count)| fit(rows, count, seed, watch));
    let models: Vec<PlaceModel> = fitted.collect::<Result<_, Stopped>>()?;
    let kinds = FaceCategories { clusters: models.iter().map(PlaceModel::len).sum() };
    let mut first = 0;
    for ((members, rows), model) in grounds.values().zip(&rows).zip(&models) {
        let mut labels = vec![0; members.len()];
        let mut memberships = vec![0.0; members.len() * model.len()];
        model.memberships(rows, &mut labels, &mut memberships);
        let memberships = memberships.chunks_exact(model.len().max(1));
        for ((&face, category), shares) in members.iter().zip(labels).zip(memberships) {
            faces[face].category = first as u8 + category;
            faces[face].confidence = f64::from(shares[usize::from(category)]);
            faces[face].category_shares = vec![0.0; kinds.clusters];
            faces[face].category_shares[first..first + shares.len()].copy_from_slice(shares);
        }
        first += model.len();
    }
    for face in outside {
        faces[face].category = kinds.outside();
        faces[face].category_shares = vec![0.0; kinds.clusters];
    }
    Ok(kinds)
}

/// The kind of ground that a face counts as: a passage is floor.
fn ground(kind: Option<PlotKind>) -> Option<PlotKind> {
    kind.map(|kind| if kind == PlotKind::Passage { PlotKind::OpenFloor } else { kind })
}

/// How many categories each kind of ground gets, given the descriptions of its faces: one, and then each of the
/// remaining `categories` goes to the ground with the greatest sum of squared deviations for each that it has (V.
/// D'Hondt's rule).
fn counts_of_grounds(grounds: &[Vec<f32>], categories: usize) -> Vec<usize> {
    let spreads: Vec<f64> = grounds.iter().map(|rows| spread(rows)).collect();
    let mut counts = vec![1; grounds.len()];
    for _ in grounds.len()..categories {
        let claim = |ground: usize| spreads[ground] / counts[ground] as f64;
        let open = (0..grounds.len()).filter(|&ground| counts[ground] * COLUMNS < grounds[ground].len());
        match open.reduce(|most, other| if claim(other) > claim(most) { other } else { most }) {
            Some(ground) if spreads[ground] > 0.0 => counts[ground] += 1,
            _ => break,
        }
    }
    counts
}

/// The sum of the squared distances of some descriptions from their mean.
fn spread(rows: &[f32]) -> f64 {
    let count = (rows.len() / COLUMNS) as f64;
    let of_column = |column: usize| {
        let values = || rows.iter().skip(column).step_by(COLUMNS).map(|&value| f64::from(value));
        let mean = values().sum::<f64>() / count;
        values().map(|value| (value - mean).powi(2)).sum::<f64>()
    };
    (0..COLUMNS).map(of_column).sum()
}

/// Clusters of faces, numbered by their area from small to large.
fn fit(rows: &[f32], categories: usize, seed: u64, watch: &Watch<'_>) -> Result<PlaceModel, Stopped> {
    let options = FitOptions {
        method: Method::KMeans,
        count: CategoryCount::Fixed(categories),
        max_count: categories,
        scaling: Scaling::None,
        restarts: RESTARTS,
        max_iterations: MAX_ITERATIONS,
        tolerance: TOLERANCE,
        fit_rows: usize::MAX,
        seed,
    };
    Ok(clustering::fit(rows, COLUMNS, &options, watch)?.0)
}

/// The description of a face, its size first: clusters are numbered by the first number.
fn describe(face: &FaceAnnotation) -> [f32; COLUMNS] {
    [
        AREA_WEIGHT * ((face.area + AREA_OFFSET_M2).ln() as f32),
        ELONGATION_WEIGHT * (face.elongation.ln() as f32),
        OCCUPIED_WEIGHT * (face.occupied_fraction.sqrt() as f32),
        UNKNOWN_WEIGHT * face.unknown_fraction as f32,
        face.free_fraction as f32,
    ]
}
