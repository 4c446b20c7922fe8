//! Compares the geometry of an analysis with the truth once, then scores any labels against it.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

use super::boundary;
use super::occupancy::OccupancyScores;
use super::overlap::{Match, ShapeAreas};
use super::scores::{GeometryScores, LabelOverlap, LabelScores, PlaceScores};
use super::truth::{GroundTruth, TrueArea, TruePlace};
use super::truth_labels::{MissingLabel, TruthLabels};
use crate::analysis::Analysis;
use crate::arrangement::FaceId;
use crate::geometry::{Point, line_angle_between};
use crate::semantics::{Assignment, LabelId, RuleSet, SemanticMap};
use crate::watch::{Stopped, Watch};

/// Share of a place's surroundings that the robot must have seen for the place to count.
pub(super) const OBSERVED: f64 = 0.5;

/// Area below which a face is a sliver, as a share of the median place.
const SLIVER: f64 = 0.25;

/// Distance from every true direction above which an orientation is false, radians.
const FALSE_ORIENTATION: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// An analysis compared with the truth, ready to score labels.
#[derive(Debug)]
pub struct Evaluator<'a> {
    analysis: &'a Analysis,
    truth: &'a GroundTruth,
    matches: Vec<Match>,
    face_areas: Vec<f64>,
    /// By face, the area of true corridors, junctions and places in it, and the rest.
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
        let faces = ShapeAreas::of_faces(&analysis.subdivision);
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
            // The last label is that of places.
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

    /// The decision of a person who knows the truth: for each category the true label of most of the area of its faces.
    ///
    /// # Errors
    /// [`MissingLabel`] when the rule set lacks a label that the truth uses.
    pub fn decision(&self, rule_set: &RuleSet) -> Result<Assignment, MissingLabel> {
        let names = TruthLabels::of(rule_set)?;
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
    /// [`MissingLabel`] when its rule set lacks a label that the truth uses.
    pub fn score(&self, semantic: &SemanticMap) -> Result<LabelScores, MissingLabel> {
        let names = TruthLabels::of(&semantic.rule_set)?;
        let is_cell = |face: u32| semantic.labels[face as usize] == names.pallet_cell;
        let verdicts: Vec<Verdict> = self.matches.iter().map(|place| self.verdict(place, is_cell)).collect();
        let places = self.places(&verdicts, |_| true);
        let names_of_regions: BTreeSet<&str> = self.truth.places.iter().map(|place| place.region.as_str()).collect();
        let regions = names_of_regions.into_iter().filter_map(|name| {
            let scores = self.places(&verdicts, |place| place.region == name)?;
            Some((name.to_owned(), scores))
        });
        let regions = regions.collect();
        let CellCount { right, wrong, slivers } = self.cells(is_cell);
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
    fn cells(&self, is_cell: impl Fn(u32) -> bool) -> CellCount {
        let mut fits = vec![false; self.face_areas.len()];
        for place in &self.matches {
            for &overlap in &place.overlaps {
                fits[overlap.0 as usize] |= place.fits(overlap, &self.face_areas);
            }
        }
        let least = SLIVER * median(self.matches.iter().map(|place| place.area).collect()).unwrap_or(0.0);
        let mut cells = CellCount::default();
        for FaceId(face) in self.analysis.subdivision.faces().filter(|face| is_cell(face.0)) {
            match (self.face_areas[face as usize] >= least, fits[face as usize]) {
                (false, _) => cells.slivers += 1,
                (true, true) => cells.right += 1,
                (true, false) => cells.wrong += 1,
            }
        }
        cells
    }

    fn label_overlap(&self, semantic: &SemanticMap, names: &TruthLabels) -> LabelOverlap {
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

    fn cogency(&self, semantic: &SemanticMap, names: &TruthLabels) -> Option<f64> {
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

/// How one place was found; see [`PlaceScores`].
#[allow(clippy::struct_excessive_bools, reason = "four independent criteria")]
struct Verdict {
    strict: bool,
    lax: bool,
    area: bool,
    geometry: bool,
}

/// Number of faces labelled pallet cell, by how they fit.
#[derive(Default)]
struct CellCount {
    right: usize,
    wrong: usize,
    slivers: usize,
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
