//! The collections of a map and their features.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Api, HALL, METADATA, pgm, request, upload};

const CRS84: &str = "http://www.opengis.net/def/crs/OGC/1.3/CRS84";
const EPSG_3857: &str = "http://www.opengis.net/def/crs/EPSG/0/3857";
pub const COLLECTIONS: [&str; 12] = [
    "faces",
    "edges",
    "vertices",
    "nodes",
    "links",
    "lines",
    "regions",
    "places",
    "doors",
    "locations",
    "aisles",
    "rows",
];

/// Follows the pages of a list; ids in their order.
async fn ids(api: &Api, path: &str) -> Vec<Value> {
    let mut ids = Vec::new();
    let mut path = path.to_owned();
    loop {
        let answer = api.get(&path).await;
        assert_eq!(answer.status, 200, "{path}: {}", answer.text());
        let page = answer.json();
        let features = page["features"].as_array().expect("features");
        assert_eq!(page["numberReturned"], features.len());
        ids.extend(features.iter().map(|feature| feature["id"].clone()));
        let next = page["links"].as_array().expect("links").iter().find(|link| link["rel"] == "next");
        let Some(next) = next else { return ids };
        assert!(answer.header("link").contains("rel=\"next\""));
        next["href"].as_str().expect("an address").trim_start_matches("http://stillage.test").clone_into(&mut path);
    }
}

#[tokio::test]
async fn collections_say_what_they_hold() {
    let api = Api::new().await;
    let map = api.hall().await;
    let list = api.get(&format!("{map}/collections")).await.json();
    let collections = list["collections"].as_array().expect("collections");
    assert_eq!(collections.iter().filter_map(|collection| collection["id"].as_str()).collect::<Vec<_>>(), COLLECTIONS);
    for collection in collections {
        assert_eq!(collection["crs"], json!([CRS84, EPSG_3857]));
        assert_eq!(collection["storageCrs"], EPSG_3857);
        let links = collection["links"].as_array().expect("links");
        let items = links.iter().find(|link| link["rel"] == "items").expect("a link to the items");
        assert_eq!(items["type"], "application/geo+json");
        let href = items["href"].as_str().expect("an address");
        assert!(!href.contains('?'), "{href}");
        let answer = api.get(href.trim_start_matches("http://stillage.test")).await.json();
        assert_eq!(answer["numberMatched"], collection["itemCount"], "{collection}");
        let alone = api.get(&format!("{map}/collections/{}", collection["id"].as_str().expect("an id"))).await.json();
        assert_eq!(&alone, collection);
    }
    api.get(&format!("{map}/collections/walls")).await.problem(404, "not-found");
    api.get(&format!("{map}/collections/walls/items")).await.problem(404, "not-found");
}

#[tokio::test]
async fn items_are_geojson() {
    let api = Api::new().await;
    let map = api.hall().await;
    for collection in COLLECTIONS {
        let answer = api.get(&format!("{map}/collections/{collection}/items?limit=10000")).await;
        assert_eq!(answer.header("content-type"), "application/geo+json");
        assert_eq!(answer.header("content-crs"), format!("<{CRS84}>"));
        let items = answer.json();
        assert_eq!(items["type"], "FeatureCollection");
        assert!(items["timeStamp"].as_str().is_some_and(|time| time.ends_with('Z')));
        for feature in items["features"].as_array().expect("features") {
            assert_eq!(feature["type"], "Feature");
            assert!(feature["properties"].is_object() && feature["geometry"]["coordinates"].is_array(), "{feature}");
        }
        if !["locations", "places", "doors"].contains(&collection) {
            assert!(items["numberMatched"].as_u64() > Some(0), "{collection}");
        }
    }
}

#[tokio::test]
async fn pages_hold_every_feature_once() {
    let api = Api::new().await;
    let map = api.hall().await;
    let all = ids(&api, &format!("{map}/collections/edges/items?limit=10000")).await;
    assert!(all.len() > 20);
    assert_eq!(ids(&api, &format!("{map}/collections/edges/items?limit=7")).await, all);
    assert_eq!(ids(&api, &format!("{map}/collections/edges/items?limit=7&offset=5")).await, all[5..]);
    let beyond = api.get(&format!("{map}/collections/edges/items?offset=999999")).await.json();
    assert_eq!((&beyond["numberReturned"], &beyond["numberMatched"]), (&json!(0), &json!(all.len())));
    let beyond = api.get(&format!("{map}/collections/edges/items?after=999999")).await.json();
    assert_eq!((&beyond["numberReturned"], &beyond["numberMatched"]), (&json!(0), &json!(all.len())));
}

#[tokio::test]
async fn features_are_picked_by_id_and_sorted_by_a_property() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/faces/items");
    assert_eq!(ids(&api, &format!("{items}?ids=2,1,999999")).await, [json!(1), json!(2)]);
    let whole = api.get(&format!("{items}?sortby=-areaM2")).await.json();
    let features = whole["features"].as_array().expect("a list");
    let areas: Vec<f64> =
        features.iter().map(|face| face["properties"]["areaM2"].as_f64().expect("a number")).collect();
    assert!(areas.len() > 2 && areas.is_sorted_by(|larger, smaller| larger >= smaller), "{areas:?}");
    let in_order: Vec<Value> = features.iter().map(|face| face["id"].clone()).collect();
    assert_eq!(ids(&api, &format!("{items}?sortby=-areaM2&limit=2")).await, in_order, "page by page");
}

#[tokio::test]
async fn metres_of_the_map_are_those_of_web_mercator() {
    let api = Api::new().await;
    let map = api.hall().await;
    for crs in [EPSG_3857, "EPSG:3857"] {
        let answer = api.get(&format!("{map}/collections/vertices/items?crs={crs}&limit=10000")).await;
        assert_eq!(answer.header("content-crs"), format!("<{EPSG_3857}>"));
        for vertex in answer.json()["features"].as_array().expect("features") {
            let [x, y] = [0, 1].map(|axis| vertex["geometry"]["coordinates"][axis].as_f64().expect("a number"));
            assert!((-2.3..=13.8).contains(&x) && (-1.3..=4.8).contains(&y), "{x}, {y}");
        }
    }
}

#[tokio::test]
async fn boxes_select() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/faces/items");
    let all = ids(&api, &items).await;
    let everything = ids(&api, &format!("{items}?bbox=-180,-90,180,90")).await;
    assert_eq!(everything, all);
    assert_eq!(ids(&api, &format!("{items}?bbox=-10,-10,0,20,20,9&bbox-crs=EPSG:3857")).await, all);
    let some = ids(&api, &format!("{items}?bbox=0,0,2,2&bbox-crs=EPSG:3857&limit=3")).await;
    assert!(!some.is_empty() && some.len() < all.len(), "{} of {}", some.len(), all.len());
    let degrees = ids(&api, &format!("{items}?bbox=0,0,0.0000179663,0.0000179663")).await;
    assert_eq!(degrees, some, "two metres are that many degrees");
    assert_eq!(ids(&api, &format!("{items}?bbox=1000,1000,1001,1001&bbox-crs=EPSG:3857")).await, Vec::<Value>::new());
    // Across the antimeridian: all but a strip of the Earth, and that strip alone.
    assert_eq!(ids(&api, &format!("{items}?bbox=-1,-1,-2,1")).await, everything);
    assert_eq!(ids(&api, &format!("{items}?bbox=179,-1,-179,1")).await, Vec::<Value>::new());
}

#[tokio::test]
async fn bad_values_are_refused_by_name() {
    let api = Api::new().await;
    let map = api.hall().await;
    for (query, parameter) in [
        ("limit=0", "limit"),
        ("limit=-1", "limit"),
        ("bbox=1,2,3", "bbox"),
        ("bbox=1,2,3,x", "bbox"),
        ("bbox=10,10,0,0", "bbox"),
        ("bbox=3,0,1,1&bbox-crs=EPSG:3857", "bbox"),
        ("bbox=0,0,1,1&bbox-crs=EPSG:4326", "bbox-crs"),
        ("crs=EPSG:4326", "crs"),
        ("after=x", "after"),
        ("ids=1,x", "ids"),
        ("ids=", "ids"),
        ("properties=colour", "properties"),
        ("properties=", "properties"),
        ("sortby=colour", "sortby"),
        ("sortby=edges", "sortby"),
        ("sortby=areaM2&after=999999", "after"),
        ("crs=EPSG:32633", "crs"),
        ("datetime=yesterday", "datetime"),
        ("f=xml", "f"),
        ("f=json&f=csv", "f"),
        ("offset=-1", "offset"),
        ("filter=label=", "filter"),
    ] {
        let problem = api.get(&format!("{map}/collections/faces/items?{query}")).await.problem(400, "bad-parameter");
        assert_eq!(problem["errors"][0]["parameter"], parameter, "{query}: {problem}");
    }
}

#[tokio::test]
async fn items_are_cached_and_compressed() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/collections/faces/items");
    let tag = api.get(&path).await.header("etag").to_owned();
    assert!(tag.starts_with('"'), "{tag}");
    assert_eq!(api.get(&path).await.header("etag"), tag, "the time of the answer is not in it");
    let again = api.get_with(&path, &[("if-none-match", &tag)]).await;
    assert_eq!((again.status.as_u16(), again.body.len()), (304, 0));
    let small = api.get_with(&path, &[("accept-encoding", "zstd")]).await;
    assert_eq!(small.header("content-encoding"), "zstd");
    assert!(small.header("vary").contains("accept"));
    let for_browsers = api.get_with(&path, &[("accept-encoding", "br")]).await;
    assert_eq!(for_browsers.header("content-encoding"), "br");
    assert!(for_browsers.header("etag").ends_with("-br\"") && for_browsers.body.len() < 10_000);
    let again = api.get_with(&path, &[("accept-encoding", "zstd"), ("if-none-match", small.header("etag"))]).await;
    assert_eq!(again.status, 304);
    api.send_json(Method::PATCH, &map, &[], &json!({"georeference": {"lon": 12.86, "lat": 56.66}})).await;
    assert_eq!(api.get_with(&path, &[("if-none-match", &tag)]).await.status, 200, "the map has moved");
}

/// How often the metrics say that the faces were answered with a status.
async fn answered(api: &Api, status: u16) -> usize {
    let route = "route=\"/v1/maps/{mapId}/collections/{collectionId}/items\"";
    let (status, text) = (format!("status=\"{status}\""), api.get("/metrics").await.text());
    let line = text
        .lines()
        .find(|line| line.starts_with("http_requests_total") && line.contains(route) && line.contains(&status));
    line.and_then(|line| line.rsplit(' ').next()?.parse().ok()).unwrap_or_default()
}

#[tokio::test]
async fn an_answer_given_again_is_the_same_and_counted() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/collections/faces/items");
    for coding in ["", "br", "gzip", "zstd"] {
        let headers = [("accept-encoding", coding)];
        let (first, again) = (api.get_with(&path, &headers).await, api.get_with(&path, &headers).await);
        assert_eq!(first.body, again.body, "{coding}");
        for name in ["content-type", "content-encoding", "content-crs", "etag", "vary", "access-control-allow-origin"] {
            assert_eq!(first.header(name), again.header(name), "{coding} {name}");
        }
        assert_ne!(first.header("x-request-id"), again.header("x-request-id"));
        let known = [("accept-encoding", coding), ("if-none-match", first.header("etag"))];
        let unchanged = api.get_with(&path, &known).await;
        assert_eq!((unchanged.status.as_u16(), unchanged.header("etag")), (304, first.header("etag")));
        assert_eq!(unchanged.headers.get_all("vary").iter().count(), first.headers.get_all("vary").iter().count());
        assert_eq!((unchanged.header("content-type"), unchanged.header("content-encoding")), ("", ""));
    }
    assert_eq!((answered(&api, 200).await, answered(&api, 304).await), (8, 4));
}

#[tokio::test]
async fn an_answer_is_made_anew_once_its_map_has_changed() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/collections/faces/items");
    let before = api.get(&path).await;
    let labels = json!({"assignment": api.all_labelled(&map, "un").await});
    assert_eq!(
        api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &labels).await.status,
        200
    );
    let after = api.get(&path).await;
    assert!(before.header("etag") != after.header("etag") && before.body != after.body, "{}", after.text());
    api.send(request(Method::DELETE, &map, &[], Body::empty())).await;
    api.get(&path).await.problem(404, "not-found");
}

#[tokio::test]
async fn without_memory_for_answers_all_are_made_anew() {
    let api = Api::with(|config| config.cached_answer_bytes = 0).await;
    let path = format!("{}/collections/faces/items", api.hall().await);
    let (first, again) = (api.get(&path).await, api.get(&path).await);
    assert_eq!((first.header("etag"), first.body.clone()), (again.header("etag"), again.body.clone()));
}

#[tokio::test]
async fn a_feature_has_an_address() {
    let api = Api::new().await;
    let map = api.hall().await;
    for collection in COLLECTIONS {
        let items = format!("{map}/collections/{collection}/items");
        let page = api.get(&format!("{items}?limit=1&crs=EPSG:3857")).await.json();
        let Some(first) = page["features"].get(0) else { continue };
        let id = first["id"].as_str().map_or_else(|| first["id"].to_string(), str::to_owned);
        let answer = api.get(&format!("{items}/{id}?crs=EPSG:3857")).await;
        assert_eq!(
            (answer.status.as_u16(), answer.header("content-type")),
            (200, "application/geo+json"),
            "{collection}"
        );
        let feature = answer.json();
        for member in ["id", "type", "geometry", "properties"] {
            assert_eq!(feature[member], first[member], "{collection}");
        }
        let here = format!("http://stillage.test{items}/{id}?crs=http://www.opengis.net/def/crs/EPSG/0/3857");
        assert_eq!(feature["links"][0]["href"], here);
        for wrong in ["999999", "01", "x%20y"] {
            api.get(&format!("{items}/{wrong}")).await.problem(404, "not-found");
        }
    }
}

#[tokio::test]
async fn media_types_of_items() {
    let api = Api::new().await;
    let map = api.hall().await;
    let faces = format!("{map}/collections/faces/items");
    for accept in ["*/*", "application/geo+json", "application/json", "application/geo+json, application/json"] {
        assert_eq!(api.get_with(&faces, &[("accept", accept)]).await.header("content-type"), "application/geo+json");
    }
    for (name, accept, media_type) in [
        ("json", "application/json", "application/geo+json"),
        ("geojson", "application/geo+json", "application/geo+json"),
        ("jsonfg", "application/fg+json", "application/fg+json"),
        ("html", "text/html", "text/html; charset=utf-8"),
        ("csv", "text/csv", "text/csv; charset=utf-8"),
        ("fgb", "application/flatgeobuf", "application/flatgeobuf"),
    ] {
        let accepted = api.get_with(&faces, &[("accept", accept)]).await;
        let named = api.get(&format!("{faces}?f={name}")).await;
        assert_eq!((accepted.header("content-type"), named.header("content-type")), (media_type, media_type));
        assert_eq!((accepted.body, accepted.headers["etag"].clone()), (named.body, named.headers["etag"].clone()));
    }
    api.get_with(&faces, &[("accept", "image/png")]).await.problem(406, "not-acceptable");
    api.get(&format!("{map}/collections?f=csv")).await.problem(400, "bad-parameter");
}

#[tokio::test]
async fn locations_are_a_table_too() {
    let api = Api::new().await;
    let map = api.hall().await;
    // Every face a pallet cell, so that there are locations for sure.
    let all = api.all_labelled(&map, "pc").await;
    let answer = api
        .send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &json!({"assignment": all}))
        .await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    let items = format!("{map}/collections/locations/items");
    let all = ids(&api, &format!("{items}?limit=10000")).await;
    assert!(!all.is_empty());
    for (path, accept) in [(items.clone(), "text/csv"), (format!("{items}?f=csv"), "*/*")] {
        let table = api.get_with(&path, &[("accept", accept)]).await;
        assert_eq!((table.status.as_u16(), table.header("content-type")), (200, "text/csv; charset=utf-8"));
        let mut reader = csv::Reader::from_reader(table.body.as_slice());
        assert_eq!(reader.headers().expect("a head").get(0), Some("code"));
        assert_eq!(reader.records().count(), all.len(), "the table is whole");
    }
    let page = api.get_with(&format!("{items}?limit=2"), &[("accept", "text/csv")]).await;
    assert!(page.header("link").contains("f=csv"), "the next page is a table too: {}", page.header("link"));
    assert!(page.header("link").contains("type=\"text/csv\""), "{}", page.header("link"));
    let page = api.get(&format!("{items}?f=csv&limit=2")).await;
    assert_eq!(csv::Reader::from_reader(page.body.as_slice()).records().count(), 2);
    assert!(page.header("link").contains("f=csv"), "{}", page.header("link"));
    let json_tag = api.get(&items).await.header("etag").to_owned();
    assert_ne!(page.header("etag"), json_tag, "another representation");
    assert_eq!(page.header("content-crs"), "", "its positions are map-frame metres");
}

#[tokio::test]
async fn the_same_map_gives_the_same_features() {
    let api = Api::new().await;
    let first = api.hall().await;
    let second = api.hall().await;
    for collection in COLLECTIONS {
        let features = |map: &str| {
            let (api, path) = (&api, format!("{map}/collections/{collection}/items?limit=10000"));
            async move { api.get(&path).await.json()["features"].to_string() }
        };
        assert_eq!(features(&first).await, features(&second).await, "{collection}");
    }
    let answer = api.send(upload(&pgm(HALL), METADATA)).await;
    assert_eq!(answer.status, 202);
}
