//! Distributions of faces over the categories, and their relaxation over the adjacency graph (`crate::relaxation`).
//!
//! Memberships of cells are whole numbers (parts of 65,535), so the mean of a face does not depend on the order in
//! which threads add them. Cost: O(measured cells x k), and O(links x k^2) per iteration of the relaxation.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::faces::FaceAnnotation;
use crate::arrangement::{CellFaces, FaceId, Subdivision};
use crate::categorization::CellMemberships;
use crate::relaxation::{Adjacency, RelaxationReport, relax_faces};
use crate::spec::RelaxationOptions;
use crate::watch::{Stopped, Watch};

/// Measured cells that one task adds up.
const CELLS_PER_BLOCK: usize = 1 << 14;

/// Gives each face the mean membership of its measured cells.
pub(super) fn average(
    faces: &mut [FaceAnnotation],
    cells: &CellFaces,
    memberships: &CellMemberships,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let count = memberships.shares.count();
    if count == 0 {
        return Ok(());
    }
    let sums: Vec<AtomicU64> = std::iter::repeat_with(|| AtomicU64::new(0)).take(faces.len() * count).collect();
    let blocks = memberships.cells.par_chunks(CELLS_PER_BLOCK);
    blocks.zip(memberships.shares.values().par_chunks(CELLS_PER_BLOCK * count)).try_for_each(|(numbers, values)| {
        watch.check()?;
        let face = |number: &u32| cells.of_cell(*number as usize);
        let mut values = values.chunks_exact(count);
        for run in numbers.chunk_by(|one, other| face(one) == face(other)) {
            let mut of_run = vec![0_u64; count];
            for shares in values.by_ref().take(run.len()) {
                of_run.iter_mut().zip(shares).for_each(|(sum, &share)| *sum += u64::from(share));
            }
            // Only sums leave the tasks, and rayon joins them before these are read.
            for (sum, of_run) in sums[face(&run[0]).index() * count..].iter().zip(of_run) {
                sum.fetch_add(of_run, Ordering::Relaxed);
            }
        }
        Ok(())
    })?;
    for (index, (face, sums)) in faces.iter_mut().zip(sums.chunks_exact(count)).enumerate() {
        let sums: Vec<u64> = sums.iter().map(|sum| sum.load(Ordering::Relaxed)).collect();
        let total: u64 = sums.iter().sum();
        let is_measured = total > 0 && FaceId(index as u32) != FaceId::OUTER;
        let shares = || sums.iter().map(|&sum| (sum as f64 / total as f64) as f32).collect();
        // In a face without a measured cell, the cells got their categories from others; the shares of these are used.
        face.membership = Some(if is_measured { shares() } else { voted(face).to_vec() });
    }
    Ok(())
}

/// The shares of the categories; empty where there are none to share.
fn voted(face: &FaceAnnotation) -> &[f32] {
    let has_shares = face.category_shares.iter().any(|&share| share > 0.0);
    if usize::from(face.category) < face.category_shares.len() && has_shares { &face.category_shares } else { &[] }
}

/// Relaxes the faces that have categorized cells: each gets a new distribution, category and confidence.
pub(super) fn relax(
    faces: &mut [FaceAnnotation],
    subdivision: &Subdivision,
    count: usize,
    options: RelaxationOptions,
    watch: &Watch<'_>,
) -> Result<RelaxationReport, Stopped> {
    let start = |face: &FaceAnnotation| face.membership.clone().unwrap_or_else(|| voted(face).to_vec());
    let mut distributions: Vec<Vec<f32>> = faces.iter().map(start).collect();
    let report = relax_faces(&mut distributions, &adjacency(subdivision), count, options, watch)?;
    for (face, distribution) in faces.iter_mut().zip(distributions) {
        let greatest =
            distribution.iter().enumerate().reduce(|best, other| if other.1 > best.1 { other } else { best });
        if let Some((category, &share)) = greatest {
            face.category = category as u8;
            face.confidence = f64::from(share);
        }
        face.membership = Some(distribution);
    }
    Ok(report)
}

/// The neighbours of each face, and the length of each border with them.
fn adjacency(subdivision: &Subdivision) -> Adjacency {
    let mut adjacency = vec![Vec::new(); subdivision.face_count()];
    for edge in subdivision.edges() {
        let [left, right] = subdivision.sides(edge);
        if left != FaceId::OUTER && right != FaceId::OUTER {
            let length = subdivision.length(edge);
            adjacency[left.index()].push((right.index(), length));
            adjacency[right.index()].push((left.index(), length));
        }
    }
    adjacency
}
