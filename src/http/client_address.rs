//! Which address a request comes from.

use std::net::{IpAddr, Ipv4Addr};

use axum::extract::Request;

/// The address at the other end of the connection: of the client, or of the proxy in front. The server tells it to every request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ClientAddress(pub IpAddr);

impl ClientAddress {
    /// The address of a request; without a connection, as in tests, that of nobody.
    #[must_use]
    pub fn of(request: &Request) -> Self {
        request.extensions().get().copied().unwrap_or(Self(IpAddr::V4(Ipv4Addr::UNSPECIFIED)))
    }
}
