//! A row of places, or several that are reached from one side, one behind the other.

use std::ops::Range;

use super::evidence::RowEvidence;
use super::size_hints::SizeHints;
use crate::decomposition::bodies::layers::LayerGroup;
use crate::decomposition::ground::{Axis, Patch, Rect, RegionFrame};
use crate::watch::{Stopped, Watch};

/// Rows of one length, one behind the other, whose storage lanes run through all of them; often a single row.
pub(super) struct RackRow {
    /// All layers together.
    pub rect: Rect,
    pub axis: Axis,
    pub layers: LayerGroup,
    /// Share of its length with room for a vehicle on one side, whatever layers of the same group are in between.
    pub open: f64,
}

impl RackRow {
    /// The evidence of each layer.
    pub fn evidence(
        &self,
        frame: &RegionFrame,
        hints: &SizeHints,
        watch: &Watch<'_>,
    ) -> Result<Vec<RowEvidence>, Stopped> {
        let of_layer = |layer: Patch| watch.check().map(|()| RowEvidence::of(&layer, frame.cell, hints.widths()));
        self.patches(frame).map(of_layer).collect()
    }

    /// The cells of each layer.
    pub fn patches(&self, frame: &RegionFrame) -> impl Iterator<Item = Patch> {
        self.layers.iter().map(|layer| frame.patch(&self.rect.with(self.axis.other(), layer.clone()), self.axis))
    }

    /// The same layers as rows of their own, of so many layers each.
    pub fn parted(&self, counts: &[usize]) -> Vec<Self> {
        let mut start = 0;
        let part = |&count: &usize| {
            let layers = self.layers[start..start + count].to_vec();
            start += count;
            Self { rect: self.rect.with(self.axis.other(), span(&layers)), layers, ..*self }
        };
        counts.iter().map(part).collect()
    }
}

/// From the first line of some layers to the last.
pub(super) fn span(layers: &[Range<usize>]) -> Range<usize> {
    let start = layers.iter().map(|layer| layer.start).min().unwrap_or(0);
    let end = layers.iter().map(|layer| layer.end).max().unwrap_or(start);
    start..end
}
