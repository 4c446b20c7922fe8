//! Windows, peaks, wavelets. (to be written)
