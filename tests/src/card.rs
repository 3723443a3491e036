//! Reading `scorecard.json` as an outsider would: as plain JSON.

use serde_json::Value;
use std::path::Path;

/// A score with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The estimate.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Span {
    /// Whether 0 lies in the interval, ends included.
    pub fn has_zero(&self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    fn of(value: &Value) -> Option<Self> {
        let number = |key: &str| value[key].as_f64();
        Some(Self { value: number("value")?, low: number("low")?, high: number("high")? })
    }

    fn negated(self) -> Self {
        Self { value: -self.value, low: -self.high, high: -self.low }
    }
}

/// A scorecard.
#[derive(Clone, Debug, PartialEq)]
pub struct Card(pub Value);

impl Card {
    /// The scorecard of a run.
    ///
    /// # Panics
    /// When there is none, or it is not JSON.
    pub fn load(run: &Path) -> Self {
        let path = run.join("scorecard.json");
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self(serde_json::from_str(&text).expect("a scorecard is JSON"))
    }

    /// Names as on the command line, `chss/light-matched`, in display order.
    pub fn variants(&self) -> Vec<String> {
        let name = |v: &Value| format!("{}/{}", text(&v["name"]), text(&v["calibration"]));
        self.list("variants").iter().map(name).collect()
    }

    /// The windows.
    pub fn windows(&self) -> &[Value] {
        self.list("windows")
    }

    /// Path of each result's window, name of its variant, and its scores.
    pub fn results(&self) -> Vec<(String, String, &Value)> {
        let variants = self.variants();
        let place = |r: &Value, key: &str| r[key].as_u64().expect("an index") as usize;
        let of = |r| (self.window_name(place(r, "window")), variants[place(r, "variant")].clone());
        self.list("results").iter().map(|r| (of(r), &r["scores"])).map(|((w, v), s)| (w, v, s)).collect()
    }

    /// A score; none when it was not measured. `window` is `scene P1`.
    ///
    /// # Panics
    /// When there is no such window, variant or metric.
    pub fn score(&self, window: &str, variant: &str, metric: &str) -> Option<Span> {
        Span::of(self.measurement(window, variant, metric))
    }

    /// Why a score was not measured; none when it was.
    ///
    /// # Panics
    /// As [`Card::score`].
    pub fn why_not(&self, window: &str, variant: &str, metric: &str) -> Option<String> {
        self.measurement(window, variant, metric)["not_measured"].as_str().map(str::to_string)
    }

    /// `a` minus `b` in a window.
    ///
    /// # Panics
    /// When they were not compared.
    pub fn paired(&self, window: &str, (a, b): (&str, &str), metric: &str) -> Span {
        let variants = self.variants();
        let index = |name: &str| variants.iter().position(|v| v == name).expect("a variant of the run");
        let (a, b) = (index(a), index(b));
        let names = |card: &Value| card["window"].as_u64().map(|w| self.window_name(w as usize));
        let is = |card: &Value, first: usize, second: usize| {
            card["a"] == first && card["b"] == second && card["metric"] == metric
        };
        let mut here = self.list("paired").iter().filter(|card| names(card).as_deref() == Some(window));
        let found = here.find(|card| is(card, a, b) || is(card, b, a));
        let card = found.unwrap_or_else(|| panic!("{window}: {metric} of {a} and {b} is not compared"));
        let span = Span::of(&card["difference"]).expect("an interval");
        if is(card, a, b) { span } else { span.negated() }
    }

    fn measurement(&self, window: &str, variant: &str, metric: &str) -> &Value {
        let mut here = self.results().into_iter().filter(|(w, v, _)| w == window && v == variant);
        let (_, _, scores) = here.next().unwrap_or_else(|| panic!("no result of {variant} in {window}"));
        scores.get(metric).unwrap_or_else(|| panic!("{variant} in {window} has no {metric}"))
    }

    fn window_name(&self, index: usize) -> String {
        let window = &self.windows()[index];
        format!("{} {}", text(&window["scene"]), text(&window["path"]))
    }

    fn list(&self, key: &str) -> &[Value] {
        self.0[key].as_array().unwrap_or_else(|| panic!("no list of {key}"))
    }
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
