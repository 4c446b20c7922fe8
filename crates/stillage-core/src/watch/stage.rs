//! The stages of an analysis, and the share of each in its time.

/// The stages of [`crate::analyze`], in their order. The paper's decomposition has no rooms, rows or site plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Removal of single hits, small holes and specks.
    Declutter,
    /// Beams from every free cell of a sample, or of the whole map, reduced to features.
    Features,
    /// Clustering of the features into place categories.
    Clustering,
    /// Features of the cells outside the sample, and the category of every cell.
    Categorization,
    /// Dominant orientations of the whole map.
    Orientation,
    /// Regions of one direction or texture, and their own orientations.
    Regions,
    /// Projections along the orientations, and the infinite lines of the paper's method.
    Radiography,
    /// Passages and gates of the ground, and the rooms between them (adaptive method).
    Rooms,
    /// Aisles, rows and their places, and which rooms are halls (adaptive method).
    Rows,
    /// Goods that stand in rooms, and the borders of rooms (adaptive method).
    SitePlan,
    /// Subdivision into faces and its dual graph.
    Arrangement,
    /// Categories, occupancy and evidence of faces and edges.
    Annotation,
}

impl Stage {
    /// Every stage, in order.
    pub const ALL: [Self; 12] = [
        Self::Declutter,
        Self::Features,
        Self::Clustering,
        Self::Categorization,
        Self::Orientation,
        Self::Regions,
        Self::Radiography,
        Self::Rooms,
        Self::Rows,
        Self::SitePlan,
        Self::Arrangement,
        Self::Annotation,
    ];

    /// The name used in reports and job states.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Declutter => "declutter",
            Self::Features => "features",
            Self::Clustering => "clustering",
            Self::Categorization => "categorization",
            Self::Orientation => "orientation",
            Self::Regions => "regions",
            Self::Radiography => "radiography",
            Self::Rooms => "rooms",
            Self::Rows => "rows",
            Self::SitePlan => "site-plan",
            Self::Arrangement => "arrangement",
            Self::Annotation => "annotation",
        }
    }
}

/// The share of each stage in the time of an analysis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StageShares([f64; Stage::ALL.len()]);

impl Default for StageShares {
    /// Equal shares, for when nothing is known.
    fn default() -> Self {
        Self([1.0 / Stage::ALL.len() as f64; Stage::ALL.len()])
    }
}

impl StageShares {
    /// The shares of stages that take these times, in the order of [`Stage::ALL`]; equal ones where all times are 0.
    pub(crate) fn of_times(times: [f64; Stage::ALL.len()]) -> Self {
        let whole: f64 = times.iter().sum();
        if whole > 0.0 { Self(times.map(|time| time / whole)) } else { Self::default() }
    }

    /// Share of a stage, 0 to 1; all together are 1.
    #[must_use]
    pub const fn of(&self, stage: Stage) -> f64 {
        self.0[stage as usize]
    }
}
