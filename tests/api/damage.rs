//! Blobs that are damaged or missing: the answer says which, and the service mends what it can.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Duration;

use crate::client::{Api, HALL, METADATA, pgm, upload};

/// The files of all blobs.
fn blobs(api: &Api) -> BTreeSet<PathBuf> {
    let files =
        |folder: PathBuf| std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("a file").path());
    files(api.app.config().blobs.folder().expect("files").to_owned()).flat_map(files).collect()
}

/// Uploads a map and analyses it: its path, the blobs of its upload and of its analysis.
async fn analysed(api: &Api, picture: &str) -> (String, PathBuf, PathBuf) {
    let before = blobs(api);
    let answer = api.send(upload(&pgm(picture), METADATA)).await;
    let with_upload = blobs(api);
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let all = blobs(api);
    let source = with_upload.difference(&before).next().expect("an upload").clone();
    let analysis = all.difference(&with_upload).next().expect("an analysis").clone();
    (format!("/v1/maps/{}", answer.json()["mapId"].as_str().expect("an id")), source, analysis)
}

#[tokio::test]
async fn an_analysis_that_is_damaged_or_missing_is_made_again() {
    let api = Api::new().await;
    for (picture, damage) in [(HALL.to_owned(), true), (HALL.replace("###..###", "###..#.#"), false)] {
        let (map, _, blob) = analysed(&api, &picture).await;
        let whole = std::fs::read(&blob).expect("is there");
        if damage {
            std::fs::write(&blob, &whole[..whole.len() / 2]).expect("can be written");
        } else {
            std::fs::remove_file(&blob).expect("can be removed");
        }
        let faces = format!("{map}/collections/faces/items");
        let problem = api.get(&faces).await;
        assert!(problem.header("retry-after").parse::<u32>().is_ok());
        let detail = problem.problem(503, "unavailable")["detail"].as_str().expect("a text").to_owned();
        assert!(detail.contains(map.trim_start_matches("/v1/maps/")) && detail.contains("made again"), "{detail}");
        let mended = async {
            while api.get(&faces).await.status != 200 {
                tokio::time::sleep(Duration::from_millis(50)).await;
            }
        };
        tokio::time::timeout(Duration::from_mins(1), mended).await.expect("it is made again");
        assert_eq!(std::fs::read(&blob).expect("is there"), whole, "to the byte");
    }
}

#[tokio::test]
async fn an_upload_that_is_damaged_is_mended_by_the_same_files() {
    let api = Api::new().await;
    let (map, blob, _) = analysed(&api, HALL).await;
    std::fs::write(&blob, b"nothing").expect("can be written");
    let problem = api.get(&format!("{map}/image.png")).await.problem(500, "damaged");
    let detail = problem["detail"].as_str().expect("a text");
    assert!(
        detail.contains(map.trim_start_matches("/v1/maps/")) && detail.contains("upload the same files"),
        "{detail}"
    );
    assert_eq!(api.send(upload(&pgm(HALL), METADATA)).await.status, 202);
    assert_eq!(api.get(&format!("{map}/image.png")).await.status, 200);
}
