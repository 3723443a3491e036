//! `[[light]]`.

use crate::{AreaLight, SceneError};
use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A light as it is written down. Directions may have any length; sizes may be zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LightSpec {
    /// Infinitely far away. Its direction is given by two angles or by a vector.
    Sun {
        /// Full angle of its disc, 0 to below 180.
        angular_diameter_degrees: f64,
        /// Above the horizon, -90 to 90.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        elevation_degrees: Option<f64>,
        /// From +x (0) towards +z (90).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        azimuth_degrees: Option<f64>,
        /// From the scene towards the sun; excludes the two angles.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        direction_to_light: Option<[f64; 3]>,
    },
    /// A flat disc.
    Disk {
        /// In metres.
        centre: [f64; 3],
        /// Either of the two directions square to it.
        normal: [f64; 3],
        /// In metres.
        radius_world: f64,
    },
    /// A flat parallelogram.
    Rect {
        /// In metres.
        centre: [f64; 3],
        /// From the centre to the middle of one side, in metres.
        half_u: [f64; 3],
        /// From the centre to the middle of the next side, in metres.
        half_v: [f64; 3],
    },
    /// A ball.
    Sphere {
        /// In metres.
        centre: [f64; 3],
        /// In metres.
        radius_world: f64,
    },
}

impl LightSpec {
    /// Reads a file that holds one light, written as in a scene file's `[[light]]`: at the top, or in a
    /// table of that name.
    ///
    /// # Errors
    /// A file that cannot be read, does not parse, or holds several lights or a value that makes no sense.
    pub fn read(path: &Path, origin: DVec3) -> Result<AreaLight, SceneError> {
        let read = |source| SceneError::Read { path: path.to_owned(), source };
        let text = std::fs::read_to_string(path).map_err(read)?;
        let parsed = |e: toml::de::Error| {
            let cure = "a light is kind = \"sun\", \"disk\", \"rect\" or \"sphere\" with its sizes, as a scene file's [[light]]";
            SceneError::value(path, format!("{}\n  help: {cure}", e.to_string().trim_end()))
        };
        let table: toml::Table = toml::from_str(&text).map_err(parsed)?;
        let spec: Self = match table.get("light") {
            None => table.try_into().map_err(parsed)?,
            Some(toml::Value::Array(all)) => match all.as_slice() {
                [only] => only.clone().try_into().map_err(parsed)?,
                all => {
                    let message = format!("has {} lights: one is scored at a time", all.len());
                    return Err(SceneError::value(path, message));
                }
            },
            Some(only) => only.clone().try_into().map_err(parsed)?,
        };
        spec.resolve(origin).map_err(|message| SceneError::value(path, message))
    }

    /// The light in a scene whose coordinates are those of the file less `origin`.
    ///
    /// # Errors
    /// A sentence that says which value makes no sense.
    pub(crate) fn resolve(&self, origin: DVec3) -> Result<AreaLight, String> {
        let place = |centre: [f64; 3]| Ok::<_, String>((vector("centre", centre)? - origin).as_vec3());
        match *self {
            Self::Sun { angular_diameter_degrees, .. } => {
                let diameter = size("angular_diameter_degrees", angular_diameter_degrees)?;
                if diameter >= 180.0 {
                    return Err(format!("angular_diameter_degrees must be below 180, is {diameter}"));
                }
                let direction_to_light = self.direction_to_sun()?;
                let angular_diameter_radians = diameter.to_radians() as f32;
                Ok(AreaLight::Sun { direction_to_light, angular_diameter_radians })
            }
            Self::Disk { centre, normal, radius_world } => Ok(AreaLight::Disk {
                centre: place(centre)?,
                normal: unit("normal", normal)?,
                radius_world: size("radius_world", radius_world)? as f32,
            }),
            Self::Rect { centre, half_u, half_v } => Ok(AreaLight::Rect {
                centre: place(centre)?,
                half_u: vector("half_u", half_u)?.as_vec3(),
                half_v: vector("half_v", half_v)?.as_vec3(),
            }),
            Self::Sphere { centre, radius_world } => Ok(AreaLight::Sphere {
                centre: place(centre)?,
                radius_world: size("radius_world", radius_world)? as f32,
            }),
        }
    }

    fn direction_to_sun(&self) -> Result<Vec3, String> {
        let Self::Sun { elevation_degrees, azimuth_degrees, direction_to_light, .. } = *self else {
            return Err("only a sun has a direction".to_owned());
        };
        match (elevation_degrees, azimuth_degrees, direction_to_light) {
            (Some(elevation), Some(azimuth), None) => {
                let [elevation, azimuth] =
                    [number("elevation_degrees", elevation)?, number("azimuth_degrees", azimuth)?];
                let ((up, level), (z, x)) =
                    (elevation.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
                Ok(DVec3::new(level * x, up, level * z).as_vec3().normalize())
            }
            (None, None, Some(direction)) => unit("direction_to_light", direction),
            _ => Err("a sun needs either direction_to_light or both elevation_degrees and azimuth_degrees"
                .to_owned()),
        }
    }
}

/// A finite number.
pub(super) fn number(name: &str, value: f64) -> Result<f64, String> {
    if value.is_finite() { Ok(value) } else { Err(format!("{name} must be finite, is {value}")) }
}

/// A finite number of at least 0.
pub(super) fn size(name: &str, value: f64) -> Result<f64, String> {
    if number(name, value)? >= 0.0 {
        Ok(value)
    } else {
        Err(format!("{name} must be at least 0, is {value}"))
    }
}

/// A finite vector.
pub(super) fn vector(name: &str, value: [f64; 3]) -> Result<DVec3, String> {
    for component in value {
        number(name, component)?;
    }
    Ok(DVec3::from(value))
}

/// A vector with a direction.
fn unit(name: &str, value: [f64; 3]) -> Result<Vec3, String> {
    let direction = vector(name, value)?.try_normalize();
    direction.map(|d| d.as_vec3().normalize()).ok_or(format!("{name} must not be zero"))
}
