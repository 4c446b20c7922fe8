//! Orientations refined, confirmed and completed by radiogram energy.

use std::f64::consts::PI;

use super::energy::{Alignment, EnergyScan, OccupiedSample};
use crate::geometry::line_angle_between;
use crate::spec::OrientationOptions;
use crate::watch::{Stopped, Watch};

/// Least contrast of an orientation, as a share of the greatest. Of 30 maps the weakest true direction has 0.14 and the
/// strongest false one 0.07.
const MIN_CONTRAST: f64 = 0.1;

/// The same for a direction perpendicular to a stronger one, which is expected in buildings: the walls across a
/// corridor of 15 m in `office__halmstad_F5_05` have 0.05.
const MIN_CONTRAST_ACROSS: f64 = 0.03;

/// Largest deviation of such a direction from the perpendicular, degrees: maps of robots are slightly bent.
const ACROSS_DEG: f64 = 2.0;

/// Least contrast in standard deviations of that of scattered cells. Measured:
///
/// | map | contrast |
/// | --- | --- |
/// | random grids | up to 4.4 |
/// | a single bar of eight cells | 5.7 |
/// | a drawn floor plan of 60 cells | 15 |
/// | real maps | 50 and more |
const MIN_DEVIATIONS: f64 = 5.0;

/// Moves each angle to the nearby maximum of the energy, adds the pairs of perpendicular directions that the energy
/// shows, and keeps those that stand out; strongest first.
pub(super) fn refine(
    sample: &OccupiedSample,
    angles: &[f64],
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Vec<f64>, Stopped> {
    let scan = EnergyScan::new(sample, watch)?;
    let mut alignments: Vec<Alignment> = angles
        .iter()
        .copied()
        .chain(scan.pair_peaks(options.min_peak))
        .map(|angle| scan.refine(sample, angle, watch))
        .collect::<Result<_, _>>()?;
    alignments.sort_by(|one, other| other.contrast.total_cmp(&one.contrast).then(one.angle.total_cmp(&other.angle)));
    let strongest = alignments.first().map_or(0.0, |alignment| alignment.contrast);
    let least = MIN_DEVIATIONS * scan.noise(sample);
    let separation = options.min_separation_deg.to_radians();
    let mut kept: Vec<f64> = Vec::new();
    for Alignment { angle, contrast } in alignments {
        let between = |other: &f64| line_angle_between(angle, *other);
        let is_across = kept.iter().any(|other| PI / 2.0 - between(other) <= ACROSS_DEG.to_radians());
        let share = if is_across { MIN_CONTRAST_ACROSS } else { MIN_CONTRAST };
        let stands_out = contrast >= least.max(share * strongest);
        if stands_out && kept.iter().all(|other| between(other) >= separation) {
            kept.push(angle);
        }
    }
    Ok(kept)
}
