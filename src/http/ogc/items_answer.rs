//! Features in the format that the client wants.

use std::sync::Arc;

use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde_json::{Map, Value, json};

use super::item_query::ItemQuery;
use super::items_format::Format;
use super::items_query::ItemsQuery;
use super::profile::GeoJsonProfile;
use crate::app::MapContext;
use crate::coordinates::{Crs, Transform};
use crate::features::query::{Page, PropertySelection};
use crate::features::{Collection, CollectionSchema, Feature};
use crate::formats::json_fg::{self, JsonFgDocument};
use crate::formats::{Json, csv, flatgeobuf, geojson};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::links::{Base, JSON, JSON_SCHEMA, encode, header as link_header};
use crate::http::page::{self, LinkedFeature, Markup};
use crate::views::link::Link;

/// What is asked about, and how it is to be written.
pub struct Answer {
    pub base: Base,
    pub context: Arc<MapContext>,
    pub properties: PropertySelection,
    pub format: Format,
    pub profile: Option<GeoJsonProfile>,
    pub crs: CrsName,
    pub transform: Transform,
}

impl Answer {
    const fn collection(&self) -> Collection {
        self.properties.collection()
    }

    fn is_json_fg(&self) -> bool {
        self.profile.is_some_and(GeoJsonProfile::is_json_fg)
    }

    /// The path of the collection.
    fn path(&self) -> String {
        format!("/v1/maps/{}/collections/{}", self.context.record.id, self.collection().id())
    }

    /// When the answer last changed: it is the same for all who ask, as its entity tag promises.
    fn time_stamp(&self) -> Timestamp {
        self.context.record.updated.max(self.context.semantics.created)
    }

    /// A page of features.
    pub fn page(&self, query: &ItemsQuery, page: &Page<'_>) -> Response {
        let address =
            |format, after: Option<&str>| format!("{}/items?{}", self.path(), query.parameters(format, after));
        let others = Format::ALL.into_iter().filter(|format| *format != self.format);
        let last = page.features.last().filter(|_| page.has_more).map(|last| last.id.to_string());
        let next = last.map(|last| {
            let path = address(self.format, Some(&last));
            self.base.link("next", &path, self.format.media_type()).titled("The next page")
        });
        let alternate = |format: Format| {
            self.base.link("alternate", &address(format, query.after()), format.media_type()).titled(format.title())
        };
        let mut links = vec![self.base.link("self", &address(self.format, query.after()), self.format.media_type())];
        links.extend(others.map(alternate));
        links.push(self.base.link("collection", &self.path(), JSON));
        let profile = self.profile.map(GeoJsonProfile::link);
        links.extend(profile.iter().chain(&next).cloned());
        let time_stamp = self.time_stamp();
        let returned = page.features.len();
        let members: [(&str, &dyn Json); 4] = [
            ("numberMatched", &page.matched),
            ("numberReturned", &returned),
            ("timeStamp", &time_stamp),
            ("links", &links),
        ];
        let features = page.features.iter().copied();
        let mut headers = self.headers();
        headers.extend(next.iter().chain(&profile).map(|link| (header::LINK, link_header(link))));
        match self.format {
            Format::GeoJson | Format::JsonFg if self.is_json_fg() => self.as_json_fg(|document| {
                (headers, json_fg::feature_collection(features, &self.properties, document, &members)).into_response()
            }),
            Format::GeoJson if self.crs.0 == Crs::Crs84 && !self.properties.are_named() => {
                let (all, texts) =
                    (self.context.features(self.collection()), self.context.feature_texts(self.collection()));
                (headers, texts.feature_collection(all, &page.features, &members)).into_response()
            }
            Format::GeoJson | Format::JsonFg => {
                (headers, geojson::feature_collection(features, &self.properties, &self.transform, &members))
                    .into_response()
            }
            // Importers know this table: its positions are map-frame metres whatever the request says.
            Format::Csv if self.collection() == Collection::Locations && !self.properties.are_named() => {
                headers.remove(CONTENT_CRS);
                (headers, csv::locations(features)).into_response()
            }
            Format::Csv => (headers, csv::collection(&self.properties, features, &self.transform)).into_response(),
            Format::FlatGeobuf => {
                (headers, flatgeobuf::collection(&self.properties, features, &self.transform)).into_response()
            }
            Format::Html => self.table(page, &links),
        }
    }

    /// A feature by itself.
    pub fn feature(&self, feature: &Feature, query: &ItemQuery) -> Response {
        let path = format!("{}/items/{}", self.path(), encode(&feature.id.to_string()));
        let address = |format: Format| match query.parameters(format) {
            parameters if parameters.is_empty() => path.clone(),
            parameters => format!("{path}?{parameters}"),
        };
        let alternate = |format: Format| self.base.link("alternate", &address(format), format.media_type());
        let mut links = vec![self.base.link("self", &address(self.format), self.format.media_type())];
        links.extend(Format::OF_ONE.into_iter().filter(|format| *format != self.format).map(alternate));
        links.push(self.base.link("collection", &self.path(), JSON));
        let profile = self.profile.map(GeoJsonProfile::link);
        links.extend(profile.clone());
        let mut headers = self.headers();
        headers.extend(profile.iter().map(|link| (header::LINK, link_header(link))));
        let members: [(&str, &dyn Json); 1] = [("links", &links)];
        match self.format {
            Format::GeoJson | Format::JsonFg if self.is_json_fg() => self.as_json_fg(|document| {
                (headers, json_fg::feature(feature, &self.properties, document, &members)).into_response()
            }),
            Format::Html => {
                let title = format!("{} {}", CollectionSchema::of(self.collection()).title, feature.id);
                let drawing = page::drawing(&[self.drawn(feature)]);
                let properties: Map<String, Value> = self
                    .properties
                    .values(feature)
                    .map(|(property, value)| (property.name.to_owned(), json!(value)))
                    .collect();
                page::document(&title, &json!({"properties": properties, "links": links}), &drawing)
            }
            _ => (headers, geojson::feature(feature, &self.properties, &self.transform, &members)).into_response(),
        }
    }

    fn headers(&self) -> HeaderMap {
        let mut headers = HeaderMap::new();
        let (media_type, extension) = match self.format {
            Format::Csv => ("text/csv; charset=utf-8", Some("csv")),
            Format::FlatGeobuf => (self.format.media_type(), Some("fgb")),
            _ => (self.format.media_type(), None),
        };
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(media_type));
        headers.insert(CONTENT_CRS, self.crs.header());
        let name =
            extension.map(|extension| format!("attachment; filename=\"{}.{extension}\"", self.collection().id()));
        headers.extend(name.and_then(|name| Some((header::CONTENT_DISPOSITION, HeaderValue::try_from(name).ok()?))));
        headers
    }

    /// Writes JSON-FG: its metres are those of the map frame where degrees are asked for.
    fn as_json_fg<T>(&self, write: impl FnOnce(JsonFgDocument<'_>) -> T) -> T {
        let (map_frame, uri) = (Transform::map_frame(), self.crs.uri());
        let degrees = Transform::new(Crs::Crs84, self.context.record.georeference);
        let (place, place_uri) = match self.crs.0 {
            Crs::Crs84 => (&map_frame, json_fg::ENGINEERING_2D),
            _ => (&self.transform, uri.as_str()),
        };
        let schema = self.base.link("describedby", &format!("{}/schema", self.path()), JSON_SCHEMA).href;
        // The schema asks for properties that a selection leaves out.
        let schema = Some(schema.as_str()).filter(|_| !self.properties.are_named());
        write(JsonFgDocument { place, place_uri, geometry: &degrees, schema })
    }

    fn drawn<'a>(&self, feature: &'a Feature) -> LinkedFeature<'a> {
        let path = format!("{}/items/{}?f=html", self.path(), encode(&feature.id.to_string()));
        LinkedFeature { feature, href: self.base.link("item", &path, Format::Html.media_type()).href }
    }

    /// A page of features as a page for people: a small map, and a row for each.
    fn table(&self, page: &Page<'_>, links: &[Link]) -> Response {
        let schema = CollectionSchema::of(self.collection());
        let cells = |name: &'static str, texts: Vec<Markup>| {
            Markup::element("tr", &[], texts.into_iter().map(|text| Markup::element(name, &[], [text])))
        };
        // The id leads to the page of its feature, whether it is among the properties or not.
        let id = &schema.properties[0];
        let others = || self.properties.properties().filter(|property| property.name != id.name);
        let head = std::iter::once(id).chain(others()).map(|property| page::text(property.name)).collect();
        let head = cells("th", head);
        let drawn: Vec<LinkedFeature<'_>> = page.features.iter().map(|feature| self.drawn(feature)).collect();
        let rows = drawn.iter().map(|LinkedFeature { feature, href }| {
            let link = Markup::element("a", &[("href", href)], [page::part(&feature.id)]);
            let values = self.properties.values(feature).filter(|(property, _)| property.name != id.name);
            cells("td", std::iter::once(link).chain(values.map(|(_, value)| page::part(&value))).collect())
        });
        let table = Markup::element("table", &[], std::iter::once(head).chain(rows));
        let found = format!("{} of {} features", page.features.len(), page.matched);
        let found = Markup::element("p", &[], [page::text(&found)]);
        let links = page::part(&links);
        page::page(schema.title, &[&page::drawing(&drawn), &found, &table, &links])
    }
}
