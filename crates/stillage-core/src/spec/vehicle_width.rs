//! The width of the vehicles that drive in the aisles.

use serde::de::{self, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The width of the narrowest vehicle that drives in the aisles: in JSON a number of metres or `"auto"`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VehicleWidth {
    /// The one for which the site has aisles between its rows.
    Auto,
    /// This one, metres.
    Fixed(f64),
}

/// The word for [`VehicleWidth::Auto`].
const AUTO: &str = "auto";
/// What binary formats, which cannot tell a number from a word, have for it: no vehicle is so narrow.
const NO_WIDTH: f64 = 0.0;

impl Serialize for VehicleWidth {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match (*self, serializer.is_human_readable()) {
            (Self::Auto, true) => serializer.serialize_str(AUTO),
            (Self::Auto, false) => serializer.serialize_f64(NO_WIDTH),
            (Self::Fixed(width), _) => serializer.serialize_f64(width),
        }
    }
}

impl<'de> Deserialize<'de> for VehicleWidth {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return deserializer.deserialize_any(WidthOrAuto);
        }
        let width = f64::deserialize(deserializer)?;
        Ok(if width > NO_WIDTH { Self::Fixed(width) } else { Self::Auto })
    }
}

/// Reads a [`VehicleWidth`].
struct WidthOrAuto;

impl Visitor<'_> for WidthOrAuto {
    type Value = VehicleWidth;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "a number of metres or \"{AUTO}\"")
    }

    fn visit_f64<E: de::Error>(self, width: f64) -> Result<Self::Value, E> {
        Ok(VehicleWidth::Fixed(width))
    }

    fn visit_u64<E: de::Error>(self, width: u64) -> Result<Self::Value, E> {
        self.visit_f64(width as f64)
    }

    fn visit_i64<E: de::Error>(self, width: i64) -> Result<Self::Value, E> {
        self.visit_f64(width as f64)
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        if word == AUTO { Ok(VehicleWidth::Auto) } else { Err(E::invalid_value(Unexpected::Str(word), &self)) }
    }
}
