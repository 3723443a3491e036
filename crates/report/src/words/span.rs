//! A sentence as parts, so that pages and plain text say the same.

use crate::{Scorecard, VariantCard};
use maud::{Markup, Render, html};
use std::collections::BTreeMap;

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Span {
    Text(String),
    /// A number with its interval, already formatted.
    Number(String),
    Link(Target, String),
}

/// Where a link leads on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    Variant(usize),
    Section(&'static str),
}

/// One sentence of the answer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sentence(pub(crate) Vec<Span>);

impl Sentence {
    pub(crate) fn text(mut self, text: impl Into<String>) -> Self {
        self.0.push(Span::Text(text.into()));
        self
    }

    pub(crate) fn number(mut self, number: impl Into<String>) -> Self {
        self.0.push(Span::Number(number.into()));
        self
    }

    pub(crate) fn section(mut self, id: &'static str, text: &str) -> Self {
        self.0.push(Span::Link(Target::Section(id), text.into()));
        self
    }

    pub(crate) fn variant(mut self, card: &Scorecard, variant: usize) -> Self {
        self.0.push(Span::Link(Target::Variant(variant), full_name(&card.variants[variant])));
        self
    }

    /// "a, b and c"; both calibrations of a name are said once; what exceeds `most` is counted.
    pub(crate) fn variants(mut self, card: &Scorecard, variants: &[usize], most: usize) -> Self {
        let names = merged(card, variants);
        let shown = if names.len() > most { most } else { names.len() };
        for (i, (variant, name)) in names.iter().take(shown).enumerate() {
            let last = i + 1 == names.len();
            let joint = if i == 0 {
                ""
            } else if last {
                " and "
            } else {
                ", "
            };
            self = self.text(joint);
            self.0.push(Span::Link(Target::Variant(*variant), name.clone()));
        }
        let rest = names.len() - shown;
        if rest > 0 { self.text(format!(" and {rest} more")) } else { self }
    }

    /// Without links and emphasis.
    #[cfg(test)]
    pub(crate) fn plain(&self) -> String {
        let part = |s: &Span| match s {
            Span::Text(t) | Span::Number(t) | Span::Link(_, t) => t.clone(),
        };
        self.0.iter().map(part).collect()
    }
}

impl Render for Sentence {
    fn render(&self) -> Markup {
        html! {
            @for span in &self.0 {
                @match span {
                    Span::Text(text) => (text),
                    Span::Number(number) => span.number { (number) },
                    Span::Link(Target::Variant(v), text) => a href={ "#variant-" (v) } { (text) },
                    Span::Link(Target::Section(id), text) => a href={ "#" (id) } { (text) },
                }
            }
        }
    }
}

/// "chss-mask (light-matched)".
pub(crate) fn full_name(variant: &VariantCard) -> String {
    format!("{} ({})", variant.name, variant.calibration.label())
}

/// One entry a name; its calibration is said only when the other one is not in the list.
pub(super) fn merged(card: &Scorecard, variants: &[usize]) -> Vec<(usize, String)> {
    let mut count: BTreeMap<&str, usize> = BTreeMap::new();
    for &v in variants {
        *count.entry(&card.variants[v].name).or_default() += 1;
    }
    let mut entries: Vec<(usize, String)> = Vec::new();
    for &v in variants {
        let variant = &card.variants[v];
        if count.get(variant.name.as_str()) == Some(&1) {
            entries.push((v, full_name(variant)));
        } else if !entries.iter().any(|e| e.1 == variant.name) {
            entries.push((v, variant.name.clone()));
        }
    }
    entries
}
