//! Abstract tests of OGC API - Features - Part 1: Core (OGC 17-069r4, annex A), each under its number.

use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api};
use crate::features::COLLECTIONS;

/// The path of an address of the service.
pub fn path_of(href: &Value) -> &str {
    href.as_str().expect("an address").trim_start_matches("http://stillage.test")
}

/// The links of a document with a relation.
pub fn links<'a>(document: &'a Value, rel: &str) -> Vec<&'a Value> {
    let links = document["links"].as_array().unwrap_or_else(|| panic!("no links in {document}"));
    links.iter().filter(|link| link["rel"] == rel).collect()
}

async fn json_of(api: &Api, path: &str) -> (Answer, Value) {
    let answer = api.get(path).await;
    assert_eq!(answer.status, 200, "{path}: {}", answer.text());
    let document = answer.json();
    (answer, document)
}

#[tokio::test]
async fn a_3_and_4_the_landing_page_leads_to_api_conformance_and_data() {
    let api = Api::new().await;
    let map = api.hall().await;
    let (_, page) = json_of(&api, &map).await;
    for rel in ["self", "alternate", "service-desc", "service-doc", "conformance", "data"] {
        let found = links(&page, rel);
        assert_eq!(found.len(), 1, "{rel}");
        let answer = api.get_with(path_of(&found[0]["href"]), &[("accept", "*/*")]).await;
        assert_eq!(answer.status, 200, "{rel}");
        let media_type = found[0]["type"].as_str().expect("a type");
        assert!(answer.header("content-type").starts_with(media_type), "{rel}: {}", answer.header("content-type"));
    }
}

#[tokio::test]
async fn a_5_and_6_the_api_definition_is_that_of_the_map() {
    let api = Api::new().await;
    let map = api.hall().await;
    let (_, page) = json_of(&api, &map).await;
    let link = links(&page, "service-desc")[0];
    assert_eq!(link["type"], "application/vnd.oai.openapi+json;version=3.0");
    let (answer, definition) = json_of(&api, path_of(&link["href"])).await;
    assert_eq!(answer.header("content-type"), link["type"].as_str().expect("a type"));
    assert_eq!(definition["openapi"], "3.0.3");
    assert_eq!(definition["servers"][0]["url"], format!("http://stillage.test{map}"));
    for path in definition["paths"].as_object().expect("paths").keys().filter(|path| !path.contains('{')) {
        let path = format!("{map}{path}");
        assert_eq!(api.get(&path).await.status, 200, "{path}");
    }
}

#[tokio::test]
async fn a_7_and_8_conformance_names_the_classes() {
    let api = Api::new().await;
    let map = api.hall().await;
    let (_, conformance) = json_of(&api, &format!("{map}/conformance")).await;
    let classes = conformance["conformsTo"].as_array().expect("a list");
    for class in ["1/1.0/conf/core", "1/1.0/conf/geojson", "1/1.0/conf/html", "1/1.0/conf/oas30", "2/1.0/conf/crs"] {
        let uri = json!(format!("http://www.opengis.net/spec/ogcapi-features-{class}"));
        assert!(classes.contains(&uri), "{uri}");
    }
}

#[tokio::test]
async fn a_9_and_10_the_collections_have_links_and_content() {
    let api = Api::new().await;
    let map = api.hall().await;
    let (_, list) = json_of(&api, &format!("{map}/collections")).await;
    assert_eq!((links(&list, "self").len(), links(&list, "alternate").len()), (1, 1));
    for collection in list["collections"].as_array().expect("a list") {
        let id = collection["id"].as_str().expect("an id");
        let items = links(collection, "items");
        let types: Vec<&str> = items.iter().filter_map(|link| link["type"].as_str()).collect();
        let expected =
            ["application/geo+json", "application/fg+json", "text/html", "text/csv", "application/flatgeobuf"];
        assert_eq!(types, expected, "{id}");
        for link in items {
            assert_eq!(path_of(&link["href"]), format!("{map}/collections/{id}/items"), "no query string");
            let media_type = link["type"].as_str().expect("a type");
            let answer = api.get_with(path_of(&link["href"]), &[("accept", media_type)]).await;
            assert!(answer.header("content-type").starts_with(media_type), "{id}: {media_type}");
        }
        let [west, south, east, north] =
            [0, 1, 2, 3].map(|index| collection["extent"]["spatial"]["bbox"][0][index].as_f64().expect("a number"));
        assert!(-180.0 <= west && west <= east && east <= 180.0 && -90.0 <= south && south <= north && north <= 90.0);
        assert_eq!(collection["extent"]["spatial"]["crs"], "http://www.opengis.net/def/crs/OGC/1.3/CRS84");
    }
}

#[tokio::test]
async fn a_11_and_12_a_collection_by_itself_is_that_of_the_list() {
    let api = Api::new().await;
    let map = api.hall().await;
    let (_, list) = json_of(&api, &format!("{map}/collections")).await;
    for collection in list["collections"].as_array().expect("a list") {
        let (_, alone) = json_of(&api, path_of(&links(collection, "self")[0]["href"])).await;
        assert_eq!(&alone, collection);
        let page = api.get(path_of(&links(collection, "alternate")[0]["href"])).await;
        assert_eq!(page.header("content-type"), "text/html; charset=utf-8");
        let file = api.get(path_of(&links(collection, "enclosure")[0]["href"])).await;
        assert!(file.body.starts_with(b"fgb\x03"), "the whole collection");
    }
}

#[tokio::test]
async fn a_13_and_22_to_26_items_say_what_they_are() {
    let api = Api::new().await;
    let map = api.hall().await;
    for collection in COLLECTIONS {
        let (answer, items) = json_of(&api, &format!("{map}/collections/{collection}/items?limit=2")).await;
        assert_eq!(answer.header("content-type"), "application/geo+json");
        assert_eq!(items["type"], "FeatureCollection");
        let features = items["features"].as_array().expect("a list");
        assert!(features.len() <= 2 && items["numberReturned"] == features.len());
        let matched = items["numberMatched"].as_u64().expect("a number");
        assert_eq!(links(&items, "next").len(), usize::from(matched > 2), "{collection}");
        assert_eq!(links(&items, "self").len(), 1);
        assert_eq!(links(&items, "alternate").len(), 4);
        assert!(items["links"].as_array().expect("a list").iter().all(|link| link["type"].is_string()));
        assert!(items["timeStamp"].as_str().is_some_and(|time| time.ends_with('Z')));
    }
}

#[tokio::test]
async fn a_14_and_15_a_box_selects_what_meets_it() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/faces/items");
    let count = |query: &str| {
        let (api, path) = (&api, format!("{items}?{query}"));
        async move { json_of(api, &path).await.1["numberMatched"].as_u64().expect("a number") }
    };
    let all = count("limit=1").await;
    assert_eq!(count("bbox=-180,-90,180,90").await, all);
    assert_eq!(count("bbox=-180,-90,0,180,90,10").await, all, "heights do not select");
    assert_eq!(count("bbox=177,-10,-177,10").await, 0, "across the antimeridian, where nothing is");
    assert_eq!(count("bbox=20,20,21,21").await, 0);
}

#[tokio::test]
async fn a_16_and_17_a_limit_is_met_and_a_large_one_is_lowered() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/edges/items");
    let (_, three) = json_of(&api, &format!("{items}?limit=3")).await;
    assert_eq!(three["numberReturned"], 3);
    let (_, many) = json_of(&api, &format!("{items}?limit=10001")).await;
    assert_eq!(many["numberReturned"], many["numberMatched"]);
    assert!(path_of(&links(&many, "self")[0]["href"]).contains("limit=10000"));
}

#[tokio::test]
async fn a_18_and_19_a_time_selects_features_that_have_none() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/faces/items");
    let (_, all) = json_of(&api, &items).await;
    for time in
        ["2026-01-01T00:00:00Z", "2026-01-01T00:00:00Z/2026-12-31T23:59:59Z", "../2026-01-01T00:00:00Z", "../.."]
    {
        let (_, some) = json_of(&api, &format!("{items}?datetime={time}")).await;
        assert_eq!(some["numberMatched"], all["numberMatched"], "{time}");
    }
}

#[tokio::test]
async fn a_20_an_invalid_parameter_value_is_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    for query in ["limit=x", "limit=0", "limit=-1", "bbox=1,2,3", "bbox=a,b,c,d", "datetime=today", "datetime=a/b"] {
        api.get(&format!("{map}/collections/faces/items?{query}")).await.problem(400, "bad-parameter");
    }
}

#[tokio::test]
async fn a_21_an_unknown_parameter_is_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    for path in ["", "/conformance", "/api", "/collections", "/collections/faces", "/collections/faces/items"] {
        api.get(&format!("{map}{path}?stranger=1")).await.problem(400, "bad-parameter");
    }
}

#[tokio::test]
async fn a_27_to_29_a_feature_links_to_itself_and_its_collection() {
    let api = Api::new().await;
    let map = api.hall().await;
    for collection in COLLECTIONS {
        let (_, items) = json_of(&api, &format!("{map}/collections/{collection}/items?limit=1")).await;
        let Some(first) = items["features"].get(0) else { continue };
        let id = first["id"].as_str().map_or_else(|| first["id"].to_string(), str::to_owned);
        let path = format!("{map}/collections/{collection}/items/{id}");
        let (answer, feature) = json_of(&api, &path).await;
        assert_eq!(answer.header("content-type"), "application/geo+json");
        assert_eq!((&feature["type"], &feature["id"]), (&json!("Feature"), &first["id"]));
        assert_eq!(path_of(&links(&feature, "self")[0]["href"]), path);
        assert_eq!(path_of(&links(&feature, "collection")[0]["href"]), format!("{map}/collections/{collection}"));
        assert_eq!(links(&feature, "alternate").len(), 2);
    }
}

/// Recommendation 1: HEAD and OPTIONS.
#[tokio::test]
async fn every_resource_answers_head_and_options() {
    let api = Api::new().await;
    let map = api.hall().await;
    for path in ["", "/conformance", "/api", "/collections", "/collections/faces", "/collections/faces/items"] {
        let path = format!("{map}{path}");
        let send = |method| api.send(crate::client::request(method, &path, &[], axum::body::Body::empty()));
        let (head, get) = (send(Method::HEAD).await, api.get(&path).await);
        assert_eq!((head.status.as_u16(), head.body.len()), (200, 0), "{path}");
        assert_eq!(head.header("content-type"), get.header("content-type"));
        let options = send(Method::OPTIONS).await;
        assert_eq!(options.status, 204);
        assert!(options.header("allow").starts_with("GET,HEAD"), "{path}: {}", options.header("allow"));
    }
}
