//! Principal component analysis by the symmetric eigenvalue decomposition of the covariance matrix.
//!
//! The sign of an eigenvector is arbitrary; here the entry of largest magnitude is positive, so that the same points
//! always give the same axes. Sums are taken in `f64`, in the order of the points.
//!
//! Cost: O(n d^2 + d^3) for n points of d dimensions. Limits: meant for tens of dimensions.

use nalgebra::{DMatrix, SymmetricEigen};

/// The axes along which points vary most.
#[derive(Debug, Clone, PartialEq)]
pub struct PrincipalComponents {
    mean: Vec<f64>,
    axes: Vec<Vec<f64>>,
    variances: Vec<f64>,
}

impl PrincipalComponents {
    /// Fits points given row by row, `dimensions` numbers each.
    #[must_use]
    pub fn fit(points: &[f32], dimensions: usize) -> Self {
        let mean = mean(points, dimensions);
        let SymmetricEigen { eigenvalues, eigenvectors } = covariance(points, &mean).symmetric_eigen();
        let mut order: Vec<usize> = (0..dimensions).collect();
        order.sort_by(|&one, &other| eigenvalues[other].total_cmp(&eigenvalues[one]).then(one.cmp(&other)));
        let axes = order.iter().map(|&index| with_fixed_sign(eigenvectors.column(index).iter().copied().collect()));
        // Rounding may leave the eigenvalue of a constant direction just below zero.
        let variances = order.iter().map(|&index| eigenvalues[index].max(0.0)).collect();
        Self { axes: axes.collect(), variances, mean }
    }

    /// Unit vectors, the one of largest variance first.
    #[must_use]
    pub fn axes(&self) -> &[Vec<f64>] {
        &self.axes
    }

    /// Variance along each axis, falling.
    #[must_use]
    pub fn variances(&self) -> &[f64] {
        &self.variances
    }

    /// Keeps the first axes that hold `share` of the variance, and `most` of them at most.
    #[must_use]
    pub fn keep(mut self, share: f64, most: usize) -> Self {
        let wanted = share * self.variances.iter().sum::<f64>();
        let mut held = 0.0;
        let needed = self.variances.iter().take_while(|&&variance| {
            let missing = held < wanted;
            held += variance;
            missing
        });
        let kept = needed.count().clamp(1, most.max(1)).min(self.axes.len());
        self.axes.truncate(kept);
        self.variances.truncate(kept);
        self
    }

    /// Coordinates of points along the axes, row by row, one number for each axis.
    #[must_use]
    pub fn project(&self, points: &[f32]) -> Vec<f32> {
        let along = |point: &[f32], axis: &[f64]| {
            point
                .iter()
                .zip(&self.mean)
                .zip(axis)
                .map(|((&value, mean), weight)| (f64::from(value) - mean) * weight)
                .sum()
        };
        points
            .chunks_exact(self.mean.len().max(1))
            .flat_map(|point| self.axes.iter().map(move |axis| along(point, axis)))
            .map(|value: f64| value as f32)
            .collect()
    }
}

fn mean(points: &[f32], dimensions: usize) -> Vec<f64> {
    let mut sums = vec![0.0; dimensions];
    for point in points.chunks_exact(dimensions.max(1)) {
        for (sum, &value) in sums.iter_mut().zip(point) {
            *sum += f64::from(value);
        }
    }
    let count = (points.len() / dimensions.max(1)).max(1);
    sums.into_iter().map(|sum| sum / count as f64).collect()
}

fn covariance(points: &[f32], mean: &[f64]) -> DMatrix<f64> {
    let dimensions = mean.len();
    let mut products = DMatrix::zeros(dimensions, dimensions);
    let mut centered = vec![0.0; dimensions];
    for point in points.chunks_exact(dimensions.max(1)) {
        for (index, value) in centered.iter_mut().enumerate() {
            *value = f64::from(point[index]) - mean[index];
        }
        for column in 0..dimensions {
            for row in column..dimensions {
                products[(row, column)] += centered[row] * centered[column];
            }
        }
    }
    let count = (points.len() / dimensions.max(1)).max(1);
    products.fill_upper_triangle_with_lower_triangle();
    products / count as f64
}

/// Turns a vector so that its entry of largest magnitude (the first of equals) is positive.
fn with_fixed_sign(mut vector: Vec<f64>) -> Vec<f64> {
    let largest = vector.iter().copied().reduce(|best, value| if value.abs() > best.abs() { value } else { best });
    if largest.is_some_and(|value| value < 0.0) {
        for value in &mut vector {
            *value = -*value;
        }
    }
    vector
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_a_slanted_line_have_one_component() {
        let points: Vec<f32> = (0..10).flat_map(|step| [step as f32 * -4.0, step as f32 * 3.0]).collect();
        let components = PrincipalComponents::fit(&points, 2).keep(0.95, 8);
        assert_eq!(components.axes().len(), 1);
        assert!((components.axes()[0][0] - 0.8).abs() < 1e-9 && (components.axes()[0][1] + 0.6).abs() < 1e-9);
        let along = components.project(&points);
        assert!((along[0] - along[9] - 45.0).abs() < 1e-4, "{along:?}");
    }

    #[test]
    fn variances_fall_and_keep_the_total() {
        let points = [1.0, 0.0, 5.0, 2.0, 1.0, -5.0, 3.0, -1.0, 4.0, 0.0, 0.5, -4.0];
        let components = PrincipalComponents::fit(&points, 3);
        let variances = components.variances();
        assert!(variances[0] >= variances[1] && variances[1] >= variances[2]);
        let mean = mean(&points, 3);
        let total: f64 = covariance(&points, &mean).trace();
        assert!((variances.iter().sum::<f64>() - total).abs() < 1e-9);
        assert_eq!(components.clone().keep(1.0, 2).axes().len(), 2);
        assert_eq!(components.keep(0.1, 2).axes().len(), 1);
    }

    #[test]
    fn no_points_and_equal_points_are_no_trouble() {
        assert!(PrincipalComponents::fit(&[], 3).keep(0.95, 8).project(&[]).is_empty());
        let components = PrincipalComponents::fit(&[2.0; 12], 3).keep(0.95, 8);
        assert_eq!(components.project(&[2.0; 3]), [0.0]);
    }
}
