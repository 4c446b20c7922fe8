//! `stillage export` as a person runs it.

use std::path::Path;
use std::process::{Command, Output};

const METADATA: &str = "image: hall.pgm\nresolution: 0.25\norigin: [-2.0, -1.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A folder with a map of a hall: two rows of pallets, ways around them.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let pixel = |index: usize| {
        let (column, row) = (index % 62, index / 62);
        let is_wall = column == 0 || column == 61 || row == 0 || row == 21;
        let is_pallet =
            [5..9, 13..17].iter().any(|rows| rows.contains(&row)) && (5..55).contains(&column) && column % 5 < 3;
        if is_wall || is_pallet { 0 } else { 254 }
    };
    let mut image = b"P5 62 22 255\n".to_vec();
    image.extend((0..62 * 22).map(pixel));
    std::fs::write(folder.path().join("hall.pgm"), image).unwrap();
    std::fs::write(folder.path().join("hall.yaml"), METADATA).unwrap();
    folder
}

fn export(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stillage")).arg("export").args(arguments).current_dir(folder).output().unwrap()
}

fn refused(arguments: &[&str]) -> String {
    let folder = folder();
    let output = export(folder.path(), arguments);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert_eq!(folder.path().read_dir().unwrap().count(), 2, "nothing is written");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn formats_are_listed_without_a_map() {
    let output = export(Path::new("."), &["--format", "list"]);
    let text = String::from_utf8(output.stdout).unwrap();
    for line in ["lif ", "nav2-route ", "    profile=odoo: "] {
        assert!(text.lines().any(|found| found.starts_with(line)), "{line}: {text}");
    }
}

#[test]
fn a_map_becomes_files_and_the_same_bytes_on_any_number_of_threads() {
    let folder = folder();
    let all = |out: &str, threads: &str| {
        let output = export(folder.path(), &["hall.yaml", "--format", "all", "--out", out, "--threads", threads]);
        assert!(output.status.success(), "{output:?}");
        // Nobody says where vehicles would fetch the bundle.
        assert!(
            String::from_utf8(output.stderr)
                .unwrap()
                .contains("vda5050-download-map.json is left out: link is missing")
        );
        let files = folder.path().join(out).read_dir().unwrap().map(|entry| entry.unwrap().path());
        let mut files: Vec<_> =
            files.map(|path| (path.file_name().unwrap().to_owned(), std::fs::read(path).unwrap())).collect();
        files.sort();
        files
    };
    let files = all("one", "1");
    assert_eq!(files.len(), 16);
    assert!(files == all("two", "2"));
    let csv = &files.iter().find(|(name, _)| name == "locations.csv").unwrap().1;
    let alone = export(folder.path(), &["hall.yaml", "--format", "csv", "--out", "-"]);
    assert!(alone.status.success() && alone.stdout == *csv, "{:?}", alone.stderr);
}

#[test]
fn what_is_wrong_is_said_before_the_work() {
    assert!(refused(&["--format", "lif"]).contains("name the map file"));
    assert!(refused(&["hall.yaml", "--format", "lift"]).contains("there is no format lift: name lif, lif-2.0,"));
    assert!(refused(&["hall.yaml", "--format", "lif", "--set", "profile=odoo"]).contains("which has footprintRadiusM"));
    assert!(refused(&["hall.yaml", "--format", "csv", "--set", "profile"]).contains("must be NAME=VALUE"));
    assert!(refused(&["nowhere.yaml", "--format", "lif"]).contains("nowhere.yaml cannot be opened"));
}
