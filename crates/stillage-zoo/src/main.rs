//! `stillage-zoo`: writes generated maps with their truth.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the command line talks to people")]

use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use rayon::prelude::*;
use stillage_zoo::{Kind, Options, Sample, generate};

/// Generates maps of warehouses with their truth.
///
/// Each map is a folder with map.pgm, map.yaml, truth.geojson (metres of the map frame) and meta.json.
#[derive(Debug, Parser)]
#[command(name = "stillage-zoo", version)]
struct Arguments {
    /// Lists the kinds.
    #[arg(long, exclusive = true)]
    list: bool,
    /// Kind of the site.
    #[arg(long, required_unless_present_any = ["list", "all"])]
    kind: Option<Kind>,
    /// All kinds, each in its folder OUT/<kind>_<seed>.
    #[arg(long, conflicts_with = "kind")]
    all: bool,
    /// Seed of one map.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Seeds of several maps, `1..3` with both ends, each in its folder OUT/<kind>_<seed>.
    #[arg(long, value_parser = seeds, conflicts_with = "seed")]
    seeds: Option<RangeInclusive<u64>>,
    /// Share of the cells turned to salt or pepper.
    #[arg(long, default_value_t = 0.0)]
    speckle: f64,
    /// Side of a cell, metres.
    #[arg(long, default_value_t = 0.05)]
    resolution: f64,
    /// Turn of the hall in the map, degrees; drawn when absent.
    #[arg(long, allow_negative_numbers = true)]
    rotation: Option<f64>,
    /// Field of view of the scanner, degrees; 270 or 360 when absent.
    #[arg(long)]
    fov: Option<u32>,
    /// Share of the pallets that show a load instead of legs; drawn when absent.
    #[arg(long)]
    boxes: Option<f64>,
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
        return ExitCode::SUCCESS;
    }
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let options = Options {
        resolution: arguments.resolution,
        speckle: arguments.speckle,
        rotation_deg: arguments.rotation,
        field_of_view: arguments.fov,
        boxes: arguments.boxes,
    };
    check(&options)?;
    let out = arguments.out.as_deref().unwrap_or(Path::new("."));
    let kinds = arguments.kind.map_or_else(|| Kind::ALL.to_vec(), |kind| vec![kind]);
    let seeds = arguments.seeds.clone().unwrap_or(arguments.seed..=arguments.seed);
    let several = arguments.all || arguments.seeds.is_some();
    let jobs: Vec<(Kind, u64)> = kinds.iter().flat_map(|&kind| seeds.clone().map(move |seed| (kind, seed))).collect();
    let lines: Result<Vec<String>, String> = jobs
        .par_iter()
        .map(|&(kind, seed)| {
            let folder = if several { out.join(format!("{kind}_{seed}")) } else { out.to_owned() };
            let sample = generate(kind, seed, &options);
            write(&folder, &sample, arguments.picture)
                .map_err(|error| format!("{} cannot be written: {error}", folder.display()))?;
            let meta = &sample.meta;
            let [width, height] = [meta.width, meta.height].map(|cells| cells as f64 * meta.resolution);
            Ok(format!(
                "{}: {width:.0} m x {height:.0} m, {} places, {} degrees, {}, {} scans",
                folder.display(),
                meta.pallets,
                meta.fov,
                meta.sensor,
                meta.poses
            ))
        })
        .collect();
    lines?.iter().for_each(|line| println!("{line}"));
    Ok(())
}

fn check(options: &Options) -> Result<(), String> {
    let share = |value: f64| (0.0..=1.0).contains(&value);
    match options {
        options if !(0.01..=0.5).contains(&options.resolution) => Err("--resolution is between 0.01 and 0.5".into()),
        options if !share(options.speckle) => Err("--speckle is between 0 and 1".into()),
        options if !options.boxes.is_none_or(share) => Err("--boxes is between 0 and 1".into()),
        options if !options.field_of_view.is_none_or(|degrees| (1..=360).contains(&degrees)) => {
            Err("--fov is between 1 and 360".into())
        }
        _ => Ok(()),
    }
}

fn write(folder: &Path, sample: &Sample, picture: bool) -> Result<(), Box<dyn Error>> {
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
