//! From a site to greys.

use stillage_core::geometry::Vector;

use super::plan::Plan;
use crate::raster::Lattice;
use crate::scanner::grey;
use crate::shape::Convex;
use crate::site::Site;

/// Samples along each side of a cell, for grey edges.
const SAMPLES: usize = 4;

/// The cells of a drawing: the walls with the margin around them, moved by a part of a cell.
pub(super) fn lattice(site: &Site, plan: &Plan, shifted_cells: f64) -> Lattice {
    let walls: Vec<Convex> = site.floor.iter().map(|floor| floor.grown(plan.wall)).collect();
    let bounds = walls.iter().map(Convex::bounds).reduce(|one, other| (one.0.inf(&other.0), one.1.sup(&other.1)));
    let (low, high) = bounds.expect("a site has floor");
    let margin = Vector::new(plan.margin, plan.margin);
    let moved = Vector::new(shifted_cells, shifted_cells) * plan.resolution;
    let size = (high - low + 2.0 * margin) / plan.resolution;
    let [width, height] = [size.x, size.y].map(|cells| (cells - 1e-9).ceil() as usize);
    Lattice { width, height, resolution: plan.resolution, origin: low - margin - moved }
}

/// The greys of a drawing, lowest row first.
pub(super) fn greys(site: &Site, plan: &Plan, lattice: &Lattice) -> Vec<u8> {
    let mut greys = vec![plan.outside.grey(); lattice.width * lattice.height];
    for floor in &site.floor {
        lattice.for_each_cell(floor, |cell| greys[cell] = grey::FREE);
    }
    if plan.soft {
        for (grey, share) in greys.iter_mut().zip(covered(&site.solids, lattice)) {
            *grey = (f64::from(*grey) * (1.0 - share)).round() as u8;
        }
    } else {
        for solid in &site.solids {
            lattice.for_each_cell(solid, |cell| greys[cell] = grey::OCCUPIED);
        }
    }
    greys
}

/// The share of each cell that shapes cover.
fn covered(shapes: &[Convex], lattice: &Lattice) -> impl Iterator<Item = f64> {
    let fine = Lattice {
        width: lattice.width * SAMPLES,
        height: lattice.height * SAMPLES,
        resolution: lattice.resolution / SAMPLES as f64,
        origin: lattice.origin,
    };
    // A bit for each sample: shapes may overlap.
    let mut samples = vec![0_u16; lattice.width * lattice.height];
    for shape in shapes {
        fine.for_each_cell(shape, |index| {
            let (column, row) = (index % fine.width, index / fine.width);
            let cell = row / SAMPLES * lattice.width + column / SAMPLES;
            samples[cell] |= 1 << (row % SAMPLES * SAMPLES + column % SAMPLES);
        });
    }
    samples.into_iter().map(|bits| f64::from(bits.count_ones()) / (SAMPLES * SAMPLES) as f64)
}
