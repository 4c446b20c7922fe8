//! Text that means to be more than text: markup, SQL, paths, ends of lines. It comes back as the text that it is.

use std::fmt::Write as _;

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, METADATA, form, pgm, request};
use crate::document::{Site, operations, valid};

/// What somebody may write where a name is asked for; short enough for a group.
const TEXTS: [&str; 10] = [
    "<script>alert(1)</script>",
    "\"><img src=x onerror=alert(1)>",
    "' onmouseover='alert(1)",
    "</title><svg/onload=alert(1)>",
    "</script><!--",
    "javascript:alert('1')",
    "'; DROP TABLE maps; --",
    "=HYPERLINK(\"http://evil\")",
    "${jndi:ldap://evil/x}&lt;b&gt;",
    "\u{202e}<b>\u{2028}gnp.exe",
];
/// The same as the code of a location.
const CODE: &str = "<b onclick=a()>";

/// Text as HTML shows it.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&#39;")
}

/// Whether a policy lets browsers run only scripts that the service sends as files of their own.
fn runs_no_script_within(policy: &str) -> bool {
    let directive = |name: &str| policy.split("; ").find_map(|directive| directive.strip_prefix(name));
    directive("script-src").or_else(|| directive("default-src")).map(str::trim) == Some("'self'")
}

#[track_caller]
fn is_done(answer: &Answer) {
    assert!(answer.status.is_success(), "{}", answer.text());
}

/// Writes a text wherever a client may write one.
async fn write_everywhere(api: &Api, map: &str, index: usize, text: &str) {
    let any = [("if-match", "*")];
    is_done(&api.send_json(Method::PATCH, map, &any, &json!({"name": text})).await);
    let label = |id: &str, functionality: Value| json!({"id": id, "name": text, "color": "#1f77b4", "functionality": functionality, "connectsTo": ["co"]});
    let rules = json!({"id": format!("texts-{index}"), "labels": [
        label("pc", json!(["storage"])), label("co", json!(["drivable", "storage-access"])), label("un", json!([]))]});
    is_done(&api.send_json(Method::POST, "/v1/rule-sets", &[], &rules).await);
    let labels = json!({"ruleSet": rules["id"], "assignment": api.all_labelled(map, "co").await});
    is_done(&api.send_json(Method::PUT, &format!("{map}/semantics"), &any, &labels).await);
    let rack = [[2.0, -0.5], [6.0, -0.5], [6.0, 0.0], [2.0, 0.0]];
    let corrections = json!({"corrections": [{"kind": "draw", "ring": rack, "label": "pc", "name": text},
        {"kind": "name", "at": [10.0, -0.2], "name": text}]});
    is_done(&api.send_json(Method::POST, &format!("{map}/corrections"), &any, &corrections).await);
    for collection in ["places", "locations"] {
        let items = format!("{map}/collections/{collection}/items");
        let list = api.get(&format!("{items}?limit=1")).await.json();
        let feature = &list["features"][0];
        let id = feature["id"].as_str().map_or_else(|| feature["id"].to_string(), str::to_owned);
        let path = format!("{items}/{}", id.replace(' ', "%20").replace('<', "%3C").replace('>', "%3E"));
        let names = json!({"name": text, "groups": [text]});
        is_done(&api.send_json(Method::PATCH, &path, &any, &names).await);
        if collection == "locations" {
            is_done(&api.send_json(Method::PATCH, &path, &any, &json!({"code": CODE})).await);
        }
    }
}

/// The addresses of all pages and drawings, by what the document says of their answers.
async fn pages(site: &Site) -> Vec<String> {
    let document = site.api.get("/openapi.json").await.json();
    let mut pages = Vec::new();
    for (id, operation) in operations(&document) {
        let content = operation["responses"]["200"]["content"].as_object();
        if content.is_some_and(|content| content.contains_key("text/html") || content.contains_key("image/svg+xml")) {
            let (sent, _) = valid(site, &id).await;
            pages.extend((sent.method == Method::GET).then_some(sent.path));
        }
    }
    assert!(pages.len() > 30, "{pages:?}");
    let items = |collection: &str| format!("{}/collections/{collection}/items", site.map);
    pages.extend(["places", "locations", "aisles", "rows"].map(items));
    pages.push("/v1/rule-sets/texts".to_owned());
    pages
}

#[tokio::test]
async fn texts_of_clients_are_shown_and_never_become_markup() {
    let site = Site::new().await;
    let (api, map) = (&site.api, &site.map);
    let pages = pages(&site).await;
    for (index, text) in TEXTS.into_iter().enumerate() {
        write_everywhere(api, map, index, text).await;
        assert_eq!(api.get(map).await.json()["name"], text, "as it was written");
        let mut shown = Vec::new();
        for page in &pages {
            let path = page.replace("rule-sets/texts", &format!("rule-sets/texts-{index}"));
            let answer = api.get_with(&path, &[("accept", "text/html,image/svg+xml")]).await;
            let told = || format!("{text} on {path}: {} {}", answer.status, answer.text());
            assert_eq!(answer.header("x-content-type-options"), "nosniff", "{}", told());
            assert!(runs_no_script_within(answer.header("content-security-policy")), "{}", told());
            // A correction or a feature may be gone after all that was written: that is told as JSON.
            if !answer.status.is_success() {
                assert_eq!(answer.header("content-type"), "application/problem+json", "{}", told());
                continue;
            }
            // A drawing has texts between its elements only, where quotes mean nothing.
            let means_more = match answer.header("content-type") {
                "text/html; charset=utf-8" => escaped(text) != text,
                "image/svg+xml" => text.contains('<'),
                other => panic!("{other}: {}", told()),
            };
            let html = answer.text();
            assert!(!(means_more && html.contains(text)), "{}", told());
            assert!(!html.contains(CODE) && !html.contains("href=\"javascript"), "{}", told());
            shown.extend(html.contains(&escaped(text)).then_some(path));
        }
        assert!(shown.len() >= 8, "{text} is shown on {shown:?}");
    }
    let table = api.get(&format!("{map}/collections/locations/items?f=csv")).await.text();
    assert!(table.contains(CODE) && !table.contains(",="), "{table}");
}

#[tokio::test]
async fn names_of_files_are_names_and_no_paths() {
    let api = Api::new().await;
    for (file_name, name) in [
        ("../../etc/passwd", "passwd"),
        ("C:\\\\windows\\\\system32\\\\drivers.png", "drivers"),
        ("<img src=x onerror=alert(1)>.pgm", "<img src=x onerror=alert(1)>"),
        ("a.pgm\u{0}.exe", "map"),
        ("'; DROP TABLE maps; --.pgm", "'; DROP TABLE maps; --"),
    ] {
        let parts = [("image", Some(file_name), pgm("#.\n..\n")), ("metadata", None, METADATA.as_bytes().to_vec())];
        let parts: Vec<_> = parts.iter().map(|(part, file, bytes)| (*part, *file, bytes.as_slice())).collect();
        let answer = api.send(form(&parts)).await;
        if answer.status == 400 {
            // A name that no header can hold.
            assert!(file_name.contains('\u{0}'), "{file_name}: {}", answer.text());
            continue;
        }
        assert_eq!(answer.status, 202, "{file_name}: {}", answer.text());
        let map = answer.json()["mapId"].as_str().expect("an id").to_owned();
        assert_eq!(api.get(&format!("/v1/maps/{map}")).await.json()["name"], name);
    }
}

#[tokio::test]
async fn addresses_with_sql_paths_and_ends_of_lines_find_nothing_and_break_nothing() {
    let api = Api::new().await;
    let map = api.hall().await;
    let mut wrong = String::new();
    for (path, status) in [
        ("/v1/maps/'%20OR%201=1--", 404),
        ("/v1/maps/%2e%2e", 404),
        ("/v1/maps/..%2f..%2fetc%2fpasswd", 404),
        ("/v1/jobs?status=running%27%3B--", 400),
        ("/v1/jobs?after=1%27%20OR%201=1", 400),
        ("/v1/maps?limit=1%0d%0aX-Injected:%20yes", 400),
        ("/v1/rule-sets/office%27--", 404),
        ("/v1/rule-sets/..%2foffice", 404),
        ("/problems/%3Cscript%3E", 404),
        ("/assets/..%2findex.html", 404),
        ("/docs/..%2f..%2fetc%2fpasswd", 404),
        ("{map}/exports/..%2f..%2fstillage.sqlite3", 404),
        ("{map}/exports/locations.csv%0d%0aX-Injected:%20yes", 404),
        ("{map}/collections/faces'--/items", 404),
        ("{map}/collections/faces/items/1%27%20OR%201=1", 404),
        ("{map}/collections/locations/items/%27%20UNION%20SELECT%201--", 404),
        ("{map}/collections/faces/items?limit=%00", 400),
        ("{map}/collections/faces/items?%00=1", 400),
        ("{map}/collections/faces/items?after=1%27%20OR%201=1", 400),
        ("{map}/collections/faces/items?bbox=0,0,1,1;DROP%20TABLE%20maps", 400),
        ("{map}/collections/faces/items?bbox=nan,0,1,1", 400),
        ("{map}/collections/faces/items?bbox=0,0,1e999,1", 400),
        ("{map}/collections/faces/items?crs=http://evil/crs", 400),
        ("{map}/collections/faces/items?f=%3Cscript%3E", 400),
        ("{map}/collections/faces/items?sortby=(SELECT%201)", 400),
        ("{map}/collections/faces/items?properties=*;--", 400),
        ("{map}/collections/faces/items?filter=1=1;DROP%20TABLE%20maps", 400),
        ("{map}/collections/faces/items?filter=label=%27x%27%20UNION%20SELECT%201", 400),
        ("{map}/collections/faces/items?filter=label=%27%27%27;DROP%20TABLE%20maps;--%27", 200),
        ("{map}/collections/faces/items?limit=1&filter=label%3C%3E%27%0d%0aX-Injected:%20yes%27", 200),
        ("{map}/routes?from=location:%3Cscript%3E&to=face:1", 404),
        ("{map}/routes?from=location:%27OR%201=1&to=face:1", 404),
    ] {
        let path = path.replace("{map}", &map);
        let answer = api.get_with(&path, &[("accept", "text/html,application/geo+json")]).await;
        let kind = answer.header("content-type");
        let is_safe =
            answer.headers.get("x-injected").is_none() && (answer.status == 200 || kind == "application/problem+json");
        if answer.status != status || !is_safe {
            writeln!(wrong, "{path}: {} {kind} {}", answer.status, answer.text()).expect("memory takes it");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    let listed = api.get("/v1/maps").await.json();
    assert_eq!(listed["maps"].as_array().map(Vec::len), Some(1), "the database is as it was");
    let upload =
        request(Method::POST, "/v1/maps?name=a%0d%0ab", &[("content-type", "application/json")], Body::from("{}"));
    api.send(upload).await.problem(400, "bad-parameter");
}
