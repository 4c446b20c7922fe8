//! A semantic map against the truth of a real map that a person drew.
//!
//! The truth has polygons in metres of the map frame, labelled `pc` (a rack, shelf, stack or block of storage), `co` (an
//! aisle along storage), `ju` (crossing or open floor), `floor` (drivable, corridor or junction: both are right), `room`,
//! `ob` (column, machine) and `unsure` (masked out).
//!
//! | figure | meaning |
//! | --- | --- |
//! | met | true things whose intersection over union is above one half with the faces of their label that lie in them by more than half; a hall that is one face meets no aisle, a rack cut into bays meets the rack |
//! | recall | share of the true things that are met; of `ju` the share of their area, for how open floor is divided is a matter of taste |
//! | precision | share of the area with a label that lies in true things of that label; of floor only what somebody drew counts |
//! | score | mean over the labels of the harmonic mean of recall and precision |
//! | false faces | faces labelled `pc` with less than half of their area on true storage |

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;
use stillage_core::geometry::{Point, direction};
use stillage_core::semantics::SemanticMap;
use stillage_core::{Analysis, Vector};

use crate::{Outcome, scan};

/// The labels that are scored: storage, aisle, open floor.
const LABELS: [&str; 3] = ["pc", "co", "ju"];
/// What is unsure is masked with so much around it, metres.
const UNSURE: f64 = 0.05;
/// Faces below this area are none, square metres.
const NO_FACE: f64 = 0.01;

type Rings = Vec<Vec<Point>>;

/// What a person drew.
pub struct DrawnTruth(Vec<Thing>);

struct Thing {
    label: String,
    /// Number of bays where they can be counted.
    bays: Option<f64>,
    rings: Rings,
}

/// How well one label fits.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LabelScore {
    pub things: usize,
    pub met: usize,
    pub recall: f64,
    pub precision: f64,
}

impl LabelScore {
    pub fn f1(&self) -> f64 {
        2.0 * self.recall * self.precision / (self.recall + self.precision).max(1e-9)
    }
}

/// How well a semantic map fits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MapScore {
    /// By [`LABELS`]; `None` where the truth has nothing of a label.
    pub labels: [Option<LabelScore>; 3],
    pub storage_faces: usize,
    pub false_faces: usize,
    /// Median of the faces of a rack by its bays.
    pub faces_per_bay: Option<f64>,
    pub drivable: f64,
}

impl MapScore {
    pub fn score(&self) -> f64 {
        let f1: Vec<f64> = self.labels.iter().flatten().map(LabelScore::f1).collect();
        f1.iter().sum::<f64>() / f1.len().max(1) as f64
    }
}

impl DrawnTruth {
    pub fn read(path: &Path) -> Outcome<Self> {
        let document: Value = serde_json::from_slice(&std::fs::read(path)?)?;
        let features = document["features"].as_array().ok_or_else(|| format!("{}: no features", path.display()))?;
        let thing = |feature: &Value| {
            let properties = &feature["properties"];
            let rows = properties["rows"].as_f64().unwrap_or(1.0);
            Ok(Thing {
                label: properties["label"].as_str().ok_or("a feature has no label")?.to_owned(),
                bays: properties["bays"].as_f64().filter(|&bays| bays > 0.0).map(|bays| bays * rows),
                rings: rings(&feature["geometry"])?,
            })
        };
        Ok(Self(features.iter().map(thing).collect::<Outcome<_>>()?))
    }

    /// Scores the faces of an analysis under their labels.
    pub fn score(&self, analysis: &Analysis, semantic: &SemanticMap) -> MapScore {
        let faces: Vec<(&str, Rings)> = analysis
            .subdivision
            .faces()
            .map(|face| {
                let to_map = |ring: &Vec<Point>| ring.iter().map(|&point| analysis.frame.to_map(point)).collect();
                (semantic.label(face).id.as_str(), analysis.subdivision.rings(face).iter().map(to_map).collect())
            })
            .collect();
        Areas::measure(&faces, &self.0).score(&self.0)
    }
}

fn rings(geometry: &Value) -> Outcome<Rings> {
    let polygons = match geometry["type"].as_str() {
        Some("Polygon") => vec![&geometry["coordinates"]],
        Some("MultiPolygon") => geometry["coordinates"].as_array().into_iter().flatten().collect(),
        other => return Err(format!("a truth has polygons, not {other:?}").into()),
    };
    let point = |pair: &Value| Some(Point::new(pair[0].as_f64()?, pair[1].as_f64()?));
    let ring = |ring: &Value| ring.as_array()?.iter().map(point).collect::<Option<Vec<Point>>>();
    let rings = polygons.iter().flat_map(|polygon| polygon.as_array().into_iter().flatten()).map(ring);
    rings.collect::<Option<_>>().ok_or_else(|| "a ring is a list of pairs of numbers".into())
}

/// What is known of one face, without what is unsure. Square metres.
#[derive(Debug, Clone, Default)]
struct FaceAreas {
    area: f64,
    /// In anything that somebody drew, in floor of either kind, in anything drivable.
    drawn: f64,
    either: f64,
    drivable: f64,
    /// In each true thing of its own label.
    things: BTreeMap<usize, f64>,
}

struct Areas<'a> {
    labels: Vec<&'a str>,
    faces: Vec<FaceAreas>,
    things: Vec<f64>,
    /// The union of everything drivable.
    drivable: f64,
}

impl<'a> Areas<'a> {
    fn measure(faces: &[(&'a str, Rings)], things: &[Thing]) -> Self {
        let masks = things.iter().filter(|thing| thing.label == "unsure").flat_map(|thing| grown(&thing.rings));
        let mut polygons: Vec<Rings> = faces.iter().map(|(_, rings)| rings.clone()).collect();
        polygons.extend(things.iter().map(|thing| thing.rings.clone()));
        polygons.extend(masks);
        let (of_things, of_masks) = (faces.len(), faces.len() + things.len());
        let mut areas = Self {
            labels: faces.iter().map(|(label, _)| *label).collect(),
            faces: vec![FaceAreas::default(); faces.len()],
            things: vec![0.0; things.len()],
            drivable: 0.0,
        };
        scan::pieces(&polygons, |inside, area| {
            let here = || {
                inside.iter().filter(|&&index| (of_things..of_masks).contains(&index)).map(|index| index - of_things)
            };
            here().for_each(|thing| areas.things[thing] += area);
            let is = |wanted: &[&str]| here().any(|thing| wanted.contains(&things[thing].label.as_str()));
            let is_drivable = is(&["co", "ju", "floor"]);
            if is_drivable {
                areas.drivable += area;
            }
            // Faces do not overlap, and come first.
            let Some(&face) = inside.first().filter(|&&index| index < of_things) else { return };
            if inside.last().is_some_and(|&index| index >= of_masks) {
                return;
            }
            let share = |holds: bool| if holds { area } else { 0.0 };
            let of_face = &mut areas.faces[face];
            of_face.area += area;
            of_face.drawn += share(here().next().is_some());
            of_face.either += share(is(&["floor"]));
            of_face.drivable += share(is_drivable);
            for thing in here().filter(|&thing| things[thing].label == areas.labels[face]) {
                *of_face.things.entry(thing).or_default() += area;
            }
        });
        areas
    }

    /// The faces with a label.
    fn labelled(&self, label: &str) -> Vec<&FaceAreas> {
        let faces = self.faces.iter().zip(&self.labels).filter(|(face, own)| **own == label && face.area > NO_FACE);
        faces.map(|(face, _)| face).collect()
    }

    fn score(&self, truth: &[Thing]) -> MapScore {
        let mut score = MapScore { labels: LABELS.map(|label| self.of_label(label, truth)), ..MapScore::default() };
        let storage = self.labelled("pc");
        score.storage_faces = storage.len();
        score.false_faces = storage.iter().filter(|face| face.things.values().sum::<f64>() < 0.5 * face.area).count();
        score.faces_per_bay = median(self.bays(truth, &storage));
        let mine = || self.faces.iter().zip(&self.labels).filter(|(_, label)| ["co", "ju"].contains(label));
        let both: f64 = mine().map(|(face, _)| face.drivable).sum();
        let either = self.drivable + mine().map(|(face, _)| face.drawn).sum::<f64>() - both;
        score.drivable = both / either.max(1e-9);
        score
    }

    /// The faces that lie in a thing by more than half, where they meet it together.
    fn meeting<'f>(&self, thing: usize, mine: &[&'f FaceAreas]) -> Option<Vec<&'f FaceAreas>> {
        let common = |face: &FaceAreas| face.things.get(&thing).copied().unwrap_or(0.0);
        let own: Vec<&FaceAreas> = mine.iter().copied().filter(|face| common(face) > 0.5 * face.area).collect();
        let [both, all] = [own.iter().map(|face| common(face)).sum::<f64>(), own.iter().map(|face| face.area).sum()];
        (both / (all + self.things[thing] - both).max(1e-9) > 0.5).then_some(own)
    }

    fn of_label(&self, label: &str, truth: &[Thing]) -> Option<LabelScore> {
        let things: Vec<usize> = (0..truth.len()).filter(|&thing| truth[thing].label == label).collect();
        let mine = self.labelled(label);
        let met = things.iter().filter(|&&thing| self.meeting(thing, &mine).is_some()).count();
        let inside: f64 = mine.iter().flat_map(|face| face.things.values()).sum();
        let is_storage = label == "pc";
        // Storage that lies outside of everything drawn is false; floor there may be true.
        let right = inside + if is_storage { 0.0 } else { mine.iter().map(|face| face.either).sum() };
        let drawn: f64 = mine.iter().map(|face| if is_storage { face.area } else { face.drawn }).sum();
        let true_area: f64 = things.iter().map(|&thing| self.things[thing]).sum();
        let recall = if label == "ju" { inside / true_area } else { met as f64 / things.len() as f64 };
        let precision = if drawn > 0.0 { right / drawn } else { 0.0 };
        (!things.is_empty()).then_some(LabelScore { things: things.len(), met, recall, precision })
    }

    /// For each rack that is met, its faces by its bays.
    fn bays(&self, truth: &[Thing], storage: &[&FaceAreas]) -> Vec<f64> {
        let racks = truth.iter().enumerate().filter(|(_, thing)| thing.label == "pc");
        let ratio = |(thing, rack): (usize, &Thing)| Some(self.meeting(thing, storage)?.len() as f64 / rack.bays?);
        racks.filter_map(ratio).collect()
    }
}

/// Polygons whose union is a polygon with [`UNSURE`] around it: itself, a box along each side and a disc about each corner.
fn grown(rings: &Rings) -> Vec<Rings> {
    const CORNERS: usize = 32;
    let side = |[from, to]: [Point; 2]| {
        let along = (to - from).try_normalize(0.0)?;
        let across = Vector::new(-along.y, along.x) * UNSURE;
        Some(vec![vec![from - across, to - across, to + across, from + across]])
    };
    let disc = |[from, _]: [Point; 2]| {
        let corner = |index: usize| from + direction(std::f64::consts::TAU * index as f64 / CORNERS as f64) * UNSURE;
        vec![(0..CORNERS).map(corner).collect()]
    };
    let sides = || stillage_core::geometry::polygon::sides(rings);
    let around = sides().filter_map(side).chain(sides().map(disc));
    std::iter::once(rings.clone()).chain(around).collect()
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    Some(f64::midpoint(upper, values[(values.len() - 1) / 2]))
}
