//! Bounding boxes as clients write them.

use std::fmt;

use serde::Deserialize;

/// A box as a parameter: west, south, east, north.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Bbox(pub [f64; 4]);

impl TryFrom<String> for Bbox {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
        match numbers.as_deref() {
            Some(&[west, south, east, north]) => Ok(Self([west, south, east, north])),
            // Heights do not select: a map lies on the floor.
            Some(&[west, south, low, east, north, high]) if low <= high => Ok(Self([west, south, east, north])),
            _ => Err("must be four or six numbers: west,south[,low],east,north[,high]"),
        }
    }
}

impl fmt::Display for Bbox {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [west, south, east, north] = self.0;
        write!(formatter, "{west},{south},{east},{north}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_have_four_or_six_numbers() {
        let read = |text: &str| Bbox::try_from(text.to_owned()).ok().map(|bbox| bbox.0);
        assert_eq!(read("1,2,3,4"), Some([1.0, 2.0, 3.0, 4.0]));
        assert_eq!(read("1,2,-9,3,4,9"), Some([1.0, 2.0, 3.0, 4.0]));
        for wrong in ["", "1,2,3", "1,2,3,4,5", "1,2,x,4", "1,2,NaN,4", "1,2,inf,4", "1,2,9,3,4,-9"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
