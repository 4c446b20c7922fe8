//! What every message of VDA 5050 says of itself.

/// Version of the protocol.
pub(super) const VERSION: &str = "3.0.0";

/// The vehicle that a message goes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recipient {
    /// Its manufacturer.
    pub manufacturer: String,
    /// Its serial number.
    pub serial_number: String,
}

impl Default for Recipient {
    /// Any vehicle: whoever sends the message puts in which.
    fn default() -> Self {
        let any = || "any".to_owned();
        Self { manufacturer: any(), serial_number: any() }
    }
}
