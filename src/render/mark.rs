//! Marks: small filled shapes around a point.

use super::drawing::{Colour, Pixel, Shape};

/// A small filled shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    Square,
    Diamond,
    /// Two crossing bars.
    Cross,
}

impl Mark {
    /// The mark around a point; `size` is its width in pixels.
    pub(super) fn shape<'a>(self, [x, y]: Pixel, size: f64, colour: Colour, title: String) -> Shape<'a> {
        let corners = self.corners().into_iter().map(|[right, down]| [x + right * size, y + down * size]);
        Shape::Area { rings: vec![corners.collect()], colour, title }
    }

    /// Its corners, as shares of its size from its middle, y down.
    fn corners(self) -> Vec<Pixel> {
        match self {
            Self::Square => vec![[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]],
            Self::Diamond => vec![[0.0, -0.5], [0.5, 0.0], [0.0, 0.5], [-0.5, 0.0]],
            Self::Cross => {
                let quarter = [[0.0, -0.15], [0.35, -0.5], [0.5, -0.35]];
                let turned = |corner: Pixel, times: usize| (0..times).fold(corner, |[x, y], _| [-y, x]);
                (0..4).flat_map(|times| quarter.map(|corner| turned(corner, times))).collect()
            }
        }
    }
}
