//! Files for other programs.

use std::collections::BTreeSet;

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Api, request};

#[tokio::test]
async fn every_listed_export_is_served_as_it_is_listed() {
    let api = Api::new().await;
    let map = api.hall().await;
    let list = api.get(&format!("{map}/exports")).await.json();
    let document = api.get("/openapi.json").await.json();
    let documented = &document["paths"]["/v1/maps/{mapId}/exports/{file}"]["get"]["responses"]["200"]["content"];
    let mut names = BTreeSet::new();
    for export in list["exports"].as_array().expect("exports") {
        let name = export["name"].as_str().expect("a name");
        let href = export["links"][0]["href"].as_str().expect("a link");
        assert_eq!(href, format!("http://stillage.test{map}/exports/{name}"));
        let path = &href["http://stillage.test".len()..];
        let answer = api.get(path).await;
        assert_eq!(answer.status, 200, "{name}: {}", answer.text());
        assert_eq!(answer.header("content-type"), export["mediaType"]);
        assert!(documented[answer.header("content-type")].is_object(), "{name}");
        assert_eq!(answer.header("content-disposition"), format!("attachment; filename=\"{name}\""));
        assert!(!answer.body.is_empty(), "{name}");
        let tag = answer.header("etag").to_owned();
        let again = api.get_with(path, &[("if-none-match", &tag)]).await;
        assert_eq!((again.status.as_u16(), again.body.len()), (304, 0), "{name}");
        let head = api.send(request(Method::HEAD, path, &[], Body::empty())).await;
        assert_eq!((head.status.as_u16(), head.header("etag"), head.body.len()), (200, tag.as_str(), 0), "{name}");
        names.insert(name.to_owned());
    }
    for name in ["lif.json", "lif-2.0.json", "nav2-route.geojson", "rmf.building.yaml", "faces.fgb", "bundle.zip"] {
        assert!(names.contains(name), "{name}");
    }
    let links = api.get(&map).await.json()["links"].clone();
    assert!(
        links
            .as_array()
            .expect("links")
            .iter()
            .any(|link| link["href"] == format!("http://stillage.test{map}/exports"))
    );
}

#[tokio::test]
async fn a_tag_is_that_of_the_options_and_the_labels() {
    let api = Api::new().await;
    let map = api.hall().await;
    let tag = async |query: &str| {
        let answer = api.get(&format!("{map}/exports/locations.csv{query}")).await;
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer.header("etag").to_owned()
    };
    let (plain, odoo) = (tag("").await, tag("?profile=odoo").await);
    assert_ne!(plain, odoo);
    assert_eq!(plain, tag("?profile=generic").await, "the same options have the same tag");
    let labels = json!({"assignment": api.all_labelled(&map, "co").await});
    api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &labels).await;
    assert_ne!(plain, tag("").await);
}

#[tokio::test]
async fn what_is_unknown_is_refused_with_what_is_known() {
    let api = Api::new().await;
    let map = api.hall().await;
    let problem = api.get(&format!("{map}/exports/lif.xml")).await.problem(404, "not-found");
    assert!(problem["detail"].as_str().expect("a text").contains("there are lif.json, lif-2.0.json"), "{problem}");
    for (address, parameter) in [
        ("lif.json?stranger=1", "stranger"),
        ("lif.json?profile=odoo", "profile"),
        ("lif.json?footprintRadiusM=-1", "footprintRadiusM"),
        ("lif.json?footprintRadiusM=1&footprintRadiusM=2", "footprintRadiusM"),
        ("locations.csv?profile=excel", "profile"),
        ("locations.csv?profile=sap-ewm&warehouse=TOO-LONG", "warehouse"),
        ("vda5050-zone-set.json?zones=xx:BLOCKED", "zones"),
        ("vda5050-zone-set.json?zones=ju:FAST", "zones"),
        ("bundle.zip?zones=xx:BLOCKED", "zones"),
        ("faces.fgb?crs=EPSG:1", "crs"),
    ] {
        let problem = api.get(&format!("{map}/exports/{address}")).await.problem(400, "bad-parameter");
        assert_eq!(problem["errors"][0]["parameter"], parameter, "{problem}");
    }
}

#[tokio::test]
async fn options_change_what_is_written() {
    let api = Api::new().await;
    let map = api.hall().await;
    let zones = api.get(&format!("{map}/exports/vda5050-zone-set.json?zones=ju:NONE,co:PENALTY:0.25")).await.json();
    assert!(zones["timestamp"].as_str().is_some_and(|time| time.len() == "2026-01-15T08:00:00.000Z".len()), "{zones}");
    let zones = zones["zoneSet"]["zones"].as_array().expect("zones").clone();
    assert!(zones.iter().all(|zone| zone["zoneType"] != "SPEED_LIMIT" && zone["zoneType"] != "BIDIRECTED"));
    let odoo = api.get(&format!("{map}/exports/locations.csv?profile=odoo&warehouse=WH1")).await.text();
    assert!(odoo.starts_with("name,location_id,usage,barcode") && odoo.contains(",WH1,internal,"), "{odoo}");
    let wide = api.get(&format!("{map}/exports/lif.json?footprintRadiusM=4")).await.json();
    assert_eq!(wide["layouts"][0]["edges"], json!([]), "no aisle is 8 m wide");
    api.get(&format!("{map}/exports/nav2-route.geojson?footprintRadiusM=4")).await.problem(409, "conflict");
}

#[tokio::test]
async fn a_name_that_a_spreadsheet_would_run_is_only_text() {
    let api = Api::new().await;
    let map = api.hall().await;
    let text = api.get(&format!("{map}/exports/locations.csv?profile=odoo&warehouse=%3DHYPERLINK(1)")).await.text();
    assert!(text.contains(",'=HYPERLINK(1),") && !text.contains(",=HYPERLINK"), "{text}");
}

#[tokio::test]
async fn a_vehicle_is_sent_to_the_bundle_with_its_checksum() {
    let api = Api::new().await;
    let map = api.hall().await;
    let order =
        api.get(&format!("{map}/exports/vda5050-download-map.json?warehouse=W%261&serialNumber=7")).await.json();
    let parameters = order["actions"][0]["actionParameters"].as_array().expect("parameters").clone();
    let value = |key: &str| {
        let found = parameters.iter().find(|parameter| parameter["key"] == key);
        found.and_then(|found| found["value"].as_str()).expect("a text").to_owned()
    };
    let link = value("mapDownloadLink");
    assert_eq!(link, format!("http://stillage.test{map}/exports/bundle.zip?warehouse=W%261"));
    let bundle = api.get(&link["http://stillage.test".len()..]).await;
    let sum: String =
        <sha2::Sha256 as sha2::Digest>::digest(&bundle.body).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!((value("mapHash"), order["serialNumber"].clone()), (sum, Value::from("7")));
}
