//! Filters on the features of a map: CQL2 in both encodings, a parameter for each property, and what says which there are.

use serde_json::{Value, json};

use crate::client::Api;

/// A part of a query string, percent-encoded.
fn encoded(text: &str) -> String {
    text.bytes()
        .map(|byte| if byte.is_ascii_alphanumeric() { char::from(byte).to_string() } else { format!("%{byte:02X}") })
        .collect()
}

/// The ids of what a query selects, on pages of two.
async fn ids(api: &Api, items: &str, query: &str) -> Vec<Value> {
    let mut path = format!("{items}?limit=2&{query}");
    let mut ids = Vec::new();
    loop {
        let answer = api.get(&path).await;
        assert_eq!(answer.status, 200, "{path}: {}", answer.text());
        let page = answer.json();
        ids.extend(page["features"].as_array().expect("features").iter().map(|feature| feature["id"].clone()));
        let next = page["links"].as_array().expect("links").iter().find(|link| link["rel"] == "next");
        let Some(next) = next else {
            assert_eq!(page["numberMatched"], ids.len());
            return ids;
        };
        path = next["href"].as_str().expect("an address").trim_start_matches("http://stillage.test").to_owned();
    }
}

async fn text(api: &Api, items: &str, filter: &str) -> Vec<Value> {
    ids(api, items, &format!("filter={}&filter-crs=EPSG:3857", encoded(filter))).await
}

/// All features of a collection, in metres.
async fn all(api: &Api, items: &str) -> Vec<Value> {
    let page = api.get(&format!("{items}?limit=10000&crs=EPSG:3857")).await.json();
    page["features"].as_array().expect("features").clone()
}

fn ids_where(features: &[Value], holds: impl Fn(&Value) -> bool) -> Vec<Value> {
    features.iter().filter(|feature| holds(&feature["properties"])).map(|feature| feature["id"].clone()).collect()
}

#[tokio::test]
async fn filters_select_by_properties_in_both_encodings() {
    let api = Api::new().await;
    let items = format!("{}/collections/faces/items", api.hall().await);
    let faces = all(&api, &items).await;
    let area = |properties: &Value| properties["areaM2"].as_f64().expect("an area");
    let middle = area(&faces[faces.len() / 2]["properties"]);
    let larger = ids_where(&faces, |properties| area(properties) > middle);
    assert!(!larger.is_empty() && larger.len() < faces.len());
    assert_eq!(text(&api, &items, &format!("areaM2 > {middle}")).await, larger);
    let json = json!({"op": ">", "args": [{"property": "areaM2"}, middle]}).to_string();
    assert_eq!(ids(&api, &items, &format!("filter-lang=cql2-json&filter={}", encoded(&json))).await, larger);
    let old_name = format!("filter-lang=cql-text&filter={}", encoded(&format!("(\"areaM2\" > {middle})")));
    assert_eq!(ids(&api, &items, &old_name).await, larger);
    let smaller = ids_where(&faces, |properties| area(properties) <= middle);
    assert_eq!(text(&api, &items, &format!("NOT areaM2 > {middle} AND CASEI(label) LIKE '%'")).await, smaller);
    let edges = ids_where(&faces, |properties| properties["edges"].as_array().expect("ids").contains(&json!(0)));
    assert_eq!(text(&api, &items, "A_CONTAINS(edges, (0))").await, edges);
}

#[tokio::test]
async fn filters_select_by_shape_in_metres_and_degrees() {
    let api = Api::new().await;
    let items = format!("{}/collections/faces/items", api.hall().await);
    let of_box = ids(&api, &items, "bbox=0,0,5,2&bbox-crs=EPSG:3857").await;
    assert!(!of_box.is_empty());
    assert_eq!(text(&api, &items, "S_INTERSECTS(geometry, BBOX(0, 0, 5, 2))").await, of_box);
    assert_eq!(text(&api, &items, "S_INTERSECTS(POLYGON((0 0, 5 0, 5 2, 0 2, 0 0)), geometry)").await, of_box);
    let (east, north) = (5.0 / 6_378_137.0_f64, (2.0 / 6_378_137.0_f64).sinh().atan());
    let degrees = format!("S_INTERSECTS(geometry, BBOX(0, 0, {}, {}))", east.to_degrees(), north.to_degrees());
    assert_eq!(ids(&api, &items, &format!("filter={}", encoded(&degrees))).await, of_box);
    // What is sent back as it came is the same shape.
    for face in all(&api, &items).await {
        let own = json!({"op": "s_equals", "args": [{"property": "geometry"}, face["geometry"]]}).to_string();
        let query = format!("filter-lang=cql2-json&filter-crs=EPSG:3857&filter={}", encoded(&own));
        assert_eq!(ids(&api, &items, &query).await, [face["id"].clone()], "{own}");
    }
}

#[tokio::test]
async fn each_property_is_a_parameter() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/faces/items");
    let faces = all(&api, &items).await;
    let label = faces[0]["properties"]["label"].clone();
    let query = format!("label={}", label.as_str().expect("a label"));
    assert_eq!(ids(&api, &items, &query).await, ids_where(&faces, |properties| properties["label"] == label));
    assert_eq!(ids(&api, &items, "id=1").await, [1]);
    assert_eq!(ids(&api, &items, "id=1&filter=id%3D2").await, [0; 0]);
    let refused = |query: &'static str| {
        let path = format!("{items}?{query}");
        let api = &api;
        async move { api.get(&path).await.problem(400, "bad-parameter")["errors"][0].clone() }
    };
    let item = |parameter: &str, detail: &str| json!({"parameter": parameter, "detail": detail});
    assert_eq!(refused("id=one").await, item("id", "must be a whole number"));
    assert_eq!(refused("cogency=cogent").await, item("cogency", "is not a property of faces"));
    assert_eq!(refused("walls=1").await, item("walls", "is not a parameter of this operation"));
}

#[tokio::test]
async fn a_wrong_filter_is_told_where_it_is_wrong() {
    let api = Api::new().await;
    let items = format!("{}/collections/faces/items", api.hall().await);
    for (query, parameter, detail) in [
        ("filter=label%20%3D", "filter", "column 8: expected a property, a value or a condition, found the end"),
        (
            "filter=lable%20%3D%20'co'",
            "filter",
            "there is no property lable, and a text stands in single quotes; did you mean label, name or place?",
        ),
        ("filter=label%20%3D%205", "filter", "label (a text) cannot be compared with the number 5"),
        ("filter=", "filter", "is empty"),
        ("filter-lang=cql2-json&filter=%7B%22op%22%3A5%7D", "filter", "/op: must be a text"),
        ("filter-lang=sql&filter=TRUE", "filter-lang", "must be cql2-text or cql2-json"),
    ] {
        let problem = api.get(&format!("{items}?{query}")).await.problem(400, "bad-parameter");
        assert_eq!(problem["errors"], json!([{"parameter": parameter, "detail": detail}]), "{query}");
    }
    api.get(&format!("{items}?filter=TRUE&filter-crs=EPSG:4326")).await.problem(400, "bad-parameter");
}

#[tokio::test]
async fn every_queryable_can_be_filtered_by() {
    let api = Api::new().await;
    let map = api.hall().await;
    let list = api.get(&format!("{map}/collections")).await.json();
    for collection in list["collections"].as_array().expect("collections") {
        let address = |rel: &str| {
            let links = collection["links"].as_array().expect("links").iter();
            let link = links.into_iter().find(|link| link["rel"] == rel).unwrap_or_else(|| panic!("no link {rel}"));
            assert_eq!(link["type"], "application/schema+json");
            link["href"].as_str().expect("an address").to_owned()
        };
        let path = |address: &str| address.trim_start_matches("http://stillage.test").to_owned();
        let queryables_address = address("http://www.opengis.net/def/rel/ogc/1.0/queryables");
        let answer = api.get(&path(&queryables_address)).await;
        assert_eq!(answer.header("content-type"), "application/schema+json");
        let queryables = answer.json();
        assert_eq!(queryables["$id"], *queryables_address);
        assert_eq!(queryables["$schema"], "https://json-schema.org/draft/2020-12/schema");
        let items = format!("{map}/collections/{}/items", collection["id"].as_str().expect("an id"));
        for (name, queryable) in queryables["properties"].as_object().expect("properties") {
            let found = text(&api, &items, &format!("\"{name}\" IS NULL OR \"{name}\" IS NOT NULL")).await;
            assert_eq!(found.len(), collection["itemCount"], "{name}");
            let is_scalar = queryable["type"].as_str().is_some_and(|kind| kind != "array");
            if is_scalar {
                let answer = api.get(&format!("{items}?{name}=1")).await;
                let is_wrong_value = queryable["type"] == "boolean";
                assert_eq!(answer.status, if is_wrong_value { 400 } else { 200 }, "{name}: {}", answer.text());
            }
        }
        let schema = api.get(&path(&address("describedby"))).await.json();
        for feature in all(&api, &items).await {
            let properties = feature["properties"].as_object().expect("properties");
            for name in properties.keys() {
                assert!(schema["properties"].get(name).is_some(), "{name} is not in the schema");
            }
            for name in schema["required"].as_array().expect("names") {
                assert!(!properties[name.as_str().expect("a name")].is_null(), "{name} is missing in {feature}");
            }
        }
    }
}
