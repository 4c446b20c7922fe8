//! Maps on their way in: what is taken, and what is refused how.

use axum::body::Body;
use axum::http::Method;
use serde_json::json;

use crate::client::{Api, HALL, METADATA, form, pgm, request, upload};

#[tokio::test]
async fn an_upload_is_stored_and_queued() {
    let api = Api::new().await;
    let answer = api.send(upload(&pgm(HALL), METADATA)).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    let job = answer.json();
    assert_eq!(answer.header("location"), format!("/v1/jobs/{}", job["jobID"].as_str().expect("an id")));
    for (member, value) in [("processID", "semantic-map"), ("type", "process"), ("status", "accepted")] {
        assert_eq!(job[member], value);
    }
    let map = api.get(&format!("/v1/maps/{}", job["mapId"].as_str().expect("an id"))).await.json();
    assert_eq!(map["name"], "hall", "the name of the file");
    assert_eq!((&map["width"], &map["height"], &map["resolutionM"]), (&json!(62), &json!(22), &json!(0.25)));
    assert_eq!(map["georeference"]["status"], "nominal");
    assert_eq!(map.get("analysisId"), None);
}

#[tokio::test]
async fn a_form_carries_name_options_and_georeference() {
    let api = Api::new().await;
    let parts: [Part<'_>; 5] = [
        ("image", Some("x.pgm"), &pgm(HALL)),
        ("metadata", None, METADATA.as_bytes()),
        ("name", None, "Halle 3 – Süd".as_bytes()),
        ("options", None, br#"{"categorization": {"k": 3}}"#),
        ("georeference", None, br#"{"lon": 12.86, "lat": 56.66, "heading": 30}"#),
    ];
    let answer = api.send(form(&parts)).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    let path = format!("/v1/maps/{}", answer.json()["mapId"].as_str().expect("an id"));
    let map = api.get(&path).await.json();
    assert_eq!(map["name"], "Halle 3 – Süd");
    assert_eq!(map["georeference"], json!({"status": "surveyed", "lon": 12.86, "lat": 56.66, "heading": 30.0}));
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let analyses = api.get(&format!("{path}/analyses")).await.json();
    assert_eq!(analyses["analyses"][0]["options"]["categorization"]["k"], 3);
}

#[tokio::test]
async fn a_message_of_ros_is_taken_too() {
    let api = Api::new().await;
    let message = json!({
        "header": {"frame_id": "map"},
        "info": {"resolution": 0.25, "width": 3, "height": 2,
            "origin": {"position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}},
        "data": [0, 0, 100, -1, 0, 100],
    });
    let answer = api.send_json(Method::POST, "/v1/maps?name=dock", &[], &message).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    let map = api.get(&format!("/v1/maps/{}", answer.json()["mapId"].as_str().expect("an id"))).await.json();
    assert_eq!((&map["name"], &map["width"], &map["height"]), (&json!("dock"), &json!(3), &json!(2)));
}

#[tokio::test]
async fn an_idempotency_key_makes_one_job() {
    let api = Api::new().await;
    let with_key = |name: &'static [u8]| {
        let parts: [Part<'_>; 3] =
            [("image", None, &pgm(HALL)), ("metadata", None, METADATA.as_bytes()), ("name", None, name)];
        let mut request = form(&parts);
        request.headers_mut().insert("idempotency-key", "upload-7".parse().expect("is a header"));
        request
    };
    let first = api.send(with_key(b"hall")).await;
    let second = api.send(with_key(b"hall")).await;
    assert_eq!((first.status.as_u16(), second.status.as_u16()), (202, 202));
    assert_eq!(first.json()["jobID"], second.json()["jobID"]);
    assert_eq!((first.header("idempotent-replayed"), second.header("idempotent-replayed")), ("", "true"));
    assert_eq!(api.get("/v1/maps").await.json()["maps"].as_array().map(Vec::len), Some(1));
    api.send(with_key(b"another hall")).await.problem(422, "invalid");
    let mut empty = upload(&pgm(HALL), METADATA);
    empty.headers_mut().insert("idempotency-key", "".parse().expect("is a header"));
    api.send(empty).await.problem(400, "bad-request");
}

/// Name, file name and content of a part.
type Part<'a> = (&'a str, Option<&'a str>, &'a [u8]);

/// A grey PNG of 8 x 8 pixels.
fn png_file() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 8, 8);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[254; 64]).expect("pixels");
    writer.finish().expect("an end");
    bytes
}

/// The same, whose header says that it is far larger.
fn png_bomb(side: u32) -> Vec<u8> {
    let mut bytes = png_file();
    bytes[16..20].copy_from_slice(&side.to_be_bytes());
    bytes[20..24].copy_from_slice(&side.to_be_bytes());
    let checksum = bytes[12..29].iter().fold(u32::MAX, |checksum, &byte| {
        (0..8).fold(checksum ^ u32::from(byte), |rest, _| (rest >> 1) ^ (0xEDB8_8320 * (rest & 1)))
    });
    bytes[29..33].copy_from_slice(&(!checksum).to_be_bytes());
    bytes
}

#[tokio::test]
async fn what_is_no_map_is_refused_with_a_reason() {
    let api = Api::with(|config| config.limits.max_cells = 1_000_000).await;
    let hall = pgm(HALL);
    let whole = png_file();
    let truncated = &whole[..whole.len() - 20];
    let metadata = |from: &str, to: &str| METADATA.replace(from, to);
    #[allow(clippy::type_complexity, reason = "a table")]
    let cases: [(&str, &[u8], String, u16, &str, &str); 11] = [
        ("not an image", b"hello", METADATA.into(), 415, "unsupported-media-type", "/image"),
        ("an empty image", b"", METADATA.into(), 422, "invalid", "/image"),
        ("a truncated image", truncated, METADATA.into(), 422, "invalid", "/image"),
        ("a truncated PGM", &hall[..200], METADATA.into(), 422, "invalid", "/image"),
        ("a decompression bomb", &png_bomb(60_000), METADATA.into(), 413, "too-large", "/image"),
        ("0 x 0", b"P5\n0 0\n255\n", METADATA.into(), 422, "invalid", "/image"),
        ("resolution nan", &hall, metadata("0.25", ".nan"), 422, "invalid", "/metadata/resolution"),
        ("resolution 0", &hall, metadata("0.25", "0"), 422, "invalid", "/metadata/resolution"),
        ("no resolution", &hall, metadata("resolution: 0.25\n", ""), 422, "invalid", "/metadata/resolution"),
        ("no origin", &hall, metadata("origin: [-2.0, -1.0, 0.0]\n", ""), 422, "invalid", "/metadata/origin"),
        ("metadata that is none", &hall, "just words".into(), 422, "invalid", "/metadata"),
    ];
    for (name, image, metadata, status, kind, pointer) in cases {
        let answer = api.send(upload(image, &metadata)).await;
        assert_eq!(answer.status.as_u16(), status, "{name}: {}", answer.text());
        let problem = answer.problem(status, kind);
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{name}: {problem}");
    }
    assert_eq!(api.get("/v1/maps").await.json()["maps"], json!([]), "nothing is left behind");
}

#[tokio::test]
async fn a_full_queue_refuses_before_the_map_is_read() {
    let api = Api::with(|config| config.max_queued_jobs = 0).await;
    let refused = api.send(upload(b"no picture", METADATA)).await;
    refused.problem(503, "busy");
    assert_eq!(refused.header("retry-after"), "10");
}

#[tokio::test]
async fn forms_have_their_parts_once() {
    let api = Api::new().await;
    let hall = pgm(HALL);
    let (image, metadata) = (("image", None, hall.as_slice()), ("metadata", None, METADATA.as_bytes()));
    let cases: [(Vec<Part<'_>>, &str); 10] = [
        (vec![image], "/metadata"),
        (vec![metadata], "/image"),
        (vec![image, metadata, image], "/image"),
        (vec![image, metadata, ("colour", None, b"red")], "/colour"),
        (vec![image, metadata, ("name", None, b"")], "/name"),
        (vec![image, metadata, ("name", None, b"\xff")], "/name"),
        (vec![image, metadata, ("options", None, br#"{"categorization": {"k": 0}}"#)], "/options/categorization/k"),
        (vec![image, metadata, ("options", None, br#"{"categorisation": {}}"#)], "/options/categorisation"),
        (vec![image, metadata, ("georeference", None, br#"{"lon": 200, "lat": 0}"#)], "/georeference/lon"),
        (vec![image, metadata, ("georeference", None, br#"{"lon": 20}"#)], "/georeference"),
    ];
    for (parts, pointer) in cases {
        let problem = api.send(form(&parts)).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
    let long = vec![b' '; 70_000];
    api.send(form(&[image, ("metadata", None, &long)])).await.problem(413, "too-large");
    let broken = "--boundary\r\nContent-Disposition: form-data; name=\"image\"\r\n\r\nabc";
    let headers = [("content-type", "multipart/form-data; boundary=boundary")];
    api.send(request(Method::POST, "/v1/maps", &headers, Body::from(broken))).await.problem(400, "bad-request");
}

#[tokio::test]
async fn messages_are_checked() {
    let api = Api::new().await;
    let origin = json!({"position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}});
    let info = |width: u32| json!({"resolution": 0.05, "width": width, "height": 1, "origin": origin});
    for message in [
        json!({}),
        json!({"info": info(2)}),
        json!({"info": info(2), "data": [0]}),
        json!({"info": info(0), "data": []}),
        json!({"info": {"resolution": null, "width": 1, "height": 1, "origin": origin}, "data": [0]}),
    ] {
        api.send_json(Method::POST, "/v1/maps", &[], &message).await.problem(422, "invalid");
    }
    let headers = [("content-type", "application/json")];
    let answer = api.send(request(Method::POST, "/v1/maps", &headers, Body::from("{\"info\": "))).await;
    assert!(matches!(answer.status.as_u16(), 400 | 422), "{}", answer.text());
}

#[tokio::test]
async fn a_map_without_structure_is_answered_with_a_remark() {
    let api = Api::new().await;
    let block = |cell: &str| format!("{}\n", cell.repeat(30)).repeat(20);
    for (name, picture, code) in [
        ("all free", block("."), "no-occupied-cells"),
        ("all occupied", block("#"), "no-free-cells"),
        ("all unknown", block("?"), "all-unknown"),
        ("one free pixel", ".".to_owned(), "no-occupied-cells"),
        ("one occupied pixel", "#".to_owned(), "no-free-cells"),
    ] {
        let map = api.analysed(&pgm(&picture)).await;
        let diagnostics = api.get(&format!("{map}/diagnostics")).await.json();
        let codes: Vec<&str> = diagnostics["diagnostics"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|remark| remark["code"].as_str())
            .collect();
        assert!(codes.contains(&code), "{name}: {codes:?}");
        let collections = api.get(&format!("{map}/collections")).await.json();
        for collection in collections["collections"].as_array().expect("a list") {
            let id = collection["id"].as_str().expect("an id");
            let items = api.get(&format!("{map}/collections/{id}/items")).await;
            assert_eq!(items.status, 200, "{name}: {id}: {}", items.text());
            assert_eq!(items.json()["numberMatched"], collection["itemCount"], "{name}: {id}");
        }
        for picture in ["image", "categories", "regions", "semantic"] {
            assert_eq!(api.get(&format!("{map}/{picture}.png")).await.status, 200, "{name}: {picture}");
        }
        assert_eq!(api.get(&format!("{map}/categories")).await.status, 200, "{name}");
    }
}
