//! Scaling of the columns, so that they are comparable. It is an option, since it changes clusters more than any other.
//!
//! A scaling is fitted once, to the rows that the clusters are fitted to, and is then a part of the model. Scaled
//! values are not stored. Statistics are sums in double precision over fixed blocks of rows, combined in order: the
//! same for any number of threads. Cost: O(values), twice for the fit.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::spec::Scaling;

/// Rows whose sums one task takes.
const ROWS_PER_BLOCK: usize = 4_096;

/// Standard deviation over the mean below which a column counts as constant: the rounding of single precision.
const CONSTANT: f64 = 1e-6;

/// A scaling of each column of a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowScaling {
    columns: Vec<ColumnScaling>,
}

/// `value -> (value - shift) * factor`, after the logarithm if there is one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct ColumnScaling {
    logarithm: bool,
    shift: f64,
    factor: f64,
}

impl RowScaling {
    /// Finds the scaling of `rows`, `columns` numbers each. Constant columns become zero where they are divided by
    /// their spread; `DivideByMean` divides by the mean of absolute values, which is the mean for lengths and counts,
    /// and does not vanish for columns of either sign.
    ///
    /// # Panics
    /// When the values are not whole rows, or there are no columns.
    #[must_use]
    pub fn fit(rows: &[f32], columns: usize, scaling: Scaling) -> Self {
        assert!(columns > 0 && rows.len().is_multiple_of(columns), "rows have {columns} values each");
        let logarithm = scaling == Scaling::LogZScore;
        let mut fitted = Self { columns: vec![ColumnScaling { logarithm, shift: 0.0, factor: 1.0 }; columns] };
        if scaling == Scaling::None || rows.is_empty() {
            return fitted;
        }
        let count = (rows.len() / columns) as f64;
        let means = fitted.sums(rows, |_, value| value).into_iter().map(|sum| sum / count).collect::<Vec<f64>>();
        if scaling == Scaling::DivideByMean {
            let sizes = fitted.sums(rows, |_, value| value.abs());
            for (column, size) in fitted.columns.iter_mut().zip(sizes) {
                column.factor = if size > 0.0 { count / size } else { 0.0 };
            }
            return fitted;
        }
        let squares = fitted.sums(rows, |column, value| (value - means[column]).powi(2));
        for ((column, mean), square) in fitted.columns.iter_mut().zip(means).zip(squares) {
            let deviation = (square / count).sqrt();
            let constant = deviation <= CONSTANT * mean.abs();
            column.shift = mean;
            column.factor = if constant { 0.0 } else { deviation.recip() };
        }
        fitted
    }

    /// Values per row.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns.len()
    }

    /// The scaled values of a row.
    pub fn row<'a>(&'a self, row: &'a [f32]) -> impl Iterator<Item = f32> + 'a {
        row.iter().zip(&self.columns).map(|(&value, column)| column.apply(value) as f32)
    }

    /// Sum of a function of the values of each column, scaled by what is fitted so far.
    fn sums(&self, rows: &[f32], function: impl Fn(usize, f64) -> f64 + Sync) -> Vec<f64> {
        let columns = self.columns.len();
        let blocks: Vec<Vec<f64>> = rows
            .par_chunks(ROWS_PER_BLOCK * columns)
            .map(|block| {
                let mut sums = vec![0.0; columns];
                for row in block.chunks_exact(columns) {
                    for (column, (sum, &value)) in sums.iter_mut().zip(row).enumerate() {
                        *sum += function(column, self.columns[column].apply(value));
                    }
                }
                sums
            })
            .collect();
        let mut total = vec![0.0; columns];
        for block in blocks {
            total.iter_mut().zip(block).for_each(|(total, sum)| *total += sum);
        }
        total
    }
}

impl ColumnScaling {
    fn apply(&self, value: f32) -> f64 {
        let value = f64::from(value);
        let value = if self.logarithm { value.signum() * value.abs().ln_1p() } else { value };
        (value - self.shift) * self.factor
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    /// Three columns: a spread one, one of either sign, a constant one.
    const ROWS: [f32; 12] = [1.0, -2.0, 5.0, 2.0, 2.0, 5.0, 3.0, -2.0, 5.0, 10.0, 2.0, 5.0];

    fn check(scaling: Scaling, expected: &Expect) {
        let fitted = RowScaling::fit(&ROWS, 3, scaling);
        let line = |row| fitted.row(row).map(|value| format!("{value:.2}")).collect::<Vec<_>>().join(", ");
        expected.assert_eq(&ROWS.chunks_exact(3).map(line).collect::<Vec<_>>().join("\n"));
    }

    #[test]
    fn plain_rows_stay() {
        check(
            Scaling::None,
            &expect![[r#"
            1.00, -2.00, 5.00
            2.00, 2.00, 5.00
            3.00, -2.00, 5.00
            10.00, 2.00, 5.00"#]],
        );
    }

    #[test]
    fn a_mean_becomes_one() {
        check(
            Scaling::DivideByMean,
            &expect![[r#"
            0.25, -1.00, 1.00
            0.50, 1.00, 1.00
            0.75, -1.00, 1.00
            2.50, 1.00, 1.00"#]],
        );
    }

    #[test]
    fn a_constant_column_has_no_score() {
        check(
            Scaling::ZScore,
            &expect![[r#"
            -0.85, -1.00, 0.00
            -0.57, 1.00, 0.00
            -0.28, -1.00, 0.00
            1.70, 1.00, 0.00"#]],
        );
    }

    #[test]
    fn the_logarithm_keeps_the_sign() {
        check(
            Scaling::LogZScore,
            &expect![[r#"
            -1.11, -1.00, 0.00
            -0.47, 1.00, 0.00
            -0.01, -1.00, 0.00
            1.59, 1.00, 0.00"#]],
        );
    }

    #[test]
    fn no_rows_are_no_trouble() {
        assert_eq!(RowScaling::fit(&[], 3, Scaling::ZScore).columns(), 3);
    }
}
