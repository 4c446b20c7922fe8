//! Truth against result: Table III of the paper, made precise.
//!
//! Source: the paper, section III-C and Table III, which counts pallet cells that are detected correctly, with
//! "systematic" and other errors. Departures: the paper looks whether a place is labelled right; whether it is *one
//! face* is what a user of the places needs, so both are told, and much more.
//!
//! - A place is found *strictly* when one face labelled pallet cell has an intersection over union above one half with
//!   it; *laxly* when its centre lies in such a face of less than twice its area; *by area* when more than half of it
//!   is covered by such faces, which is nearest to the paper's count. Faces cut small pass the last two: never rest on
//!   them.
//! - A *systematic* miss is a place that is missed laxly and was empty: no shape shows it.
//! - Only places count whose surroundings the robot saw by half or more; the paper leaves unexplored margins out.
//! - *Precision* is the share of faces labelled pallet cell that strictly fit a true place. Faces below a quarter of
//!   the median place are slivers, counted apart. *F1* of strict recall and precision is the figure to go by.
//! - Cogency is compared with what the true labels imply, by length of the edges.
//!
//! Areas are those of the polygons, not of cells. [`evaluate`] tells all; behind it, [`Evaluator`] compares the
//! geometry once; [`Evaluator::score`] then reads any labels against it in milliseconds, and [`Evaluator::decision`]
//! takes the one decision per category that a person who knows the truth would take.
//!
//! Cost: O(true areas x faces they meet), seconds for a site of 6,000 places. Limits: true areas of one label must not
//! overlap.

mod boundary;
mod occupancy;
mod overlap;
mod truth;

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

pub use occupancy::OccupancyScores;
pub use truth::{GroundTruth, TrueArea, TruePlace, TrueRegion};

use crate::analysis::Analysis;
use crate::arrangement::FaceId;
use crate::geometry::{Point, line_angle_between};
use crate::semantics::{self, Assignment, LabelId, RuleSet, SemanticMap};
use crate::watch::{Stopped, Watch};
use overlap::{FaceAreas, Match};

/// A place counts when so much of its surroundings was seen.
const OBSERVED: f64 = 0.5;
/// Faces below this share of the median place are slivers.
const SLIVER: f64 = 0.25;
/// An orientation farther from every true one is false, radians.
const FALSE_ORIENTATION: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// Ids of the labels that a truth speaks of.
const CORRIDOR: &str = "co";
const JUNCTION: &str = "ju";
const PALLET_CELL: &str = "pc";

/// A rule set that has no word for something that the truth speaks of.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "the rule set has no label {id}: a truth of corridors (co), junctions (ju) and pallet cells (pc) needs all three"
)]
pub struct MissingLabel {
    /// The label.
    pub id: &'static str,
}

/// How places were found: shares of `places`, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaceScores {
    /// Places that count.
    pub places: usize,
    /// One face labelled pallet cell is the place.
    pub strict: f64,
    /// The place's centre lies in a face labelled pallet cell of less than twice its area.
    pub lax: f64,
    /// More than half of the place is labelled pallet cell.
    pub area: f64,
    /// One face is the place, whatever its label.
    pub geometry: f64,
    /// Missed laxly, and empty.
    pub systematic: f64,
}

/// Intersection over union of the area of each label, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelOverlap {
    /// Corridors.
    pub corridor: f64,
    /// Junctions.
    pub junction: f64,
    /// Pallet cells.
    pub pallet_cell: f64,
    /// Corridors and junctions together.
    pub drivable: f64,
}

/// How well labels fit the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct LabelScores {
    /// All places; `None` when none counts.
    pub places: Option<PlaceScores>,
    /// Places by region; regions without a place that counts are left out.
    pub regions: BTreeMap<String, PlaceScores>,
    /// Share of the faces labelled pallet cell (without slivers) that are a true place.
    pub precision: f64,
    /// Harmonic mean of strict recall and precision.
    pub f1: f64,
    /// Faces labelled pallet cell that are no true place, without slivers.
    pub false_cells: usize,
    /// Faces labelled pallet cell that are much smaller than a place.
    pub slivers: usize,
    /// Agreement by area.
    pub overlap: LabelOverlap,
    /// Share of the length of edges whose cogency is that of the true labels; `None` without edges between faces.
    pub cogency: Option<f64>,
}

/// How well the decomposition fits the truth, whatever the labels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeometryScores {
    /// Faces of the subdivision.
    pub faces: usize,
    /// True places.
    pub places: usize,
    /// Faces for each place; `None` without places.
    pub faces_per_place: Option<f64>,
    /// Share of the borders of true places that are borders of faces.
    pub boundary_recall: Option<f64>,
    /// Share of the borders of faces around true places that are borders of places.
    pub boundary_precision: Option<f64>,
    /// Largest distance of a true direction (along or across rows) from the nearest orientation found, radians.
    pub orientation_error: Option<f64>,
    /// Orientations found that are far from every true direction; `None` where the truth names no region.
    pub false_orientations: Option<usize>,
    /// Whether goods stand on the places that one face fits; `None` when there is none.
    pub occupancy: Option<OccupancyScores>,
}

/// How well an analysis fits the truth of its site, under labels of several origins.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The decomposition, whatever the labels.
    pub geometry: GeometryScores,
    /// Under the suggested labels: what comes out without a human.
    pub automatic: LabelScores,
    /// Under the best decision per category: what a person can make of it.
    pub decided: LabelScores,
    /// That decision.
    pub decision: Assignment,
    /// Under labels that somebody assigned, where there are any.
    pub assigned: Option<LabelScores>,
}

/// Why an analysis cannot be compared with a truth.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EvaluationError {
    /// It was asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The rule set does not speak of what the truth speaks of.
    #[error(transparent)]
    MissingLabel(#[from] MissingLabel),
}

/// Compares an analysis with the truth of its site: under the suggested labels, under one human decision per category,
/// and under assigned labels where there are any.
///
/// # Errors
/// [`EvaluationError`] when the watch says so, or when the rule set lacks a label.
///
/// # Panics
/// Never: suggestions and decision name the analysis' own categories and labels of the rule set.
pub fn evaluate(
    analysis: &Analysis,
    rule_set: &RuleSet,
    assigned: Option<&SemanticMap>,
    truth: &GroundTruth,
    watch: &Watch<'_>,
) -> Result<Evaluation, EvaluationError> {
    let evaluator = Evaluator::new(analysis, truth, watch)?;
    let score = |assignment: &Assignment| {
        let semantic = semantics::apply(analysis, rule_set, assignment)
            .expect("an assignment of the analysis' own categories to labels of the rule set applies");
        evaluator.score(&semantic)
    };
    let decision = evaluator.decision(rule_set)?;
    Ok(Evaluation {
        geometry: *evaluator.geometry(),
        automatic: score(&Assignment::suggested(&semantics::suggest(analysis, rule_set), rule_set))?,
        decided: score(&decision)?,
        decision,
        assigned: assigned.map(|semantic| evaluator.score(semantic)).transpose()?,
    })
}

/// Whether a rule set speaks of all that a truth speaks of.
///
/// # Errors
/// [`MissingLabel`] names what it lacks.
pub fn check_rule_set(rule_set: &RuleSet) -> Result<(), MissingLabel> {
    Names::of(rule_set).map(|_| ())
}

/// An analysis compared with the truth; ready to score labels.
#[derive(Debug)]
pub struct Evaluator<'a> {
    analysis: &'a Analysis,
    truth: &'a GroundTruth,
    matches: Vec<Match>,
    face_areas: Vec<f64>,
    /// By face: area of true corridors, junctions and places inside, and the rest.
    inside: Vec<[f64; 4]>,
    /// Area of all true corridors, junctions and places.
    true_areas: [f64; 3],
    geometry: GeometryScores,
}

impl<'a> Evaluator<'a> {
    /// Compares the geometry of an analysis with the truth.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn new(analysis: &'a Analysis, truth: &'a GroundTruth, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let frame = &analysis.frame;
        let faces = FaceAreas::new(&analysis.subdivision);
        let overlaps = |areas: &[&TrueArea]| -> Result<Vec<Vec<(u32, f64)>>, Stopped> {
            let one = |area: &&TrueArea| watch.check().map(|()| faces.overlaps(&area.in_grid(frame)));
            areas.par_iter().map(one).collect()
        };
        let places: Vec<&TrueArea> = truth.places.iter().map(|place| &place.area).collect();
        let labels = [truth.corridors.iter().collect(), truth.junctions.iter().collect(), places];
        let mut inside = vec![[0.0; 4]; faces.areas.len()];
        let mut of_places = Vec::new();
        for (label, areas) in labels.iter().enumerate() {
            let found = overlaps(areas)?;
            for &(face, area) in found.iter().flatten() {
                inside[face as usize][label] += area;
            }
            // Places come last.
            of_places = found;
        }
        for (inside, area) in inside.iter_mut().zip(&faces.areas) {
            inside[3] = (area - inside[..3].iter().sum::<f64>()).max(0.0);
        }
        let matches = truth.places.iter().zip(of_places).map(|(place, overlaps)| {
            let center = place.area.centroid().map(|center| frame.to_grid(center));
            let holds = |&&(face, _): &&(u32, f64)| center.is_some_and(|center| faces.holds(face, center));
            let holder = overlaps.iter().find(holds).map(|&(face, _)| face);
            Match { area: place.area.area(), holder, overlaps }
        });
        let matches: Vec<Match> = matches.collect();
        let rings: Vec<Vec<Vec<Point>>> = truth.places.iter().map(|place| place.area.in_grid(frame)).collect();
        let [boundary_recall, boundary_precision] = boundary::compare(&analysis.subdivision, &rings, watch)?;
        let (orientation_error, false_orientations) = orientations(analysis, truth);
        let count = analysis.subdivision.faces().len();
        let counted = truth.places.iter().zip(&matches).filter(|(place, _)| place.observed >= OBSERVED);
        let seen = counted.filter_map(|(place, found)| {
            let face = found.fitting(&faces.areas)?;
            Some((place.occupied, &analysis.faces[face as usize]))
        });
        let occupancy = OccupancyScores::of(seen);
        let geometry = GeometryScores {
            faces: count,
            places: truth.places.len(),
            faces_per_place: (!truth.places.is_empty()).then(|| count as f64 / truth.places.len() as f64),
            boundary_recall,
            boundary_precision,
            orientation_error,
            false_orientations,
            occupancy,
        };
        let true_areas = labels.map(|areas| areas.iter().map(|area| area.area()).sum());
        Ok(Self { analysis, truth, matches, face_areas: faces.areas, inside, true_areas, geometry })
    }

    /// How well the decomposition fits, whatever the labels.
    #[must_use]
    pub const fn geometry(&self) -> &GeometryScores {
        &self.geometry
    }

    /// One decision per category, as a person who knows the truth would take it: the label that most of the area of
    /// the category's faces has.
    ///
    /// # Errors
    /// [`MissingLabel`] when the rule set does not speak of what the truth speaks of.
    pub fn decision(&self, rule_set: &RuleSet) -> Result<Assignment, MissingLabel> {
        let names = Names::of(rule_set)?;
        let mut by_category: BTreeMap<u8, [f64; 4]> = BTreeMap::new();
        for face in self.analysis.subdivision.faces().map(FaceId::index) {
            let sums = by_category.entry(self.analysis.faces[face].category).or_default();
            sums.iter_mut().zip(self.inside[face]).for_each(|(sum, area)| *sum += area);
        }
        let label = |(category, areas): (u8, [f64; 4])| (category, rule_set.label(names.largest(areas)).id.clone());
        Ok(Assignment { assignment: by_category.into_iter().map(label).collect(), ..Assignment::default() })
    }

    /// How well the labels of a semantic map of this analysis fit.
    ///
    /// # Errors
    /// [`MissingLabel`] when its rule set does not speak of what the truth speaks of.
    pub fn score(&self, semantic: &SemanticMap) -> Result<LabelScores, MissingLabel> {
        let names = Names::of(&semantic.rule_set)?;
        let is_cell = |face: u32| semantic.labels[face as usize] == names.pallet_cell;
        let verdicts: Vec<Verdict> = self.matches.iter().map(|place| self.verdict(place, is_cell)).collect();
        let places = self.places(&verdicts, |_| true);
        let names_of_regions: BTreeSet<&str> = self.truth.places.iter().map(|place| place.region.as_str()).collect();
        let regions = names_of_regions.into_iter().filter_map(|name| {
            let scores = self.places(&verdicts, |place| place.region == name)?;
            Some((name.to_owned(), scores))
        });
        let regions = regions.collect();
        let Cells { right, wrong, slivers } = self.cells(is_cell);
        let precision = if right + wrong > 0 { right as f64 / (right + wrong) as f64 } else { 0.0 };
        let recall = places.map_or(0.0, |places| places.strict);
        let f1 = if recall + precision > 0.0 { 2.0 * recall * precision / (recall + precision) } else { 0.0 };
        let overlap = self.label_overlap(semantic, &names);
        let cogency = self.cogency(semantic, &names);
        Ok(LabelScores { places, regions, precision, f1, false_cells: wrong, slivers, overlap, cogency })
    }

    fn verdict(&self, place: &Match, is_cell: impl Fn(u32) -> bool) -> Verdict {
        let fitting = place.fitting(&self.face_areas);
        let covered: f64 = place.overlaps.iter().filter(|(face, _)| is_cell(*face)).map(|(_, area)| area).sum();
        Verdict {
            strict: fitting.is_some_and(&is_cell),
            lax: place.holder.is_some_and(|face| is_cell(face) && self.face_areas[face as usize] < 2.0 * place.area),
            area: covered > 0.5 * place.area,
            geometry: fitting.is_some(),
        }
    }

    /// Shares over the places that count and are asked for.
    fn places(&self, verdicts: &[Verdict], asked: impl Fn(&TruePlace) -> bool) -> Option<PlaceScores> {
        let counted: Vec<(&TruePlace, &Verdict)> = self
            .truth
            .places
            .iter()
            .zip(verdicts)
            .filter(|(place, _)| place.observed >= OBSERVED && asked(place))
            .collect();
        let share = |holds: &dyn Fn(&TruePlace, &Verdict) -> bool| {
            counted.iter().filter(|(place, verdict)| holds(place, verdict)).count() as f64 / counted.len() as f64
        };
        (!counted.is_empty()).then(|| PlaceScores {
            places: counted.len(),
            strict: share(&|_, verdict| verdict.strict),
            lax: share(&|_, verdict| verdict.lax),
            area: share(&|_, verdict| verdict.area),
            geometry: share(&|_, verdict| verdict.geometry),
            systematic: share(&|place, verdict| !verdict.lax && !place.occupied),
        })
    }

    /// Counts the faces labelled pallet cell.
    fn cells(&self, is_cell: impl Fn(u32) -> bool) -> Cells {
        let mut fits = vec![false; self.face_areas.len()];
        for place in &self.matches {
            for &overlap in &place.overlaps {
                fits[overlap.0 as usize] |= place.fits(overlap, &self.face_areas);
            }
        }
        let least = SLIVER * median(self.matches.iter().map(|place| place.area).collect()).unwrap_or(0.0);
        let mut cells = Cells::default();
        for FaceId(face) in self.analysis.subdivision.faces().filter(|face| is_cell(face.0)) {
            match (self.face_areas[face as usize] >= least, fits[face as usize]) {
                (false, _) => cells.slivers += 1,
                (true, true) => cells.right += 1,
                (true, false) => cells.wrong += 1,
            }
        }
        cells
    }

    fn label_overlap(&self, semantic: &SemanticMap, names: &Names) -> LabelOverlap {
        let overlap = |labels: &[usize]| {
            let ids: Vec<LabelId> = labels.iter().map(|&label| names.all()[label]).collect();
            let faces = || self.analysis.subdivision.faces().map(FaceId::index);
            let named = faces().filter(|&face| ids.contains(&semantic.labels[face]));
            let (mut mine, mut both) = (0.0, 0.0);
            for face in named {
                mine += self.face_areas[face];
                both += labels.iter().map(|&label| self.inside[face][label]).sum::<f64>();
            }
            let either = mine + labels.iter().map(|&label| self.true_areas[label]).sum::<f64>() - both;
            if either > 0.0 { both / either } else { 0.0 }
        };
        LabelOverlap {
            corridor: overlap(&[0]),
            junction: overlap(&[1]),
            pallet_cell: overlap(&[2]),
            drivable: overlap(&[0, 1]),
        }
    }

    fn cogency(&self, semantic: &SemanticMap, names: &Names) -> Option<f64> {
        let subdivision = &self.analysis.subdivision;
        let (mut right, mut all) = (0.0, 0.0);
        for edge in subdivision.edges() {
            let sides = subdivision.sides(edge);
            if sides.contains(&FaceId::OUTER) {
                continue;
            }
            let [left, other] = sides.map(|face| names.largest(self.inside[face.index()]));
            let length = subdivision.length(edge);
            all += length;
            if semantic.cogency[edge.index()] == semantic.rule_set.cogency(left, other) {
                right += length;
            }
        }
        (all > 0.0).then(|| right / all)
    }
}

/// What became of one place.
#[allow(clippy::struct_excessive_bools, reason = "four answers to four questions")]
struct Verdict {
    strict: bool,
    lax: bool,
    area: bool,
    geometry: bool,
}

/// Faces labelled pallet cell.
#[derive(Default)]
struct Cells {
    right: usize,
    wrong: usize,
    slivers: usize,
}

/// The labels of a rule set that a truth speaks of.
struct Names {
    corridor: LabelId,
    junction: LabelId,
    pallet_cell: LabelId,
    unidentified: LabelId,
}

impl Names {
    fn of(rule_set: &RuleSet) -> Result<Self, MissingLabel> {
        let find = |id: &'static str| rule_set.find(id).ok_or(MissingLabel { id });
        Ok(Self {
            corridor: find(CORRIDOR)?,
            junction: find(JUNCTION)?,
            pallet_cell: find(PALLET_CELL)?,
            unidentified: rule_set.unidentified(),
        })
    }

    const fn all(&self) -> [LabelId; 4] {
        [self.corridor, self.junction, self.pallet_cell, self.unidentified]
    }

    /// The label of the largest area; the first of equals.
    fn largest(&self, areas: [f64; 4]) -> LabelId {
        let largest = (1..4).fold(0, |best, label| if areas[label] > areas[best] { label } else { best });
        self.all()[largest]
    }
}

/// Mean of the two middle values of an even number.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    let lower = values[(values.len() - 1) / 2];
    Some(f64::midpoint(lower, upper))
}

/// The largest error of a true direction, and how many directions found are false.
fn orientations(analysis: &Analysis, truth: &GroundTruth) -> (Option<f64>, Option<usize>) {
    let along = truth.regions.iter().map(|region| region.angle - analysis.frame.yaw);
    let directions: Vec<f64> = along.flat_map(|angle| [angle, angle + FRAC_PI_2]).collect();
    if directions.is_empty() {
        return (None, None);
    }
    let nearest = |angle: f64, among: &[f64]| {
        among.iter().map(|&other| line_angle_between(angle, other)).fold(FRAC_PI_2, f64::min)
    };
    let found = &analysis.orientations.angles;
    let error = directions.iter().map(|&angle| nearest(angle, found)).fold(0.0, f64::max);
    let wrong = found.iter().filter(|&&angle| nearest(angle, &directions) > FALSE_ORIENTATION).count();
    (Some(error), Some(wrong))
}
