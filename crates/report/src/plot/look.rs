//! What each variant looks like in every plot: a colour, a shape, a dash.

use crate::{Calibration, Scorecard};
use maud::{Markup, html};

/// Colours of the style sheet, told apart by colour-blind readers; beyond eight names they come
/// round again with another shape.
pub(crate) const COLOURS: usize = 8;

/// Names with a look of their own, whatever else is on the page: a colour means the same technique
/// on every page. Others come after them, in the order of the scorecard.
const KNOWN: [&str; 7] =
    ["hard", "pcf-grid-11", "pcf-vogel-16", "pcf-vogel-16-ign", "chss", "chss-mask", "chss-min"];

/// A variant's look. Both calibrations of a name share colour and shape: light-matched is solid,
/// as printed is hollow and dashed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Look {
    name: usize,
    pub(crate) calibration: Calibration,
}

impl Look {
    /// The look of a variant of this scorecard.
    pub(crate) fn of(card: &Scorecard, variant: usize) -> Self {
        let mut names: Vec<&str> = KNOWN.to_vec();
        for v in &card.variants {
            if !names.contains(&v.name.as_str()) {
                names.push(&v.name);
            }
        }
        let subject = &card.variants[variant];
        let name = names.iter().position(|n| *n == subject.name).unwrap_or(0);
        Self { name, calibration: subject.calibration }
    }

    /// The class that carries its colour.
    pub(crate) fn class(self) -> String {
        let kind = if self.calibration == Calibration::AsPrinted { "printed" } else { "matched" };
        format!("c{} {kind}", self.name % COLOURS)
    }

    /// Its shape round a point.
    pub(crate) fn marker(self, x: f64, y: f64, radius: f64) -> Markup {
        let class = format!("mark {}", self.class());
        let corners: &[(f64, f64)] = match (self.name + self.name / COLOURS) % COLOURS {
            0 => return html! { circle class=(class) cx=(p(x)) cy=(p(y)) r=(p(radius)) {} },
            1 => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            2 => &[(0.0, -1.15), (1.1, 0.85), (-1.1, 0.85)],
            3 => &[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
            4 => &[(0.0, 1.15), (1.1, -0.85), (-1.1, -0.85)],
            5 => &[(-1.15, 0.0), (0.85, -1.1), (0.85, 1.1)],
            6 => &[(1.15, 0.0), (-0.85, -1.1), (-0.85, 1.1)],
            _ => &[(-1.2, -0.6), (0.0, -1.2), (1.2, -0.6), (1.2, 0.6), (0.0, 1.2), (-1.2, 0.6)],
        };
        let point = |c: &(f64, f64)| format!("{},{}", p(x + radius * c.0), p(y + radius * c.1));
        let points = corners.iter().map(point).collect::<Vec<_>>().join(" ");
        html! { polygon class=(class) points=(points) {} }
    }
}

/// A place in a drawing, to a hundredth of a pixel.
pub(crate) fn p(v: f64) -> String {
    let text = format!("{v:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A small picture of a variant's marker and dash, for legends and rows.
pub(crate) fn swatch(look: Look) -> Markup {
    html! {
        svg.swatch viewBox="0 0 26 12" width="26" height="12" aria-hidden="true" {
            line class={ "line " (look.class()) } x1="0" y1="6" x2="26" y2="6" {}
            (look.marker(13.0, 6.0, 4.0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{Device, scorecard};

    #[test]
    fn a_look_follows_the_name_and_not_the_place() {
        let mut card = scorecard(Device::Software, (48, 27));
        let look = |card: &Scorecard, name: &str| {
            let place = card.variants.iter().position(|v| v.name == name).expect("in the fixture");
            Look::of(card, place)
        };
        let before = look(&card, "chss-min");
        assert_eq!(before.class(), "c6 matched");
        card.variants.retain(|v| v.name.starts_with("chss"));
        card.variants.reverse();
        card.variants[0].name = "another".into();
        card.variants[1].name = "one-more".into();
        assert_eq!(look(&card, "chss-min").name, before.name);
        assert_eq!(look(&card, "another").class(), "c7 printed");
        assert_eq!(look(&card, "one-more").name, look(&card, "another").name + 1);
    }
}
