//! Principal components. (to be written)
