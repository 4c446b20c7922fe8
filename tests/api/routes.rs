//! Routes through a map.

use axum::http::Method;
use serde_json::json;

use crate::client::Api;

/// A hall in which every place is a corridor: robots may drive wherever cells are free.
async fn drivable_hall(api: &Api) -> String {
    let map = api.hall().await;
    let all = api.all_labelled(&map, "co").await;
    let body = json!({"ruleSet": "warehouse", "assignment": all});
    let answer = api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &body).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    map
}

#[tokio::test]
async fn a_route_is_a_line_in_the_coordinates_asked_for() {
    let api = Api::new().await;
    let map = drivable_hall(&api).await;
    let answer = api.get(&format!("{map}/routes?from=-1,3.5&to=12,0&crs=EPSG:3857")).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert_eq!(answer.header("content-type"), "application/geo+json");
    assert_eq!(answer.header("content-crs"), "<http://www.opengis.net/def/crs/EPSG/0/3857>");
    let route = answer.json();
    assert_eq!((&route["type"], &route["geometry"]["type"]), (&json!("Feature"), &json!("LineString")));
    let line = route["geometry"]["coordinates"].as_array().expect("positions");
    assert_eq!((&line[0], line.last()), (&json!([-1, 3.5]), Some(&json!([12, 0]))));
    let length = route["properties"]["lengthM"].as_f64().expect("a length");
    assert!((13.4..20.0).contains(&length), "{length}");
    let faces = route["properties"]["faces"].as_array().expect("faces");
    let ends = format!("{map}/routes?from=face:{}&to=face:{}", faces[0], faces[faces.len() - 1]);
    assert_eq!(api.get(&ends).await.status, 200);
}

#[tokio::test]
async fn no_route_says_why() {
    let api = Api::new().await;
    let map = drivable_hall(&api).await;
    let routes = format!("{map}/routes?crs=EPSG:3857");
    api.get(&format!("{routes}&from=-1,3.5&to=500,500")).await.problem(404, "route-outside");
    api.get(&format!("{routes}&from=-1.9,3.5&to=12,0")).await.problem(404, "route-blocked");
    api.get(&format!("{routes}&from=face:1&to=face:999999")).await.problem(404, "not-found");
    api.get(&format!("{routes}&from=face:1&to=location:99-999")).await.problem(404, "not-found");
    for (query, parameter) in [("from=x&to=face:1", "from"), ("from=face:1&to=face:x", "to")] {
        let problem = api.get(&format!("{routes}&{query}")).await.problem(400, "bad-parameter");
        assert_eq!(problem["errors"][0]["parameter"], parameter);
    }
    api.get(&format!("{map}/routes")).await.problem(400, "bad-parameter");
    let unidentified = json!({"ruleSet": "warehouse", "assignment": {}});
    api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &unidentified).await;
    api.get(&format!("{routes}&from=-1,3.5&to=12,0")).await.problem(404, "route-not-drivable");
}
