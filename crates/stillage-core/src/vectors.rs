//! Code compiled several times, for several SIMD widths; the width is chosen when the program runs.
//!
//! One x86-64 binary runs on every machine and uses AVX2 or AVX-512 where they are available; elsewhere (aarch64 and
//! others) the portable path is compiled for the vectors that every such machine has. A [`Kernel`] is ordinary safe
//! code over short arrays whose length is a parameter. The numbers of an array are never combined with one another, and
//! there is no fused multiply-add, so every width gives the same bytes.

#![allow(unsafe_code, reason = "calls of functions compiled for features that were just detected: the one place")]

/// The vectors that kernels are compiled for, by width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vectors {
    /// The vectors that every machine of the target has: SSE2 on x86-64, NEON on aarch64.
    Portable,
    /// 256 bits.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// 512 bits.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// A computation that is compiled for every width.
pub trait Kernel {
    /// Its result.
    type Output;

    /// Computes with `SIMD_WIDTH` single precision numbers at a time. It, and every function it calls in inner loops,
    /// must be
    /// `#[inline(always)]`: a function that is not inlined is compiled for the portable path only.
    fn run<const SIMD_WIDTH: usize>(self) -> Self::Output;
}

impl Vectors {
    /// All that this machine supports, the narrowest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        {
            let mut available = vec![Self::Portable];
            if is_x86_feature_detected!("avx2") {
                available.push(Self::Avx2);
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                {
                    available.push(Self::Avx512);
                }
            }
            available
        }
        #[cfg(not(target_arch = "x86_64"))]
        vec![Self::Portable]
    }

    /// The widest that this machine supports.
    #[must_use]
    pub fn widest() -> Self {
        Self::available().pop().unwrap_or(Self::Portable)
    }

    /// Runs a kernel compiled for these vectors.
    ///
    /// # Panics
    /// When this machine does not support them.
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        assert!(self == Self::Portable || Self::available().contains(&self), "{self:?} is not of this machine");
        match self {
            Self::Portable => kernel.run::<4>(),
            // SAFETY: the assertion has detected the features that the function is compiled for.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { with_avx2(kernel) },
            // SAFETY: likewise.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { with_avx512(kernel) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<8>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn with_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<16>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_path_gives_the_same_answer() {
        struct Sum<'a>(&'a [f32]);
        impl Kernel for Sum<'_> {
            type Output = u32;

            #[inline(always)]
            fn run<const SIMD_WIDTH: usize>(self) -> u32 {
                self.0.iter().map(|value| value.sqrt()).sum::<f32>().to_bits()
            }
        }
        let values: Vec<f32> = (0..1_000_u16).map(f32::from).collect();
        let answers: Vec<u32> = Vectors::available().into_iter().map(|vectors| vectors.run(Sum(&values))).collect();
        assert!(answers.windows(2).all(|pair| pair[0] == pair[1]), "{answers:?}");
    }
}
