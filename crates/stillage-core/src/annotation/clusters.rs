//! Categories of faces: faces that look alike, are alike in shape, and were cut out for the same.
//!
//! A face is described by what its cells hold, by its shape and by the plot it was cut out for; k-means finds the
//! categories, and its model ([`PlaceModel`]) says how far a face belongs to each. One look at a whole face tells more
//! than the votes of its cells, which see through open racks (accuracy study: 11 points of correct places, corridors
//! 0.69 to 0.90 by area).
//!
//! Cost: O(faces x categories x iterations). Limits: faces of unexplored ground around the site are not clustered.

use super::face_categories::FaceCategories;
use super::faces::FaceAnnotation;
use crate::clustering::{self, FitOptions, Method, PlaceModel};
use crate::plot::PlotKind;
use crate::spec::{AnnotationOptions, CategoryCount, Scaling};
use crate::watch::{Stopped, Watch};

/// Numbers per face.
const COLUMNS: usize = 11;
/// Weight of what a face was cut out for: no category holds faces of two kinds, unless there are very few of one.
const KIND_WEIGHT: f32 = 3.0;
/// Weights of the shares of cells (accuracy study).
const OCCUPIED_WEIGHT: f32 = 2.0;
const UNKNOWN_WEIGHT: f32 = 2.0;
/// Weights of size and shape, per factor e (accuracy study).
const AREA_WEIGHT: f32 = 1.0;
const ELONGATION_WEIGHT: f32 = 0.8;
/// Area that counts as none, square metres (accuracy study).
const NO_AREA: f64 = 0.05;
/// Runs of k-means and their length: thousands of rows of a few numbers.
const RESTARTS: usize = 8;
const MAX_ITERATIONS: usize = 200;
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
    let rows: Vec<f32> = members.iter().flat_map(|&face| describe(&faces[face])).collect();
    let model = fit(&rows, options.categories, seed, watch)?;
    let kinds = FaceCategories { clusters: model.len() };
    let mut labels = vec![0; members.len()];
    let mut memberships = vec![0.0; members.len() * model.len()];
    model.memberships(&rows, &mut labels, &mut memberships);
    for ((&face, category), shares) in members.iter().zip(labels).zip(memberships.chunks_exact(model.len().max(1))) {
        faces[face].category = category;
        faces[face].confidence = f64::from(shares[usize::from(category)]);
        faces[face].category_shares = shares.to_vec();
    }
    for face in outside {
        faces[face].category = kinds.outside();
        faces[face].category_shares = vec![0.0; kinds.clusters];
    }
    Ok(kinds)
}

/// Clusters of faces, numbered from small to large ones.
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

/// A face in numbers, its size first.
fn describe(face: &FaceAnnotation) -> [f32; COLUMNS] {
    let flag = |kinds: &[Option<PlotKind>]| if kinds.contains(&face.kind) { KIND_WEIGHT } else { 0.0 };
    [
        AREA_WEIGHT * ((face.area + NO_AREA).ln() as f32),
        ELONGATION_WEIGHT * (face.elongation.ln() as f32),
        flag(&[Some(PlotKind::Place)]),
        flag(&[Some(PlotKind::Aisle)]),
        flag(&[Some(PlotKind::OpenFloor), Some(PlotKind::Passage)]),
        flag(&[Some(PlotKind::Room)]),
        flag(&[Some(PlotKind::Other)]),
        flag(&[None]),
        OCCUPIED_WEIGHT * (face.occupied_fraction.sqrt() as f32),
        UNKNOWN_WEIGHT * face.unknown_fraction as f32,
        face.free_fraction as f32,
    ]
}
