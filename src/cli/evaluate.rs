//! `stillage evaluate`: how well a map is read where the truth is known.

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use stillage_core::evaluation::{self, Evaluation, GeometryScores, LabelScores, PlaceScores};
use stillage_core::semantics::{self, RuleSet};
use stillage_core::watch::Watch;

use super::failure::Failure;
use super::progress::ProgressDisplay;
use super::{computation, input};
use crate::ingest;
use crate::views::evaluation::EvaluationView;

/// Arguments of `stillage evaluate`.
#[derive(Debug, clap::Args)]
pub(super) struct EvaluateArgs {
    /// The map: a `map_server` YAML file with its image beside it, or a `nav_msgs/OccupancyGrid` message as JSON.
    #[arg(value_name = "MAP")]
    map: PathBuf,
    /// The truth: GeoJSON in metres of the map frame, with features labelled pallet, corridor, junction and region.
    #[arg(long, value_name = "FILE")]
    truth: PathBuf,
    /// Prints the figures as JSON, as the service answers them.
    #[arg(long)]
    json: bool,
    /// Labels and their rules: `site`, `warehouse`, or a JSON file with labels `co`, `ju` and `pc`.
    #[arg(long, value_name = "ID|FILE", default_value = RuleSet::DEFAULT_ID)]
    rule_set: String,
    /// JSON file with options of the analysis: a preset, and what differs from it or from the defaults.
    #[arg(long, value_name = "FILE")]
    options: Option<PathBuf>,
    /// JSON file with one label per category, to be compared as well.
    #[arg(long, value_name = "FILE")]
    assignment: Option<PathBuf>,
    /// Threads to compute with; all cores when absent.
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

/// Runs the command.
pub(super) fn run(arguments: &EvaluateArgs) -> Result<(), Failure> {
    let spec = input::options(arguments.options.as_deref())?;
    let rule_set = input::rule_set(&arguments.rule_set)?;
    evaluation::check_rule_set(&rule_set)
        .map_err(|missing| Failure::Input(format!("{}: {missing}", arguments.rule_set)))?;
    let assignment = arguments.assignment.as_deref().map(input::assignment).transpose()?;
    let truth = ingest::ground_truth(&input::read_json(&arguments.truth)?).map_err(|error| {
        let path = arguments.truth.display();
        Failure::Input(format!("{path} cannot be read as a truth, at `{}`: {error}", error.pointer))
    })?;
    let source = input::map(&arguments.map)?;

    let progress = ProgressDisplay::new();
    let pool = computation::pool(arguments.threads)?;
    let analysis = computation::analyze(&arguments.map, source, &spec, &pool, &progress)?.analysis;
    let assigned = assignment.map(|assignment| semantics::apply(&analysis, &rule_set, &assignment)).transpose();
    let assigned = assigned.map_err(|problems| input::misfit(&problems))?;
    let evaluation = progress.clock().time("evaluation", || {
        pool.install(|| evaluation::evaluate(&analysis, &rule_set, assigned.as_ref(), &truth, &Watch::unwatched()))
    });
    progress.finish();
    let evaluation = evaluation.map_err(Failure::internal)?;
    if arguments.json {
        let text = serde_json::to_string_pretty(&EvaluationView::from(&evaluation)).map_err(Failure::internal)?;
        println!("{text}");
    } else {
        print!("{}", table(&evaluation));
    }
    Ok(())
}

/// The figures for people.
fn table(evaluation: &Evaluation) -> String {
    let mut columns = vec![("automatic", &evaluation.automatic), ("decided", &evaluation.decided)];
    columns.extend(evaluation.assigned.as_ref().map(|scores| ("assigned", scores)));
    let mut text = head(&evaluation.geometry);
    row(&mut text, "", columns.iter().map(|(name, _)| (*name).to_owned()));
    let mut line = |name: &str, value: &dyn Fn(&LabelScores) -> String| {
        row(&mut text, name, columns.iter().map(|(_, scores)| value(scores)));
    };
    line("F1", &|scores| percent(scores.f1));
    line("precision", &|scores| percent(scores.precision));
    line("false cells", &|scores| scores.false_cells.to_string());
    line("slivers", &|scores| scores.slivers.to_string());
    line("overlap of corridors", &|scores| percent(scores.overlap.corridor));
    line("overlap of junctions", &|scores| percent(scores.overlap.junction));
    line("overlap of pallet cells", &|scores| percent(scores.overlap.pallet_cell));
    line("overlap of drivable floor", &|scores| percent(scores.overlap.drivable));
    line("cogency", &|scores| scores.cogency.map_or_else(none, percent));
    places(&mut text, &columns, "all places", |scores| scores.places.as_ref());
    let regions = &evaluation.automatic.regions;
    for name in regions.keys().filter(|_| regions.len() > 1) {
        places(&mut text, &columns, &format!("region {name}"), |scores| scores.regions.get(name));
    }
    let decision = evaluation.decision.assignment.iter();
    let decision: Vec<String> = decision.map(|(category, label)| format!("{category} {label}")).collect();
    let _ = writeln!(text, "\ndecided: {}", decision.join(", "));
    text
}

/// The decomposition in a few sentences.
fn head(geometry: &GeometryScores) -> String {
    let GeometryScores { faces, places, .. } = geometry;
    let each = geometry.faces_per_place.map(|ratio| format!(", {ratio:.1} for each")).unwrap_or_default();
    let share = |value: Option<f64>| value.map_or_else(none, percent);
    let (recall, precision) = (share(geometry.boundary_recall), share(geometry.boundary_precision));
    let mut text = format!("{places} true places, {faces} faces{each}.\n");
    let _ = writeln!(
        text,
        "Borders in per cent: {recall} of the places' are faces', {precision} of the faces' are places'."
    );
    if let (Some(error), Some(wrong)) = (geometry.orientation_error, geometry.false_orientations) {
        let degrees = error.to_degrees();
        let _ = writeln!(text, "Orientations: off by {degrees:.3} degrees at most, {wrong} of them false.");
    }
    if let Some(occupancy) = geometry.occupancy {
        let ([_, missed, unseen], [false_goods, _, _]) = (occupancy.occupied, occupancy.empty);
        let _ = writeln!(
            text,
            "Occupancy: {} of {} places right in per cent; goods missed on {}, unknown on {unseen}, seen on {false_goods} \
             empty ones.",
            percent(occupancy.accuracy),
            occupancy.places,
            missed,
        );
    }
    text + "\n"
}

/// How places were found, all or those of a region.
fn places<'a>(
    text: &mut String,
    columns: &[(&str, &'a LabelScores)],
    title: &str,
    of: impl Fn(&'a LabelScores) -> Option<&'a PlaceScores>,
) {
    let seen = columns.first().and_then(|(_, scores)| of(scores)).map_or(0, |places| places.places);
    let _ = writeln!(text, "{title}: {seen} seen");
    let names = ["strict", "lax", "by area", "geometry", "systematic misses"];
    for (index, name) in names.into_iter().enumerate() {
        let figures = |places: &PlaceScores| {
            [places.strict, places.lax, places.area, places.geometry, places.systematic].map(percent)
        };
        let value =
            |&(_, scores): &(&str, &'a LabelScores)| of(scores).map_or_else(none, |it| figures(it)[index].clone());
        row(text, &format!("  {name}"), columns.iter().map(value));
    }
}

fn row(text: &mut String, name: &str, values: impl Iterator<Item = String>) {
    let values: String = values.map(|value| format!("{value:>11}")).collect();
    let _ = writeln!(text, "{name:<26}{values}");
}

fn percent(share: f64) -> String {
    format!("{:.1}", share * 100.0)
}

/// Where there is nothing to count.
fn none() -> String {
    "-".to_owned()
}
