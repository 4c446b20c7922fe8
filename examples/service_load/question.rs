//! The questions that are asked.

use std::net::SocketAddr;

use crate::client::{self, Load};
use crate::serving::Serving;

/// Questions of one kind that nobody has asked before, before they begin again: more pages of 100 faces than fit into the
/// memory for answers.
const FRESH: usize = 4_000;

/// A question, and how often it is asked in a round.
pub struct Question {
    pub name: &'static str,
    /// Asked by turns.
    pub paths: Vec<String>,
    pub headers: String,
    times: usize,
}

impl Question {
    fn new(name: &'static str, path: impl Into<String>, headers: &str, times: usize) -> Self {
        Self { name, paths: vec![path.into()], headers: headers.to_owned(), times }
    }

    fn fresh(name: &'static str, path: impl Fn(usize) -> String) -> Self {
        Self { name, paths: (0..FRESH).map(path).collect(), headers: String::new(), times: 3_000 }
    }

    pub fn load(&self, serving: &Serving) -> Load {
        client::load(serving, &self.paths, &self.headers, self.times)
    }
}

/// Questions that are asked again and again, so that their answers are kept.
pub fn repeated(items: &str, service: SocketAddr) -> Vec<Question> {
    let page = format!("{items}?limit=100");
    let whole = format!("{items}?limit=10000");
    let tag = client::get(service, &page, "").header("etag").expect("an entity tag").to_owned();
    let (gzip, zstd) = ("accept-encoding: gzip\r\n", "accept-encoding: zstd\r\n");
    vec![
        Question::new("304", &page, &format!("if-none-match: {tag}\r\n"), 30_000),
        Question::new("page of 100", &page, "", 20_000),
        Question::new("page of 100, gzip", &page, gzip, 20_000),
        Question::new("whole layer, gzip", &whole, gzip, 3_000),
        Question::new("whole layer, zstd", &whole, zstd, 3_000),
        Question::new("/health/live", "/health/live", "", 20_000),
    ]
}

/// Questions of which each is new, so that each answer has to be made.
pub fn fresh(items: &str) -> Vec<Question> {
    // A box of 25 m somewhere on the 190 m x 170 m of the drawing, which are the metres of EPSG:3857.
    let corner = |number: usize| [number % 80 * 2, number / 80 * 2].map(|metres| metres as f64 + number as f64 * 1e-4);
    let query = move |query: String| format!("{items}?limit=100&{query}");
    let filter = move |text: String| query(format!("filter={}", encoded(&text)));
    vec![
        Question::fresh("bbox", move |number| {
            let [x, y] = corner(number);
            query(format!("bbox-crs=EPSG:3857&bbox={x:.4},{y:.4},{:.4},{:.4}", x + 25.0, y + 25.0))
        }),
        Question::fresh("property", move |number| query(format!("label=pc&after={number}"))),
        Question::fresh("CQL2, a comparison", move |number| filter(format!("areaM2 > 1.{number:04}"))),
        Question::fresh("CQL2, several conditions", move |number| {
            filter(format!("label IN ('co','ju') AND (areaM2 > 2.{number:04} OR occupiedFraction < 0.05)"))
        }),
        Question::fresh("CQL2, a geometry", move |number| {
            let [x, y] = corner(number);
            let corners = [[x, y], [x + 30.0, y + 5.0], [x + 5.0, y + 30.0], [x, y]];
            let corners = corners.map(|[x, y]| format!("{x:.4} {y:.4}")).join(",");
            filter(format!("S_INTERSECTS(geometry,POLYGON(({corners})))")) + "&filter-crs=EPSG:3857"
        }),
    ]
}

/// A value as it stands in a query.
fn encoded(value: &str) -> String {
    let character = |byte: u8| match byte {
        b if b.is_ascii_alphanumeric() => char::from(b).to_string(),
        b => format!("%{b:02X}"),
    };
    value.bytes().map(character).collect()
}
