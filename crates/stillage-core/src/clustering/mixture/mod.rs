//! Gaussian mixture: clusters with sizes and shapes of their own, and memberships instead of a single cluster.
//!
//! The density of a row is a sum of weighted normal densities; its membership in a component is the component's share
//! of that sum. Covariances are diagonal (columns independent within a component) or full. Fitted by
//! expectation-maximization (`em`; A. Dempster, N. Laird and D. Rubin 1977). Memberships are computed from logarithms
//! of densities, so that they sum to 1 far from every component too.
//!
//! Cost: O(k x columns) per row with diagonal covariances, O(k x columns^2) with full ones. Limits: 255 components.

mod component;
mod em;
mod gaussian_mixture;

pub(super) use em::{Fitted, REGULARIZATION, fit};
pub use gaussian_mixture::GaussianMixture;
pub(super) use gaussian_mixture::{Scratch, normalize};

#[cfg(test)]
mod tests;
