//! Random bytes of the system.

use std::fmt::Write as _;

use rustix::rand::{GetRandomFlags, getrandom};

/// Random bytes as hexadecimal digits.
pub(super) fn random_digits(bytes: usize) -> std::io::Result<String> {
    let mut random = vec![0_u8; bytes];
    let mut filled = 0;
    while filled < bytes {
        filled += getrandom(&mut random[filled..], GetRandomFlags::empty())?;
    }
    Ok(random.iter().fold(String::new(), |mut digits, byte| {
        let _ = write!(digits, "{byte:02x}");
        digits
    }))
}
