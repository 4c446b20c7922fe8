//! How good the results are: prints the tables of `docs/accuracy.md`, and with `--write` fills them in there.
//!
//! `just accuracy` runs it on all that the document tells. Every section is made from one argument, so each can be made
//! again by itself; what a person wrote around the tables stays. Each map is told on standard error.
//!
//! ```text
//! cargo run --release --example accuracy -- real drawings offices steadiness
//! cargo run --release --example accuracy -- drawings --seeds 21..28 --only pods
//! cargo run --release --example accuracy -- --zoo seen=1..2 --zoo unseen=5..6 --rotation 1
//! cargo run --release --example accuracy -- --generated seen=DIR --rooms --write
//! cargo run --release --example accuracy -- --layout 1..2 --layout-maps DIR
//! ```

#![allow(clippy::print_stderr, clippy::print_stdout, reason = "a tool of developers says what it does")]

mod document;
mod drawings;
mod drawn_truth;
mod layouts;
mod location_errors;
mod moved;
mod offices;
mod real;
mod room_scans;
mod rooms;
mod rotation;
mod scan;
mod sites;
mod steadiness;
mod tables;

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use clap::{Parser, ValueEnum};

use document::Document;
use stillage_core::{Analysis, OccupancyGrid};

/// Anything may be wrong with a file that a developer names.
type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// What is measured by its name alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Group {
    /// Real maps against truth that a person drew (`truth` of the shared folder).
    Real,
    /// Drawings of the zoo, by style.
    Drawings,
    /// Offices, where nothing is storage (`maps/dev` of the shared folder).
    Offices,
    /// Real maps and drawings turned and moved under the cells.
    Steadiness,
}

/// Measures accuracy, prints it and writes it into a document.
#[derive(Debug, Parser)]
struct Arguments {
    /// What to measure.
    groups: Vec<Group>,
    /// Seeds of the drawings.
    #[arg(long, value_name = "FIRST..LAST", default_value = "1..8")]
    seeds: Seeds,
    /// Of the groups only maps and styles whose names hold this text.
    #[arg(long, value_name = "TEXT", default_value = "", conflicts_with = "write")]
    only: String,
    /// The folder of real maps and their truth.
    #[arg(long, value_name = "DIR", env = "STILLAGE_SHARED", default_value = "../shared")]
    shared: PathBuf,
    /// Draws every map of the groups into a folder.
    #[arg(long, value_name = "DIR")]
    pictures: Option<PathBuf>,
    /// Fills the tables into the document, and draws the pictures that it shows.
    #[arg(long)]
    write: bool,
    /// Maps of `generate.py`, as NAME=DIR: fills the section `generated-NAME` from all folders
    /// `<size>_<sensor>_<difficulty>_<seed>` in DIR.
    #[arg(long, value_name = "NAME=DIR", value_parser = named::<PathBuf>)]
    generated: Vec<(String, PathBuf)>,
    /// Seeds of the zoo, as NAME=FIRST..LAST: fills the section `zoo-NAME`, without and with speckle.
    #[arg(long, value_name = "NAME=SEEDS", value_parser = named::<Seeds>)]
    zoo: Vec<(String, Seeds)>,
    /// Storage layouts of the zoo for some seeds, and of the maps of `--layout-maps`: fills the section `layout`.
    #[arg(long, value_name = "FIRST..LAST")]
    layout: Option<Seeds>,
    /// Folders of maps of `generate.py` for `--layout`.
    #[arg(long, value_name = "DIR", requires = "layout")]
    layout_maps: Vec<PathBuf>,
    /// Folder of maps of `generate.py` of the paper's size: fills the section `paper-size`.
    #[arg(long, value_name = "DIR")]
    paper_size: Option<PathBuf>,
    /// Seed of the zoo whose sites are turned: fills the section `rotation`.
    #[arg(long, value_name = "SEED")]
    rotation: Option<u64>,
    /// Real offices by rooms: fills the section `rooms`.
    #[arg(long)]
    rooms: bool,
    /// The document.
    #[arg(long, value_name = "FILE", default_value = "docs/accuracy.md")]
    document: PathBuf,
}

impl Arguments {
    /// The folder of the pictures that the document shows, where it is written.
    fn shown(&self) -> Option<PathBuf> {
        self.write.then(|| self.document.with_extension(""))
    }

    /// Draws an analysed map where every map is drawn.
    fn draw(&self, name: &str, grid: &OccupancyGrid, analysis: &Analysis) -> Outcome<()> {
        let Some(folder) = &self.pictures else { return Ok(()) };
        Ok(fs::write(folder.join(format!("{name}.png")), sites::picture(grid, analysis))?)
    }
}

/// Seeds from the first to the last.
#[derive(Debug, Clone, Copy)]
struct Seeds(u64, u64);

impl std::str::FromStr for Seeds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (first, last) = text.split_once("..").unwrap_or((text, text));
        let number = |text: &str| text.parse().map_err(|_| format!("{text} is no seed: write 1..3"));
        Ok(Self(number(first)?, number(last)?))
    }
}

fn named<T: std::str::FromStr>(text: &str) -> Result<(String, T), String> {
    let (name, value) = text.split_once('=').ok_or("has no name: write NAME=VALUE")?;
    let value = value.parse().map_err(|_| format!("{value} cannot be read"))?;
    Ok((name.to_owned(), value))
}

fn main() -> Outcome<()> {
    let arguments = Arguments::parse();
    let mut document = Document::read(&arguments.document)?;
    if let Some(folder) = &arguments.pictures {
        fs::create_dir_all(folder)?;
    }
    let mut tell = |section: &str, table: &str| {
        println!("{section}\n\n{table}");
        if arguments.write { document.fill(section, table) } else { Ok(()) }
    };
    for group in &arguments.groups {
        match group {
            Group::Real => tell("real", &real::real(&arguments)?)?,
            Group::Drawings => tell("drawings", &drawings::drawings(&arguments)?)?,
            Group::Offices => tell("offices", &offices::offices(&arguments)?)?,
            Group::Steadiness => tell("steadiness", &steadiness::steadiness(&arguments)?)?,
        }
    }
    for (name, seeds) in &arguments.zoo {
        let scores = sites::zoo(seeds.0..=seeds.1, arguments.shown().as_deref())?;
        tell(&format!("zoo-{name}"), &tables::zoo(&scores))?;
    }
    for (name, folder) in &arguments.generated {
        tell(&format!("generated-{name}"), &tables::generated(&sites::generated(folder)?))?;
    }
    if let Some(folder) = &arguments.paper_size {
        tell("paper-size", &tables::regions(&sites::generated(folder)?))?;
    }
    if let Some(seeds) = arguments.layout {
        tell("layout", &layouts::layouts(seeds.0..=seeds.1, &arguments.layout_maps)?)?;
    }
    if let Some(seed) = arguments.rotation {
        tell("rotation", &rotation::table(seed)?)?;
    }
    if arguments.rooms {
        tell("rooms", &rooms::table(&arguments.shared.join("maps/dev"))?)?;
        tell("room-scans", &room_scans::scans(&arguments.shared.join("maps/dev"))?)?;
    }
    if arguments.write { document.write() } else { Ok(()) }
}
