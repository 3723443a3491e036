//! Do the cameras fit the frames? Asked before anything is scored: a wrong camera looks like a wrong shadow.
//!
//! What the frames show at a grid of pixels (depth where there is a channel of it, the shadow itself otherwise)
//! is compared with what truth shows from the cameras as given, and from cameras with each of the usual
//! mistakes. The cameras are refused where a mistake explains the frames clearly better than no mistake, or
//! where nothing does. Blind spot: a mistake that changes no pixel by more than the frames' own error.

use super::asked::{Asked, Shown, Unexplained, holds_depth};
use super::guesses::{Guess, lens};
use super::lights;
use crate::error::CliError;
use umbrage_reference::Tracer;
use umbrage_scene::{AreaLight, Camera};

/// Most of the points of a frame that are compared: a tenth of a percent of them is several.
const POINTS: u32 = 6000;
/// Enough to search by.
pub(super) const POINTS_OF_A_SEARCH: u32 = 1500;
/// Most of the points that may differ in depth (as for truth and raster, decision 0003): silhouettes make
/// far less.
const DEPTH_LIMIT: f64 = 0.02;
/// Below this nothing is wrong, whatever fits better: silhouettes.
const DEPTH_FINE: f64 = 2e-3;
/// A mistake explains frames better where it leaves less than this part of what is unexplained.
const BETTER: f64 = 0.6;
/// The same of shadows, which a bad technique leaves unexplained from any camera.
const BETTER_SHADOW: f64 = 0.5;
/// A shadow that is less like truth's (1 - correlation) is of another scene, or of other cameras: of the techniques'
/// frames that were tried the least alike left .28 (an exponential map over thin poles).
const SHADOW_LIMIT: f64 = 0.5;
/// Up to here a shadow says that cameras are right; beyond, that nothing better was found. A hard shadow in place of one of a sun
/// of 2 degrees leaves .03 on the colonnade.
const SHADOW_SURE: f64 = 0.05;
/// A correlation below -.3: lit and dark are exchanged.
const INVERTED: f64 = 1.3;
/// Below this nothing is wrong: the best real-time shadows leave about .01 on the standard scenes.
const SHADOW_FINE: f64 = 2e-3;
/// A mistake with a name of its own leaves so little that no other field of view is looked for.
const NAMED: f64 = 0.1;

/// What the check came to, in words.
pub(super) fn check(
    tracer: &Tracer,
    (lights, size): (&[AreaLight], (u32, u32)),
    (shown, light_is_given): (&[Shown], bool),
    (given, guesses): (&[Camera], &[Guess]),
) -> Result<String, CliError> {
    let by_depth = shown.iter().all(|s| s.mask.depth.as_ref().is_some_and(holds_depth));
    let asked = Asked { tracer, lights, size, shown, by_depth, points: POINTS };
    let own = Guess::none(given);
    let cameras = check_cameras(&asked, (given, &own), guesses)?;
    // Depth knows nothing about the light, and cameras that fit by their shadow may still have a neighbour's.
    let light = lights::check(&Asked { by_depth: false, ..asked }, &own, (by_depth, light_is_given))?;
    let empty = shown.iter().any(|s| s.mask.depth.is_some()) && !by_depth;
    let unread = if empty { "; the frames' depth holds no depth and was not used" } else { "" };
    Ok(format!("{cameras}; {light}{unread}"))
}

/// "correlation with truth's shadow .9812".
pub(super) fn said(u: Unexplained) -> String {
    match u.by_depth {
        true => format!("{:.2} % of the points have another depth", 100.0 * u.part),
        false => format!("correlation with truth's shadow {:.4}", 1.0 - u.part),
    }
}

fn check_cameras(
    asked: &Asked<'_>,
    (given, own): (&[Camera], &Guess),
    guesses: &[Guess],
) -> Result<String, CliError> {
    let Some(as_given) = asked.unexplained(own, 0) else {
        return Ok(
            "the cameras could not be checked: nothing in the frames changes from point to point".into()
        );
    };
    let (fine, limit, better) = match as_given.by_depth {
        true => (DEPTH_FINE, DEPTH_LIMIT, BETTER),
        false => (SHADOW_FINE, SHADOW_LIMIT, BETTER_SHADOW),
    };
    if !as_given.by_depth && as_given.part > INVERTED {
        return Err(CliError::Projection(
            "the shadow is dark where truth is lit\n  help: 1 is fully lit, 0 is umbra: write 1 - v".into(),
        ));
    }
    if as_given.part <= fine {
        return Ok(format!("the cameras fit the frames: {}", said(as_given)));
    }
    // Each against no mistake in the same frames: one that shifts frames has none for the last.
    let tried = |g: &Guess| {
        let none = if g.offset == 0 { as_given } else { asked.unexplained(own, g.offset)? };
        let found = asked.unexplained(g, g.offset)?;
        (found.part < better * none.part && none.part > fine).then_some(found)
    };
    let named = guesses.iter().filter_map(|g| Some((g.clone(), tried(g)?)));
    let named = named.min_by(|a, b| a.1.part.total_cmp(&b.1.part));
    let fitted = match &named {
        Some((_, found)) if found.part < NAMED * as_given.part => None,
        _ => lens(given, |guess| {
            let search = Asked { points: POINTS_OF_A_SEARCH, ..*asked };
            search.unexplained(guess, 0).map_or(f64::MAX, |u| u.smooth)
        }),
    };
    let fitted = fitted.and_then(|guess| tried(&guess).map(|found| (guess, found)));
    let best = named.into_iter().chain(fitted).min_by(|a, b| a.1.part.total_cmp(&b.1.part));
    // A mistake may be named by its kind, and its amount be off. A shadow that is hardly explained names nothing.
    if let Some((guess, found)) = best
        && (as_given.by_depth || found.part < limit)
    {
        let message = format!("{}; {}: {}", said(as_given), guess.words, said(found));
        return Err(CliError::Projection(format!("{message}\n  help: {}", guess.cure)));
    }
    if as_given.part > limit && as_given.by_depth && asked.holds_buffer_depth() {
        return Err(CliError::Projection(format!(
            "{}; all depths lie between 0 and 1\n  help: a depth buffer's values are no metres: write linear depth, or leave \
             the channel out",
            said(as_given)
        )));
    }
    if as_given.part > limit {
        if !as_given.by_depth {
            // Another light may be what is wrong.
            lights::check(asked, own, (false, true))?;
        }
        return Err(CliError::Projection(format!(
            "{}, and no usual mistake explains it\n  help: check scene, light, scale and frame numbers; \
             --no-projection-check scores them all the same",
            said(as_given)
        )));
    }
    Ok(match as_given.by_depth || as_given.part <= SHADOW_SURE {
        true => format!("the cameras fit the frames: {}, and no usual mistake explains more", said(as_given)),
        false => format!(
            "the cameras may fit the frames: {}, and no usual mistake explains more; write depth to be sure",
            said(as_given)
        ),
    })
}
