//! Figures as Markdown tables, in per cent.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use stillage_core::evaluation::{Evaluation, LabelScores};
use stillage_zoo::Kind;

use crate::sites::{Generated, OfZoo};

pub fn percent(share: f64) -> String {
    // Not -0, which a sum of nothing is.
    format!("{:.1}", 100.0 * share + 0.0)
}

pub fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count.max(1))
}

pub fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

pub fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|{}\n", head.join(" | "), " --- |".repeat(head.len()));
    for row in rows {
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// What the label scores of several maps have in common: means, and the worst F1.
struct Summary<'a>(Vec<&'a Evaluation>);

impl Summary<'_> {
    fn decided(&self, of: impl Fn(&LabelScores) -> f64) -> String {
        percent(mean(self.0.iter().map(|evaluation| of(&evaluation.decided))))
    }

    fn strict(&self) -> String {
        self.decided(|scores| scores.places.map_or(0.0, |places| places.strict))
    }

    fn automatic(&self) -> String {
        percent(mean(self.0.iter().map(|evaluation| evaluation.automatic.f1)))
    }

    fn worst(&self) -> String {
        percent(least(self.0.iter().map(|evaluation| evaluation.decided.f1)))
    }

    fn cogency(&self) -> String {
        percent(mean(self.0.iter().filter_map(|evaluation| evaluation.decided.cogency)))
    }

    fn orientation(&self) -> String {
        let errors = self.0.iter().filter_map(|evaluation| evaluation.geometry.orientation_error);
        format!("{:.3}", errors.fold(0.0, f64::max).to_degrees())
    }

    fn faces(&self) -> String {
        let ratios = self.0.iter().filter_map(|evaluation| evaluation.geometry.faces_per_place);
        format!("{:.2}", ratios.fold(0.0, f64::max))
    }

    /// The columns that every table ends with.
    fn rest(&self) -> [String; 6] {
        [
            self.decided(|scores| scores.overlap.corridor),
            self.decided(|scores| scores.overlap.junction),
            self.decided(|scores| scores.overlap.drivable),
            self.cogency(),
            self.orientation(),
            self.faces(),
        ]
    }
}

const REST: [&str; 6] =
    ["corridor IoU", "junction IoU", "drivable IoU", "cogency", "worst orientation error, °", "most faces per place"];

/// Maps of `generate.py` by sensor, difficulty and size.
pub fn generated(scores: &[Generated]) -> String {
    let mut groups: BTreeMap<(&str, &str), Vec<&Generated>> = BTreeMap::new();
    for score in scores {
        groups.entry((&score.group, "all")).or_default().push(score);
        groups.entry((&score.group, &score.size)).or_default().push(score);
    }
    let head = ["group", "size", "maps", "F1", "worst F1", "F1 automatic", "strict", "precision", "paper's F1"];
    let rows = groups.iter().map(|((group, size), scores)| {
        let summary = Summary(scores.iter().map(|score| &score.default).collect());
        let papers: Vec<f64> = scores.iter().filter_map(|score| Some(score.paper.as_ref()?.decided.f1)).collect();
        let paper = if papers.is_empty() { "-".to_owned() } else { percent(mean(papers.into_iter())) };
        let mut row = vec![(*group).to_owned(), (*size).to_owned(), scores.len().to_string()];
        row.extend([summary.decided(|scores| scores.f1), summary.worst(), summary.automatic(), summary.strict()]);
        row.extend([summary.decided(|scores| scores.precision), paper]);
        row.extend(summary.rest());
        row
    });
    table(&[&head[..], &REST].concat(), rows)
}

/// The regions of maps of the paper's size, as in its Table III.
pub fn regions(scores: &[Generated]) -> String {
    let head = [
        "group",
        "region",
        "places",
        "strict",
        "by area",
        "systematic misses",
        "precision of the map",
        "faces per place",
    ];
    let rows = scores.iter().flat_map(|score| {
        let decided = &score.default.decided;
        decided.regions.iter().map(|(region, places)| {
            let shares = [places.strict, places.area, places.systematic, decided.precision].map(percent);
            let faces = format!("{:.2}", score.default.geometry.faces_per_place.unwrap_or(f64::NAN));
            [&[score.group.clone(), region.clone(), places.places.to_string()][..], &shares, &[faces]].concat()
        })
    });
    table(&head, rows)
}

/// Sites of the zoo by kind.
pub fn zoo(scores: &[OfZoo]) -> String {
    let of = |kind: Option<Kind>| -> Vec<&OfZoo> {
        scores.iter().filter(|score| kind.is_none_or(|kind| score.kind == kind)).collect()
    };
    let head = ["kind", "F1", "worst F1", "F1 automatic", "with speckle", "automatic", "strict", "precision"];
    let rows = Kind::ALL.iter().copied().map(Some).chain([None]).map(|kind| {
        let scores = of(kind);
        let clean = Summary(scores.iter().map(|score| &score.clean).collect());
        let speckled = Summary(scores.iter().map(|score| &score.speckled).collect());
        let mut row = vec![kind.map_or_else(|| "**all**".to_owned(), |kind| kind.to_string())];
        row.extend([clean.decided(|scores| scores.f1), clean.worst(), clean.automatic()]);
        row.extend([speckled.decided(|scores| scores.f1), speckled.automatic(), clean.strict()]);
        row.push(clean.decided(|scores| scores.precision));
        row.extend(clean.rest());
        row
    });
    table(&[&head[..], &REST].concat(), rows)
}
