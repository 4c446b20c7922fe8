//! How large a map may be.

use super::error::IngestError;

/// Limits on uploaded maps, applied before anything is decoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of an upload.
    pub max_bytes: usize,
    /// Cells of a map.
    pub max_cells: u64,
    /// Columns or rows of a map.
    pub max_side: u32,
}

impl Default for Limits {
    // 100 million cells and 32,768 a side are what nav2 users proposed for its own loader (navigation2 issue 5612).
    fn default() -> Self {
        Self { max_bytes: 128 << 20, max_cells: 100_000_000, max_side: 32_768 }
    }
}

impl Limits {
    /// Checks the size of a map that is about to be read.
    pub(super) fn check_size(&self, width: u64, height: u64, pointers: [&str; 2]) -> Result<(), IngestError> {
        for (side, name, pointer) in [(width, "wide", pointers[0]), (height, "high", pointers[1])] {
            if side == 0 {
                return Err(IngestError::invalid(
                    pointer,
                    format!("the map is 0 cells {name}: a map needs at least one cell"),
                ));
            }
            if side > u64::from(self.max_side) {
                let most = self.max_side;
                return Err(IngestError::too_large(
                    pointer,
                    format!("the map is {side} cells {name}, the most is {most}: crop it, or use a coarser resolution"),
                ));
            }
        }
        // Neither side exceeds 32 bits here, so the product fits.
        let (cells, most) = (width * height, self.max_cells);
        if cells > most {
            return Err(IngestError::too_large(
                pointers[0],
                format!("the map has {cells} cells, the most is {most}: crop it, or use a coarser resolution"),
            ));
        }
        Ok(())
    }
}
