//! Profiles of GeoJSON: plain, or with the members of JSON-FG (OGC 21-045r1, clauses 14 and 15; OGC API Features part 5,
//! requirements class "Profile Query Parameter").

use super::items_format::Format;
use crate::http::links::HTML;
use crate::views::link::Link;

/// Where the OGC lists profiles.
const REGISTER: &str = "http://www.opengis.net/def/profile/OGC/0/";

/// A profile of GeoJSON.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GeoJsonProfile {
    /// Plain GeoJSON.
    Rfc7946,
    /// JSON-FG.
    JsonFg,
    /// JSON-FG whose features have shapes that readers of plain GeoJSON understand, too. Every document of JSON-FG here is
    /// one.
    JsonFgPlus,
}

impl GeoJsonProfile {
    const ALL: [Self; 3] = [Self::Rfc7946, Self::JsonFg, Self::JsonFgPlus];

    /// The first of the requested profiles in which a format can be written, else the default of the format; none where a
    /// format has no profiles. Whatever cannot be provided is no error (part 5, recommendation "profile-negotiation"): the
    /// links of the answer say which profile it has.
    pub fn chosen(requested: Option<&str>, format: Format) -> Option<Self> {
        let default = match format {
            Format::GeoJson => Self::Rfc7946,
            Format::JsonFg => Self::JsonFgPlus,
            Format::Html | Format::Csv | Format::FlatGeobuf => return None,
        };
        let is_written = |profile: &Self| format == Format::GeoJson || profile.is_json_fg();
        let named = requested.unwrap_or_default().split(',').filter_map(Self::find);
        Some(named.into_iter().find(is_written).unwrap_or(default))
    }

    /// The profile of a name, a URI or a safe CURIE.
    fn find(name: &str) -> Option<Self> {
        let name = name.trim();
        let secure = REGISTER.replacen("http:", "https:", 1);
        let curie = name.strip_prefix("[ogc-profile:").and_then(|rest| rest.strip_suffix(']'));
        let id = curie.or_else(|| name.strip_prefix(REGISTER)).or_else(|| name.strip_prefix(&secure)).unwrap_or(name);
        Self::ALL.into_iter().find(|profile| profile.id() == id)
    }

    const fn id(self) -> &'static str {
        match self {
            Self::Rfc7946 => "rfc7946",
            Self::JsonFg => "jsonfg",
            Self::JsonFgPlus => "jsonfg-plus",
        }
    }

    /// Whether documents have the members of JSON-FG.
    pub const fn is_json_fg(self) -> bool {
        matches!(self, Self::JsonFg | Self::JsonFgPlus)
    }

    /// The link that tells the profile of an answer.
    pub fn link(self) -> Link {
        Link { href: format!("{REGISTER}{}", self.id()), rel: "profile", r#type: HTML, title: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_profile_that_a_format_has_is_chosen() {
        let chosen = |requested, format| GeoJsonProfile::chosen(Some(requested), format);
        let plus = "http://www.opengis.net/def/profile/OGC/0/jsonfg-plus";
        let cases = [
            ("jsonfg", Format::GeoJson, Some(GeoJsonProfile::JsonFg)),
            ("rel-as-link, [ogc-profile:jsonfg],rfc7946", Format::GeoJson, Some(GeoJsonProfile::JsonFg)),
            (plus, Format::GeoJson, Some(GeoJsonProfile::JsonFgPlus)),
            ("of-somebody-else", Format::GeoJson, Some(GeoJsonProfile::Rfc7946)),
            ("rfc7946", Format::JsonFg, Some(GeoJsonProfile::JsonFgPlus)),
            ("rfc7946,jsonfg", Format::JsonFg, Some(GeoJsonProfile::JsonFg)),
            ("jsonfg", Format::Csv, None),
        ];
        for (requested, format, profile) in cases {
            assert_eq!(chosen(requested, format), profile, "{requested} as {format:?}");
        }
        assert_eq!(GeoJsonProfile::chosen(None, Format::GeoJson), Some(GeoJsonProfile::Rfc7946));
    }
}
