//! The colour of the noise: its power over spatial frequency, white = 1.

use super::axis::Axis;
use super::look::{Look, p};
use super::swatch;
use crate::numbers::{Power, number};
use crate::words::full_name;
use crate::{ResultCard, Scorecard};
use maud::{Markup, html};
use umbrage_metrics::SPECTRUM_FREQUENCIES;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 28.0;
const BOTTOM: f64 = 40.0;

/// A line for each variant that has noise; nothing when none has.
pub(crate) fn spectrum(card: &Scorecard, window: usize) -> Option<Markup> {
    let has_noise = |r: &&ResultCard| r.window == window && !r.noise_spectrum.is_empty();
    let noisy: Vec<&ResultCard> = card.results.iter().filter(has_noise).collect();
    (!noisy.is_empty()).then(|| {
        html! {
            (lines(card, &noisy))
            ul.legend {
                @for r in &noisy {
                    li { (swatch(Look::of(card, r.variant))) (full_name(&card.variants[r.variant])) }
                }
            }
        }
    })
}

fn lines(card: &Scorecard, noisy: &[&ResultCard]) -> Markup {
    let highest = noisy.iter().flat_map(|r| &r.noise_spectrum).copied().fold(1.0, f64::max);
    // Estimates from few pixels may dip below 0.
    let y = Axis::root(0.0, 1.05 * highest);
    let last = SPECTRUM_FREQUENCIES[SPECTRUM_FREQUENCIES.len() - 1];
    let at_x = |frequency: f64| LEFT + frequency / last * (WIDTH - LEFT - RIGHT);
    let at_y = |v: f64| HEIGHT - BOTTOM - y.at(v.max(0.0)) * (HEIGHT - TOP - BOTTOM);
    html! {
        svg.plot viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label="Power of the noise over spatial frequency" {
            @for tick in y.ticks() {
                line.grid x1=(p(LEFT)) x2=(p(WIDTH - RIGHT)) y1=(p(at_y(tick))) y2=(p(at_y(tick))) {}
                text.tick x=(p(LEFT - 8.0)) y=(p(at_y(tick) + 4.0)) text-anchor="end" { (Axis::tick_label(Power::ONE, tick)) }
            }
            @for frequency in [0.0, 0.1, 0.2, 0.3, 0.4] {
                text.tick x=(p(at_x(frequency))) y=(p(HEIGHT - BOTTOM + 20.0)) text-anchor="middle" { (number(frequency)) }
            }
            text.axis x=(p(WIDTH - RIGHT)) y=(p(HEIGHT - 4.0)) text-anchor="end" { "cycles per pixel" }
            text.axis x="0" y="10" { "power of the noise, white = 1 (root scale)" }
            @for r in noisy {
                @let look = Look::of(card, r.variant);
                path class={ "line " (look.class()) } d=(line(&r.noise_spectrum, at_x, at_y)) {}
            }
        }
    }
}

fn line(powers: &[f64], at_x: impl Fn(f64) -> f64, at_y: impl Fn(f64) -> f64) -> String {
    let points = SPECTRUM_FREQUENCIES.iter().zip(powers);
    let points = points.map(|(&f, &v)| format!("{} {}", p(at_x(f)), p(at_y(v))));
    format!("M{}", points.collect::<Vec<_>>().join("L"))
}
