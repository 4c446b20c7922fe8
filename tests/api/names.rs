//! Names for people: codes, names and groups, and how codes are written.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, request};

async fn item(api: &Api, map: &str, path: &str) -> Value {
    api.get(&format!("{map}/collections/{path}")).await.json()["properties"].clone()
}

/// Names a feature as it is now.
async fn name(api: &Api, map: &str, path: &str, body: &Value) -> Answer {
    let path = format!("{map}/collections/{path}");
    let tag = api.get(&path).await.header("etag").to_owned();
    api.send_json(Method::PATCH, &path, &[("if-match", &tag)], body).await
}

/// Changes members of the semantics in force.
async fn put_semantics(api: &Api, map: &str, members: &Value) -> Answer {
    let path = format!("{map}/semantics");
    let read = api.get(&path).await;
    let mut body = read.json();
    for (member, value) in members.as_object().expect("members") {
        body[member] = value.clone();
    }
    api.send_json(Method::PUT, &path, &[("if-match", read.header("etag"))], &body).await
}

async fn codes(api: &Api, map: &str) -> Vec<String> {
    let items = api.get(&format!("{map}/collections/locations/items?limit=1000")).await.json();
    let features = items["features"].as_array().expect("features").iter();
    features.map(|feature| feature["id"].as_str().expect("a code").to_owned()).collect()
}

#[tokio::test]
async fn locations_and_places_are_named_and_keep_their_names_through_relabelling() {
    let api = Api::new().await;
    let map = api.hall().await;
    let first = codes(&api, &map).await[0].clone();
    let named = name(
        &api,
        &map,
        &format!("locations/items/{first}"),
        &json!({"name": "By the gate", "groups": ["A", "A", "fast"]}),
    )
    .await;
    assert_eq!(named.status, 200, "{}", named.text());
    assert_eq!(named.json()["properties"]["name"], "By the gate");
    assert_eq!(named.json()["properties"]["groups"], json!(["A", "fast"]));
    assert_eq!(named.json()["properties"]["stale"], false);
    let coded = name(&api, &map, &format!("locations/items/{first}"), &json!({"code": "GATE 1"})).await;
    assert_eq!((coded.status.as_u16(), &coded.json()["id"]), (200, &json!("GATE 1")));
    for (collection, id) in [("places", 0), ("aisles", 1), ("rows", 1)] {
        let path = format!("{collection}/items/{id}");
        let named = name(&api, &map, &path, &json!({"name": format!("My {collection}"), "groups": ["ground"]})).await;
        assert_eq!(named.status, 200, "{}", named.text());
    }

    let label =
        json!({"overrides": [{"face": item(&api, &map, "locations/items/GATE%201").await["face"], "label": "un"}]});
    assert_eq!(put_semantics(&api, &map, &label).await.status, 200);
    api.get(&format!("{map}/collections/locations/items/GATE%201")).await.problem(404, "not-found");
    assert_eq!(put_semantics(&api, &map, &json!({"overrides": []})).await.status, 200);
    assert_eq!(item(&api, &map, "locations/items/GATE%201").await["name"], "By the gate");
    assert_eq!(item(&api, &map, "places/items/0").await["name"], "My places");
    assert_eq!(item(&api, &map, "rows/items/1").await["groups"], json!(["ground"]));

    let table = api.get(&format!("{map}/collections/locations/items?f=csv")).await.text();
    assert!(table.contains(",By the gate,A|fast,false"), "{table}");
    let registry = api.get(&format!("{map}/registry")).await.json();
    let kinds: Vec<&Value> = registry["areas"].as_array().expect("a list").iter().map(|area| &area["kind"]).collect();
    assert_eq!(kinds, ["place", "aisle", "row"]);

    // A merge patch takes away with null, and leaves the rest.
    let bare = name(&api, &map, "aisles/items/1", &json!({"name": null})).await.json()["properties"].clone();
    assert_eq!((&bare["name"], &bare["groups"]), (&Value::Null, &json!(["ground"])));
}

#[tokio::test]
async fn a_name_is_written_on_what_was_read() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/collections/places/items/0");
    let tag = api.get(&path).await.header("etag").to_owned();
    let patch = async |tag: &[(&str, &str)]| api.send_json(Method::PATCH, &path, tag, &json!({"name": "Hall"})).await;
    patch(&[]).await.problem(428, "precondition-required");
    assert_eq!(patch(&[("if-match", &tag)]).await.status, 200);
    patch(&[("if-match", &tag)]).await.problem(412, "precondition-failed");
    assert_eq!(patch(&[("if-match", "*"), ("content-type", "application/merge-patch+json")]).await.status, 200);
}

#[tokio::test]
async fn names_that_cannot_be_given_are_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    let codes = codes(&api, &map).await;
    let first = format!("locations/items/{}", codes[0]);
    let taken = name(&api, &map, &first, &json!({"code": codes[1]})).await.problem(409, "conflict");
    assert!(taken["detail"].as_str().is_some_and(|detail| detail.contains(&codes[1])), "{taken}");
    let cases = [
        (first.as_str(), json!({"code": "1234567890123456789"}), "/code"),
        (first.as_str(), json!({"code": "a,b"}), "/code"),
        (first.as_str(), json!({"name": "two\nlines"}), "/name"),
        (first.as_str(), json!({"name": "x".repeat(201)}), "/name"),
        (first.as_str(), json!({"groups": ["a|b"]}), "/groups/0"),
        (first.as_str(), json!({"label": "co"}), "/label"),
        ("places/items/0", json!({"code": "H"}), "/code"),
    ];
    for (path, body, pointer) in cases {
        let problem = name(&api, &map, path, &body).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{body}: {problem}");
    }
    let answer = name(&api, &map, "edges/items/1", &json!({"name": "x"})).await;
    answer.problem(405, "method-not-allowed");
    assert_eq!(answer.header("allow"), "GET,HEAD");
    name(&api, &map, "places/items/9999", &json!({"name": "x"})).await.problem(404, "not-found");
}

#[tokio::test]
async fn options_tells_what_may_be_written() {
    let api = Api::new().await;
    let map = api.hall().await;
    for (path, allow, patch) in [
        ("rows/items/1", "GET,HEAD,PUT,PATCH", "application/merge-patch+json, application/geo+json, application/json"),
        ("edges/items/1", "GET,HEAD", ""),
    ] {
        let path = format!("{map}/collections/{path}");
        let answer = api.send(request(Method::OPTIONS, &path, &[], Body::empty())).await;
        assert_eq!(
            (answer.status.as_u16(), answer.header("allow"), answer.header("accept-patch")),
            (204, allow, patch)
        );
        assert_eq!(answer.header("access-control-allow-methods"), "GET, HEAD", "pages of other sites read");
    }
}

#[tokio::test]
async fn another_template_is_a_wish_for_new_codes() {
    let api = Api::new().await;
    let map = api.hall().await;
    let before = codes(&api, &map).await;
    let last = before.last().expect("a code");
    name(&api, &map, &format!("locations/items/{}", before[0]), &json!({"name": "First"})).await;
    assert_eq!(name(&api, &map, &format!("locations/items/{last}"), &json!({"code": "mine"})).await.status, 200);
    let layout = json!({"layout": {"codeTemplate": "R{row}.{bay:02}{side}", "entrance": [12.0, 0.0]}});
    let put = put_semantics(&api, &map, &layout).await;
    assert_eq!((put.status.as_u16(), &put.json()["layout"]), (200, &layout["layout"]), "{}", put.text());
    let coded = codes(&api, &map).await;
    assert_eq!(coded.len(), before.len());
    assert!(coded.contains(&"mine".to_owned()), "a given code stays: {coded:?}");
    assert!(
        coded.iter().filter(|code| *code != "mine").all(|code| code.starts_with('R') && code.len() == 6),
        "{coded:?}"
    );
    let items = api.get(&format!("{map}/collections/locations/items?limit=1000")).await.json();
    let named =
        items["features"].as_array().expect("features").iter().filter(|one| one["properties"]["name"] == "First");
    assert_eq!(named.count(), 1, "names stay with their places");

    // What was read can be sent back, and another analysis keeps the layout.
    let same = put_semantics(&api, &map, &json!({})).await;
    assert_eq!((same.status.as_u16(), codes(&api, &map).await), (200, coded.clone()));
    api.send_json(Method::POST, &format!("{map}/analyses?activate=true"), &[], &json!({"seed": 5})).await;
    api.app.run_until_empty().await.expect("the queue can be worked on");
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["layout"], layout["layout"]);
    assert_eq!(codes(&api, &map).await, coded);

    let back = put_semantics(&api, &map, &json!({"layout": {}})).await;
    assert_eq!(back.json()["layout"], json!({"codeTemplate": "{aisle:02}-{bay:03}"}));
    let back = codes(&api, &map).await;
    assert!(back[..3] == before[..3] && back.contains(&"mine".to_owned()), "{back:?}");
}

#[tokio::test]
async fn wide_locations_are_cut_without_a_new_analysis() {
    let api = Api::new().await;
    let map = api.hall().await;
    let whole = codes(&api, &map).await.len();
    let put = put_semantics(&api, &map, &json!({"layout": {"placeWidthM": 0.4, "vehicleRadiusM": 0.3}})).await;
    assert_eq!(put.status, 200, "{}", put.text());
    let cut = codes(&api, &map).await;
    assert!(cut.len() > whole, "{whole} {cut:?}");
    let first = item(&api, &map, &format!("locations/items/{}", cut[0])).await;
    assert!(first["parts"].as_u64() > Some(1) && first["stale"] == false, "{first}");
    let matrix = json!({"from": [format!("location:{}", cut[0])]});
    let matrix = api.send_json(Method::POST, &format!("{map}/distance-matrix"), &[], &matrix).await;
    assert_eq!(matrix.json()["footprintRadiusM"], 0.3, "routes are for the same vehicle");
}

#[tokio::test]
async fn a_layout_that_cannot_be_is_refused_with_an_example() {
    let api = Api::new().await;
    let map = api.hall().await;
    let cases = [
        (json!({"codeTemplate": "{gang}-{bay}"}), "/layout/codeTemplate", "{aisle:02}-{bay:03}"),
        (json!({"codeTemplate": "{aisle}"}), "/layout/codeTemplate", "would not be unique"),
        (json!({"codeTemplate": "warehouse seven {aisle}.{bay}"}), "/layout/codeTemplate", "`warehouse seven"),
        (json!({"entrance": [500.0, 0.0]}), "/layout/entrance", "outside the map"),
        (json!({"placeWidthM": 0.0}), "/layout/placeWidthM", "0.1 to 20"),
        (json!({"vehicleRadiusM": 11.0}), "/layout/vehicleRadiusM", "0.05 to 10"),
        (json!({"template": "x"}), "/layout/template", "codeTemplate"),
    ];
    for (layout, pointer, hint) in cases {
        let problem = put_semantics(&api, &map, &json!({"layout": layout})).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
        assert!(problem["errors"][0]["detail"].as_str().is_some_and(|detail| detail.contains(hint)), "{problem}");
    }
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["version"], 0);
}

/// The lanes of the navigation graph, each as the places of its ends.
async fn lanes(api: &Api, map: &str) -> Vec<[[f64; 2]; 2]> {
    let graph = api.get(&format!("{map}/exports/nav2-route.geojson")).await.json();
    let features = graph["features"].as_array().expect("features");
    let place = |id: &Value| {
        let node = features.iter().find(|node| node["geometry"]["type"] == "Point" && node["properties"]["id"] == *id);
        let at = &node.expect("a node")["geometry"]["coordinates"];
        [at[0].as_f64().expect("x"), at[1].as_f64().expect("y")]
    };
    let lanes = features.iter().filter(|lane| lane["geometry"]["type"] != "Point");
    lanes.map(|lane| [place(&lane["properties"]["startid"]), place(&lane["properties"]["endid"])]).collect()
}

#[tokio::test]
async fn lanes_follow_the_rules_of_people() {
    let api = Api::new().await;
    let map = api.hall().await;
    let before = lanes(&api, &map).await;
    let lane = before[0];
    let back = [lane[1], lane[0]];
    assert!(before.contains(&back));
    let rules = json!([{"rule": "one-way", "from": lane[0], "to": lane[1]}]);
    let put = put_semantics(&api, &map, &json!({"layout": {"laneRules": rules}})).await;
    assert_eq!((put.status.as_u16(), &put.json()["layout"]["laneRules"]), (200, &rules), "{}", put.text());
    let after = lanes(&api, &map).await;
    assert!(after.contains(&lane) && !after.contains(&back));
    // Rules outlive another analysis.
    api.send_json(Method::POST, &format!("{map}/analyses?activate=true"), &[], &json!({"seed": 5})).await;
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let again = lanes(&api, &map).await;
    assert!(again.contains(&lane) && !again.contains(&back));

    let nowhere = json!({"layout": {"laneRules": [{"rule": "no-node", "at": [500.0, 0.0]}]}});
    let problem = put_semantics(&api, &map, &nowhere).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/layout/laneRules/0", "{problem}");
    assert!(problem["errors"][0]["detail"].as_str().is_some_and(|detail| detail.contains("the nearest is ")));
}

/// Sends a table of names.
async fn import(api: &Api, map: &str, query: &str, table: &str) -> Answer {
    let path = format!("{map}/names?crs=EPSG:3857{query}");
    api.send(request(Method::POST, &path, &[("content-type", "text/csv")], Body::from(table.to_owned()))).await
}

#[tokio::test]
async fn the_table_of_locations_is_sent_back_with_other_codes() {
    let api = Api::new().await;
    let map = api.hall().await;
    let before = codes(&api, &map).await;
    let table = api.get(&format!("{map}/collections/locations/items?f=csv")).await.text();
    // Every code becomes that of the next location: they are exchanged in one go.
    let mut rows: Vec<Vec<String>> = table.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    for (row, code) in rows[1..].iter_mut().zip(before.iter().cycle().skip(1)) {
        row[0].clone_from(code);
    }
    rows[1][0] = "GATE".into();
    let table = rows.iter().map(|row| row.join(",")).collect::<Vec<_>>().join("\r\n");
    let dry = import(&api, &map, "&dryRun=true", &table).await;
    assert_eq!(dry.status, 200, "{}", dry.text());
    let report = dry.json();
    assert_eq!(
        (&report["dryRun"], &report["named"], &report["unmatched"]),
        (&json!(true), &json!(before.len()), &json!(0))
    );
    assert_eq!(codes(&api, &map).await, before, "nothing was written");
    let made = import(&api, &map, "", &table).await.json();
    assert_eq!(made["changes"], report["changes"]);
    assert_eq!(
        made["changes"][0],
        json!({"row": "/rows/2", "collection": "locations", "before": before[0], "now": "GATE"})
    );
    let now = codes(&api, &map).await;
    assert!(now.contains(&"GATE".to_owned()) && !now.contains(&before[1]), "{now:?}");
    let again = import(&api, &map, "", &table).await.json();
    assert_eq!((&again["unchanged"], &again["changes"]), (&json!(before.len()), &json!([])));
}

#[tokio::test]
async fn what_is_wrong_in_a_table_is_told_by_its_row_and_nothing_is_named() {
    let api = Api::new().await;
    let map = api.hall().await;
    let before = codes(&api, &map).await;
    let centre = item(&api, &map, &format!("locations/items/{}", before[0])).await["centre"].clone();
    let other = item(&api, &map, &format!("locations/items/{}", before[2])).await["centre"].clone();
    let (at, there) = (format!("{},{}", centre[0], centre[1]), format!("{},{}", other[0], other[1]));
    let cases = [
        (format!("x,y,code\n{at},A\n{at},B\n"), "/rows/3", "like row 2"),
        (format!("x,y,code\n{at},A\n{there},A\n"), "/rows/3", "the code A of row 2"),
        (format!("x,y,code\n{at},{}\n", before[1]), "/rows/2", "another location has the code"),
        (format!("x,y,code\n{at},A\n-1,4,B\n"), "/rows/3", "is nearest"),
        (format!("x,y,code\n{at},1234567890123456789\n"), "/rows/2/code", "18 characters"),
        ("x,y,code\n1,y,A\n".to_owned(), "/rows/2/y", "no number"),
        ("x,y,codes\n1,2,A\n".to_owned(), "/rows/1", "no column"),
    ];
    for (table, pointer, hint) in cases {
        let problem = import(&api, &map, "", &table).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
        assert!(problem["errors"][0]["detail"].as_str().is_some_and(|detail| detail.contains(hint)), "{problem}");
    }
    assert_eq!(codes(&api, &map).await, before);
}

#[tokio::test]
async fn labelled_polygons_name_what_they_cover() {
    let api = Api::new().await;
    let map = api.hall().await;
    let first = codes(&api, &map).await[0].clone();
    let path = format!("{map}/collections/locations/items/{first}?crs=EPSG:3857");
    let location = api.get(&path).await.json()["geometry"].clone();
    let place = api.get(&format!("{map}/collections/places/items/0?crs=EPSG:3857")).await.json()["geometry"].clone();
    let feature = |geometry: &Value, properties: Value| json!({"type": "Feature", "geometry": geometry, "properties": properties});
    let document = json!({"type": "FeatureCollection", "features": [
        feature(&location, json!({"code": "P-1", "name": "Polygon", "fill": "red"})),
        feature(&place, json!({"name": "Whole", "collection": "places"})),
    ]});
    let headers = [("content-type", "application/geo+json")];
    let path = format!("{map}/names?crs=EPSG:3857");
    let report = api.send_json(Method::POST, &path, &headers, &document).await;
    assert_eq!(report.status, 200, "{}", report.text());
    assert_eq!(report.json()["named"], 2);
    assert_eq!(item(&api, &map, "locations/items/P-1").await["name"], "Polygon");
    assert_eq!(item(&api, &map, "places/items/0").await["name"], "Whole");
    let far = json!({"type": "Polygon", "coordinates": [[[500, 500], [501, 500], [501, 501], [500, 501], [500, 500]]]});
    let document = json!({"type": "FeatureCollection", "features": [feature(&far, json!({"code": "X"}))]});
    let problem = api.send_json(Method::POST, &path, &headers, &document).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/features/0");
}

#[tokio::test]
async fn a_pose_is_told_where_it_is() {
    let api = Api::new().await;
    let map = api.hall().await;
    assert_eq!(put_semantics(&api, &map, &json!({"layout": {"vehicleRadiusM": 0.2}})).await.status, 200);
    let first = codes(&api, &map).await[0].clone();
    name(&api, &map, &format!("locations/items/{first}"), &json!({"name": "Gate"})).await;
    let location = item(&api, &map, &format!("locations/items/{first}")).await;
    let at = async |x: &Value, y: &Value, more: &str| {
        let answer = api.get(&format!("{map}/at?point={x},{y}&crs=EPSG:3857{more}")).await;
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer.json()
    };
    let inside = at(&location["centre"][0], &location["centre"][1], "").await;
    assert_eq!((&inside["name"], &inside["location"]["code"]), (&json!("Gate"), &json!(first)));
    assert_eq!((&inside["location"]["distanceM"], &inside["location"]["side"]), (&json!(0.0), &location["side"]));
    assert_eq!(inside["face"]["id"], location["face"]);

    let pose = &location["approach"];
    let heading = location["headingDeg"].as_f64().expect("degrees");
    // Looking along the front of the location, it lies to the left or the right.
    let aisle = at(&pose["x"], &pose["y"], &format!("&heading={}", heading - 90.0)).await["aisle"].clone();
    assert_eq!(aisle["left"], json!(first), "{aisle}");
    let aisle = at(&pose["x"], &pose["y"], &format!("&heading={}", heading + 90.0)).await["aisle"].clone();
    assert_eq!(aisle["right"], json!(first), "{aisle}");
    assert!(["along", "against"].contains(&aisle["direction"].as_str().expect("a word")));

    let outside = api.get(&format!("{map}/at?point=-20,0&crs=EPSG:3857")).await.problem(404, "outside-map");
    assert!(outside["detail"].as_str().is_some_and(|detail| detail.contains("-1.875,0")), "{outside}");
    api.get(&format!("{map}/at?point=1&crs=EPSG:3857")).await.problem(400, "bad-parameter");
    api.get(&format!("{map}/at?point=1,1&heading=400&crs=EPSG:3857")).await.problem(400, "bad-parameter");
}

#[tokio::test]
async fn routes_lead_to_names_and_wrong_ones_are_mended() {
    let api = Api::new().await;
    let map = api.hall().await;
    let codes = codes(&api, &map).await;
    for (code, given) in [(&codes[0], "Gate"), (&codes[3], "Twin"), (&codes[4], "Twin")] {
        assert_eq!(name(&api, &map, &format!("locations/items/{code}"), &json!({"name": given})).await.status, 200);
    }
    let to = async |end: &str| {
        api.get(&format!("{map}/routes?from=location:{}&to={end}&footprintRadiusM=0.2", codes[6])).await
    };
    let by_name = to("name:Gate").await;
    assert_eq!(by_name.status, 200, "{}", by_name.text());
    assert_eq!(by_name.json()["geometry"], to(&format!("location:{}", codes[0])).await.json()["geometry"]);
    let several = to("name:Twin").await.problem(404, "not-found");
    assert!(
        several["detail"].as_str().is_some_and(|detail| detail.contains(&format!("location:{}", codes[4]))),
        "{several}"
    );
    let unknown = to("name:Gaet").await.problem(404, "not-found");
    assert!(unknown["detail"].as_str().is_some_and(|detail| detail.contains("did you mean Gate")), "{unknown}");
    let unknown = to("location:01-0011").await.problem(404, "not-found");
    assert!(unknown["detail"].as_str().is_some_and(|detail| detail.contains("did you mean 01-001")), "{unknown}");
}
