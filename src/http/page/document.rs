//! A JSON document -> HTML: objects are tables of their members, lists of objects follow one another, links lead on.

use serde_json::Value;

use super::markup::{Markup, text};

/// A document, member by member.
pub fn markup(value: &Value) -> Markup {
    match value {
        Value::Object(_) if link(value).is_some() => markup_of_link(value),
        Value::Object(members) => {
            let row = |(name, value): (&String, &Value)| {
                let head = Markup::element("th", &[("scope", "row")], [text(name)]);
                Markup::element("tr", &[], [head, Markup::element("td", &[], [markup(value)])])
            };
            Markup::element("table", &[], members.iter().map(row))
        }
        Value::Array(entries) if entries.iter().any(|entry| link(entry).is_some()) => {
            Markup::element("ul", &[], entries.iter().map(|entry| Markup::element("li", &[], [markup_of_link(entry)])))
        }
        Value::Array(entries) if entries.iter().any(Value::is_object) => {
            Markup::element("div", &[], entries.iter().map(markup))
        }
        Value::Array(entries) if entries.iter().all(Value::is_string) => {
            Markup::element("ul", &[], entries.iter().map(|entry| Markup::element("li", &[], [markup(entry)])))
        }
        Value::String(words) if is_address(words) => Markup::element("a", &[("href", words)], [text(words)]),
        Value::String(words) => text(words),
        Value::Null => Markup::default(),
        other => text(&other.to_string()),
    }
}

/// Takes the shapes out of GeoJSON: nobody reads coordinates.
pub fn forget_shapes(value: &mut Value) {
    if let Some(members) = value.as_object_mut() {
        members.remove("geometry");
    }
    for feature in value.get_mut("features").and_then(Value::as_array_mut).into_iter().flatten() {
        forget_shapes(feature);
    }
}

/// Address and name of a link.
fn link(value: &Value) -> Option<(&str, String)> {
    let href = value.get("href")?.as_str().filter(|href| is_address(href))?;
    let word = |name: &str| value.get(name).and_then(Value::as_str).unwrap_or_default();
    let name = if word("title").is_empty() { word("rel") } else { word("title") };
    Some((href, format!("{name} ({})", word("type"))))
}

/// How the title of a link begins that nobody can follow by a click: what it leads to answers no reading.
const WRITES: &str = "POST ";

fn markup_of_link(value: &Value) -> Markup {
    match link(value) {
        None => markup(value),
        Some((href, name)) if name.starts_with(WRITES) => text(&format!("{name}: {href}")),
        Some((href, name)) => Markup::element("a", &[("href", href)], [text(&name)]),
    }
}

/// Whether a browser that follows this stays on the web.
fn is_address(text: &str) -> bool {
    text.starts_with("http://") || text.starts_with("https://")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn documents_are_tables_and_links_lead_on() {
        let document = json!({"id": "a<b", "count": 2, "links": [
            {"href": "http://here/x", "rel": "self", "type": "text/html"},
            {"href": "javascript:alert(1)", "rel": "next", "type": "text/html"}]});
        let html = markup(&document);
        assert!(html.as_str().starts_with("<table><tr><th scope=\"row\">id</th><td>a&lt;b</td></tr>"), "{html:?}");
        assert!(html.as_str().contains("<a href=\"http://here/x\">self (text/html)</a>"), "{html:?}");
        assert!(!html.as_str().contains("href=\"javascript"), "{html:?}");
    }

    #[test]
    fn what_only_a_program_can_follow_is_told_without_a_link() {
        let link =
            json!({"href": "http://here/x", "rel": "related", "type": "application/json", "title": "POST does it"});
        let html = markup(&json!({"links": [link]}));
        assert!(html.as_str().contains("<li>POST does it (application/json): http://here/x</li>"), "{html:?}");
    }

    #[test]
    fn shapes_of_features_are_left_out() {
        let feature = || json!({"type": "Feature", "geometry": {"type": "Point"}, "properties": {"code": "01-001"}});
        let mut document = json!({"type": "FeatureCollection", "features": [feature()], "counts": {"added": 1}});
        forget_shapes(&mut document);
        let bare = json!({"type": "Feature", "properties": {"code": "01-001"}});
        assert_eq!(document, json!({"type": "FeatureCollection", "features": [bare], "counts": {"added": 1}}));
    }
}
