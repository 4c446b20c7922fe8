//! The map of the paper's size, analysed and labelled, for examples that measure what comes after.

use stillage_core::semantics::{self, Assignment, RuleSet, SemanticMap};
use stillage_core::{Analysis, AnalysisOptions, OccupancyGrid, Stopped, Watch, analyze};

use crate::site;

/// The map, its analysis, and the suggested labels under the default rule set.
pub struct LabelledSite {
    pub grid: OccupancyGrid,
    pub analysis: Analysis,
    pub semantic: SemanticMap,
}

impl LabelledSite {
    /// Analyses the map: some 20 CPU seconds.
    pub fn new() -> Result<Self, Stopped> {
        let grid = site::warehouse([0..site::SIZE[0], 0..site::SIZE[1]]);
        let mut options = AnalysisOptions::default();
        // The categories of cells do not matter here.
        options.categorization.stride = 4;
        let spec = options.check().expect("the options are valid");
        let analysis = analyze(&grid, &spec, &Watch::unwatched())?;
        let rules = RuleSet::default();
        let assignment = Assignment::suggested(&semantics::suggest(&analysis, &rules), &rules);
        let semantic = semantics::apply(&analysis, &rules, &assignment).expect("suggestions can be applied");
        Ok(Self { grid, analysis, semantic })
    }
}
