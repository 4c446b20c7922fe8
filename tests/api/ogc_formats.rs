//! The other formats of features: pages, JSON-FG, tables, `FlatGeobuf`.

use std::collections::BTreeSet;

use axum::http::Method;
use serde_json::json;

use crate::client::Api;
use crate::features::COLLECTIONS;
use crate::ogc_part_1::{links, path_of};

#[tokio::test]
async fn every_resource_has_a_page_without_scripts() {
    let api = Api::new().await;
    let map = api.hall().await;
    api.send_json(Method::PATCH, &map, &[], &json!({"name": "<script>alert('1')</script> & Co"})).await;
    let paths = [
        "",
        "/conformance",
        "/collections",
        "/collections/faces",
        "/collections/faces/items",
        "/collections/faces/items/1",
    ];
    for path in paths {
        let path = format!("{map}{path}");
        let page = api.get_with(&path, &[("accept", "text/html,application/xhtml+xml,*/*;q=0.8")]).await;
        assert_eq!((page.status.as_u16(), page.header("content-type")), (200, "text/html; charset=utf-8"), "{path}");
        let html = page.text();
        assert!(html.starts_with("<!doctype html>") && html.contains("<h1>"), "{path}");
        assert!(!html.contains("<script") && !html.contains("src=") && !html.contains("<link"), "{path}: {html}");
        assert_eq!(html.contains("<svg"), path.contains("/faces"), "a small map: {path}");
        assert!(api.get(&path).await.header("content-type").contains("json"), "{path}");
    }
    for path in ["/v1/maps", "/v1/deleted-maps", "/v1/jobs", "/v1/rule-sets", "/v1/rule-sets/site"] {
        assert!(api.get(&format!("{path}?f=html")).await.text().starts_with("<!doctype html>"), "{path}");
    }
    let job = api.get("/v1/jobs").await.json()["jobs"][0]["jobID"].as_str().expect("an id").to_owned();
    for path in [format!("/v1/jobs/{job}"), format!("{map}/analyses"), format!("{map}/exports")] {
        assert!(api.get_with(&path, &[("accept", "text/html")]).await.text().contains("<h1>"), "{path}");
    }
    assert!(api.get(&format!("{map}?f=html")).await.text().contains("&lt;script&gt;alert(&#39;1&#39;)"));
}

/// What a browser accepts.
const BROWSER: (&str, &str) = ("accept", "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8");

/// The addresses that a page leads to within the service, without its host.
fn leads_to(html: &str) -> Vec<String> {
    let parts = html.split("href=\"http://stillage.test").skip(1);
    parts.filter_map(|part| Some(part.split('"').next()?.replace("&amp;", "&"))).collect()
}

#[tokio::test]
async fn a_person_walks_from_page_to_page() {
    let api = Api::new().await;
    let map = api.hall().await;
    let corrections = json!({"kind": "name", "at": [4.0, -0.2], "name": "Strip"});
    api.send_json(Method::POST, &format!("{map}/corrections"), &[("if-match", "*")], &corrections).await;
    let (mut seen, mut open) = (BTreeSet::new(), vec!["/v1".to_owned(), map.clone()]);
    while let Some(path) = open.pop() {
        // One feature of each collection stands for the others.
        let place = path.split_once("/items/").map_or(path.as_str(), |(items, _)| items).to_owned();
        if !seen.insert(place) {
            continue;
        }
        let page = api.get_with(&path, &[BROWSER]).await;
        let is_asked_for_ends = path.ends_with("/routes");
        assert_eq!(page.status, if is_asked_for_ends { 400 } else { 200 }, "{path}");
        let media_type = page.header("content-type").to_owned();
        let is_file =
            ["/events", "/exports/", ".png", ".svg", "/api", "openapi", "/docs"].iter().any(|part| path.contains(part));
        if media_type.starts_with("text/html") {
            open.extend(leads_to(&page.text()));
        } else {
            assert!(is_file || is_asked_for_ends || path.contains("f="), "{path} is no page: {media_type}");
        }
    }
    let pages = [
        "analyses",
        "categories",
        "changes",
        "corrections",
        "diagnostics",
        "exports",
        "graph-report",
        "registry",
        "semantics",
        "semantics/versions",
    ];
    for page in pages {
        assert!(seen.contains(&format!("{map}/{page}")), "{page} is reached: {seen:?}");
    }
    let by_hand = ["at?point=1,1&crs=EPSG:3857", "nearest?point=1,1&crs=EPSG:3857&collection=faces", "corrections/c1"];
    for path in by_hand {
        let page = api.get(&format!("{map}/{path}{}f=html", if path.contains('?') { "&" } else { "?" })).await;
        assert!(page.text().starts_with("<!doctype html>"), "{path}: {}", page.text());
    }
    assert!(api.get("/problems/not-found?f=html").await.text().starts_with("<!doctype html>"));
}

#[tokio::test]
async fn a_page_is_another_answer_than_json() {
    let api = Api::new().await;
    let map = api.hall().await;
    for path in ["categories", "semantics", "semantics/versions/0", "corrections", "diagnostics", "graph-report"] {
        let path = format!("{map}/{path}");
        let (json, page) = (api.get(&path).await, api.get_with(&path, &[BROWSER]).await);
        assert_ne!(json.header("etag"), page.header("etag"), "{path}");
        let again = api.get_with(&path, &[BROWSER, ("if-none-match", page.header("etag"))]).await;
        assert_eq!(again.status, 304, "{path}");
    }
}

#[tokio::test]
async fn json_fg_has_metres_beside_degrees() {
    let api = Api::new().await;
    let map = api.hall().await;
    for collection in COLLECTIONS {
        let items = format!("{map}/collections/{collection}/items");
        let [metres, degrees, both] = ["crs=EPSG:3857", "f=json", "f=jsonfg"].map(|query| format!("{items}?{query}"));
        let [metres, degrees] = [api.get(&metres).await.json(), api.get(&degrees).await.json()];
        let answer = api.get(&both).await;
        assert_eq!(answer.header("content-type"), "application/fg+json");
        let both = answer.json();
        assert_eq!(both["coordRefSys"], "http://www.opengis.net/def/crs/OGC/0/Engineering2D");
        assert_eq!(both["featureType"], collection);
        for (index, feature) in both["features"].as_array().expect("a list").iter().enumerate() {
            assert_eq!(feature["place"], metres["features"][index]["geometry"], "{collection}");
            assert_eq!(feature["geometry"], degrees["features"][index]["geometry"], "{collection}");
            assert_eq!(feature["properties"], degrees["features"][index]["properties"], "{collection}");
        }
    }
    let alone = api.get(&format!("{map}/collections/vertices/items/0?f=jsonfg&crs=EPSG:3857")).await.json();
    assert_eq!(alone["coordRefSys"], "http://www.opengis.net/def/crs/EPSG/0/3857");
    assert_eq!(alone["conformsTo"][0], "http://www.opengis.net/spec/json-fg-1/1.0/conf/core");
}

#[tokio::test]
async fn a_profile_chooses_between_plain_geojson_and_json_fg() {
    const REGISTER: &str = "http://www.opengis.net/def/profile/OGC/0/";
    let api = Api::new().await;
    let map = api.hall().await;
    let [items, item] = ["items", "items/1"].map(|path| format!("{map}/collections/faces/{path}"));
    for path in [&items, &item] {
        let plain = api.get(path).await;
        for (query, profile, media_type) in [
            ("", "rfc7946", "application/geo+json"),
            ("?profile=rfc7946", "rfc7946", "application/geo+json"),
            ("?profile=of-somebody-else", "rfc7946", "application/geo+json"),
            ("?profile=jsonfg", "jsonfg", "application/geo+json"),
            ("?profile=http://www.opengis.net/def/profile/OGC/0/jsonfg-plus", "jsonfg-plus", "application/geo+json"),
            ("?f=jsonfg", "jsonfg-plus", "application/fg+json"),
            ("?f=jsonfg&profile=rfc7946", "jsonfg-plus", "application/fg+json"),
        ] {
            let answer = api.get(&format!("{path}{query}")).await;
            assert_eq!((answer.status.as_u16(), answer.header("content-type")), (200, media_type), "{query}");
            let json = answer.json();
            assert_eq!(links(&json, "profile")[0]["href"], format!("{REGISTER}{profile}"), "{query}");
            let told = answer.headers.get_all("link").iter().filter_map(|link| link.to_str().ok());
            assert!(told.into_iter().any(|link| link.contains(&format!("<{REGISTER}{profile}>; rel=\"profile\""))));
            assert_eq!(json.get("conformsTo").is_some(), profile != "rfc7946", "{query}");
            assert_eq!(answer.text().contains("\"place\":{"), profile != "rfc7946", "{query}");
            if profile == "rfc7946" {
                assert_eq!(json["features"], plain.json()["features"], "{query}");
            }
        }
    }
    let both = api.get(&format!("{items}?profile=jsonfg&limit=1")).await.json();
    assert_eq!((&both["geometryDimension"], &both["featureType"]), (&json!(2), &json!("faces")));
    let schema = api.get(path_of(&both["featureSchema"])).await;
    assert_eq!(schema.header("content-type"), "application/schema+json");
    assert!(links(&both, "next")[0]["href"].as_str().is_some_and(|next| next.contains("profile=jsonfg")));
    let some = api.get(&format!("{items}?profile=jsonfg&properties=label&limit=1")).await.json();
    assert!(some.get("featureSchema").is_none(), "the schema asks for more");
    let table = api.get(&format!("{items}?f=csv&profile=jsonfg")).await;
    assert_eq!((table.status.as_u16(), table.header("link")), (200, ""));
}

#[tokio::test]
async fn every_collection_is_a_table() {
    let api = Api::new().await;
    let map = api.hall().await;
    for collection in COLLECTIONS {
        let items = format!("{map}/collections/{collection}/items");
        let matched = api.get(&items).await.json()["numberMatched"].as_u64().expect("a number");
        let table = api.get(&format!("{items}?f=csv")).await;
        let mut reader = csv::Reader::from_reader(table.body.as_slice());
        let last = reader.headers().expect("a head").iter().next_back().map(str::to_owned);
        assert_eq!(reader.records().count() as u64, matched, "{collection}");
        if collection != "locations" {
            assert_eq!(last.as_deref(), Some("geometry"));
        }
    }
    let table = api.get(&format!("{map}/collections/vertices/items?f=csv&crs=EPSG:3857&limit=1")).await;
    assert_eq!(table.header("content-crs"), "<http://www.opengis.net/def/crs/EPSG/0/3857>");
    assert!(table.text().contains("POINT("), "{}", table.text());
}

#[tokio::test]
async fn every_format_has_the_properties_that_are_named() {
    let api = Api::new().await;
    let map = api.hall().await;
    for (collection, named) in
        [("faces", ["areaM2", "label"]), ("locations", ["label", "code"]), ("vertices", ["edges", "id"])]
    {
        let items = format!("{map}/collections/{collection}/items");
        let at = |format: &str| format!("{items}?properties={}&f={format}", named.join(","));
        let in_order = [named[1], named[0]];
        for format in ["json", "jsonfg", "json&crs=EPSG:3857"] {
            let page = api.get(&at(format)).await.json();
            assert_eq!(page["numberMatched"], page["numberReturned"]);
            for feature in page["features"].as_array().expect("a list") {
                let names: Vec<&String> = feature["properties"].as_object().expect("an object").keys().collect();
                assert_eq!(names, in_order, "{collection} as {format}");
                assert!(feature.get("id").is_some(), "the id is no property");
            }
        }
        let table = api.get(&at("csv")).await.text();
        assert_eq!(table.lines().next(), Some(format!("{},geometry", in_order.join(",")).as_str()));
        let page = api.get(&at("html")).await.text();
        let heads: Vec<&str> =
            page.split("<th>").skip(1).filter_map(|head| head.split("</th>").next()).take(3).collect();
        assert!(heads.ends_with(&in_order[1..]) && heads.contains(&in_order[0]), "{heads:?}");
        let [some, all] = [at("fgb"), format!("{items}?f=fgb")].map(|path| path);
        let (some, all) = (api.get(&some).await.body, api.get(&all).await.body);
        assert!(some.len() < all.len() || collection == "vertices", "{} of {} bytes", some.len(), all.len());
        let one = api.get(&format!("{items}?properties={}&limit=1", named[0])).await.json();
        let next = links(&one, "next");
        if let Some(next) = next.first() {
            let next = path_of(&next["href"]);
            assert!(next.contains(&format!("properties={}", named[0])), "{next}");
        }
        let id = match &one["features"][0]["id"] {
            serde_json::Value::String(code) => code.clone(),
            number => number.to_string(),
        };
        let alone = api.get(&format!("{items}/{id}?properties={}", named[0])).await.json();
        assert_eq!(alone["properties"], one["features"][0]["properties"]);
        assert!(links(&alone, "self")[0]["href"].as_str().is_some_and(|href| href.contains("?properties=")));
        let page = api.get(&format!("{items}/{id}?properties={}&f=html", named[0])).await;
        assert_eq!(page.status, 200);
    }
    let refused = api.get(&format!("{map}/collections/faces/items/1?properties=colour")).await;
    assert!(refused.problem(400, "bad-parameter").to_string().contains("did you mean"), "{}", refused.text());
}

#[tokio::test]
async fn pages_go_on_in_their_format() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/edges/items");
    let page = api.get(&format!("{items}?f=jsonfg&limit=2")).await.json();
    let next = api.get(path_of(&links(&page, "next")[0]["href"])).await;
    assert_eq!(next.header("content-type"), "application/fg+json");
    for format in ["html", "csv", "fgb"] {
        let page = api.get(&format!("{items}?f={format}&limit=2")).await;
        assert_eq!(
            page.header("link").contains(&format!("f={format}")),
            format != "html",
            "{format}: {}",
            page.header("link")
        );
    }
}

#[tokio::test]
async fn equal_tags_mean_equal_bytes() {
    let api = Api::new().await;
    let map = api.hall().await;
    for format in ["json", "jsonfg", "html", "csv", "fgb"] {
        let path = format!("{map}/collections/faces/items?f={format}");
        let (first, second) = (api.get(&path).await, api.get(&path).await);
        assert!(!first.header("etag").is_empty(), "{format}");
        assert_eq!((first.header("etag"), &first.body), (second.header("etag"), &second.body), "{format}");
    }
}
