//! How well two categories go together as neighbours (H. Yamamoto 1979).

/// How well categories go together: row l, column l' is the support that l has from a neighbour l', -1 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Compatibilities {
    count: usize,
    /// Row by row.
    values: Vec<f32>,
}

impl Compatibilities {
    /// From the summed weights of neighbours, by the category of the one (row) and of the other (column); symmetric.
    pub(super) fn from_pairs(pairs: &[f64], count: usize) -> Self {
        let total: f64 = pairs.iter().sum();
        let marginals: Vec<f64> = pairs.chunks_exact(count.max(1)).map(|row| row.iter().sum()).collect();
        let compatibility = |own: usize, other: usize| {
            if marginals[own] <= 0.0 || marginals[other] <= 0.0 {
                // Without neighbours the two are taken as independent.
                return 0.0;
            }
            let prior = marginals[own] / total;
            let conditional = pairs[own * count + other] / marginals[other];
            if conditional > prior { (1.0 - prior / conditional) / (1.0 - prior) } else { conditional / prior - 1.0 }
        };
        let values = (0..count * count).map(|at| compatibility(at / count, at % count).clamp(-1.0, 1.0) as f32);
        Self { count, values: values.collect() }
    }

    /// Number of categories.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The compatibilities of one category with all.
    pub(super) fn row(&self, own: usize) -> &[f32] {
        &self.values[own * self.count..(own + 1) * self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compatibilities_are_those_of_yamamoto() {
        // Two categories that are neighbours of themselves three times as often as of each other.
        let found = Compatibilities::from_pairs(&[3.0, 1.0, 1.0, 3.0], 2);
        // p(l) = 1/2, p(l | l) = 3/4, p(l | l') = 1/4.
        assert_eq!(found.values, [2.0 / 3.0, -0.5, -0.5, 2.0 / 3.0]);
        let independent = Compatibilities::from_pairs(&[1.0; 4], 2);
        assert_eq!(independent.values, [0.0; 4]);
        let alone = Compatibilities::from_pairs(&[4.0, 0.0, 0.0, 0.0], 2);
        assert_eq!(alone.values, [0.0; 4]);
    }
}
