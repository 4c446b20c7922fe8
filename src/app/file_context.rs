//! A map file in memory, read as a map of the service is: the same answers without a store.

use std::sync::Arc;

use jiff::Timestamp;
use stillage_core::corrections::Correction;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{Assignment, RuleSet};
use stillage_core::{Analysis, OccupancyGrid, SiteCells};
use uuid::Uuid;

use super::context::Decided;
use super::geometric_level::GeometricLevel;
use super::{AppError, MapContext, MapRecord, SemanticsOrigin, SemanticsRecord};

/// A map file, analysed and labelled.
#[derive(Debug)]
pub struct FileMap {
    /// Name for people.
    pub name: String,
    /// Its cells.
    pub grid: OccupancyGrid,
    /// The geometric level.
    pub analysis: Analysis,
    /// What is read off its cells.
    pub cells: SiteCells,
    /// Labels and their rules.
    pub rule_set: RuleSet,
    /// The label of each category, and of single faces of the corrected map.
    pub assignment: Assignment,
    /// What people say about it, in metres of the map frame.
    pub corrections: Vec<Correction>,
}

impl MapContext {
    /// Reads a map file as a map of the service is read. Its id is made of its cells: the same file has the same id.
    ///
    /// # Errors
    /// An assignment that does not fit the corrected analysis or the rule set.
    pub fn of_file(file: FileMap) -> Result<Self, AppError> {
        let FileMap { name, grid, analysis, cells, rule_set, assignment, corrections } = file;
        let bytes: Vec<u8> = grid.cells().iter().map(|&cell| cell as u8).collect();
        let hash = blake3::hash(&bytes);
        let id = uuid::Builder::from_custom_bytes(std::array::from_fn(|index| hash.as_bytes()[index])).into_uuid();
        let record = MapRecord {
            id,
            name,
            created: Timestamp::UNIX_EPOCH,
            updated: Timestamp::UNIX_EPOCH,
            width: grid.width() as u32,
            height: grid.height() as u32,
            resolution: grid.resolution(),
            georeference: None,
            point_pairs: Vec::new(),
            site: id,
            alignment: None,
            analysis: Some(Uuid::nil()),
            warnings: Vec::new(),
            version: 1,
        };
        let semantics = SemanticsRecord {
            analysis: Uuid::nil(),
            rule_set: String::new(),
            draft: rule_set.draft().clone(),
            assignment,
            layout: LayoutOptions::default(),
            corrections: None,
            version: 0,
            origin: SemanticsOrigin::Suggested,
            carried: None,
            restores: None,
            created: Timestamp::UNIX_EPOCH,
        };
        let level = GeometricLevel::new(Arc::new(grid), analysis, cells).corrected(corrections);
        let decided = Decided { semantics: Some(semantics), ..Decided::default() };
        level.read_under(record, (Uuid::nil(), Timestamp::UNIX_EPOCH), decided, LayoutOptions::default())
    }
}
