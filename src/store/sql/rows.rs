//! Rows as records, and values as columns.

use serde::Serialize;

use super::columns::SqlRow;
use crate::coordinates::Survey;
use crate::records::{AnalysisRecord, CorrectionList, JobRecord, MapRecord, RuleSetRecord, SemanticsRecord};
use crate::store::StoreError;

/// Writes a value into a JSON column.
pub(super) fn json<T: Serialize>(value: &T) -> String {
    serde_json::to_string(value).expect("records have string keys and finite depth")
}

pub(super) fn map_record(row: &SqlRow) -> Result<MapRecord, StoreError> {
    let survey: Option<Survey> = row.json_if("georeference")?;
    Ok(MapRecord {
        id: row.uuid("id")?,
        name: row.text("name")?,
        created: row.time("created")?,
        updated: row.time("updated")?,
        width: row.whole("width")?,
        height: row.whole("height")?,
        resolution: row.real("resolution")?,
        georeference: survey.as_ref().map(|survey| survey.georeference),
        point_pairs: survey.map(|survey| survey.pairs).unwrap_or_default(),
        site: row.uuid("site")?,
        alignment: row.json_if("alignment")?,
        analysis: row.uuid_if("analysis")?,
        warnings: row.json("warnings")?,
        version: row.whole("version")?,
    })
}

pub(super) fn analysis_record(row: &SqlRow) -> Result<AnalysisRecord, StoreError> {
    Ok(AnalysisRecord {
        id: row.uuid("id")?,
        map: row.uuid("map")?,
        created: row.time("created")?,
        options: row.json("options")?,
        stages: row.json("stages")?,
        diagnostics: row.json("diagnostics")?,
    })
}

pub(super) fn job_record(row: &SqlRow) -> Result<JobRecord, StoreError> {
    Ok(JobRecord {
        id: row.uuid("id")?,
        map: row.uuid("map")?,
        process: row.text("process")?,
        inputs: row.json("inputs")?,
        outputs: row.json_if("outputs")?,
        state: row.state()?,
        progress: row.whole("progress")?,
        stage: row.text_if("stage")?,
        stages: row.json("stages")?,
        message: row.text("message")?,
        attempt: row.whole("attempt")?,
        created: row.time("created")?,
        started: row.time_if("started")?,
        finished: row.time_if("finished")?,
        updated: row.time("updated")?,
    })
}

pub(super) fn rule_set_record(row: &SqlRow) -> Result<RuleSetRecord, StoreError> {
    Ok(RuleSetRecord {
        id: row.text("id")?,
        draft: row.json("draft")?,
        built_in: false,
        version: row.whole("version")?,
    })
}

pub(super) fn semantics_record(row: &SqlRow) -> Result<SemanticsRecord, StoreError> {
    Ok(SemanticsRecord {
        analysis: row.uuid("analysis")?,
        rule_set: row.text("rule_set")?,
        draft: row.json("draft")?,
        assignment: row.json("assignment")?,
        layout: row.json("layout")?,
        corrections: correction_list(row)?,
        version: row.whole("version")?,
        origin: row.origin()?,
        carried: row.json_if("carried")?,
        restores: row.whole_if("restores")?,
        created: row.time("created")?,
    })
}

/// The list that a version of the semantics names.
fn correction_list(row: &SqlRow) -> Result<Option<CorrectionList>, StoreError> {
    let Some(number) = row.whole_if("corrections")? else { return Ok(None) };
    Ok(Some(CorrectionList { number, count: row.whole("correction_count")? }))
}
