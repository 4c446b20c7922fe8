//! `stillage evaluate` as a person runs it.

use std::path::Path;
use std::process::{Command, Output};

use expect_test::expect;
use serde_json::Value;

/// Runs the command among the examples of the repository.
fn evaluate(arguments: &[&str]) -> Output {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    Command::new(env!("CARGO_BIN_EXE_stillage")).arg("evaluate").args(arguments).current_dir(examples).output().unwrap()
}

#[test]
fn the_example_is_compared_with_its_truth() {
    let output = evaluate(&["warehouse.yaml", "--truth", "warehouse.truth.geojson", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["geometry"]["places"], 198);
    for scores in [&report["automatic"], &report["decided"]] {
        // Seven places have less than half of their surroundings seen.
        assert_eq!((&scores["places"]["places"], &scores["regions"]["A"]["places"]), (&191.into(), &191.into()));
        assert!(scores["places"]["area"].as_f64() > Some(0.9), "{scores}");
        assert!(scores["f1"].as_f64() > Some(0.9), "{scores}");
        assert!(scores["iou"]["drivable"].as_f64() > Some(0.9), "{scores}");
    }
    assert!(report["geometry"]["orientationErrorDeg"].as_f64() < Some(0.1), "{report}");
    assert_eq!(report["geometry"]["falseOrientations"], 0);
}

#[test]
fn people_get_a_table() {
    let output = evaluate(&["warehouse.yaml", "--truth", "warehouse.truth.geojson"]);
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    // Its words; the figures are those of the day.
    let words: Vec<String> = text
        .lines()
        .map(|line| line.chars().filter(|character| !"0123456789.".contains(*character)).collect::<String>())
        .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
        .filter(|line| !line.starts_with("decided:"))
        .collect();
    expect![[r#"
        true places, faces, for each
        Borders in per cent: of the places' are faces', of the faces' are places'
        Orientations: off by degrees at most, of them false
        Occupancy: of places right in per cent; goods missed on , unknown on , seen on empty ones

        automatic decided
        F
        precision
        false cells
        slivers
        overlap of corridors
        overlap of junctions
        overlap of pallet cells
        overlap of drivable floor
        cogency
        all places: seen
        strict
        lax
        by area
        geometry
        systematic misses
    "#]]
    .assert_eq(&words.join("\n"));
}

#[test]
fn faults_of_the_input_end_with_2_and_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let empty = folder.path().join("empty.geojson");
    std::fs::write(&empty, r#"{"type": "FeatureCollection", "features": []}"#).unwrap();
    let report: String = [
        &["warehouse.yaml", "--truth", "nowhere.geojson"][..],
        &["warehouse.yaml", "--truth", "warehouse.yaml"],
        &["warehouse.yaml", "--truth", empty.to_str().unwrap()],
        &["warehouse.yaml", "--truth", "warehouse.truth.geojson", "--rule-set", "office"],
    ]
    .iter()
    .map(|arguments| {
        let output = evaluate(arguments);
        let last = String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or_default().to_owned();
        let last = last.replace(&*folder.path().to_string_lossy(), "..");
        format!("{} {last}\n", output.status.code().unwrap())
    })
    .collect();
    expect![[r#"
        2 error: nowhere.geojson cannot be opened (No such file or directory (os error 2)): check the path
        2 error: warehouse.yaml is not the JSON that is expected: expected value at line 1 column 1
        2 error: ../empty.geojson cannot be read as a truth, at `/features`: holds no feature labelled `pallet`, `corridor` or `junction`: there is nothing to compare with
        2 error: office: the rule set has no label pc: a truth of corridors (co), junctions (ju) and pallet cells (pc) needs all three
    "#]].assert_eq(&report);
}
