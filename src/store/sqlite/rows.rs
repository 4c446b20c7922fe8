//! Rows as records, and values as columns.

use jiff::Timestamp;
use serde::Serialize;
use serde::de::DeserializeOwned;
use sqlx::Row;
use sqlx::sqlite::SqliteRow;
use uuid::Uuid;

use crate::coordinates::Survey;
use crate::records::{
    AnalysisRecord, CorrectionList, JobRecord, JobState, MapRecord, RuleSetRecord, SemanticsOrigin, SemanticsRecord,
    Tenant,
};
use crate::store::{BlobId, StoreError};

/// Writes a value into a JSON column.
pub(super) fn json<T: Serialize>(value: &T) -> String {
    serde_json::to_string(value).expect("records have string keys and finite depth")
}

/// Reads typed columns.
pub(super) trait Columns {
    fn text(&self, column: &'static str) -> Result<String, StoreError>;
    fn uuid(&self, column: &'static str) -> Result<Uuid, StoreError>;
    fn uuid_if(&self, column: &'static str) -> Result<Option<Uuid>, StoreError>;
    fn time(&self, column: &'static str) -> Result<Timestamp, StoreError>;
    fn time_if(&self, column: &'static str) -> Result<Option<Timestamp>, StoreError>;
    fn whole<T: TryFrom<i64>>(&self, column: &'static str) -> Result<T, StoreError>;
    fn whole_if<T: TryFrom<i64>>(&self, column: &'static str) -> Result<Option<T>, StoreError>;
    fn json<T: DeserializeOwned>(&self, column: &'static str) -> Result<T, StoreError>;
    fn json_if<T: DeserializeOwned>(&self, column: &'static str) -> Result<Option<T>, StoreError>;
    fn blob(&self, column: &'static str) -> Result<BlobId, StoreError>;
    fn tenant(&self) -> Result<Tenant, StoreError>;
    fn state(&self) -> Result<JobState, StoreError>;
    fn origin(&self) -> Result<SemanticsOrigin, StoreError>;
}

impl Columns for SqliteRow {
    fn text(&self, column: &'static str) -> Result<String, StoreError> {
        Ok(self.try_get(column)?)
    }

    fn uuid(&self, column: &'static str) -> Result<Uuid, StoreError> {
        let value = self.text(column)?;
        Uuid::parse_str(&value).map_err(|_| StoreError::BadValue { column, value })
    }

    fn uuid_if(&self, column: &'static str) -> Result<Option<Uuid>, StoreError> {
        let value: Option<String> = self.try_get(column)?;
        value.map(|_| self.uuid(column)).transpose()
    }

    fn time(&self, column: &'static str) -> Result<Timestamp, StoreError> {
        let value: i64 = self.try_get(column)?;
        Timestamp::from_microsecond(value).map_err(|_| StoreError::BadValue { column, value: value.to_string() })
    }

    fn time_if(&self, column: &'static str) -> Result<Option<Timestamp>, StoreError> {
        let value: Option<i64> = self.try_get(column)?;
        value.map(|_| self.time(column)).transpose()
    }

    fn whole<T: TryFrom<i64>>(&self, column: &'static str) -> Result<T, StoreError> {
        let value: i64 = self.try_get(column)?;
        T::try_from(value).map_err(|_| StoreError::BadValue { column, value: value.to_string() })
    }

    fn whole_if<T: TryFrom<i64>>(&self, column: &'static str) -> Result<Option<T>, StoreError> {
        let value: Option<i64> = self.try_get(column)?;
        value.map(|_| self.whole(column)).transpose()
    }

    fn json<T: DeserializeOwned>(&self, column: &'static str) -> Result<T, StoreError> {
        let value = self.text(column)?;
        serde_json::from_str(&value).map_err(|_| StoreError::BadValue { column, value })
    }

    fn json_if<T: DeserializeOwned>(&self, column: &'static str) -> Result<Option<T>, StoreError> {
        let value: Option<String> = self.try_get(column)?;
        value.map(|_| self.json(column)).transpose()
    }

    fn blob(&self, column: &'static str) -> Result<BlobId, StoreError> {
        Ok(BlobId::from_digits(self.text(column)?))
    }

    fn tenant(&self) -> Result<Tenant, StoreError> {
        Ok(Tenant::new(self.text("tenant")?))
    }

    fn state(&self) -> Result<JobState, StoreError> {
        let value = self.text("state")?;
        JobState::find(&value).ok_or(StoreError::BadValue { column: "state", value })
    }

    fn origin(&self) -> Result<SemanticsOrigin, StoreError> {
        let value = self.text("origin")?;
        SemanticsOrigin::find(&value).ok_or(StoreError::BadValue { column: "origin", value })
    }
}

pub(super) fn map_record(row: &SqliteRow) -> Result<MapRecord, StoreError> {
    let survey: Option<Survey> = row.json_if("georeference")?;
    Ok(MapRecord {
        id: row.uuid("id")?,
        name: row.text("name")?,
        created: row.time("created")?,
        updated: row.time("updated")?,
        width: row.whole("width")?,
        height: row.whole("height")?,
        resolution: row.try_get("resolution")?,
        georeference: survey.as_ref().map(|survey| survey.georeference),
        point_pairs: survey.map(|survey| survey.pairs).unwrap_or_default(),
        site: row.uuid("site")?,
        alignment: row.json_if("alignment")?,
        analysis: row.uuid_if("analysis")?,
        warnings: row.json("warnings")?,
        version: row.whole("version")?,
    })
}

pub(super) fn analysis_record(row: &SqliteRow) -> Result<AnalysisRecord, StoreError> {
    Ok(AnalysisRecord {
        id: row.uuid("id")?,
        map: row.uuid("map")?,
        created: row.time("created")?,
        options: row.json("options")?,
        stages: row.json("stages")?,
        diagnostics: row.json("diagnostics")?,
    })
}

pub(super) fn job_record(row: &SqliteRow) -> Result<JobRecord, StoreError> {
    Ok(JobRecord {
        id: row.uuid("id")?,
        map: row.uuid("map")?,
        process: row.text("process")?,
        inputs: row.json("inputs")?,
        outputs: row.json_if("outputs")?,
        state: row.state()?,
        progress: row.whole("progress")?,
        stage: row.try_get("stage")?,
        stages: row.json("stages")?,
        message: row.text("message")?,
        attempt: row.whole("attempt")?,
        created: row.time("created")?,
        started: row.time_if("started")?,
        finished: row.time_if("finished")?,
        updated: row.time("updated")?,
    })
}

pub(super) fn rule_set_record(row: &SqliteRow) -> Result<RuleSetRecord, StoreError> {
    Ok(RuleSetRecord {
        id: row.text("id")?,
        draft: row.json("draft")?,
        built_in: false,
        version: row.whole("version")?,
    })
}

pub(super) fn semantics_record(row: &SqliteRow) -> Result<SemanticsRecord, StoreError> {
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
fn correction_list(row: &SqliteRow) -> Result<Option<CorrectionList>, StoreError> {
    let Some(number) = row.whole_if("corrections")? else { return Ok(None) };
    Ok(Some(CorrectionList { number, count: row.whole("correction_count")? }))
}
