//! How good the results are: fills the tables of `docs/accuracy.md` and draws its pictures.
//!
//! `just accuracy` runs it on all that the document tells. Every section is made from one argument, so each can be made
//! again by itself; what a person wrote around the tables stays.
//!
//! ```text
//! cargo run --release --example accuracy -- --zoo seen=1..2 --zoo unseen=5..6 --rotation 1
//! cargo run --release --example accuracy -- --generated seen=DIR --real ../shared/maps/dev
//! ```

#![allow(clippy::print_stderr, reason = "a tool of developers says what it does")]

mod document;
mod rooms;
mod rotation;
mod sites;
mod tables;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Parser;

use document::Document;

/// Anything may be wrong with a file that a developer names.
type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// Measures accuracy and writes it into a document.
#[derive(Debug, Parser)]
struct Arguments {
    /// Maps of `generate.py`, as NAME=DIR: fills the section `generated-NAME` from all folders
    /// `<size>_<sensor>_<difficulty>_<seed>` in DIR.
    #[arg(long, value_name = "NAME=DIR", value_parser = named::<PathBuf>)]
    generated: Vec<(String, PathBuf)>,
    /// Seeds of the zoo, as NAME=FIRST..LAST: fills the section `zoo-NAME`, without and with speckle.
    #[arg(long, value_name = "NAME=SEEDS", value_parser = named::<Seeds>)]
    zoo: Vec<(String, Seeds)>,
    /// Folder of maps of `generate.py` of the paper's size: fills the section `paper-size`.
    #[arg(long, value_name = "DIR")]
    paper_size: Option<PathBuf>,
    /// Seed of the zoo whose sites are turned: fills the section `rotation`.
    #[arg(long, value_name = "SEED")]
    rotation: Option<u64>,
    /// Folder of real maps: fills the section `rooms`, and draws the pictures of those that the document shows.
    #[arg(long, value_name = "DIR")]
    real: Option<PathBuf>,
    /// The document.
    #[arg(long, value_name = "FILE", default_value = "docs/accuracy.md")]
    document: PathBuf,
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
    let pictures = arguments.document.with_extension("");
    for (name, folder) in &arguments.generated {
        let scores = sites::generated(folder)?;
        document.fill(&format!("generated-{name}"), &tables::generated(&scores))?;
    }
    for (name, seeds) in &arguments.zoo {
        let scores = sites::zoo(seeds.0..=seeds.1, &pictures)?;
        document.fill(&format!("zoo-{name}"), &tables::zoo(&scores))?;
    }
    if let Some(folder) = &arguments.paper_size {
        document.fill("paper-size", &tables::regions(&sites::generated(folder)?))?;
    }
    if let Some(seed) = arguments.rotation {
        document.fill("rotation", &rotation::table(seed)?)?;
    }
    if let Some(folder) = &arguments.real {
        document.fill("rooms", &rooms::table(folder)?)?;
        draw_real_maps(folder, &pictures)?;
    }
    document.write()
}

/// Draws the real maps that the document shows: those that may be copied.
fn draw_real_maps(folder: &Path, pictures: &Path) -> Outcome<()> {
    const SHOWN: [&str; 6] = [
        "warehouse__svl_warehouse_dt_pallets",
        "warehouse__nav2_depot",
        "warehouse__isaac_iw_hub_warehouse",
        "warehouse__aws_small_005_rotated",
        "warehouse__aws_bookstore",
        "warehouse__tuw_warehouse_grid",
    ];
    for name in SHOWN {
        let site = sites::read(&folder.join(name).join("map.yaml"))?;
        let result = sites::analyzed(&site.grid, &stillage_core::AnalysisSpec::default())?;
        fs::write(pictures.join(format!("{name}.png")), sites::picture(&site.grid, &result))?;
    }
    Ok(())
}
