//! All cells x all beams, streamed. (to be written)
