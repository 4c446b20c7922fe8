//! k-means, scaling. (to be written)
