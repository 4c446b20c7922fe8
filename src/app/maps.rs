//! Maps: upload, list, rename, georeference.

use uuid::Uuid;

use super::{App, AppError, Caller, JobRecord, MapPatch, MapRecord, NewMap};
use crate::blocking::off_the_runtime;
use crate::coordinates::{OutOfRange, Survey};
use crate::ingest::{self, DecodedMap, MapSource};
use crate::jobs::processes::AnalysisProcess;
use crate::store::{Blob, IdempotencyKey, NewMapRow, Upload, now};
use stillage_core::AnalysisOptions;
use stillage_core::memory::analysis_bytes;

/// Longest name of a map, characters: fits one line of a list.
const MAX_NAME: usize = 200;

/// Longest idempotency key, characters (Stripe's limit, which clients know).
const MAX_KEY: usize = 255;

/// Most records that one page holds.
pub(super) const MAX_PAGE: u32 = 10_000;

impl App {
    /// Decodes and stores a map and its first job, in one transaction. `true` when the job is new (202), `false` when
    /// the idempotency key had been seen with the same content. The same key with other content is
    /// [`AppError::Invalid`].
    pub async fn create_map(&self, caller: &Caller, map: NewMap) -> Result<(JobRecord, bool), AppError> {
        check_name(&map.name)?;
        check_georeference(map.georeference.as_ref())?;
        map.options.clone().check()?;
        let key = idempotency_key(&map)?;
        if let Some(key) = &key
            && let Some(seen) = self.store.seen_upload(caller.tenant(), key, now()).await?
        {
            return self.answer(seen);
        }
        // It is checked again when the job is stored; until then a full queue or quota costs nothing but the reading of the upload.
        let capacity = self.capacity();
        if let Some(full) = self.store.full(caller.tenant(), &capacity).await? {
            return Err(self.refusal(full));
        }
        self.store.check_space()?;
        let (name, options, georeference) = (map.name.trim().to_owned(), map.options, map.georeference);
        let (mut decoded, blob) = self.decode_upload(map.source, &options).await?;
        let (width, height) = (decoded.grid.width(), decoded.grid.height());
        self.check_memory(width as u64, height as u64, &options)?;
        let id = Uuid::now_v7();
        let (mut site, mut alignment) = (id, None);
        if let Some(previous) = map.previous {
            let (read, of_previous, found) =
                self.aligned_upload(caller, decoded, previous, options.grid.clone()).await?;
            (decoded, site, alignment) = (read, of_previous, Some(found));
        }
        let row = NewMapRow {
            id,
            name,
            width: width as u32,
            height: height as u32,
            resolution: decoded.grid.resolution(),
            georeference,
            site,
            alignment,
            warnings: decoded.warnings,
        };
        let job = AnalysisProcess::job(row.id, blob.id(), &options, true);
        let upload = self.store.create_map(caller.tenant(), &row, &blob, &job, key.as_ref(), &capacity, now()).await?;
        if let Upload::New(_) = upload {
            self.signals.queued();
        }
        self.answer(upload)
    }

    /// Maps, newest first.
    pub async fn maps(&self, caller: &Caller, limit: u32, after: Option<Uuid>) -> Result<Vec<MapRecord>, AppError> {
        Ok(self.store.maps(caller.tenant(), limit.min(MAX_PAGE), after).await?)
    }

    /// A map.
    pub async fn map(&self, caller: &Caller, id: Uuid) -> Result<MapRecord, AppError> {
        self.store.map(caller.tenant(), id).await?.ok_or_else(|| AppError::not_found("map", id))
    }

    /// Renames or georeferences. `if_match` is optional here.
    pub async fn update_map(
        &self,
        caller: &Caller,
        id: Uuid,
        mut patch: MapPatch,
        if_match: Option<u64>,
    ) -> Result<MapRecord, AppError> {
        if let Some(name) = &mut patch.name {
            check_name(name)?;
            *name = name.trim().to_owned();
        }
        check_georeference(patch.georeference.as_ref().and_then(Option::as_ref))?;
        match self.store.update_map(caller.tenant(), id, &patch, if_match, now()).await? {
            None => Err(AppError::not_found("map", id)),
            Some(Err(current)) => Err(AppError::PreconditionFailed { current: current.version }),
            Some(Ok(record)) => Ok(record),
        }
    }

    /// Refuses a job that would need more memory than one may: better than to be killed half way.
    pub(super) fn check_memory(&self, width: u64, height: u64, options: &AnalysisOptions) -> Result<(), AppError> {
        let (needed, allowed) = (analysis_bytes(width.saturating_mul(height), options), self.config.max_job_bytes);
        if needed <= allowed {
            return Ok(());
        }
        Err(AppError::TooLarge(format!(
            "the analysis of {width} x {height} cells needs about {} MiB of memory, and {} MiB are allowed for a job: \
             upload a coarser map, ask for fewer beams, or raise --max-job-mib",
            needed >> 20,
            allowed >> 20
        )))
    }

    fn answer(&self, upload: Upload) -> Result<(JobRecord, bool), AppError> {
        match upload {
            Upload::New(job) => Ok((job, true)),
            Upload::Seen(job) => Ok((job, false)),
            Upload::Full(full) => Err(self.refusal(full)),
            Upload::KeyReused => Err(AppError::Invalid {
                detail: "this Idempotency-Key was used with another upload in the last 24 hours: use a new key".into(),
                fields: Vec::new(),
            }),
        }
    }

    /// Reads an upload, so that a bad map is refused at once, and packs it for the store.
    async fn decode_upload(
        &self,
        source: MapSource,
        options: &AnalysisOptions,
    ) -> Result<(DecodedMap, Blob), AppError> {
        let _permit = self.decoders.acquire().await.map_err(|_| AppError::Unavailable)?;
        let (grid, limits) = (options.grid.clone(), self.config.limits);
        let decode = move || Ok((ingest::decode(&source, &grid, &limits)?, Blob::encode(&source)));
        off_the_runtime(decode).await
    }
}

/// The key with a hash of all that it must stand for.
fn idempotency_key(map: &NewMap) -> Result<Option<IdempotencyKey>, AppError> {
    let Some(key) = &map.idempotency_key else { return Ok(None) };
    if key.is_empty() || key.chars().count() > MAX_KEY {
        let detail = format!("an Idempotency-Key has 1 to {MAX_KEY} characters");
        return Err(AppError::Invalid { detail, fields: Vec::new() });
    }
    let parts: [&[u8]; 2] = match &map.source {
        MapSource::Image { image, metadata } => [image, metadata],
        MapSource::Message(message) => [message, b""],
    };
    let options = serde_json::to_vec(&(&map.name, &map.options, &map.georeference));
    let options = options.map_err(|error| AppError::Internal(Box::new(error)))?;
    let mut hasher = blake3::Hasher::new();
    for part in [parts[0], parts[1], &options] {
        hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
    }
    // Only where there is one: keys of earlier releases stand for uploads without.
    if let Some(previous) = map.previous {
        hasher.update(previous.as_bytes());
    }
    Ok(Some(IdempotencyKey { key: key.clone(), content: hasher.finalize().to_hex().to_string() }))
}

fn check_name(name: &str) -> Result<(), AppError> {
    if name.trim().is_empty() || name.chars().count() > MAX_NAME || name.chars().any(char::is_control) {
        return Err(AppError::invalid("/name", format!("a name has 1 to {MAX_NAME} characters, none of them control")));
    }
    Ok(())
}

fn check_georeference(georeference: Option<&Survey>) -> Result<(), AppError> {
    let wrong = |OutOfRange { member, detail }| AppError::invalid(&format!("/georeference/{member}"), detail);
    georeference.map_or(Ok(()), |survey| survey.georeference.check().map_err(wrong))
}
