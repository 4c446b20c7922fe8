//! The range of each option, and options that were checked.

use serde::Serialize;

use super::categorization::CategoryCount;
use super::options::AnalysisOptions;
use super::vehicle_width::VehicleWidth;

/// Options that were checked: each value is within its range.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct AnalysisSpec(AnalysisOptions);

impl AnalysisSpec {
    /// The options behind the spec, with every default filled in.
    #[must_use]
    pub const fn options(&self) -> &AnalysisOptions {
        &self.0
    }
}

/// One option that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{pointer}: {message}")]
pub struct OptionProblem {
    /// JSON pointer to the option.
    pub pointer: &'static str,
    /// What is wrong and what would be right.
    pub message: String,
}

impl AnalysisOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// One problem for each option out of range.
    pub fn check(self) -> Result<AnalysisSpec, Vec<OptionProblem>> {
        let mut check = Check::default();
        let grid = &self.grid;
        check.share_if("/grid/occupiedThreshold", grid.occupied_threshold);
        check.share_if("/grid/freeThreshold", grid.free_threshold);
        if let (Some(occupied), Some(free)) = (grid.occupied_threshold, grid.free_threshold) {
            check.that("/grid/freeThreshold", free < occupied, "must be below occupiedThreshold");
        }

        let categorization = &self.categorization;
        check.whole("/categorization/beams", categorization.beams, 8, 3600);
        if let Some(range) = categorization.max_range_m {
            check.number("/categorization/maxRangeM", range, 0.1, 10_000.0);
        }
        check.whole("/categorization/stride", categorization.stride, 1, 64);
        check.number("/categorization/gapM", categorization.gap_m, 0.0, 1_000.0);
        if let CategoryCount::Fixed(count) = categorization.k {
            check.whole("/categorization/k", count, 2, 32);
        }
        check.whole("/categorization/maxK", categorization.max_k, 2, 32);
        check.whole("/categorization/restarts", categorization.restarts, 1, 100);
        check.whole("/categorization/maxIterations", categorization.max_iterations, 1, 10_000);
        if let Some(relaxation) = categorization.relaxation {
            check.whole("/categorization/relaxation/iterations", relaxation.iterations, 1, 100);
        }

        let orientation = &self.orientation;
        check.number("/orientation/gradientScaleM", orientation.gradient_scale_m, 0.001, 10.0);
        check.whole("/orientation/bins", orientation.bins, 36, 7_200);
        check.whole("/orientation/maxComponents", orientation.max_components, 1, 32);
        check.number("/orientation/minPeak", orientation.min_peak, 0.0, 1.0);
        check.number("/orientation/minSeparationDeg", orientation.min_separation_deg, 0.1, 89.0);

        let regions = &self.regions;
        if let Some(count) = regions.count {
            check.whole("/regions/count", count, 1, 16);
        }
        check.whole("/regions/maxCount", regions.max_count, 1, 16);
        for wavelength in regions.wavelengths_m {
            check.number("/regions/wavelengthsM", wavelength, 0.1, 100.0);
        }
        let [shortest, longest] = regions.wavelengths_m;
        check.that("/regions/wavelengthsM", shortest < longest, "must be the shortest, then the longest wavelength");
        check.number("/regions/smoothingM", regions.smoothing_m, 0.1, 100.0);
        check.number("/regions/tileM", regions.tile_m, 0.1, 100.0);
        check.number("/regions/minShare", regions.min_share, 0.0, 1.0);

        let decomposition = &self.decomposition;
        if let VehicleWidth::Fixed(width) = decomposition.vehicle_width_m {
            check.number("/decomposition/vehicleWidthM", width, 0.2, 20.0);
        }
        check.range_if("/decomposition/pitchM", decomposition.pitch_m, 0.3, 10.0);
        check.range_if("/decomposition/depthM", decomposition.depth_m, 0.3, 10.0);
        check.number("/decomposition/smoothingM", decomposition.smoothing_m, 0.0, 10.0);
        check.number("/decomposition/minDistanceM", decomposition.min_distance_m, 0.01, 100.0);
        check.number("/decomposition/minPeak", decomposition.min_peak, 0.0, 1.0);

        check.whole("/annotation/categories", self.annotation.categories, 2, 64);
        check.number("/annotation/supportWidthM", self.annotation.support_width_m, 0.0, 10.0);
        if let Some(relaxation) = self.annotation.relaxation {
            check.whole("/annotation/relaxation/iterations", relaxation.iterations, 1, 100);
        }

        if check.problems.is_empty() { Ok(AnalysisSpec(self)) } else { Err(check.problems) }
    }
}

/// The problems found so far.
#[derive(Default)]
struct Check {
    problems: Vec<OptionProblem>,
}

impl Check {
    fn that(&mut self, pointer: &'static str, holds: bool, message: &str) {
        if !holds {
            self.problems.push(OptionProblem { pointer, message: message.to_owned() });
        }
    }

    fn number(&mut self, pointer: &'static str, value: f64, low: f64, high: f64) {
        // Written so that NaN is out of range.
        let inside = value >= low && value <= high;
        self.that(pointer, inside, &format!("{value} is outside {low} to {high}"));
    }

    fn share_if(&mut self, pointer: &'static str, value: Option<f64>) {
        if let Some(value) = value {
            self.number(pointer, value, 0.0, 1.0);
        }
    }

    fn range_if(&mut self, pointer: &'static str, range: Option<[f64; 2]>, low: f64, high: f64) {
        if let Some([least, most]) = range {
            self.number(pointer, least, low, high);
            self.number(pointer, most, low, high);
            self.that(pointer, least <= most, "must be the least, then the greatest");
        }
    }

    fn whole(&mut self, pointer: &'static str, value: usize, low: usize, high: usize) {
        self.that(pointer, (low..=high).contains(&value), &format!("{value} is outside {low} to {high}"));
    }
}

#[cfg(test)]
mod tests {
    use super::super::categorization::RelaxationOptions;
    use super::*;

    #[test]
    fn the_defaults_are_valid() {
        assert!(AnalysisOptions::default().check().is_ok());
    }

    #[test]
    fn every_problem_is_named_with_its_pointer() {
        let mut options = AnalysisOptions::default();
        options.categorization.relaxation = Some(RelaxationOptions { iterations: 0 });
        options.categorization.k = CategoryCount::Fixed(0);
        options.decomposition.min_distance_m = f64::NAN;
        options.regions.wavelengths_m = [4.0, 2.0];
        let problems = options.check().unwrap_err();
        let pointers: Vec<&str> = problems.iter().map(|problem| problem.pointer).collect();
        let expected = [
            "/categorization/k",
            "/categorization/relaxation/iterations",
            "/regions/wavelengthsM",
            "/decomposition/minDistanceM",
        ];
        assert_eq!(pointers, expected);
    }
}
