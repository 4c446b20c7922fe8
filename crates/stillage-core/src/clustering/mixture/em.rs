//! Expectation-maximization of a Gaussian mixture.
//!
//! Starts from clusters (k-means), as scikit-learn does. A share of each column's variance over all rows is added to
//! its variance in each component, so that no component shrinks to a point. A component of less weight than one row per
//! column is dropped. Ends when the mean log-likelihood of a row gains less than the tolerance.
//!
//! Sums are taken over fixed blocks of rows and combined in order. Cost: O(rows x k x columns^2) per iteration with
//! full covariances, O(rows x k x columns) with diagonal ones.

use nalgebra::{Cholesky, DMatrix};
use rayon::prelude::*;

use super::component::{NormalComponent, Whitening, triangle};
use super::gaussian_mixture::{GaussianMixture, Scratch};
use crate::clustering::points::{GROUPS_PER_BLOCK, Points, SIMD_WIDTH, nearest};
use crate::spec::Covariance;
use crate::watch::{Stopped, Watch};

/// Share of a column's variance over all rows that is added to its variance in each component. A category narrower than
/// a hundredth of the variance of the map is an artefact of the grid. (scikit-learn adds 1e-6, against singular
/// matrices only.)
pub(in crate::clustering) const REGULARIZATION: f64 = 1e-2;

/// Gain in mean log-likelihood of a row below which a fit ends (scikit-learn: 1e-3).
const MIN_GAIN: f64 = 1e-4;

/// Columns without variance are regularized as if they had this one, so that densities stay finite.
const LEAST_VARIANCE: f64 = 1e-12;

/// A fitted mixture.
#[derive(Debug, Clone)]
pub(in crate::clustering) struct Fitted {
    pub mixture: GaussianMixture,
    /// Mean over the rows of the logarithm of their density.
    pub log_likelihood: f64,
    pub iterations: usize,
}

impl Fitted {
    /// Bayesian information criterion of the fit to `rows` rows (G. Schwarz 1978); lower is better.
    pub(in crate::clustering) fn criterion(&self, rows: usize) -> f64 {
        let parameters = |component: &NormalComponent| {
            let (Whitening::Diagonal(factors) | Whitening::Full(factors)) = &component.whitening;
            component.mean.len() + factors.len() + 1
        };
        // One weight follows from the others.
        let free = self.mixture.components.iter().map(parameters).sum::<usize>().saturating_sub(1);
        free as f64 * (rows as f64).ln() - 2.0 * rows as f64 * self.log_likelihood
    }
}

/// Fits a mixture to at least one point, starting at `centroids`.
pub(in crate::clustering) fn fit(
    points: &Points,
    centroids: &[f32],
    covariance: Covariance,
    regularization: f64,
    max_iterations: usize,
    watch: &Watch<'_>,
) -> Result<Fitted, Stopped> {
    let guard = points.variances().into_iter().map(|variance| (regularization * variance).max(LEAST_VARIANCE));
    let guard: Vec<f64> = guard.collect();
    let components = centroids.len() / points.columns();
    let empty = || Moments::new(components, points.columns(), covariance);
    let start = moments(points, watch, empty, |group, shares| {
        let labels = nearest(points.group(group), centroids).labels;
        shares.clear();
        shares.extend((0..components).map(|part| labels.map(|label| f64::from(u8::from(label as usize == part)))));
        [0.0; SIMD_WIDTH]
    })?;
    let mut mixture = start.mixture(&guard);
    let mut log_likelihood = f64::NEG_INFINITY;
    for iterations in 1..=max_iterations {
        let empty = || Moments::new(mixture.len(), points.columns(), covariance);
        let expected = moments_of(points, &mixture, watch, empty)?;
        let now = expected.log_likelihood / points.len() as f64;
        let gain = now - log_likelihood;
        log_likelihood = now;
        // Dropping a component may lower the likelihood a little, so the size of the change counts.
        let is_settled = gain.abs() < MIN_GAIN;
        if is_settled || iterations == max_iterations {
            return Ok(Fitted { mixture, log_likelihood, iterations });
        }
        mixture = expected.mixture(&guard);
    }
    Ok(Fitted { mixture, log_likelihood, iterations: 0 })
}

/// Weighted sums of the rows, their memberships by a mixture.
fn moments_of(
    points: &Points,
    mixture: &GaussianMixture,
    watch: &Watch<'_>,
    empty: impl Fn() -> Moments + Sync,
) -> Result<Moments, Stopped> {
    moments(points, watch, empty, |group, shares| {
        let mut scratch = Scratch { memberships: std::mem::take(shares), ..Scratch::default() };
        let log_densities = mixture.memberships(points.group(group), &mut scratch);
        *shares = scratch.memberships;
        log_densities
    })
}

/// Weighted sums of the rows; `share` gives the memberships of a group and the logarithms of its densities.
fn moments(
    points: &Points,
    watch: &Watch<'_>,
    empty: impl Fn() -> Moments + Sync,
    share: impl Fn(usize, &mut Vec<[f64; SIMD_WIDTH]>) -> [f64; SIMD_WIDTH] + Sync,
) -> Result<Moments, Stopped> {
    let groups: Vec<usize> = (0..points.group_count()).collect();
    let blocks: Result<Vec<Moments>, Stopped> = groups
        .par_chunks(GROUPS_PER_BLOCK)
        .map(|groups| {
            watch.check()?;
            let mut sums = empty();
            let mut shares = Vec::new();
            for &group in groups {
                let log_densities = share(group, &mut shares);
                sums.add_group(points.group(group), points.rows_in(group), &mut shares, &log_densities);
            }
            Ok(sums)
        })
        .collect();
    Ok(blocks?.iter().fold(empty(), |mut total, block| {
        total.add(block);
        total
    }))
}

/// Weighted sums of rows and of products of their columns, by component.
struct Moments {
    columns: usize,
    covariance: Covariance,
    weights: Vec<f64>,
    sums: Vec<f64>,
    /// Squares of the columns, or the lower triangle of all products.
    products: Vec<f64>,
    log_likelihood: f64,
}

impl Moments {
    fn new(components: usize, columns: usize, covariance: Covariance) -> Self {
        let products = products(covariance, columns);
        Self {
            columns,
            covariance,
            weights: vec![0.0; components],
            sums: vec![0.0; components * columns],
            products: vec![0.0; components * products],
            log_likelihood: 0.0,
        }
    }

    fn add(&mut self, other: &Self) {
        let add = |sums: &mut [f64], others: &[f64]| sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        add(&mut self.weights, &other.weights);
        add(&mut self.sums, &other.sums);
        add(&mut self.products, &other.products);
        self.log_likelihood += other.log_likelihood;
    }

    /// Adds the first `rows` rows of a group.
    fn add_group(
        &mut self,
        group: &[[f32; SIMD_WIDTH]],
        rows: usize,
        shares: &mut [[f64; SIMD_WIDTH]],
        log_densities: &[f64; SIMD_WIDTH],
    ) {
        self.log_likelihood += log_densities[..rows].iter().sum::<f64>();
        let values: Vec<[f64; SIMD_WIDTH]> = group.iter().map(|column| column.map(f64::from)).collect();
        let columns = self.columns;
        let products = self.products.chunks_exact_mut(products(self.covariance, columns));
        for (((share, weight), sums), products) in
            shares.iter_mut().zip(&mut self.weights).zip(self.sums.chunks_exact_mut(columns)).zip(products)
        {
            share[rows..].fill(0.0);
            *weight += share.iter().sum::<f64>();
            let mut next = products.iter_mut();
            for (column, (value, sum)) in values.iter().zip(sums).enumerate() {
                let weighted: [f64; SIMD_WIDTH] = std::array::from_fn(|slot| share[slot] * value[slot]);
                *sum += weighted.iter().sum::<f64>();
                let first = if self.covariance == Covariance::Diagonal { column } else { 0 };
                for (other, product) in values[first..=column].iter().zip(&mut next) {
                    *product += dot(&weighted, other);
                }
            }
        }
    }

    /// The mixture of greatest likelihood under these memberships.
    fn mixture(&self, guard: &[f64]) -> GaussianMixture {
        let columns = self.columns;
        let least = columns as f64;
        let kept: Vec<usize> = (0..self.weights.len()).filter(|&part| self.weights[part] >= least).collect();
        // With fewer rows than columns, only the heaviest component is kept.
        let heaviest =
            (0..self.weights.len()).max_by(|&a, &b| self.weights[a].total_cmp(&self.weights[b]).then(b.cmp(&a)));
        let kept = if kept.is_empty() { heaviest.into_iter().collect() } else { kept };
        let total: f64 = kept.iter().map(|&part| self.weights[part]).sum();
        let size = products(self.covariance, columns);
        let components = kept.into_iter().map(|part| {
            let weight = self.weights[part];
            let mean: Vec<f64> = self.sums[part * columns..][..columns].iter().map(|sum| sum / weight).collect();
            let products = &self.products[part * size..][..size];
            let whitening = match self.covariance {
                Covariance::Diagonal => diagonal_whitening(products, weight, &mean, guard),
                Covariance::Full => full_whitening(products, weight, &mean, guard),
            };
            NormalComponent::new(weight / total, mean, whitening)
        });
        GaussianMixture { components: components.collect() }
    }
}

/// Number of products of the columns that a component needs.
const fn products(covariance: Covariance, columns: usize) -> usize {
    match covariance {
        Covariance::Diagonal => columns,
        Covariance::Full => triangle(columns),
    }
}

/// Inverse deviations from sums of squares.
fn diagonal_whitening(squares: &[f64], weight: f64, mean: &[f64], guard: &[f64]) -> Whitening {
    let factor = |((square, mean), guard): ((&f64, &f64), &f64)| {
        let variance = (square / weight - mean * mean).max(0.0);
        (variance + guard).sqrt().recip()
    };
    Whitening::Diagonal(squares.iter().zip(mean).zip(guard).map(factor).collect())
}

/// Inverse Cholesky factor from sums of products; of the diagonal alone where rounding leaves no such factor.
fn full_whitening(products: &[f64], weight: f64, mean: &[f64], guard: &[f64]) -> Whitening {
    let columns = mean.len();
    let covariance = DMatrix::from_fn(columns, columns, |row, column| {
        let (high, low) = (row.max(column), row.min(column));
        let added = if row == column { guard[row] } else { 0.0 };
        products[triangle(high) + low] / weight - mean[row] * mean[column] + added
    });
    let inverse = Cholesky::new(covariance)
        .and_then(|factor| factor.l().solve_lower_triangular(&DMatrix::identity(columns, columns)));
    if let Some(inverse) = inverse {
        let places = (0..columns).flat_map(|row| (0..=row).map(move |column| (row, column)));
        Whitening::Full(places.map(|place| inverse[place]).collect())
    } else {
        let squares: Vec<f64> = (0..columns).map(|row| products[triangle(row + 1) - 1]).collect();
        diagonal_whitening(&squares, weight, mean, guard)
    }
}

/// Sum of the products of two groups of values, in four running sums.
#[inline]
fn dot(one: &[f64; SIMD_WIDTH], other: &[f64; SIMD_WIDTH]) -> f64 {
    let mut sums = [0.0; 4];
    for (one, other) in one.chunks_exact(4).zip(other.chunks_exact(4)) {
        for ((sum, one), other) in sums.iter_mut().zip(one).zip(other) {
            *sum += one * other;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
