//! The dashboard: the page that browsers get, and what it loads.

use crate::client::Api;

const BROWSER: &str = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8";

#[tokio::test]
async fn browsers_get_the_page_and_programs_the_landing_page() {
    let api = Api::new().await;
    let page = api.get_with("/", &[("accept", BROWSER)]).await;
    assert_eq!((page.status.as_u16(), page.header("content-type")), (200, "text/html; charset=utf-8"));
    assert!(page.text().contains("<script type=\"module\""), "{}", page.text());
    assert_eq!(api.get("/").await.json()["title"], "stillage");
    let again = api.get_with("/", &[("accept", BROWSER), ("if-none-match", page.header("etag"))]).await;
    assert_eq!(again.status, 304);
}

#[tokio::test]
async fn the_page_runs_its_own_scripts_only() {
    let api = Api::new().await;
    let page = api.get_with("/", &[("accept", BROWSER)]).await;
    let policy = page.header("content-security-policy");
    assert!(policy.starts_with("default-src 'none'; script-src 'self'; style-src 'self';"), "{policy}");
    assert!(!policy.contains("unsafe") && !policy.contains("http"), "{policy}");
    let text = page.text();
    assert!(!text.contains("<style") && !text.contains("style=") && !text.contains("//"), "{text}");
}

#[tokio::test]
async fn what_the_page_loads_is_kept_for_ever() {
    let api = Api::new().await;
    let page = api.get_with("/", &[("accept", BROWSER)]).await.text();
    let names: Vec<&str> =
        page.split('"').filter_map(|part| part.strip_prefix("./")).filter(|path| path.starts_with("assets/")).collect();
    assert!(names.len() >= 2, "{page}");
    for name in names {
        let asset = api.get(&format!("/{name}")).await;
        assert_eq!(asset.status, 200, "{name}");
        assert_eq!(asset.header("cache-control"), "public, max-age=31536000, immutable");
    }
    api.get("/assets/other.js").await.problem(404, "not-found");
}
