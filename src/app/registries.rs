//! Sites: an upload aligned to an earlier map, and the registry that keeps the codes of a site's places.
//!
//! The registry is written when a map's locations are first read, and again whenever they differ. Writing it anew from
//! the same map changes nothing, so readers that meet may both try: the slower one reads again.

use stillage_core::alignment::{self, SiteAlignment};
use stillage_core::compare::Footprint;
use stillage_core::geometry::RigidMotion;
use stillage_core::layout::{Layout, Location};
use stillage_core::registry::{Carried, GivenCode, NumberedLocation, Registry, Trust, UnknownCodes};
use stillage_core::{GridFrame, Point, Watch};
use uuid::Uuid;

use super::error::FieldProblem;
use super::{App, AppError, Caller, MapContext, MapRecord};
use crate::blocking::off_the_runtime;
use crate::ingest::{self, DecodedMap, MapSource};
use crate::records::AlignmentRecord;
use crate::store::{SiteRegistry, StoreError};
use stillage_core::spec::GridOptions;

/// How often a registry is written anew when others write it at the same time.
pub(super) const ATTEMPTS: usize = 8;
/// Agreement below which the codes of an aligned map are in doubt: scans that are bent.
const SURE_AGREEMENT: f64 = 0.5;
/// Outlines are kept to a tenth of a millimetre, so that they are read as they were written.
const KEPT_PER_M: f64 = 1e4;

impl App {
    /// The registry of a map's site, as the newest map of the site shows it.
    pub async fn registry(&self, caller: &Caller, map: Uuid) -> Result<(SiteRegistry, RigidMotion), AppError> {
        let context = self.context(caller, map).await?;
        let (site, _) = self.carried_registry(caller, &context).await?;
        Ok((site, context.record.to_site()))
    }

    /// Confirms the stale places with these codes, or all: they are where the newest map of the site shows them. Answers
    /// how many that were.
    pub async fn confirm_codes(
        &self,
        caller: &Caller,
        map: Uuid,
        codes: Option<Vec<String>>,
    ) -> Result<usize, AppError> {
        let context = self.context(caller, map).await?;
        for _ in 0..ATTEMPTS {
            let (site, _) = self.carried_registry(caller, &context).await?;
            if !site.is_newest {
                let detail = "a newer map of this site tells which places there are: confirm its codes";
                return Err(AppError::Conflict(detail.to_owned()));
            }
            let mut registry = site.registry;
            let wished = codes.as_deref().unwrap_or_default();
            let count =
                registry.confirm(codes.as_deref(), &map.to_string()).map_err(|unknown| no_code(unknown, wished))?;
            if count == 0 || self.store.put_registry(caller.tenant(), map, &registry, site.version, true).await? {
                return Ok(count);
            }
        }
        Err(AppError::Unavailable)
    }

    /// The registry of a map's site after the map was read with it, and the codes of the map's locations.
    pub(super) async fn carried_registry(
        &self,
        caller: &Caller,
        context: &MapContext,
    ) -> Result<(SiteRegistry, Vec<GivenCode>), AppError> {
        let map = context.record.id;
        for _ in 0..ATTEMPTS {
            let site = self.store.registry(caller.tenant(), map).await?;
            let site = site.ok_or_else(|| AppError::not_found("map", map))?;
            let trust = trust(&site, context.record.alignment.as_ref());
            let (before, numbered, scan) = (site.registry.clone(), context.numbered.clone(), map.to_string());
            let numbering = context.semantics.layout.numbering();
            // Another template or entrance is a wish for new codes: other maps of the site answer differently then.
            let is_new_numbering = trust != Trust::Earlier && site.registry.numbering != numbering;
            let carry = move || {
                let before = if is_new_numbering { before.renumbered(&numbered, numbering) } else { before };
                before.carry(&numbered, trust, &scan)
            };
            let Carried { registry, codes } = off_the_runtime(carry).await;
            if registry == site.registry {
                return Ok((site, codes));
            }
            let written =
                self.store.put_registry(caller.tenant(), map, &registry, site.version, is_new_numbering).await;
            match written {
                Ok(true) => return Ok((SiteRegistry { registry, version: site.version + 1, ..site }, codes)),
                Ok(false) => {}
                // The same map gives the same codes again: reading goes on without the disk.
                Err(StoreError::NoSpace) => return Ok((SiteRegistry { registry, ..site }, codes)),
                Err(error) => return Err(error.into()),
            }
        }
        Err(AppError::Unavailable)
    }

    /// Aligns an upload to an earlier map; its site, and how it lies there.
    pub(super) async fn aligned_upload(
        &self,
        caller: &Caller,
        decoded: DecodedMap,
        previous: Uuid,
        options: GridOptions,
    ) -> Result<(DecodedMap, Uuid, AlignmentRecord), AppError> {
        let unknown = || AppError::invalid("/previous", format!("there is no map {previous}: GET /v1/maps lists them"));
        let earlier = self.store.map(caller.tenant(), previous).await?.ok_or_else(unknown)?;
        let source = self.store.map_source(caller.tenant(), previous).await?.ok_or_else(unknown)?;
        let source = self.stored_upload(previous, &source).await?;
        let analyses = self.store.analyses(caller.tenant(), previous).await?;
        let options = analyses.into_iter().next().map_or(options, |analysis| analysis.options.grid);
        let (limits, permit) = (self.config.limits, self.decoders.acquire().await);
        let _permit = permit.map_err(|_| AppError::Unavailable)?;
        let (decoded, found) = off_the_runtime(move || {
            let old = ingest::decode(&source.decode::<MapSource>()?, &options, &limits)?.grid;
            let found = alignment::align(&decoded.grid, &old, &Watch::unwatched()).expect("nobody stops it");
            Ok::<_, AppError>((decoded, found))
        })
        .await?;
        let found: SiteAlignment = found.map_err(|refusal| {
            let detail = format!("previous: {refusal}. Upload the map without previous, or name a map of its site");
            AppError::NotSameSite(detail)
        })?;
        let to_site = found.motion.then(&earlier.to_site());
        Ok((decoded, earlier.site, AlignmentRecord { previous, found, to_site }))
    }
}

/// From the frame of the site of a map to its grid frame.
pub(super) fn site_to_grid(record: &MapRecord, frame: GridFrame) -> RigidMotion {
    frame.motion().then(&record.to_site()).inverse()
}

/// A point as it is kept.
pub(super) fn kept(point: Point) -> Point {
    Point::from((point.coords * KEPT_PER_M).map(f64::round) / KEPT_PER_M)
}

/// The locations of a fresh numbering in the frame of the site.
pub(super) fn numbered(layout: &Layout, frame: GridFrame, to_site: &RigidMotion) -> Vec<NumberedLocation> {
    let motion = frame.motion().then(to_site);
    let footprint = |location: &Location| {
        let placed = Footprint { outline: location.outline.clone(), center: location.center }.moved(&motion);
        Footprint { outline: placed.outline.into_iter().map(kept).collect(), center: kept(placed.center) }
    };
    let numbered =
        |location: &Location| NumberedLocation { code: location.code.clone(), footprint: footprint(location) };
    layout.locations.iter().map(numbered).collect()
}

fn trust(site: &SiteRegistry, alignment: Option<&AlignmentRecord>) -> Trust {
    let is_doubtful = alignment.is_some_and(|record| record.found.ambiguous || record.found.agreement < SURE_AGREEMENT);
    match (site.is_newest, is_doubtful) {
        (false, _) => Trust::Earlier,
        (true, true) => Trust::Doubtful,
        (true, false) => Trust::Newest,
    }
}

/// Codes that no place has, by their pointers in the list of a request.
fn no_code(UnknownCodes(unknown): UnknownCodes, wished: &[String]) -> AppError {
    let field = |code: &String| {
        let index = wished.iter().position(|wish| wish == code).unwrap_or_default();
        let detail = format!("no place of the site has the code {code}: GET .../registry lists them");
        FieldProblem { pointer: format!("/codes/{index}"), detail }
    };
    AppError::Invalid { detail: "some codes are unknown".into(), fields: unknown.iter().map(field).collect() }
}

/// The codes that a registry gives the locations of a map, nothing being written.
pub(super) fn codes_of(registry: &Registry, context: &MapContext) -> Vec<GivenCode> {
    registry.carry(&context.numbered, Trust::Earlier, &context.record.id.to_string()).codes
}
