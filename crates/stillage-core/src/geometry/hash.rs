//! Pseudo-random numbers from indices: the same on every run and on any number of threads.

/// The finalizer of `SplitMix64`: a bijection whose output bits each depend on all input bits (G. L. Steele, D. Lea and
/// C. H. Flood, OOPSLA 2014, doi 10.1145/2660193.2660195).
pub(crate) fn split_mix(value: u64) -> u64 {
    let value = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    value ^ (value >> 31)
}

/// A number in `[0, 1)` from the upper half of a hash.
pub(crate) fn unit(hash: u64) -> f64 {
    (hash >> 32) as f64 / 4_294_967_296.0
}
