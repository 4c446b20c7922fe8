//! Abstract tests of OGC API - Features - Part 2: Coordinate Reference Systems by Reference (OGC 18-058r1, annex A), each
//! under its number, on a map without georeference and on a surveyed one.

use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Api, request};

const CRS84: &str = "http://www.opengis.net/def/crs/OGC/1.3/CRS84";
const EPSG_3857: &str = "http://www.opengis.net/def/crs/EPSG/0/3857";
const UTM_33: &str = "http://www.opengis.net/def/crs/EPSG/0/32633";

/// Two analysed halls: nominal, and surveyed in Halmstad.
async fn halls(api: &Api) -> [(String, Vec<&'static str>); 2] {
    let (nominal, surveyed) = (api.hall().await, api.hall().await);
    let place = json!({"georeference": {"lon": 12.8572, "lat": 56.6745, "heading": 30}});
    let patched = api.send_json(Method::PATCH, &surveyed, &[], &place).await;
    assert_eq!(patched.status, 200, "{}", patched.text());
    [(nominal, vec![CRS84, EPSG_3857]), (surveyed, vec![CRS84, EPSG_3857, UTM_33])]
}

/// The first position of a point.
fn position(feature: &Value) -> [f64; 2] {
    [0, 1].map(|axis| feature["geometry"]["coordinates"][axis].as_f64().expect("a number"))
}

#[tokio::test]
async fn a_1_to_3_collections_list_their_systems_by_uri() {
    let api = Api::new().await;
    for (map, systems) in halls(&api).await {
        let list = api.get(&format!("{map}/collections")).await.json();
        for collection in list["collections"].as_array().expect("a list") {
            assert_eq!(collection["crs"], json!(systems), "the default is the first");
            assert_eq!(collection["storageCrs"], systems[systems.len() - 1], "and in the list");
        }
    }
}

#[tokio::test]
async fn a_4_to_8_coordinates_are_in_the_system_that_was_asked_for() {
    let api = Api::new().await;
    for (map, systems) in halls(&api).await {
        let items = format!("{map}/collections/vertices/items");
        let plain = api.get(&format!("{items}?limit=1")).await;
        assert_eq!(plain.header("content-crs"), format!("<{CRS84}>"));
        for crs in systems {
            let page = api.get(&format!("{items}?limit=1&crs={crs}")).await;
            assert_eq!(page.header("content-crs"), format!("<{crs}>"));
            let first = page.json()["features"][0].clone();
            let alone = api.get(&format!("{items}/{}?crs={crs}", first["id"])).await;
            assert_eq!(alone.header("content-crs"), format!("<{crs}>"));
            assert_eq!(alone.json()["geometry"], first["geometry"]);
            let [x, y] = position(&first);
            let is_degrees =
                x.abs() <= 180.0 && y.abs() <= 90.0 && plain.json()["features"][0]["geometry"] == first["geometry"];
            assert_eq!(is_degrees, crs == CRS84, "{crs}: {x}, {y}");
        }
    }
}

#[tokio::test]
async fn a_surveyed_map_is_metres_of_its_zone() {
    let api = Api::new().await;
    let [_, (map, _)] = halls(&api).await;
    let items = format!("{map}/collections/vertices/items?limit=10000&crs=EPSG:32633");
    for vertex in api.get(&items).await.json()["features"].as_array().expect("a list") {
        let [x, y] = position(vertex);
        // The origin of the map frame lies at 368707.24, 6283205.51; the hall is 16 m long.
        assert!((x - 368_707.24).hypot(y - 6_283_205.51) < 20.0, "{x}, {y}");
    }
}

#[tokio::test]
async fn a_9_an_unknown_system_is_refused() {
    let api = Api::new().await;
    for (map, _) in halls(&api).await {
        for parameter in ["crs", "bbox-crs"] {
            for name in ["EPSG:4326", "EPSG:32632", "http://www.opengis.net/def/crs/EPSG/0/25833", "metres"] {
                let query = format!("bbox=0,0,1,1&{parameter}={name}");
                let problem =
                    api.get(&format!("{map}/collections/faces/items?{query}")).await.problem(400, "bad-parameter");
                assert_eq!(problem["errors"][0]["parameter"], parameter, "{query}");
            }
        }
    }
}

#[tokio::test]
async fn a_10_to_12_a_box_is_read_in_its_own_system() {
    let api = Api::new().await;
    for (map, systems) in halls(&api).await {
        let items = format!("{map}/collections/vertices/items");
        for crs in systems {
            let first = api.get(&format!("{items}?limit=1&crs={crs}")).await.json()["features"][0].clone();
            let [x, y] = position(&first);
            let room = if crs == CRS84 { 2e-7 } else { 0.02 };
            let bbox = format!("{},{},{},{}", x - room, y - room, x + room, y + room);
            let found = api.get(&format!("{items}?bbox={bbox}&bbox-crs={crs}")).await.json();
            assert_eq!((&found["numberMatched"], &found["features"][0]["id"]), (&json!(1), &first["id"]), "{crs}");
        }
    }
}

#[tokio::test]
async fn systems_go_by_many_names() {
    let api = Api::new().await;
    let [(map, _), _] = halls(&api).await;
    let items = format!("{map}/collections/faces/items");
    for (name, uri) in [
        ("CRS84", CRS84),
        ("http://www.opengis.net/def/crs/OGC/0/CRS84", CRS84),
        ("urn:ogc:def:crs:OGC:1.3:CRS84", CRS84),
        ("https://www.opengis.net/def/crs/EPSG/0/3857", EPSG_3857),
        ("urn:ogc:def:crs:EPSG::3857", EPSG_3857),
        ("%5BEPSG:3857%5D", EPSG_3857),
    ] {
        let answer =
            api.send(request(Method::GET, &format!("{items}?crs={name}"), &[], axum::body::Body::empty())).await;
        assert_eq!(
            (answer.status.as_u16(), answer.header("content-crs")),
            (200, format!("<{uri}>").as_str()),
            "{name}"
        );
    }
}
