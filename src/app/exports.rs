//! The exports of an analysed map.

use std::sync::Arc;

use super::map_context::MapContext;
use crate::exports::{Export, ExportError, ExportOptions, ExportSource, write};

impl MapContext {
    /// Writes an export of the map: keep it off the runtime.
    ///
    /// # Errors
    /// [`ExportError`] when the format has no place for the map, or an option does not fit it.
    pub fn export(&self, export: &Export, options: &ExportOptions) -> Result<Vec<u8>, ExportError> {
        let graph = if export.reads_graph() {
            self.graph(options.footprint_radius.unwrap_or(self.layout_spec.vehicle_radius))
        } else {
            Arc::default()
        };
        let source = ExportSource {
            name: &self.record.name,
            map_id: &self.record.id.to_string(),
            version: &format!("{}.{}", self.record.version, self.semantics.version),
            created: self.record.updated.max(self.semantics.created),
            grid: &self.grid,
            analysis: &self.analysis,
            semantic: &self.semantic,
            cells: &self.cells.faces,
            layout: &self.layout,
            names: &self.names,
            graph: &graph,
            georeference: self.record.georeference,
        };
        write(export, &source, options)
    }
}
