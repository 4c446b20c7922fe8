//! A drawing as SVG text. Every text is escaped, so that a name cannot become markup.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::drawing::{Colour, Drawing, HALO, Pixel, Shape, Stroke, Text};
use super::{cells, typeface};

/// Writes the drawing as an SVG document.
pub(super) fn write(drawing: &Drawing<'_>) -> String {
    let Drawing { width, height, background, shapes } = drawing;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"{}\" text-anchor=\"middle\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
        typeface::FAMILIES,
        hex(*background)
    );
    for shape in shapes {
        write_shape(&mut svg, shape).expect("a string takes every byte");
    }
    svg.push_str("</svg>\n");
    svg
}

fn write_shape(svg: &mut String, shape: &Shape<'_>) -> std::fmt::Result {
    match shape {
        Shape::Area { rings, colour, title } => {
            write!(svg, "<path fill=\"{}\" shape-rendering=\"crispEdges\" d=\"", hex(*colour))?;
            for ring in rings {
                write_line(svg, ring)?;
                svg.push('Z');
            }
            svg.push('"');
            match title.as_str() {
                "" => svg.push_str("/>\n"),
                title => writeln!(svg, "><title>{}</title></path>", escape(title))?,
            }
            Ok(())
        }
        Shape::Cells { grid, scale } => {
            let (width, height) = (scale.pixels(grid.width()), scale.pixels(grid.height()));
            write!(svg, "<image width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" ")?;
            svg.push_str("style=\"image-rendering:pixelated\" href=\"data:image/png;base64,");
            BASE64_STANDARD.encode_string(cells::png(grid, *scale), svg);
            svg.push_str("\"/>\n");
            Ok(())
        }
        Shape::Lines { segments, stroke: Stroke { colour, opacity, thickness } } => {
            write!(svg, "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{thickness}\" ", hex(*colour))?;
            write!(svg, "stroke-opacity=\"{opacity}\" d=\"")?;
            for segment in segments {
                write_line(svg, segment)?;
            }
            svg.push_str("\"/>\n");
            Ok(())
        }
        Shape::Text(text) => write_text(svg, text),
    }
}

fn write_text(svg: &mut String, Text { content, middle: [x, y], size, turn, colour, halo }: &Text) -> std::fmt::Result {
    write!(svg, "<text transform=\"translate({x:.2} {y:.2}) rotate({turn:.2})\" ")?;
    write!(svg, "y=\"{:.2}\" font-size=\"{size:.2}\" fill=\"{}\"", size * typeface::CAPITALS / 2.0, hex(*colour))?;
    if let Some(halo) = halo {
        write!(svg, " paint-order=\"stroke\" stroke=\"{}\" stroke-width=\"{:.2}\"", hex(*halo), size * HALO)?;
    }
    writeln!(svg, ">{}</text>", escape(content))
}

/// A polyline in the language of paths.
fn write_line(svg: &mut String, points: &[Pixel]) -> std::fmt::Result {
    for (index, [x, y]) in points.iter().enumerate() {
        write!(svg, "{}{x:.2} {y:.2}", if index == 0 { 'M' } else { 'L' })?;
    }
    Ok(())
}

fn hex([red, green, blue]: Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Text as XML content: markup is escaped, and what XML does not know (control characters) is replaced.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            letter if letter.is_control() => escaped.push('\u{fffd}'),
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_no_markup() {
        let text = Text {
            content: "<script>alert(\"1 & 2\")</script>\u{1}".to_owned(),
            middle: [5.0, 5.0],
            size: 4.0,
            turn: 0.0,
            colour: [0; 3],
            halo: Some([255; 3]),
        };
        let rings = vec![vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]];
        let area = Shape::Area { rings, colour: [0; 3], title: "</title><script/>".to_owned() };
        let drawing = Drawing { width: 10, height: 10, background: [255; 3], shapes: vec![area, Shape::Text(text)] };
        expect_test::expect![[r##"
            <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10" width="10" height="10" font-family="'DejaVu Sans', Verdana, sans-serif" text-anchor="middle">
            <rect width="10" height="10" fill="#ffffff"/>
            <path fill="#000000" shape-rendering="crispEdges" d="M0.00 0.00L1.00 0.00L1.00 1.00Z"><title>&lt;/title&gt;&lt;script/&gt;</title></path>
            <text transform="translate(5.00 5.00) rotate(0.00)" y="1.46" font-size="4.00" fill="#000000" paint-order="stroke" stroke="#ffffff" stroke-width="0.88">&lt;script&gt;alert(&quot;1 &amp; 2&quot;)&lt;/script&gt;�</text>
            </svg>
        "##]]
        .assert_eq(&write(&drawing));
    }
}
