//! Whatever the map and whatever the options: no panic, a sound result, the same on any number of threads.
//!
//! A fuzz target in the clothes of a property test, for it needs no nightly compiler: every stage of the public interface
//! runs on sites made at random (`sites`), and what fails is shrunk to a small one. `PROPTEST_CASES=5000 cargo test
//! --release -p stillage-core --test any_map` runs the long campaign.

mod any_correction;
mod sites;

use std::collections::BTreeSet;
use std::io::Write as _;
use std::sync::mpsc;
use std::time::Duration;

use any_correction::{any_correction, on_site};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rayon::ThreadPool;
use stillage_core::arrangement::{CellFaces, FaceId};
use stillage_core::corrections::{self, Correction, Outcome};
use stillage_core::layout::{self, CodeTemplate, LayoutSpec, Location};
use stillage_core::routing::{Preferences, Router, Waypoint};
use stillage_core::semantics::{self, AnalysisGround, Assignment, LabelSubject, LostLabel, RuleSet, SemanticMap};
use stillage_core::watch::Observer;
use stillage_core::{
    Analysis, AnalysisSpec, OccupancyGrid, SiteCells, SiteMap, Stage, StopFlag, Stopped, Watch, analyze,
};

/// Cases of a run that nobody asked to be longer.
const CASES: u32 = 64;

/// A short run has the same cases each time, so that its outcome is that of the change under test; a campaign has new
/// ones.
fn config() -> ProptestConfig {
    let asked = ProptestConfig::default();
    let (cases, rng_seed) = match std::env::var_os("PROPTEST_CASES") {
        Some(_) => (asked.cases, asked.rng_seed),
        None => (CASES, RngSeed::Fixed(1)),
    };
    ProptestConfig { cases, rng_seed, failure_persistence: None, max_shrink_iters: 40, ..asked }
}

/// Ends the tests with the site in words when its analysis takes longer than any would: a loop without an end cannot be
/// asked to stop.
struct Watchdog(#[expect(dead_code, reason = "its end wakes the thread")] mpsc::Sender<()>);

impl Watchdog {
    /// Longest time of a case, as long as a hundred of them take.
    const PATIENCE: Duration = Duration::from_mins(5);

    fn over(site: &sites::Site, spec: &AnalysisSpec) -> Self {
        let case = format!("{site:?}\n{spec:?}");
        let (alive, watched) = mpsc::channel();
        std::thread::spawn(move || {
            if watched.recv_timeout(Self::PATIENCE) == Err(mpsc::RecvTimeoutError::Timeout) {
                // Written past the capture of test output, which an abort would lose.
                _ = writeln!(std::io::stderr(), "no end after {:?}:\n{case}", Self::PATIENCE);
                std::process::abort();
            }
        });
        Self(alive)
    }
}

fn threads(count: usize) -> ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("threads can be had")
}

fn analyzed(grid: &OccupancyGrid, spec: &AnalysisSpec, count: usize) -> Analysis {
    threads(count).install(|| analyze(grid, spec, &Watch::unwatched())).expect("nobody stops it")
}

/// The map as it is served before anyone has labelled it.
fn labelled(analysis: &Analysis) -> SemanticMap {
    let rules = RuleSet::default();
    let assignment = Assignment::suggested(&semantics::suggest(analysis, &rules), &rules);
    semantics::apply(analysis, &rules, &assignment).expect("suggestions can be applied")
}

/// Every cell lies in one face that says so, and faces cover what their areas say.
fn check_faces(grid: &OccupancyGrid, analysis: &Analysis) -> Result<(), TestCaseError> {
    let subdivision = &analysis.subdivision;
    subdivision.check_invariants().map_err(TestCaseError::fail)?;
    let cells = CellFaces::rasterize(subdivision, grid.width(), grid.height(), grid.resolution());
    let mut counts = vec![0; subdivision.face_count()];
    cells.iter().for_each(|face| counts[face.index()] += 1);
    for face in subdivision.faces() {
        let known = &analysis.faces[face.index()];
        prop_assert_eq!(known.cells, counts[face.index()], "cells of face {}", face);
        let shares = [known.free_fraction, known.occupied_fraction, known.unknown_fraction];
        prop_assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "face {} has shares {:?}", face, shares);
        prop_assert!(known.area > 0.0 && (0.0..=1.0).contains(&known.confidence), "face {} is {:?}", face, known);
        prop_assert!(usize::from(known.category) < analysis.face_categories.count(), "category of face {}", face);
    }
    // Corners lie on a lattice, a hair beside the corners of the map.
    let [width, height] = [grid.width(), grid.height()].map(|cells| cells as f64 * grid.resolution() + 1e-4);
    let whole = width * height;
    let area: f64 = subdivision.faces().map(|face| subdivision.area(face)).sum();
    prop_assert!(area <= whole, "{} m2 of faces on {} m2", area, whole);
    Ok(())
}

/// Codes are unique and short under any template, and sort like the locations under the default one.
fn check_codes(map: &SiteMap<'_>) -> Result<Vec<Location>, TestCaseError> {
    let spec = LayoutSpec::of(&map.analysis.options);
    for template in ["{row}{bay}", "{side}{bay:3}/{aisle}", "{bay}-{aisle}-{depth}", "a very long name {aisle}{bay}"] {
        let code = CodeTemplate::parse(template).expect("it is a template");
        let locations = layout::layout(map, &LayoutSpec { code, place_width: Some(0.5), ..spec.clone() }).locations;
        let codes: BTreeSet<&str> = locations.iter().map(|location| location.code.as_str()).collect();
        prop_assert_eq!(codes.len(), locations.len(), "{} codes twice", template);
        prop_assert!(codes.iter().all(|code| layout::check_code(code).is_ok()), "{}: {:?}", template, codes);
    }
    let locations = layout::layout(map, &spec).locations;
    prop_assert!(locations.windows(2).all(|pair| pair[0].code < pair[1].code), "{:?}", locations);
    Ok(locations)
}

/// Places are made of the faces that name them; locations have codes of their own; a way is as long as it says.
fn check_meaning(grid: &OccupancyGrid, analysis: &Analysis) -> Result<(), TestCaseError> {
    let semantic = labelled(analysis);
    for (number, place) in (0_u32..).zip(&semantic.places) {
        prop_assert!(place.faces.iter().all(|face| semantic.face_places[face.index()] == Some(number)));
    }
    let cells = SiteCells::of(grid, analysis);
    let map = cells.map(grid, analysis, &semantic);
    let locations = check_codes(&map)?;
    let radius = LayoutSpec::of(&analysis.options).vehicle_radius;
    for radius in [0.0, radius] {
        let router = Router::new(&map, radius);
        let faces = [analysis.subdivision.faces().next(), analysis.subdivision.faces().last()];
        let mut ends: Vec<Waypoint<'_>> = faces.into_iter().flatten().map(Waypoint::Face).collect();
        ends.extend([locations.first(), locations.last()].into_iter().flatten().map(Waypoint::Location));
        for (from, to) in ends.iter().flat_map(|from| ends.iter().map(move |to| (from, to))) {
            let Ok(route) = router.route(&map, from, to, &Preferences::default()) else { continue };
            let length: f64 = route.path.windows(2).map(|step| (step[1] - step[0]).norm()).sum();
            prop_assert!(route.path.len() >= 2 && (length - route.length).abs() < 1e-6, "{:?}", route);
            prop_assert!(route.faces.iter().all(|&face| face != FaceId::OUTER));
            prop_assert!(route.clearance >= radius - grid.resolution(), "{:?}", route);
        }
    }
    Ok(())
}

/// Whatever a person decided, carrying it to the same analysis changes the label of no face that holds a cell.
fn check_carrying(grid: &OccupancyGrid, analysis: &Analysis) -> Result<(), TestCaseError> {
    let rules = RuleSet::default();
    let mut decision = Assignment::suggested(&semantics::suggest(analysis, &rules), &rules);
    let label = |number: u32| rules.labels()[number as usize % rules.labels().len()].id.clone();
    for (category, decided) in decision.assignment.iter_mut().filter(|(category, _)| *category % 2 == 0) {
        *decided = label(u32::from(*category));
    }
    decision.overrides = analysis.subdivision.faces().step_by(3).map(|face| (face.0, label(face.0 / 3))).collect();
    let cells = CellFaces::rasterize(&analysis.subdivision, grid.width(), grid.height(), grid.resolution());
    let ground = AnalysisGround { analysis, cells: &cells };
    let carried = semantics::carry(ground, &decision, ground, &rules);
    let [before, after] = [&decision, &carried.assignment]
        .map(|labels| semantics::apply(analysis, &rules, labels).expect("labels that exist").labels);
    for face in analysis.subdivision.faces().map(FaceId::index) {
        let known = &analysis.faces[face];
        prop_assert!(known.cells == 0 || before[face] == after[face], "face {} is {:?}", face, known);
    }
    let is_small = |lost: &LostLabel| match lost.subject {
        LabelSubject::Face(face) => analysis.faces[face as usize].cells == 0,
        LabelSubject::Category(_) => false,
    };
    prop_assert!(carried.lost.iter().all(is_small), "{:?}", carried.lost);
    Ok(())
}

/// Stops an analysis at the end of some report of progress.
struct StopAfter {
    reports: std::sync::atomic::AtomicUsize,
    flag: StopFlag,
}

impl Observer for StopAfter {
    fn progress(&self, _: Stage, _: f64) {
        if self.reports.fetch_sub(1, std::sync::atomic::Ordering::Relaxed) == 1 {
            self.flag.raise();
        }
    }
}

/// Whatever people say in whatever order: a sound map, the same on any number of threads; what does not fit changes
/// nothing, and what was not redrawn is as it was.
fn check_corrections(grid: &OccupancyGrid, analysis: &Analysis, list: &[Correction]) -> Result<(), TestCaseError> {
    let cells = SiteCells::of(grid, analysis);
    let corrected = threads(1).install(|| corrections::apply(grid, analysis, &cells.faces, list));
    check_faces(grid, &corrected.analysis)?;
    let subdivision = &corrected.analysis.subdivision;
    prop_assert_eq!(corrected.outcomes.len(), list.len());
    prop_assert_eq!(&corrected.faces, &CellFaces::of_grid(subdivision, grid));
    prop_assert_eq!(corrected.analysis.edges.len(), subdivision.edge_count());
    prop_assert_eq!(corrected.analysis.faces.len(), subdivision.face_count());
    let again = threads(3).install(|| corrections::apply(grid, analysis, &cells.faces, list));
    prop_assert_eq!(format!("{corrected:?}"), format!("{again:?}"));
    let (first, more) = list.split_at(list.len() / 2);
    let by_and_by = corrections::apply(grid, analysis, &cells.faces, first).and(grid, analysis, &cells.faces, more);
    prop_assert_eq!(format!("{corrected:?}"), format!("{by_and_by:?}"));
    let fitting =
        list.iter().zip(&corrected.outcomes).filter(|(_, outcome)| matches!(outcome, Outcome::Applied { .. }));
    let fitting: Vec<Correction> = fitting.map(|(correction, _)| correction.clone()).collect();
    let without_unfit = corrections::apply(grid, analysis, &cells.faces, &fitting);
    prop_assert_eq!(without_unfit.outcomes.len(), fitting.len());
    prop_assert!(!without_unfit.outcomes.iter().any(|outcome| matches!(outcome, Outcome::Unfit(_))));
    prop_assert_eq!(format!("{:?}", without_unfit.analysis), format!("{:?}", corrected.analysis));
    let named = corrected.outcomes.iter().flat_map(|outcome| match outcome {
        Outcome::Applied { faces } => faces.as_slice(),
        Outcome::Unfit(_) => &[],
    });
    prop_assert!(named.chain(corrected.labels.keys()).all(|face| face.index() < subdivision.face_count()));
    labelled(&corrected.analysis);
    Ok(())
}

#[test]
fn a_gate_that_meets_no_hall_is_given_up() {
    let spec = AnalysisSpec::default();
    let _watchdog = Watchdog::over(&sites::with_a_bay_that_meets_no_hall(), &spec);
    let grid = sites::with_a_bay_that_meets_no_hall().grid();
    check_faces(&grid, &analyzed(&grid, &spec, 1)).expect("a sound analysis");
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn any_map_has_a_sound_analysis(site in sites::any_site(), spec in sites::any_spec()) {
        let _watchdog = Watchdog::over(&site, &spec);
        let grid = site.grid();
        let analysis = analyzed(&grid, &spec, 1);
        check_faces(&grid, &analysis)?;
        check_meaning(&grid, &analysis)?;
        check_carrying(&grid, &analysis)?;
        // Written out, since what is not a number equals nothing.
        prop_assert_eq!(format!("{analysis:?}"), format!("{:?}", analyzed(&grid, &spec, 3)));
    }

    #[test]
    fn any_corrections_leave_a_sound_map(site in sites::any_site(), list in prop::collection::vec(any_correction(), 0..12)) {
        let _watchdog = Watchdog::over(&site, &AnalysisSpec::default());
        let grid = site.grid();
        let list = on_site(&list, grid.frame());
        check_corrections(&grid, &analyzed(&grid, &AnalysisSpec::default(), 1), &list)?;
    }

    #[test]
    fn an_analysis_stops_or_ends(site in sites::any_site(), spec in sites::any_spec(), reports in 1_usize..40) {
        let _watchdog = Watchdog::over(&site, &spec);
        let flag = StopFlag::default();
        let observer = StopAfter { reports: reports.into(), flag: flag.clone() };
        let result = threads(2).install(|| analyze(&site.grid(), &spec, &Watch::new(&flag, &observer)));
        prop_assert!(matches!(result, Ok(_) | Err(Stopped)));
        prop_assert!(result.is_ok() || flag.is_raised());
    }
}
