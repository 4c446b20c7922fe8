//! The other formats of features: pages, JSON-FG, tables, `FlatGeobuf`.

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
    assert!(api.get(&format!("{map}?f=html")).await.text().contains("&lt;script&gt;alert(&#39;1&#39;)"));
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
