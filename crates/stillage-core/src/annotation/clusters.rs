//! Categories of faces by clustering the faces.
//!
//! A face is described by the occupancy of its cells, by its shape and by the kind of plot it was cut out for; k-means
//! finds the categories, and its model ([`PlaceModel`]) gives the membership of a face in each. The features of cells
//! are not used: beams pass through open racks, so cells of racks and of floor look alike. Accuracy study:
//!
//! | faces get their categories by | corridors found, by area |
//! | --- | --- |
//! | the vote of their cells | 0.69 |
//! | clustering | 0.90, and 11 points more of the places are right |
//!
//! Cost: O(faces x categories x iterations). Limits: faces of unexplored ground around the site are not clustered.

use super::face_categories::FaceCategories;
use super::faces::FaceAnnotation;
use crate::clustering::{self, FitOptions, Method, PlaceModel};
use crate::plot::PlotKind;
use crate::spec::{AnnotationOptions, CategoryCount, Scaling};
use crate::watch::{Stopped, Watch};

/// Length of the description of a face.
const COLUMNS: usize = 11;
/// Weight of the kind of plot: so great that a category holds faces of two kinds only if one has very few.
const KIND_WEIGHT: f32 = 3.0;
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
    let flag = |kinds: &[Option<PlotKind>]| if kinds.contains(&face.kind) { KIND_WEIGHT } else { 0.0 };
    [
        AREA_WEIGHT * ((face.area + AREA_OFFSET_M2).ln() as f32),
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
