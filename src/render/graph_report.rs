//! The navigation graph over the map, with what its report finds: lanes in the colour of their component, dead ends,
//! locations that are not reached, narrow passages, and borders where labels and obstacles disagree.

use stillage_core::geometry::Point;
use stillage_core::graph::{LaneKind, NavigationGraph};
use stillage_core::graph_report::{GraphReport, LinkDisagreementKind};
use stillage_core::layout::Layout;
use stillage_core::{Analysis, SiteMap};

use super::drawing::{Colour, Drawing, Shape, Stroke};
use super::encoding::encode;
use super::frame::Frame;
use super::legend::{Item, Legend, Sample};
use super::mark::Mark;
use super::raster;
use super::style::{PAPER, colour, parse_colour};

/// Share of the colour of a label that is left on its faces: they are the ground behind the graph.
const TINT: f64 = 0.3;
/// Sizes in ems: thickness of lanes, of spurs and of borders, and width of marks.
const LANE: f64 = 0.22;
const SPUR: f64 = 0.1;
const BORDER: f64 = 0.3;
const MARK: f64 = 0.9;

/// Lanes that most locations are reached over.
const MAIN: Colour = [0, 92, 175];
const DEAD_END: Colour = [120, 40, 160];
const UNREACHABLE: Colour = [205, 20, 30];
const NARROW: Colour = [245, 130, 0];
const CLOSED: Colour = [205, 20, 30];
const OPEN: Colour = [0, 140, 60];

/// Draws a report, as PNG.
#[must_use]
pub fn graph_report_png(map: &SiteMap<'_>, layout: &Layout, graph: &NavigationGraph, report: &GraphReport) -> Vec<u8> {
    let drawing = drawing(map, layout, graph, report);
    encode(drawing.width, drawing.height, png::ColorType::Rgb, None, &raster::pixels(&drawing))
}

fn drawing<'a>(map: &SiteMap<'a>, layout: &Layout, graph: &NavigationGraph, report: &GraphReport) -> Drawing<'a> {
    let frame = Frame::of(map.grid);
    let mut shapes = faces(map, &frame);
    shapes.push(Shape::Cells { grid: map.grid, scale: frame.scale });
    shapes.extend(narrow_passages(graph, report, &frame));
    shapes.extend(lanes(graph, report, &frame));
    shapes.extend(borders(map.analysis, report, &frame));
    let mark = |mark: Mark, colour: Colour| {
        let size = MARK * frame.em;
        let frame = &frame;
        move |point: Point| {
            let at = frame.pixel(point);
            // A rim keeps marks apart from lanes of their colour.
            [mark.shape(at, 1.3 * size, PAPER, String::new()), mark.shape(at, size, colour, String::new())]
        }
    };
    let ends = report.dead_ends.iter().map(|end| graph.nodes[end.node].position);
    shapes.extend(ends.flat_map(mark(Mark::Square, DEAD_END)));
    let missed = report.unreachable.iter().map(|missed| layout.locations[missed.location].center);
    shapes.extend(missed.flat_map(mark(Mark::Cross, UNREACHABLE)));
    shapes.extend(report.narrow_passages.iter().map(|passage| passage.at).flat_map(mark(Mark::Diamond, NARROW)));
    legend(report, &frame).below(&frame, shapes)
}

/// The faces in the tint of their label.
fn faces<'a>(map: &SiteMap<'_>, frame: &Frame) -> Vec<Shape<'a>> {
    let subdivision = &map.analysis.subdivision;
    let area = |face| {
        let full = parse_colour(&map.semantic.label(face).color);
        let rings = subdivision.rings(face);
        Shape::Area {
            rings: rings.iter().map(|ring| ring.iter().map(|&point| frame.pixel(point)).collect()).collect(),
            colour: std::array::from_fn(|channel| {
                (TINT * f64::from(full[channel]) + (1.0 - TINT) * f64::from(PAPER[channel])).round() as u8
            }),
            title: String::new(),
        }
    };
    subdivision.faces().map(area).collect()
}

/// The colour of a component: the first one has its own.
fn component_colour(component: usize) -> Colour {
    component.checked_sub(1).map_or(MAIN, |other| colour(other + 1))
}

/// The lanes, each pair of nodes once, those of the first component last.
fn lanes<'a>(graph: &NavigationGraph, report: &GraphReport, frame: &Frame) -> Vec<Shape<'a>> {
    let mut component_of = vec![0; graph.nodes.len()];
    for (component, nodes) in report.components.iter().map(|component| &component.nodes).enumerate() {
        for &node in nodes {
            component_of[node] = component;
        }
    }
    let mut of_components: Vec<[Vec<[[f64; 2]; 2]>; 2]> = vec![[Vec::new(), Vec::new()]; report.components.len()];
    for lane in graph.lanes.iter().filter(|lane| lane.twin.is_none() || lane.from < lane.to) {
        let pairs = lane.path.windows(2).map(|pair| [frame.pixel(pair[0]), frame.pixel(pair[1])]);
        of_components[component_of[lane.from]][usize::from(lane.kind == LaneKind::Spur)].extend(pairs);
    }
    let shapes = |(component, [ways, spurs]): (usize, [Vec<[[f64; 2]; 2]>; 2])| {
        [(spurs, SPUR), (ways, LANE)].map(|(segments, thickness)| Shape::Lines {
            segments,
            stroke: Stroke { colour: component_colour(component), opacity: 1.0, thickness: thickness * frame.em },
        })
    };
    of_components.into_iter().enumerate().rev().flat_map(shapes).collect()
}

/// A band along narrow lanes.
fn narrow_passages<'a>(graph: &NavigationGraph, report: &GraphReport, frame: &Frame) -> Option<Shape<'a>> {
    let lanes = report.narrow_passages.iter().flat_map(|passage| &passage.lanes);
    let segments: Vec<_> = lanes
        .flat_map(|&lane| graph.lanes[lane].path.windows(2))
        .map(|pair| [frame.pixel(pair[0]), frame.pixel(pair[1])])
        .collect();
    let stroke = Stroke { colour: NARROW, opacity: 0.6, thickness: 2.5 * LANE * frame.em };
    (!segments.is_empty()).then_some(Shape::Lines { segments, stroke })
}

/// The borders where labels and obstacles disagree, by kind.
fn borders<'a>(analysis: &Analysis, report: &GraphReport, frame: &Frame) -> [Shape<'a>; 2] {
    [(LinkDisagreementKind::ConnectedButClosed, CLOSED), (LinkDisagreementKind::DisconnectedButOpen, OPEN)].map(
        |(kind, colour)| {
            let disagreeing = report.disagreements.iter().filter(|border| border.kind == kind);
            let edges = disagreeing.flat_map(|border| &border.edges);
            let segments = edges.map(|&edge| analysis.subdivision.segment(edge).map(|point| frame.pixel(point)));
            let stroke = Stroke { colour, opacity: 1.0, thickness: BORDER * frame.em };
            Shape::Lines { segments: segments.collect(), stroke }
        },
    )
}

fn legend(report: &GraphReport, frame: &Frame) -> Legend {
    let line =
        |colour: Colour, thickness: f64| Sample::Line(Stroke { colour, opacity: 1.0, thickness: thickness * frame.em });
    let counted = |what: &str, count: usize| format!("{what} ({count})");
    let of_kind = |kind: LinkDisagreementKind| report.disagreements.iter().filter(|border| border.kind == kind).count();
    let others = report.components.len().saturating_sub(1);
    let items = [
        Item::new(line(MAIN, LANE), "lanes"),
        Item::new(line(MAIN, SPUR), "spurs to locations"),
        Item::new(line(component_colour(1), LANE), counted("other components, each in its colour", others)),
        Item::new(Sample::Mark(Mark::Square, DEAD_END), counted("dead end", report.dead_ends.len())),
        Item::new(Sample::Mark(Mark::Cross, UNREACHABLE), counted("location not reached", report.unreachable.len())),
        Item::new(
            Sample::Mark(Mark::Diamond, NARROW),
            format!("narrower than {:.2} m ({})", report.options.min_passage_width, report.narrow_passages.len()),
        ),
        Item::new(
            line(CLOSED, BORDER),
            counted("connected, but closed", of_kind(LinkDisagreementKind::ConnectedButClosed)),
        ),
        Item::new(
            line(OPEN, BORDER),
            counted("disconnected, but open", of_kind(LinkDisagreementKind::DisconnectedButOpen)),
        ),
    ];
    Legend::new(items, frame)
}
