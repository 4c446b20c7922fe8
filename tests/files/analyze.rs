//! `stillage analyze` as a person runs it.

use std::path::Path;
use std::process::{Command, Output};

use expect_test::expect;
use serde_json::Value;

const METADATA: &str = "image: room.pgm\nresolution: 0.5\norigin: [-4.0, 1.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A folder with a map of two rooms.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let pixel = |index: usize| {
        let (column, row) = (index % 24, index / 24);
        let is_wall = column == 0 || column == 23 || row == 0 || row == 15 || (column == 11 && row != 7);
        if is_wall { 0 } else { 254 }
    };
    let mut image = b"P5 24 16 255\n".to_vec();
    image.extend((0..24 * 16).map(pixel));
    std::fs::write(folder.path().join("room.pgm"), image).unwrap();
    std::fs::write(folder.path().join("room.yaml"), METADATA).unwrap();
    folder
}

fn analyze(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stillage")).arg("analyze").args(arguments).current_dir(folder).output().unwrap()
}

#[test]
fn a_map_becomes_a_folder_of_layers_and_pictures() {
    let folder = folder();
    let output = analyze(folder.path(), &["room.yaml", "--threads", "1"]);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(output.stdout, b"room.stillage\n");
    let results = folder.path().join("room.stillage");
    let mut names: Vec<String> =
        results.read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort_unstable();
    expect!["aisles.geojson categories.png doors.geojson edges.geojson faces.geojson image.png lines.geojson links.geojson locations.csv locations.geojson nodes.geojson places.geojson regions.geojson regions.png report.json rows.geojson semantic.png semantic.svg vertices.geojson"].assert_eq(&names.join(" "));
    let json = |name: &str| -> Value { serde_json::from_slice(&std::fs::read(results.join(name)).unwrap()).unwrap() };
    let report = json("report.json");
    assert_eq!(report["cells"], 24 * 16);
    assert_eq!(report["map"]["origin"], serde_json::json!([-4.0, 1.0, 0.0]));
    assert_eq!(report["counts"]["faces"], json("faces.geojson")["features"].as_array().unwrap().len());
    // A second run replaces the files of the first, with the same bytes.
    let before = std::fs::read(results.join("faces.geojson")).unwrap();
    assert!(analyze(folder.path(), &["room.yaml", "--threads", "2"]).status.success());
    assert!(before == std::fs::read(results.join("faces.geojson")).unwrap());
}

#[test]
fn corrections_are_applied_and_those_that_do_not_fit_are_told() {
    let folder = folder();
    let write = |name: &str, content: &str| std::fs::write(folder.path().join(name), content).unwrap();
    // As a service answers them.
    let list = r#"{"version": 4, "corrections": [
        {"id": "c1", "kind": "draw", "ring": [[-2, 3], [0, 3], [0, 5], [-2, 5]], "label": "pc", "name": "Rack 12", "isApplied": true, "faces": [3]},
        {"id": "c2", "kind": "split", "line": [[50, 50], [60, 50]], "isApplied": false, "reason": "outside"}],
        "links": [{"href": "http://127.0.0.1/", "rel": "self", "type": "application/json"}]}"#;
    write("corrections.json", list);
    let output = analyze(folder.path(), &["room.yaml", "--corrections", "corrections.json"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    assert!(told.contains("warning: correction 2 does not fit and changes nothing: /line/0: the point lies"), "{told}");
    let json = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(folder.path().join("room.stillage").join(name)).unwrap()).unwrap()
    };
    let fits: Vec<Value> =
        json("report.json")["corrections"].as_array().unwrap().iter().map(|one| one["isApplied"].clone()).collect();
    assert_eq!(fits, [true, false]);
    let faces = json("faces.geojson");
    let is_rack = |face: &&Value| face["properties"]["name"] == "Rack 12" && face["properties"]["label"] == "pc";
    assert_eq!(faces["features"].as_array().unwrap().iter().filter(is_rack).count(), 1);

    let plan = r#"{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"name": "Rack 12"},
        "geometry": {"type": "Polygon", "coordinates": [[[-2, 3], [0, 3], [0, 5], [-2, 5], [-2, 3]]]}}]}"#;
    write("plan.geojson", plan);
    let exported = Command::new(env!("CARGO_BIN_EXE_stillage"))
        .args(["export", "room.yaml", "--format", "csv", "--out", "-", "--corrections", "plan.geojson"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(exported.status.success(), "{exported:?}");
    assert_eq!(String::from_utf8_lossy(&exported.stdout).lines().count(), 2, "a head and the rack: {exported:?}");

    write("wrong.geojson", &plan.replace(r#""name": "Rack 12""#, r#""label": "shelf""#));
    let refused = analyze(folder.path(), &["room.yaml", "--corrections", "wrong.geojson"]);
    expect![[r#"
        error: wrong.geojson: /features/0/properties/label: the rule set has no label "shelf": it has co, ju, pc, ro, un
    "#]]
    .assert_eq(&String::from_utf8_lossy(&refused.stderr));
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn the_report_tells_how_categories_were_found_and_relaxed() {
    let folder = folder();
    let options = r#"{"categorization": {"k": "auto", "maxK": 4, "clustering": "gaussianMixture", "relaxation": {}},
        "annotation": {"relaxation": {"iterations": 3}}}"#;
    std::fs::write(folder.path().join("options.json"), options).unwrap();
    let output = analyze(folder.path(), &["room.yaml", "--options", "options.json"]);
    assert!(output.status.success(), "{output:?}");
    let json = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(folder.path().join("room.stillage").join(name)).unwrap()).unwrap()
    };
    let report = json("report.json");
    assert_eq!(report["options"]["categorization"]["k"], "auto");
    let tried: Vec<&Value> =
        report["clustering"]["candidates"].as_array().unwrap().iter().map(|candidate| &candidate["k"]).collect();
    assert_eq!(tried, [2, 3, 4]);
    assert!(report["clustering"]["mixture"]["logLikelihood"].is_f64());
    assert_eq!(report["relaxation"]["cells"]["nodes"], report["freeCells"]);
    assert!(
        report["relaxation"]["cells"]["entropyAfter"].as_f64()
            < report["relaxation"]["cells"]["entropyBefore"].as_f64()
    );
    assert!(report["relaxation"]["faces"]["changedByIteration"].as_array().unwrap().len() <= 3);
    let faces = json("faces.geojson");
    let memberships = faces["features"].as_array().unwrap().iter().map(|face| &face["properties"]["membership"]);
    let sums = memberships.map(|shares| shares.as_array().unwrap().iter().filter_map(Value::as_f64).sum::<f64>());
    assert!(sums.into_iter().all(|sum| sum == 0.0 || (sum - 1.0).abs() < 1e-3));
}

#[test]
fn faults_of_the_input_end_with_2_and_a_sentence() {
    let folder = folder();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("flat.yaml", &METADATA.replace("0.5", "0"));
    write("lost.yaml", &METADATA.replace("room.pgm", "nowhere.pgm"));
    write("options.json", r#"{"categorization": {"k": 0}}"#);
    write("assignment.json", r#"{"assignment": {"0": "zz"}}"#);
    let report: String = [
        &["nowhere.yaml"][..],
        &["flat.yaml"],
        &["lost.yaml"],
        &["room.pgm"],
        &["room.yaml", "--rule-set", "garden"],
        &["room.yaml", "--options", "options.json"],
        &["room.yaml", "--out", "room.pgm"],
        &["room.yaml", "--assignment", "assignment.json"],
    ]
    .iter()
    .map(|arguments| {
        let output = analyze(folder.path(), arguments);
        let last = String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or_default().to_owned();
        format!("{} -> {}: {last}\n", arguments.join(" "), output.status.code().unwrap())
    })
    .collect();
    expect![[r#"
        nowhere.yaml -> 2: error: nowhere.yaml cannot be opened (No such file or directory (os error 2)): check the path
        flat.yaml -> 2: error: flat.yaml cannot be read as a map, at `/metadata/resolution`: the resolution is 0 m per cell, it must lie between 0.0001 and 100: give the side of a cell in metres
        lost.yaml -> 2: error: the image of lost.yaml, nowhere.pgm, is not there: put it beside the YAML file
        room.pgm -> 2: error: room.pgm is an image: name the YAML file beside it, which says its resolution
        room.yaml --rule-set garden -> 2: error: there is no rule set garden: name `site`, `warehouse`, `office`, or a JSON file
        room.yaml --options options.json -> 2: error: options.json: /categorization/k: 0 is outside 2 to 32
        room.yaml --out room.pgm -> 2: error: room.pgm is a file: name a folder with --out
        room.yaml --assignment assignment.json -> 2: error: the assignment does not fit this map: /assignment/0: no label has the id "zz"; there are co, ju, pc, ro, un
    "#]].assert_eq(&report);
}
