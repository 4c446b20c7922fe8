//! What a report is asked for.

/// Room to both sides of a vehicle together, below which a passage is told, metres: our choice, 0.1 m to each side.
const MARGIN_M: f64 = 0.2;
/// Pairs of nodes between which ways are looked for: as many as SWAGGER takes.
const SAMPLES: usize = 1_000;

/// What a report is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportOptions {
    /// Passages narrower than this are told, metres.
    pub min_passage_width: f64,
    /// How many random pairs of nodes ways are looked for between.
    pub samples: usize,
    /// The pairs follow from this number.
    pub seed: u64,
}

impl ReportOptions {
    /// What holds for vehicles of a radius in metres where nobody asks for anything else.
    #[must_use]
    pub fn for_radius(radius: f64) -> Self {
        Self { min_passage_width: 2.0 * radius + MARGIN_M, samples: SAMPLES, seed: 0 }
    }
}
