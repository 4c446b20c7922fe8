//! From a robot's occupancy grid to a semantic map: the pure computation behind stillage.
//!
//! The method is that of S. Gholami Shahbandi, B. Åstrand and R. Philippsen, *Semi-supervised semantic
//! labeling of adaptive cell decomposition maps in well-structured environments* (ECMR 2015,
//! doi 10.1109/ECMR.2015.7324207). Its Fig. 2 is this crate. The head of a module says where it departs from the
//! paper; the preset `paper` brings the paper's own way back.
//!
//! ```text
//! grid ─ declutter ─┬─ raycast ─ features ─ clustering ─ categorization ────────────────────────┐
//!                   └─ orientation ─ segmentation ─┬─ site_plan (rooms, decomposition) ─┐       │
//!                                                  └─ radiography (the paper's lines) ──┤       │
//!                                                                                  arrangement  │
//!                                                                     adjacency ────────┴─── annotation ─ Analysis
//!                                                                                                            │
//!                     rule set, assignment (one human decision per category) ─ semantics ─ SemanticMap ──────┘
//!                                                                                               │
//!                                                                                       layout, routing, graph
//! ```
//!
//! Everything up to the [`Analysis`] is the geometric level, without human input: [`analyze`]. The rest is the human
//! level: [`semantics::apply`]. Where people correct the geometric level itself, [`corrections::apply`] gives the
//! analysis that they meant.
//!
//! Where the truth of a site is known, [`evaluation`] says how well both levels fit it.
//!
//! Nothing here touches a file, a socket, a clock or a thread pool of its own: parallel work runs on the rayon pool
//! of the caller. The same grid and spec give the same [`Analysis`] on any number of threads.
//!
//! Lengths are metres and angles are radians, counter-clockwise, unless a name says otherwise. Geometry lives in the
//! *grid frame*: metres from the lower left corner of the grid, x along the columns, y up along the rows.
//! [`grid::GridFrame`] carries it into the map frame (origin and yaw).

// Shared by many stages.
pub mod geometry;
pub mod grid;
pub mod linalg;
pub mod line;
pub mod plot;
pub mod signal;
pub mod vectors;

mod components;
mod digital_lines;
mod distance_transform;
mod excerpt;
mod fourier;
mod morphology;
mod runs;
mod site_ground;
mod walls;

// The stages, in the order of the data.
mod surroundings;

pub mod declutter;

pub mod raycast;

pub mod features;

pub mod clustering;

pub mod categorization;

pub mod orientation;

pub mod segmentation;

pub mod radiography;

pub mod rooms;

mod hatching;
mod marks;

pub mod decomposition;
mod floor;

pub mod site_plan;

pub mod arrangement;

pub mod adjacency;

pub mod annotation;

pub mod relaxation;

pub mod analysis;

// The human level.
pub mod corrections;
pub mod semantics;

pub mod clearance;
pub mod site_map;

pub mod lane_rule;
pub mod layout;

pub mod routing;

pub mod graph;

pub mod graph_report;

pub mod alignment;

pub mod compare;

pub mod registry;

pub mod evaluation;

// What a computation is asked for, and what it costs.
pub mod memory;
pub mod spec;
pub mod stage_shares;
pub mod watch;
pub mod whereabouts;

#[cfg(test)]
mod test_maps;

pub use analysis::{Analysis, analyze};
pub use excerpt::excerpt;
pub use geometry::{Point, Vector};
pub use grid::{GridFrame, Occupancy, OccupancyGrid};
pub use site_map::{SiteCells, SiteMap};
pub use spec::{AnalysisOptions, AnalysisSpec};
pub use watch::{Stage, StopFlag, Stopped, Watch};
