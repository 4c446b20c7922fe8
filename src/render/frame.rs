//! How a map lies on a picture.

use stillage_core::OccupancyGrid;
use stillage_core::geometry::Point;

use super::drawing::{Pixel, Scale};

/// A small map is enlarged by a whole factor until its longer side has at least so many pixels: a wide screen, on which
/// the codes of pallet places of a site of 80 m can be read.
const ENLARGED_SIDE: usize = 1_600;
/// Pixels on each side of a cell that no enlargement exceeds: a map of a few cells stays a small picture.
const LARGEST_CELL: usize = 40;
/// Pixels of a map beyond which several cells share one. A pixel takes seven bytes while it is drawn and encoded, so that
/// a picture takes at most 175 MB; a site of the paper's size (20.5 million cells) still has one pixel for each cell.
const MOST_PIXELS: usize = 25_000_000;

/// Ems of the legend to the longer side of the map.
const SIDE_PER_EM: f64 = 100.0;
/// Smallest and largest em of the legend, pixels.
const EMS: [f64; 2] = [16.0, 44.0];

/// From the grid frame to the picture.
pub(super) struct Frame {
    pub(super) scale: Scale,
    /// Of the map, pixels.
    pub(super) size: [usize; 2],
    /// Pixels to a metre.
    pub(super) per_metre: f64,
    /// Size of the letters of the legend, pixels.
    pub(super) em: f64,
    /// Of the map, pixels and parts of one.
    height: f64,
}

impl Frame {
    pub(super) fn of(grid: &OccupancyGrid) -> Self {
        let scale = scale(grid.width(), grid.height());
        let size = [grid.width(), grid.height()].map(|cells| scale.pixels(cells));
        Self {
            scale,
            size,
            per_metre: scale.factor() / grid.resolution(),
            em: (size[0].max(size[1]) as f64 / SIDE_PER_EM).clamp(EMS[0], EMS[1]),
            height: grid.height() as f64 * scale.factor(),
        }
    }

    pub(super) fn pixel(&self, point: Point) -> Pixel {
        [point.x * self.per_metre, self.height - point.y * self.per_metre]
    }
}

/// Chooses the size of a cell.
fn scale(width: usize, height: usize) -> Scale {
    if width.saturating_mul(height) <= MOST_PIXELS {
        return Scale::Enlarged(ENLARGED_SIDE.div_ceil(width.max(height).max(1)).min(LARGEST_CELL));
    }
    let fits = |&divisor: &usize| width.div_ceil(divisor).saturating_mul(height.div_ceil(divisor)) <= MOST_PIXELS;
    Scale::Reduced((2..=usize::MAX).find(fits).unwrap_or(usize::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_maps_are_enlarged_and_huge_ones_reduced() {
        assert_eq!(scale(16, 6), Scale::Enlarged(40));
        assert_eq!(scale(300, 800), Scale::Enlarged(2));
        assert_eq!(scale(3800, 5400), Scale::Enlarged(1));
        assert_eq!(scale(10_000, 10_000), Scale::Reduced(2));
        assert_eq!(scale(0, 0), Scale::Enlarged(40));
    }
}
