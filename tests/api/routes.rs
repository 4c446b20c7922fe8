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
    let answer = api.get(&format!("{map}/routes?from=-1,3.5&to=12,0&crs=EPSG:3857&footprintRadiusM=0.2")).await;
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
    let ends = format!("{map}/routes?from=face:{}&to=face:{}&footprintRadiusM=0.2", faces[0], faces[faces.len() - 1]);
    assert_eq!(api.get(&ends).await.status, 200);
}

#[tokio::test]
async fn no_route_says_why() {
    let api = Api::new().await;
    let map = drivable_hall(&api).await;
    let routes = format!("{map}/routes?crs=EPSG:3857&footprintRadiusM=0.2");
    api.get(&format!("{routes}&from=-1,3.5&to=500,500")).await.problem(404, "route-outside");
    let metres = api.get(&format!("{map}/routes?from=-1,3.5&to=12,0")).await.problem(404, "route-outside");
    assert_eq!(metres["detail"], "-1,3.5 is outside the map; did you mean crs=EPSG:3857?");
    let metres = api.get(&format!("{map}/at?point=-1,3.5")).await.problem(404, "outside-map");
    assert!(metres["detail"].as_str().expect("a text").ends_with("; did you mean crs=EPSG:3857?"), "{metres}");
    let blocked = api.get(&format!("{routes}&from=-1.9,3.5&to=12,0")).await.problem(404, "route-blocked");
    let [x, y] = [0, 1].map(|axis| blocked["position"][axis].as_f64().expect("a number"));
    assert!(blocked["detail"].as_str().expect("a text").ends_with(&format!("; {x},{y} would do")), "{blocked}");
    let wide = api
        .get(&format!("{map}/routes?crs=EPSG:3857&from=-1,3.5&to=12,0&footprintRadiusM=3"))
        .await
        .problem(404, "route-too-narrow");
    assert!(wide["detail"].as_str().expect("a text").contains("needs 3.00 m"), "{wide}");
    api.get(&format!("{routes}&from=face:1&to=face:999999")).await.problem(404, "not-found");
    api.get(&format!("{routes}&from=face:1&to=location:99-999")).await.problem(404, "not-found");
    for (query, parameter) in [("from=x&to=face:1", "from"), ("from=face:1&to=face:x", "to")] {
        let problem = api.get(&format!("{routes}&{query}")).await.problem(400, "bad-parameter");
        assert_eq!(problem["errors"][0]["parameter"], parameter);
    }
    api.get(&format!("{map}/routes")).await.problem(400, "bad-parameter");
    let unidentified = json!({"ruleSet": "warehouse", "assignment": api.all_labelled(&map, "un").await});
    api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &unidentified).await;
    api.get(&format!("{routes}&from=-1,3.5&to=12,0")).await.problem(404, "route-not-drivable");
}

#[tokio::test]
async fn a_route_fits_its_vehicle_and_says_how_to_drive_it() {
    let api = Api::new().await;
    let map = drivable_hall(&api).await;
    let routes = format!("{map}/routes?crs=EPSG:3857&from=-0.8,3.7&to=12,0");
    let point = api.get(&format!("{routes}&footprintRadiusM=0")).await.json();
    let wide = api.get(&format!("{routes}&footprint=0.2,0.2,0.2,-0.2,-0.2,-0.2,-0.2,0.2&speedMps=1")).await.json();
    let number = |route: &serde_json::Value, name: &str| route["properties"][name].as_f64().expect("a number");
    assert!((number(&wide, "footprintRadiusM") - 0.08_f64.sqrt()).abs() < 1e-9);
    assert!(number(&wide, "clearanceM") >= 0.28 && number(&wide, "lengthM") >= number(&point, "lengthM"));
    assert!(number(&wide, "timeS") > number(&wide, "lengthM"), "it speeds up and brakes");
    let steps = wide["properties"]["instructions"].as_array().expect("steps");
    assert_eq!((&steps[0]["action"], &steps[steps.len() - 1]["action"]), (&json!("depart"), &json!("arrive")));
    for (query, parameter) in [
        ("footprintRadiusM=-1", "footprintRadiusM"),
        ("footprint=1,2,3", "footprint"),
        ("labelCosts=none:2", "labelCosts"),
        ("blockedFaces=99999", "blockedFaces"),
        ("blockedEdges=99999", "blockedEdges"),
        ("alternatives=9", "alternatives"),
        ("speedMps=0", "speedMps"),
    ] {
        let problem = api.get(&format!("{routes}&{query}")).await.problem(400, "bad-parameter");
        assert_eq!(problem["errors"][0]["parameter"], parameter);
    }
}

#[tokio::test]
async fn a_matrix_tells_lengths_and_what_has_no_way() {
    let api = Api::new().await;
    let map = drivable_hall(&api).await;
    let body =
        json!({"from": ["-1,3.5", "500,500"], "to": ["-1,3.5", "12,0"], "crs": "EPSG:3857", "footprintRadiusM": 0});
    let answer = api.send_json(Method::POST, &format!("{map}/distance-matrix"), &[], &body).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    let lengths = &answer.json()["lengthsM"];
    assert_eq!((&lengths[0][0], &lengths[1]), (&json!(0.0), &json!([null, null])));
    let route = api.get(&format!("{map}/routes?from=-1,3.5&to=12,0&crs=EPSG:3857&footprintRadiusM=0")).await.json();
    let (length, alone) =
        (lengths[0][1].as_f64().expect("a way"), route["properties"]["lengthM"].as_f64().expect("one"));
    assert!((alone * 0.99..alone * 1.03).contains(&length), "{length} and {alone}");
    let wrong = json!({"from": [], "crs": "EPSG:3857"});
    api.send_json(Method::POST, &format!("{map}/distance-matrix"), &[], &wrong).await.problem(422, "invalid");
}
