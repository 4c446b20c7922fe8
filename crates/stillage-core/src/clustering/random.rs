//! Random numbers from a seed alone (`ChaCha`, the same on every machine), with a stream for each use.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A generator of its own for each use of a seed.
pub(super) fn stream(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream);
    random
}

/// A number in `[0, 1)`.
pub(super) fn uniform(random: &mut ChaCha8Rng) -> f64 {
    const BITS: u32 = f64::MANTISSA_DIGITS;
    (random.next_u64() >> (u64::BITS - BITS)) as f64 / (1_u64 << BITS) as f64
}

/// A whole number below `end`, which is not 0.
pub(super) fn below(end: usize, random: &mut ChaCha8Rng) -> usize {
    ((uniform(random) * end as f64) as usize).min(end - 1)
}

/// The first row at which the running sum of weights exceeds `target`; never one of weight 0.
pub(super) fn draw(weights: &[f32], target: f64) -> usize {
    let mut sum = 0.0;
    let mut drawn = 0;
    for (row, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
        drawn = row;
        sum += f64::from(weight);
        if sum > target {
            break;
        }
    }
    drawn
}

/// The numbers below `count` in random order (R. Fisher and F. Yates).
pub(super) fn shuffled(count: usize, random: &mut ChaCha8Rng) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for end in (2..=count).rev() {
        order.swap(end - 1, below(end, random));
    }
    order
}
