//! From measurements to what became of a part.

use super::costs::CostBook;
use super::exact;
use super::measurements::Measurements;
use super::numbers::{Gap, Numbers};
use super::place::Place;
use super::registry::{COSTS, Margins, Other, Part, Registry};
use super::subject::{Comparison, Resolved, ResolvedOther, variant_of};
use crate::error::CliError;
use crate::suite::Sampling;
use umbrage_metrics::{Bootstrap, Score};
use umbrage_report::{ClaimPart, EffectKind, Outcome, PlaceEffect};

/// Everything that a verdict follows from.
pub(crate) struct Judge<'a> {
    pub(crate) registry: &'a Registry,
    pub(crate) measurements: &'a Measurements,
    pub(crate) costs: &'a CostBook,
    pub(crate) sampling: Sampling,
    pub(crate) bootstrap: Bootstrap,
}

/// What became of a part, and where it shows most.
pub(crate) struct Judged {
    pub(crate) card: ClaimPart,
    /// The first subjects in the place with the largest effect.
    pub(crate) shown: Option<(Shown, Option<Shown>)>,
    /// A number was not finite: the run has failed.
    pub(crate) broken: bool,
}

/// A variant in a place.
pub(crate) type Shown = (Place, String);

/// Below this share of its absolute margin B counts as 0.
const NOTHING: f64 = 0.1;

impl Judge<'_> {
    pub(crate) fn part(&self, part: &Part) -> Result<Judged, CliError> {
        let wrong = |message| CliError::Suite { path: "claims".into(), message };
        let Some(comparison) = Comparison::of(part, self.registry).map_err(wrong)? else {
            return Ok(self.exact(part));
        };
        let numbers = match self.numbers(part, &comparison)? {
            Ok(numbers) => numbers,
            Err(gap) => return Ok(self.unmeasured(part, &comparison, gap)),
        };
        let (kind, margin, reason) = self.kind(part, numbers);
        let effect = numbers.effect(kind);
        let outcome = part.expect.outcome(effect, margin);
        let mut card = self.card(part, Some(&comparison), (kind, margin));
        card.reason = reason;
        let (per_place, worst) = self.per_place(part, &comparison, kind)?;
        let shown = comparison.a.shown(worst).map(|a| (a, comparison.b.shown(worst)));
        let Some(outcome) = outcome else {
            card.outcome = Outcome::NotMeasured;
            card.reason = Some("the number is not finite".into());
            return Ok(Judged { card, shown, broken: true });
        };
        let finite = |s: Score| (s.value.is_finite() && s.low.is_finite() && s.high.is_finite()).then_some(s);
        let card = ClaimPart {
            effect: Some(effect),
            value_a: finite(numbers.a),
            value_b: if matches!(part.b, Other::Constant(_)) { None } else { finite(numbers.b) },
            outcome,
            per_place,
            ..card
        };
        Ok(Judged { card, shown, broken: false })
    }

    /// A number that needs no picture.
    fn exact(&self, part: &Part) -> Judged {
        let value = exact::value(&part.number);
        let constant = match part.b {
            Other::Constant(constant) => constant,
            Other::Subject(_) => f64::NAN,
        };
        let effect = Score::exact(value - constant);
        let margin = part.margin.or(self.margins(part).absolute).unwrap_or(0.0);
        let outcome = part.expect.outcome(effect, margin);
        let mut card = self.card(part, None, (EffectKind::Difference, margin));
        if let Some(outcome) = outcome {
            card = ClaimPart { outcome, effect: Some(effect), value_a: Some(Score::exact(value)), ..card };
        }
        Judged { card, shown: None, broken: outcome.is_none() }
    }

    fn unmeasured(&self, part: &Part, comparison: &Comparison, gap: Gap) -> Judged {
        let kind = self.natural_kind(part);
        let margin = self.margin(part, kind).unwrap_or(0.0);
        let card = self.card(part, Some(comparison), (kind, margin));
        let (outcome, reason) = match gap {
            Gap::NeedsGpu => (Outcome::NeedsGpu, None),
            Gap::Missing(reason) => (Outcome::NotMeasured, Some(reason)),
        };
        Judged { card: ClaimPart { outcome, reason, ..card }, shown: None, broken: false }
    }

    fn margins(&self, part: &Part) -> Margins {
        self.registry.margin.get(&part.number).copied().unwrap_or(Margins { ratio: None, absolute: None })
    }

    /// How A is set against B where B is not nothing.
    fn natural_kind(&self, part: &Part) -> EffectKind {
        let constant = matches!(part.b, Other::Constant(_));
        if constant || self.margins(part).ratio.is_none() {
            EffectKind::Difference
        } else {
            EffectKind::Ratio
        }
    }

    /// The part's own margin is one of its natural kind.
    fn margin(&self, part: &Part, kind: EffectKind) -> Option<f64> {
        let own = part.margin.filter(|_| kind == self.natural_kind(part));
        let margins = self.margins(part);
        own.or(if kind == EffectKind::Ratio { margins.ratio } else { margins.absolute })
    }

    /// How A is set against this B, the margin, and why if not in the natural way.
    fn kind(&self, part: &Part, numbers: Numbers) -> (EffectKind, f64, Option<String>) {
        let natural = self.natural_kind(part);
        let absolute = self.margins(part).absolute;
        let b = numbers.b;
        let nothing = match part.from {
            Some(_) => b.contains(0.0),
            None => b.low <= 0.0 || absolute.is_some_and(|m| b.value < NOTHING * m),
        };
        if let (EffectKind::Ratio, true, Some(absolute)) = (natural, nothing, absolute) {
            let reason = "B cannot be told from 0: the difference counts".to_string();
            return (EffectKind::Difference, absolute, Some(reason));
        }
        (natural, self.margin(part, natural).unwrap_or(0.0), None)
    }

    /// The effect in each place alone, and the index of the largest.
    fn per_place(
        &self,
        part: &Part,
        comparison: &Comparison,
        kind: EffectKind,
    ) -> Result<(Vec<PlaceEffect>, usize), CliError> {
        let mut found = Vec::new();
        let mut worst = (0, 0.0);
        for index in 0..comparison.places().filter(|&n| n > 1).unwrap_or(0) {
            let one = comparison.in_place(index);
            let Ok(numbers) = self.numbers(part, &one)? else { continue };
            let effect = numbers.effect(kind);
            if ![effect.value, effect.low, effect.high].iter().all(|v| v.is_finite()) {
                continue;
            }
            if effect.value.abs() > worst.1 {
                worst = (index, effect.value.abs());
            }
            let place = one.a.members.first().and_then(|m| m.places.first()).map(Place::label);
            found.push(PlaceEffect { place: place.unwrap_or_default(), effect });
        }
        Ok((found, worst.0))
    }

    /// All that is known without the numbers.
    fn card(
        &self,
        part: &Part,
        comparison: Option<&Comparison>,
        (kind, margin): (EffectKind, f64),
    ) -> ClaimPart {
        let is_cost = COSTS.contains(&part.number.as_str());
        let pictured = comparison.filter(|_| !is_cost);
        let first = comparison.and_then(|c| c.a.members.first());
        let facts = first.iter().flat_map(|m| &m.places).filter_map(|p| self.measurements.places.get(p));
        let facts: Vec<_> = facts.collect();
        let stochastic =
            |c: &Comparison| c.units().any(|(_, v)| variant_of(v).is_some_and(|id| id.info().stochastic));
        let seeds = pictured.map_or(0, |c| if stochastic(c) { self.sampling.seeds } else { 1 });
        let frames = match (is_cost, pictured) {
            (true, _) => self.costs.repeats(),
            (false, Some(_)) => facts.first().map_or(self.sampling.window, |f| f.frames),
            (false, None) => 0,
        };
        ClaimPart {
            says: part.says.clone(),
            number: part.number.clone(),
            a: comparison.map_or_else(|| "computed".into(), |c| c.a.label.clone()),
            b: comparison.map_or_else(|| constant(&part.b, part.target), |c| c.b.label(part.target)),
            places: first.iter().flat_map(|m| &m.places).map(Place::label).collect(),
            expect: part.expect.label().into(),
            margin,
            margin_reason: part.why.clone(),
            effect_kind: kind,
            effect: None,
            value_a: None,
            value_b: None,
            outcome: Outcome::NotMeasured,
            reason: None,
            seeds,
            frames,
            tiles: facts.iter().map(|f| f.tiles).sum(),
            per_place: vec![],
        }
    }
}

fn constant(other: &Other, target: Option<f64>) -> String {
    match other {
        Other::Constant(value) => value.to_string(),
        Other::Subject(_) => target.map_or_else(String::new, |t| t.to_string()),
    }
}

impl ResolvedOther {
    fn label(&self, target: Option<f64>) -> String {
        match (self, target) {
            (Self::Constant(value), _) => value.to_string(),
            (Self::Subject(b), None) => b.label.clone(),
            (Self::Subject(b), Some(target)) => format!("{} x {target}", b.label),
        }
    }

    fn shown(&self, place: usize) -> Option<Shown> {
        match self {
            Self::Constant(_) => None,
            Self::Subject(b) => b.shown(place),
        }
    }
}

impl Resolved {
    /// The first member in a place.
    fn shown(&self, place: usize) -> Option<Shown> {
        let member = self.members.first()?;
        let place = member.places.get(place).or(member.places.first())?;
        Some((place.clone(), member.variant.clone()))
    }
}
