//! What is near a point.

use crate::client::Api;

#[tokio::test]
async fn the_nearest_features_come_first_with_their_distances() {
    let api = Api::new().await;
    let map = api.hall().await;
    let ask = async |query: &str| api.get(&format!("{map}/nearest?{query}")).await;
    let locations = ask("point=1,1&crs=EPSG:3857&k=4&properties=code").await;
    assert_eq!(locations.header("content-type"), "application/geo+json");
    assert_eq!(locations.header("content-crs"), "<http://www.opengis.net/def/crs/EPSG/0/3857>");
    let found = locations.json();
    let features = found["features"].as_array().expect("a list");
    assert_eq!((features.len(), &found["numberReturned"]), (4, &4.into()));
    let distances: Vec<f64> =
        features.iter().map(|feature| feature["properties"]["distanceM"].as_f64().expect("a number")).collect();
    assert!(distances.is_sorted() && distances[0] >= 0.0, "{distances:?}");
    let at = api.get(&format!("{map}/at?point=1,1&crs=EPSG:3857")).await.json();
    assert_eq!((&at["location"]["code"], &at["location"]["distanceM"]), (&features[0]["id"], &distances[0].into()));
    assert_eq!(features[0]["properties"].as_object().map(serde_json::Map::len), Some(2), "the code and the distance");

    let under = ask("point=1,1&crs=EPSG:3857&collection=faces").await.json();
    assert_eq!(
        (&under["features"][0]["id"], &under["features"][0]["properties"]["distanceM"]),
        (&at["face"]["id"], &0.0.into())
    );
    let filter = format!("id%3C%3E{}", at["face"]["id"]);
    let beside = ask(&format!("point=1,1&crs=EPSG:3857&collection=faces&filter={filter}")).await.json();
    assert_ne!(beside["features"][0]["id"], at["face"]["id"]);
    let path = format!("{map}/nearest?point=1,1&crs=EPSG:3857&k=4&properties=code");
    let again = api.get_with(&path, &[("if-none-match", locations.header("etag"))]).await;
    assert_eq!(again.status, 304);
}

#[tokio::test]
async fn a_point_or_a_collection_that_is_not_there_is_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    let ask = async |query: &str| api.get(&format!("{map}/nearest?{query}")).await;
    let outside = ask("point=-1,3.5").await.problem(404, "outside-map");
    assert!(
        outside["detail"].as_str().is_some_and(|detail| detail.ends_with("did you mean crs=EPSG:3857?")),
        "{outside}"
    );
    for wrong in [
        "",
        "point=1",
        "point=1,2,3",
        "point=1,1&crs=EPSG:3857&collection=shelves",
        "point=1,1&crs=EPSG:3857&k=0",
        "point=1,1&crs=EPSG:3857&properties=colour",
        "point=1,1&crs=EPSG:3857&filter=colour%3D1",
    ] {
        ask(wrong).await.problem(400, "bad-parameter");
    }
}
