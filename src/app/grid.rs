//! The cells of a map, before any analysis.

use stillage_core::OccupancyGrid;
use stillage_core::spec::GridOptions;
use uuid::Uuid;

use super::{App, AppError, Caller};
use crate::blocking::off_the_runtime;
use crate::ingest::{self, MapSource};
use crate::store::{BlobId, Snapshot};

/// Where the cells of a map are and how they are read. Equal sources are equal cells.
#[derive(Debug, Clone)]
pub struct GridSource {
    /// The map.
    map: Uuid,
    /// The upload, by its content.
    pub blob: BlobId,
    /// The thresholds of the analysis in force; those of the file before there is one.
    pub options: GridOptions,
}

impl App {
    /// Where the cells of a map are. The map need not be analysed.
    pub async fn grid_source(&self, caller: &Caller, map: Uuid) -> Result<GridSource, AppError> {
        let snapshot =
            self.store.snapshot(caller.tenant(), map).await?.ok_or_else(|| AppError::not_found("map", map))?;
        let Snapshot { source, analysis, .. } = snapshot;
        let options = analysis.map(|(analysis, _)| analysis.options.grid).unwrap_or_default();
        Ok(GridSource { map, blob: source, options })
    }

    /// Decodes the cells and makes something of them, beside the runtime's threads.
    pub async fn read_grid<T: Send + 'static>(
        &self,
        source: GridSource,
        read: impl FnOnce(&OccupancyGrid) -> T + Send + 'static,
    ) -> Result<T, AppError> {
        let _permit = self.decoders.acquire().await.map_err(|_| AppError::Unavailable)?;
        let (blob, limits) = (self.stored_upload(source.map, &source.blob).await?, self.config.limits);
        let decode = move || Ok(read(&ingest::decode(&blob.decode::<MapSource>()?, &source.options, &limits)?.grid));
        off_the_runtime(decode).await
    }
}
