//! Lists the files that the dashboard's page loads (`web/dist/assets`) for `http::dashboard`, which embeds them: their names
//! carry a hash of their content.

#![allow(clippy::print_stdout, reason = "it is how a build script speaks to cargo")]

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=web/dist");
    println!("cargo::rerun-if-changed=build.rs");
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("web/dist/assets");
    let mut paths: Vec<_> =
        fs::read_dir(&folder)?.map(|entry| Ok(entry?.path())).collect::<Result<_, std::io::Error>>()?;
    paths.sort();
    let mut list = String::from("&[");
    for path in &paths {
        let name = path.file_name().ok_or("a file has a name")?.to_string_lossy();
        let path = path.to_string_lossy();
        write!(list, "({name:?}, include_bytes!({path:?})),")?;
    }
    list.push(']');
    fs::write(Path::new(&env::var("OUT_DIR")?).join("dashboard_assets.rs"), list)?;
    Ok(())
}
