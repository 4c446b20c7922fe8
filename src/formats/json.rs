//! JSON, written straight into bytes.

use std::fmt::Debug;

use serde::Serialize;

/// Something that is written as JSON.
pub trait Json: Debug {
    /// Appends it to `out`.
    fn write(&self, out: &mut Vec<u8>);
}

impl<T: Serialize + Debug> Json for T {
    fn write(&self, out: &mut Vec<u8>) {
        serde_json::to_writer(out, self).expect("keys are text and a buffer in memory takes every byte");
    }
}

/// Appends `"name":` and a value.
pub fn member(name: &str, value: &dyn Json, out: &mut Vec<u8>) {
    name.write(out);
    out.push(b':');
    value.write(out);
}

/// Appends a list, its items separated by commas.
pub fn list<T>(items: impl IntoIterator<Item = T>, out: &mut Vec<u8>, write: impl Fn(T, &mut Vec<u8>)) {
    out.push(b'[');
    for (index, item) in items.into_iter().enumerate() {
        if index > 0 {
            out.push(b',');
        }
        write(item, out);
    }
    out.push(b']');
}

/// Appends a number rounded to some decimals, without trailing zeros and without -0.
pub fn decimal(value: f64, decimals: u32, out: &mut Vec<u8>) {
    let unit = 10_u64.pow(decimals);
    // Degrees with nine decimals and metres of the world with four stay far below 2^53.
    let scaled = (value * unit as f64).round() as i64;
    if scaled < 0 {
        out.push(b'-');
    }
    let (whole, mut fraction) = (scaled.unsigned_abs() / unit, scaled.unsigned_abs() % unit);
    integer(whole, 1, out);
    if fraction > 0 {
        let mut digits = decimals as usize;
        while fraction.is_multiple_of(10) {
            fraction /= 10;
            digits -= 1;
        }
        out.push(b'.');
        integer(fraction, digits, out);
    }
}

/// Appends a whole number with at least so many digits.
fn integer(mut number: u64, at_least: usize, out: &mut Vec<u8>) {
    let mut digits = [b'0'; 20];
    let mut start = digits.len();
    while number > 0 || digits.len() - start < at_least {
        start -= 1;
        digits[start] = b'0' + (number % 10) as u8;
        number /= 10;
    }
    out.extend_from_slice(&digits[start..]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn written(value: f64, decimals: u32) -> String {
        let mut out = Vec::new();
        decimal(value, decimals, &mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, 4, "0"),
            (-0.0, 4, "0"),
            (-0.000_01, 4, "0"),
            (1.5, 4, "1.5"),
            (-12.05, 4, "-12.05"),
            (0.000_000_001_4, 9, "0.000000001"),
            (179.999_999_999_9, 9, "180"),
            (-20_037_508.342_8, 4, "-20037508.3428"),
        ];
        for (value, decimals, text) in cases {
            assert_eq!(written(value, decimals), text);
        }
    }

    proptest! {
        #[test]
        fn numbers_are_right(value in -180.0..180.0) {
            let read: f64 = written(value, 9).parse().unwrap();
            prop_assert!((read - value).abs() <= 0.500_001e-9);
        }
    }
}
