//! Sites with their truth, and what comes out for them.

use std::fs;
use std::ops::RangeInclusive;
use std::path::Path;

use rayon::prelude::*;
use stillage::ingest::{self, Limits, MapSource};
use stillage::render;
use stillage_core::evaluation::{self, Evaluation, GroundTruth};
use stillage_core::layout::{self, LayoutSpec, Location};
use stillage_core::semantics::{self, Assignment, RuleSet, SemanticMap};
use stillage_core::spec::{AnnotationMethod, DecompositionMethod, GridOptions, OrientationMethod, RegionMethod};
use stillage_core::{Analysis, AnalysisOptions, AnalysisSpec, OccupancyGrid, SiteCells, Watch, analyze};
use stillage_zoo::{Kind, Options, Sample};

use crate::Outcome;

/// Share of the cells of a speckled map that are salt or pepper.
const SPECKLE: f64 = 0.01;

/// Kinds that the document shows: some that are read well, and those that are not.
const SHOWN: [Kind; 4] = [Kind::Offices, Kind::Columns, Kind::DoubleDeep, Kind::BlockStorage];

/// A map, and what is true where that is known.
pub struct Site {
    pub grid: OccupancyGrid,
    pub truth: Option<GroundTruth>,
}

/// A map of `generate.py`, scored.
pub struct Generated {
    /// `small`, `medium` or `paper`.
    pub size: String,
    /// Sensor and difficulty, like `articles easy`.
    pub group: String,
    pub default: Evaluation,
    /// Under the method of the paper.
    pub paper: Option<Evaluation>,
}

/// A site of the zoo, scored.
pub struct OfZoo {
    pub kind: Kind,
    pub clean: Evaluation,
    pub speckled: Evaluation,
}

/// Reads a map beside its metadata file, with `truth.geojson` where it lies in the same folder.
pub fn read(metadata: &Path) -> Outcome<Site> {
    let bytes = fs::read(metadata).map_err(|error| format!("{}: {error}", metadata.display()))?;
    let image = metadata.with_file_name(ingest::image_entry(&bytes)?);
    read_image(&image, metadata)
}

/// Reads an image with the metadata of a map.
pub fn read_image(image: &Path, metadata: &Path) -> Outcome<Site> {
    let (image, bytes) = (fs::read(image)?, fs::read(metadata)?);
    let truth = metadata.with_file_name("truth.geojson");
    let truth = if truth.is_file() { Some(fs::read(truth)?) } else { None };
    site(image, bytes, truth.as_deref())
}

fn site(image: Vec<u8>, metadata: Vec<u8>, truth: Option<&[u8]>) -> Outcome<Site> {
    let source = MapSource::Image { image, metadata };
    let grid = ingest::decode(&source, &GridOptions::default(), &Limits::default())?.grid;
    let read = |bytes: &[u8]| -> Outcome<GroundTruth> { Ok(ingest::ground_truth(&serde_json::from_slice(bytes)?)?) };
    Ok(Site { grid, truth: truth.map(read).transpose()? })
}

/// A site of the zoo.
pub fn of_zoo(kind: Kind, seed: u64, options: &Options) -> Outcome<Site> {
    of_sample(&stillage_zoo::generate(kind, seed, options))
}

/// A generated site or drawing, read from its files.
pub fn of_sample<M>(sample: &Sample<M>) -> Outcome<Site> {
    site(sample.pgm(), sample.yaml().into_bytes(), Some(&serde_json::to_vec(&sample.truth)?))
}

/// The same, after its picture has been a JPEG of a quality of 100.
pub fn of_jpeg<M>(sample: &Sample<M>, quality: u8) -> Outcome<Site> {
    let picture = image::load_from_memory(&sample.pgm())?.into_luma8();
    let mut bytes = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, quality).encode_image(&picture)?;
    site(bytes, sample.yaml().into_bytes(), Some(&serde_json::to_vec(&sample.truth)?))
}

/// What lies in a folder and ends like this, in order, without the ending.
pub fn names(folder: &Path, ending: &str) -> Outcome<Vec<String>> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let name =
        |entry: std::io::Result<fs::DirEntry>| Some(entry.ok()?.file_name().to_str()?.strip_suffix(ending)?.to_owned());
    let mut names: Vec<String> = entries.filter_map(name).collect();
    names.sort();
    Ok(names)
}

pub fn analyzed(grid: &OccupancyGrid, spec: &AnalysisSpec) -> Outcome<Analysis> {
    Ok(analyze(grid, spec, &Watch::unwatched())?)
}

/// Scores a site.
pub fn scored(site: &Site, spec: &AnalysisSpec) -> Outcome<Evaluation> {
    evaluated(site, &analyzed(&site.grid, spec)?)
}

/// Scores the analysis of a site.
pub fn evaluated(site: &Site, analysis: &Analysis) -> Outcome<Evaluation> {
    let truth = site.truth.as_ref().ok_or("a map without truth.geojson cannot be scored")?;
    Ok(evaluation::evaluate(analysis, &rules(), None, truth, &Watch::unwatched())?)
}

/// The rule set that everything is read under: the default of the service.
fn rules() -> RuleSet {
    RuleSet::default()
}

/// An analysis under its suggested labels.
pub fn suggested(analysis: &Analysis) -> SemanticMap {
    let rules = rules();
    let assignment = Assignment::suggested(&semantics::suggest(analysis, &rules), &rules);
    semantics::apply(analysis, &rules, &assignment).expect("suggestions fit their own analysis")
}

/// The paper's own method in every stage that has one.
fn paper() -> Outcome<AnalysisSpec> {
    let mut options = AnalysisOptions::default();
    options.orientation.method = OrientationMethod::Paper;
    options.regions.method = RegionMethod::Gabor;
    options.decomposition.method = DecompositionMethod::Paper;
    options.annotation.method = AnnotationMethod::Vote;
    Ok(options.check().map_err(|problems| problems[0].to_string())?)
}

/// Scores every folder `<size>_<sensor>_<difficulty>_<seed>`.
pub fn generated(folder: &Path) -> Outcome<Vec<Generated>> {
    let mut names = names(folder, "")?;
    names.retain(|name| folder.join(name).join("truth.geojson").is_file());
    let paper = paper()?;
    let one = |name: &String| {
        let parts: Vec<&str> = name.split('_').collect();
        let [size, sensor, difficulty, _] = parts.as_slice() else {
            return Err(format!("{name}: a folder is named <size>_<sensor>_<difficulty>_<seed>").into());
        };
        let site = read(&folder.join(name).join("map.yaml"))?;
        let default = scored(&site, &AnalysisSpec::default())?;
        eprintln!("{name:<36}{:>7.3} {:>7.3}", default.decided.f1, default.automatic.f1);
        // The paper's lines shatter a site of the paper's size into half a million faces.
        let paper = if *size == "paper" { None } else { Some(scored(&site, &paper)?) };
        Ok(Generated { size: (*size).to_owned(), group: format!("{sensor} {difficulty}"), default, paper })
    };
    names.par_iter().map(one).collect()
}

/// Scores every kind of site, and draws the first seed of some into a folder.
pub fn zoo(seeds: RangeInclusive<u64>, pictures: Option<&Path>) -> Outcome<Vec<OfZoo>> {
    let sites: Vec<(Kind, u64)> =
        Kind::ALL.iter().flat_map(|&kind| seeds.clone().map(move |seed| (kind, seed))).collect();
    let one = |&(kind, seed): &(Kind, u64)| {
        let clean_site = of_zoo(kind, seed, &Options::default())?;
        let clean = scored(&clean_site, &AnalysisSpec::default())?;
        let speckled = of_zoo(kind, seed, &Options { speckle: SPECKLE, ..Options::default() })?;
        let speckled = scored(&speckled, &AnalysisSpec::default())?;
        eprintln!("{kind:<16}{seed:>4}{:>7.3} {:>7.3}", clean.decided.f1, clean.automatic.f1);
        if let Some(pictures) = pictures.filter(|_| seed == 1 && SHOWN.contains(&kind)) {
            let analysis = analyzed(&clean_site.grid, &AnalysisSpec::default())?;
            fs::write(pictures.join(format!("zoo-{kind}.png")), small_picture(&clean_site.grid, &analysis)?)?;
        }
        Ok(OfZoo { kind, clean, speckled })
    };
    sites.par_iter().map(one).collect()
}

/// A picture of an analysis under its suggested labels.
pub fn picture(grid: &OccupancyGrid, analysis: &Analysis) -> Vec<u8> {
    let semantic = suggested(analysis);
    render::semantic_png(grid, analysis, &semantic, &locations(grid, analysis))
}

/// The storage locations of an analysis under its suggested labels.
pub fn locations(grid: &OccupancyGrid, analysis: &Analysis) -> Vec<Location> {
    let semantic = suggested(analysis);
    let cells = SiteCells::of(grid, analysis);
    layout::layout(&cells.map(grid, analysis, &semantic), &LayoutSpec::of(&analysis.options)).locations
}

/// The same picture for a page of text, at most so large.
pub fn small_picture(grid: &OccupancyGrid, analysis: &Analysis) -> Outcome<Vec<u8>> {
    /// Width and height, pixels.
    const LARGEST: u32 = 900;
    let whole = image::load_from_memory(&picture(grid, analysis))?;
    let small = if whole.width().max(whole.height()) > LARGEST { whole.thumbnail(LARGEST, LARGEST) } else { whole };
    let mut bytes = std::io::Cursor::new(Vec::new());
    small.write_to(&mut bytes, image::ImageFormat::Png)?;
    Ok(bytes.into_inner())
}
