//! Pieces of HTML. Text becomes one only by being escaped.

/// HTML in which every text is escaped.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Markup(String);

impl Markup {
    /// As it is written.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// An element around other pieces: its start tag's name and attributes, whose values are escaped.
    #[must_use]
    pub fn element(
        name: &'static str,
        attributes: &[(&'static str, &str)],
        inside: impl IntoIterator<Item = Self>,
    ) -> Self {
        let attributes: String =
            attributes.iter().map(|(name, value)| format!(" {name}=\"{}\"", text(value).as_str())).collect();
        let inside: String = inside.into_iter().map(|piece| piece.0).collect();
        Self(format!("<{name}{attributes}>{inside}</{name}>"))
    }
}

/// Text, escaped for any place of a page.
#[must_use]
pub fn text(text: &str) -> Markup {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    Markup(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_never_markup() {
        let piece = Markup::element("a", &[("href", "/x?a='1'&b=\"2\"")], [text("<script>&")]);
        assert_eq!(piece.as_str(), "<a href=\"/x?a=&#39;1&#39;&amp;b=&quot;2&quot;\">&lt;script&gt;&amp;</a>");
    }
}
