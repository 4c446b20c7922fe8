//! Random numbers that depend on the seed, the kind and the purpose alone: another scanner leaves the racks where they
//! were. `ChaCha`, the same on every machine.

use std::f64::consts::TAU;
use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::drawing::DrawingStyle;
use crate::kind::Kind;

/// What numbers are drawn for; each purpose has its own stream.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Purpose {
    /// Walls, racks, pallets, truth.
    Site,
    /// Qualities of the scanner and its drive.
    Drive,
    /// The beams cast from one pose.
    Beams(usize),
    /// Cells that a defect of the map turned over.
    Speckle,
}

/// A stream of random numbers.
#[derive(Debug)]
pub(crate) struct Random(ChaCha8Rng);

impl Random {
    pub(crate) fn new(kind: Kind, seed: u64, purpose: Purpose) -> Self {
        let (number, index) = match purpose {
            Purpose::Site => (0, 0),
            Purpose::Drive => (1, 0),
            Purpose::Beams(pose) => (2, pose as u64),
            Purpose::Speckle => (3, 0),
        };
        Self::keyed([seed, kind as u64, number, index])
    }

    /// The numbers of a drawing; no kind of site shares them.
    pub(crate) fn of_drawing(style: DrawingStyle, seed: u64) -> Self {
        Self::keyed([seed, style as u64, 4, 0])
    }

    fn keyed(words: [u64; 4]) -> Self {
        let mut key = [0; 32];
        for (bytes, word) in key.chunks_exact_mut(8).zip(words) {
            bytes.copy_from_slice(&word.to_le_bytes());
        }
        Self(ChaCha8Rng::from_seed(key))
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        // The 53 bits that a double holds.
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in a range.
    pub(crate) fn within(&mut self, range: Range<f64>) -> f64 {
        range.start + self.unit() * (range.end - range.start)
    }

    /// Uniform among the whole numbers of a range that is not empty.
    pub(crate) fn count(&mut self, range: Range<usize>) -> usize {
        let numbers = range.end.saturating_sub(range.start).max(1);
        range.start + (self.unit() * numbers as f64) as usize
    }

    /// True with a probability.
    pub(crate) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// One of several, all alike.
    pub(crate) fn pick<T: Copy, const N: usize>(&mut self, items: [T; N]) -> T {
        items[self.count(0..N)]
    }

    /// Normal with mean 0 (Box and Muller 1958, doi 10.1214/aoms/1177706645).
    pub(crate) fn normal(&mut self, deviation: f64) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        deviation * radius * (TAU * self.unit()).cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_purpose_has_its_own_numbers() {
        let draw = |purpose| Random::new(Kind::Selective, 1, purpose).unit();
        assert_eq!(draw(Purpose::Site), draw(Purpose::Site));
        assert_ne!(draw(Purpose::Site), draw(Purpose::Drive));
        assert_ne!(draw(Purpose::Beams(0)), draw(Purpose::Beams(1)));
    }

    #[test]
    fn numbers_have_the_moments_that_their_names_promise() {
        let mut random = Random::new(Kind::Selective, 1, Purpose::Site);
        let normals: Vec<f64> = (0..10_000).map(|_| random.normal(2.0)).collect();
        let mean = normals.iter().sum::<f64>() / 10_000.0;
        let deviation = (normals.iter().map(|value| value * value).sum::<f64>() / 10_000.0).sqrt();
        assert!(mean.abs() < 0.1 && (deviation - 2.0).abs() < 0.1, "{mean} {deviation}");
        assert!((0..1000).all(|_| (3..6).contains(&random.count(3..6))));
    }
}
