//! The durable queue and its worker. (to be written)
