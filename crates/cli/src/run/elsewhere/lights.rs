//! Do the frames show this light's shadow? Asked of cameras that fit: a sun ten degrees off looks like a very
//! bad technique.

use super::asked::Asked;
use super::guesses::Guess;
use super::projection::{POINTS_OF_A_SEARCH, said};
use crate::error::CliError;
use crate::run::provenance::describe_light;
use glam::Vec3;
use umbrage_scene::AreaLight;

/// Below this part unexplained (1 - correlation) no other light is looked for: good real-time shadows leave .01.
const FINE: f64 = 0.01;
/// A shadow less alike than this is another light's, whichever (as `projection::SHADOW_LIMIT`).
const LIMIT: f64 = 0.5;
/// Another light explains frames better where it leaves less than this part of what is unexplained: techniques that are
/// bad (a blurred exponential map over thin poles) come to .6 with a sun a degree off.
const BETTER: f64 = 0.4;
/// Sizes that are tried.
const SIZES: [f32; 6] = [0.25, 0.5, 0.71, 1.41, 2.0, 4.0];
/// First and last step of the search: radians of a sun's direction, parts of the distance of a lamp's place. A
/// technique's bias moves shadows by less than the last.
const STEPS: [f32; 2] = [0.28, 0.0175];

/// What the check came to, in words.
pub(super) fn check(
    asked: &Asked<'_>,
    own: &Guess,
    (cameras_are_sure, is_given): (bool, bool),
) -> Result<String, CliError> {
    let Some(given) = asked.unexplained(own, 0) else {
        return Ok("the light could not be checked: the frames hold no shadow".into());
    };
    if given.part <= FINE {
        return Ok(format!("the light fits: {}", said(given)));
    }
    let search = Asked { points: POINTS_OF_A_SEARCH, ..*asked };
    let left =
        |lights: &[AreaLight]| Asked { lights, ..search }.unexplained(own, 0).map_or(f64::MAX, |u| u.part);
    let as_given = left(asked.lights);
    let (found, part) = nearest(asked.lights, centre_of_view(own), &left);
    if part < BETTER * as_given && found != asked.lights {
        // Where it moves: in the middle.
        let light = found.get(found.len() / 2).map(describe_light).unwrap_or_default();
        return Err(refused(format!("{}; with {light}: {:.4}", said(given), 1.0 - part)));
    }
    if cameras_are_sure && given.part > LIMIT {
        return Err(refused(said(given)));
    }
    let sizes = SIZES.map(|by| (by, left(&asked.lights.iter().map(|l| sized(l, by)).collect::<Vec<_>>())));
    let best = sizes.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    Ok(match best {
        Some((by, part)) if part < BETTER * as_given => format!(
            "the light's place fits ({}), but its penumbrae are those of a light of {by}{} times the size ({:.4}): the \
             technique's{}",
            said(given),
            if by == SIZES[0] { " or fewer" } else { "" },
            1.0 - part,
            if is_given { ", or a mistake in --light" } else { "" }
        ),
        _ => format!("the light fits: {}, and no light near it does better", said(given)),
    })
}

fn refused(what: String) -> CliError {
    CliError::Projection(format!(
        "the shadow in the frames is not this light's: {what}\n  help: check --light: its direction or place is in the scene \
         file's axes (y up); 1 is fully lit"
    ))
}

/// A frame's light in each frame that is shown, and what it leaves.
type Lights = (Vec<AreaLight>, f64);

/// The lights near the given ones, or on another side, that leave least: all moved in one way.
fn nearest(given: &[AreaLight], about: Vec3, left: &dyn Fn(&[AreaLight]) -> f64) -> Lights {
    let mut best = (given.to_vec(), left(given));
    let try_it = |lights: Vec<AreaLight>, best: &mut Lights| {
        let part = left(&lights);
        // By a hair is by chance.
        if part < 0.98 * best.1 {
            *best = (lights, part);
        }
    };
    for turn in TURNS {
        let turned: Vec<AreaLight> = given.iter().map(|light| placed(light, turn)).collect();
        if turned != given {
            try_it(turned, &mut best);
        }
    }
    let mut step = STEPS[0];
    while step >= STEPS[1] {
        // Twice: a step along one way may open another.
        for _ in 0..2 {
            let from = best.clone();
            for way in 0..3 {
                for by in [step, -step] {
                    let lights: Option<Vec<AreaLight>> =
                        from.0.iter().map(|light| moved(light, about, (way, by))).collect();
                    if let Some(lights) = lights {
                        try_it(lights, &mut best);
                    }
                }
            }
            if best == from {
                break;
            }
        }
        step *= 0.5;
    }
    best
}

/// Axes that were mistaken.
const TURNS: [fn(Vec3) -> Vec3; 6] = [
    |v| Vec3::new(-v.x, v.y, -v.z),
    |v| Vec3::new(-v.x, v.y, v.z),
    |v| Vec3::new(v.x, v.y, -v.z),
    |v| Vec3::new(v.z, v.y, v.x),
    |v| Vec3::new(v.x, v.z, -v.y),
    |v| Vec3::new(v.x, -v.z, v.y),
];

fn placed(light: &AreaLight, place: impl Fn(Vec3) -> Vec3) -> AreaLight {
    let mut light = *light;
    match &mut light {
        AreaLight::Sun { direction_to_light, .. } => {
            *direction_to_light = place(*direction_to_light).normalize_or(*direction_to_light);
        }
        AreaLight::Disk { centre, .. }
        | AreaLight::Rect { centre, .. }
        | AreaLight::Sphere { centre, .. } => {
            *centre = place(*centre);
        }
    }
    light
}

/// A sun turned about one of two axes square to it; a lamp shifted along an axis.
fn moved(light: &AreaLight, about: Vec3, (way, by): (usize, f32)) -> Option<AreaLight> {
    match light.centre() {
        None if way < 2 => Some(placed(light, |direction| {
            let ways: [Vec3; 2] = direction.any_orthonormal_pair().into();
            direction + by * ways[way]
        })),
        None => None,
        Some(centre) => {
            let reach = centre.distance(about).max(0.1);
            Some(placed(light, |c| c + by * reach * [Vec3::X, Vec3::Y, Vec3::Z][way]))
        }
    }
}

fn sized(light: &AreaLight, by: f32) -> AreaLight {
    let mut light = *light;
    match &mut light {
        AreaLight::Sun { angular_diameter_radians, .. } => {
            *angular_diameter_radians = (*angular_diameter_radians * by).min(3.0);
        }
        AreaLight::Disk { radius_world, .. } | AreaLight::Sphere { radius_world, .. } => *radius_world *= by,
        AreaLight::Rect { half_u, half_v, .. } => {
            *half_u *= by;
            *half_v *= by;
        }
    }
    light
}

/// Some metres in front of the first camera: how far a lamp is from what is seen.
fn centre_of_view(own: &Guess) -> Vec3 {
    own.cameras.first().map_or(Vec3::ZERO, |camera| {
        let m = camera.world_from_camera;
        m.w_axis.truncate() - 5.0 * m.z_axis.truncate()
    })
}
