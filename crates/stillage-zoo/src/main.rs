//! `stillage-zoo`: writes generated maps with their truth.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the command line talks to people")]

use std::error::Error;
use std::fmt::Display;
use std::fs::{self, File};
use std::io::BufWriter;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use rayon::prelude::*;
use serde::Serialize;
use stillage_zoo::{DrawingOptions, DrawingStyle, Kind, Options, Outside, Sample, draw, generate};

/// Generates maps of warehouses with their truth: sites as a robot maps them (kinds), and plain drawings (styles).
///
/// Each map is a folder with map.pgm, map.yaml, truth.geojson (metres of the map frame) and meta.json.
#[derive(Debug, Parser)]
#[command(name = "stillage-zoo", version)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
struct Arguments {
    /// Lists the kinds and the styles.
    #[arg(long, exclusive = true)]
    list: bool,
    /// Kind of a simulated site.
    #[arg(long, required_unless_present_any = ["list", "all", "style", "all_styles"])]
    kind: Option<Kind>,
    /// All kinds, each in its folder OUT/<kind>_<seed>.
    #[arg(long, conflicts_with = "kind")]
    all: bool,
    /// Style of a drawing.
    #[arg(long, conflicts_with_all = ["kind", "all", "speckle", "fov", "boxes", "exact_poses"])]
    style: Option<DrawingStyle>,
    /// Drawings in all styles, each in its folder OUT/<style>_<seed>.
    #[arg(long, conflicts_with_all = ["kind", "all", "style", "speckle", "fov", "boxes", "exact_poses"])]
    all_styles: bool,
    /// Seed of one map.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Seeds of several maps, `1..3` with both ends, each in its folder OUT/<kind>_<seed>.
    #[arg(long, value_parser = seeds, conflicts_with = "seed")]
    seeds: Option<RangeInclusive<u64>>,
    /// Share of the cells turned to salt or pepper.
    #[arg(long, default_value_t = 0.0)]
    speckle: f64,
    /// Side of a cell, metres; when absent 0.05 for a site, drawn for a drawing.
    #[arg(long)]
    resolution: Option<f64>,
    /// Turn of the hall in the map, degrees; drawn when absent.
    #[arg(long, allow_negative_numbers = true)]
    rotation: Option<f64>,
    /// Field of view of the scanner, degrees; 270 or 360 when absent.
    #[arg(long)]
    fov: Option<u32>,
    /// Share of the pallets that show a load instead of legs; drawn when absent.
    #[arg(long)]
    boxes: Option<f64>,
    /// The robot knows exactly where it is: the map is not bent.
    #[arg(long)]
    exact_poses: bool,
    /// What a drawing shows beyond the walls: unknown, black or white; drawn when absent.
    #[arg(long, conflicts_with_all = ["kind", "all"])]
    outside: Option<Outside>,
    /// Also writes truth.png, the map with its truth over it.
    #[arg(long)]
    picture: bool,
    /// Folder to write into.
    #[arg(long, required_unless_present = "list")]
    out: Option<PathBuf>,
}

/// Reads `1..3` (both ends belong to it) or `2`.
fn seeds(text: &str) -> Result<RangeInclusive<u64>, String> {
    let number = |text: &str| text.parse::<u64>().map_err(|_| format!("{text} is not a number: write 1..3"));
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let range = number(first)?..=number(last)?;
    if range.is_empty() { Err(format!("{text} holds no seed: write 1..3")) } else { Ok(range) }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.list {
        for kind in Kind::ALL {
            println!("{:<16}{}", kind.name(), kind.description());
        }
        for style in DrawingStyle::ALL {
            println!("{:<16}drawing: {}", style.name(), style.description());
        }
        return ExitCode::SUCCESS;
    }
    let written =
        if arguments.style.is_some() || arguments.all_styles { drawings(&arguments) } else { sites(&arguments) };
    match written {
        Ok(lines) => {
            for line in lines {
                println!("{line}");
            }
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

/// Writes simulated sites, and describes each in a line.
fn sites(arguments: &Arguments) -> Result<Vec<String>, String> {
    let defaults = Options::default();
    let options = Options {
        resolution: arguments.resolution.unwrap_or(defaults.resolution),
        speckle: arguments.speckle,
        rotation_deg: arguments.rotation,
        field_of_view: arguments.fov,
        boxes: arguments.boxes,
        exact_poses: arguments.exact_poses,
    };
    check(&options)?;
    let kinds = arguments.kind.map_or_else(|| Kind::ALL.to_vec(), |kind| vec![kind]);
    write_all(
        arguments,
        &kinds,
        arguments.all,
        |kind, seed| generate(kind, seed, &options),
        |sample| {
            let meta = &sample.meta;
            format!("{} places, {} degrees, {}, {} scans", meta.pallets, meta.fov, meta.sensor, meta.poses)
        },
    )
}

/// Writes drawings, and describes each in a line.
fn drawings(arguments: &Arguments) -> Result<Vec<String>, String> {
    check_resolution(arguments.resolution)?;
    let options = DrawingOptions {
        resolution: arguments.resolution,
        rotation_deg: arguments.rotation,
        outside: arguments.outside,
        ..DrawingOptions::default()
    };
    let styles = arguments.style.map_or_else(|| DrawingStyle::ALL.to_vec(), |style| vec![style]);
    write_all(
        arguments,
        &styles,
        arguments.all_styles,
        |style, seed| draw(style, seed, &options),
        |sample| {
            let meta = &sample.meta;
            format!(
                "{} places, {} rows, aisles of {:.2} m, cells of {:.3} m",
                meta.places, meta.rows, meta.aisle, meta.resolution
            )
        },
    )
}

/// Writes a map for each subject and seed.
fn write_all<S: Copy + Display + Sync, M: Serialize>(
    arguments: &Arguments,
    subjects: &[S],
    all: bool,
    make: impl Fn(S, u64) -> Sample<M> + Sync,
    describe: impl Fn(&Sample<M>) -> String + Sync,
) -> Result<Vec<String>, String> {
    let out = arguments.out.as_deref().unwrap_or(Path::new("."));
    let seeds = arguments.seeds.clone().unwrap_or(arguments.seed..=arguments.seed);
    let several = all || arguments.seeds.is_some();
    let jobs: Vec<(S, u64)> =
        subjects.iter().flat_map(|&subject| seeds.clone().map(move |seed| (subject, seed))).collect();
    let one = |&(subject, seed): &(S, u64)| {
        let folder = if several { out.join(format!("{subject}_{seed}")) } else { out.to_owned() };
        let sample = make(subject, seed);
        write(&folder, &sample, arguments.picture)
            .map_err(|error| format!("{} cannot be written: {error}", folder.display()))?;
        let (width, height) = sample.size();
        let [width, height] = [width, height].map(|cells| cells as f64 * sample.resolution());
        Ok(format!("{}: {width:.0} m x {height:.0} m, {}", folder.display(), describe(&sample)))
    };
    jobs.par_iter().map(one).collect()
}

fn check_resolution(resolution: Option<f64>) -> Result<(), String> {
    let fits = resolution.is_none_or(|resolution| (0.01..=0.5).contains(&resolution));
    if fits { Ok(()) } else { Err("--resolution is between 0.01 and 0.5".into()) }
}

fn check(options: &Options) -> Result<(), String> {
    check_resolution(Some(options.resolution))?;
    let share = |value: f64| (0.0..=1.0).contains(&value);
    match options {
        options if !share(options.speckle) => Err("--speckle is between 0 and 1".into()),
        options if !options.boxes.is_none_or(share) => Err("--boxes is between 0 and 1".into()),
        options if !options.field_of_view.is_none_or(|degrees| (1..=360).contains(&degrees)) => {
            Err("--fov is between 1 and 360".into())
        }
        _ => Ok(()),
    }
}

fn write<M: Serialize>(folder: &Path, sample: &Sample<M>, picture: bool) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("map.pgm"), sample.pgm())?;
    fs::write(folder.join("map.yaml"), sample.yaml())?;
    fs::write(folder.join("truth.geojson"), serde_json::to_vec(&sample.truth)?)?;
    fs::write(folder.join("meta.json"), serde_json::to_vec_pretty(&sample.meta)?)?;
    if picture {
        let (width, height) = sample.size();
        let file = BufWriter::new(File::create(folder.join("truth.png"))?);
        let mut encoder = png::Encoder::new(file, u32::try_from(width)?, u32::try_from(height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header()?.write_image_data(&sample.overlay())?;
    }
    Ok(())
}
