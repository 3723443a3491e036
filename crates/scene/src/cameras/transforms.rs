//! NeRF's `transforms.json`, in the terms of `cameras.json`.

use super::convention::{MatrixOrder, Preset};
use super::file::{CamerasJson, ConventionJson, FrameJson, VERSION};
use serde::Deserialize;

/// NeRF's and nerfstudio's format: OpenGL's camera axes, rows, a horizontal field of view.
#[derive(Deserialize, Debug)]
pub(super) struct Transforms {
    #[serde(flatten)]
    lens: Lens,
    frames: Vec<TransformsFrame>,
}

#[derive(Deserialize, Debug)]
struct TransformsFrame {
    file_path: String,
    transform_matrix: [[f64; 4]; 4],
    /// What is not the lens of all frames.
    #[serde(flatten)]
    lens: Lens,
}

/// A lens, or the part of it that a frame says.
#[derive(Deserialize, Clone, Debug)]
struct Lens {
    camera_model: Option<String>,
    camera_angle_x: Option<f64>,
    fl_x: Option<f64>,
    fl_y: Option<f64>,
    cx: Option<f64>,
    cy: Option<f64>,
    w: Option<f64>,
    h: Option<f64>,
    k1: Option<f64>,
    k2: Option<f64>,
    k3: Option<f64>,
    k4: Option<f64>,
    p1: Option<f64>,
    p2: Option<f64>,
}

impl Transforms {
    /// The same in `cameras.json`'s terms. The world is Blender's unless told otherwise: that is what these
    /// files are made in.
    pub(super) fn into_cameras(self) -> Result<CamerasJson, String> {
        let mut frames = Vec::new();
        for (place, frame) in self.frames.into_iter().enumerate() {
            let index = trailing_number(&frame.file_path).unwrap_or(place as u32);
            let lens = frame.lens.or(&self.lens);
            let yfov = lens.yfov().map_err(|message| format!("frame {index}: {message}"))?;
            let whole = |size: Option<f64>| size.map(|s| s as u32);
            frames.push(FrameJson {
                index: Some(index),
                time: None,
                file: Some(frame.file_path),
                world_from_camera: std::array::from_fn(|i| frame.transform_matrix[i / 4][i % 4]),
                yfov,
                near: None,
                far: None,
                width: whole(lens.w.filter(|_| lens.h.is_some())),
                height: whole(lens.h.filter(|_| lens.w.is_some())),
                jitter: None,
                square: lens.is_square(),
            });
        }
        let convention = ConventionJson {
            preset: Some(Preset::Blender),
            matrix_order: Some(MatrixOrder::Row),
            ..ConventionJson::default()
        };
        Ok(CamerasJson { version: VERSION, convention, fps: None, frames })
    }
}

impl Lens {
    /// What a frame says counts before what is said of all.
    fn or(self, all: &Self) -> Self {
        // A focal length of the frame's own is not for a field of view of all, nor the other way round.
        let says = self.fl_x.or(self.fl_y).or(self.camera_angle_x).is_some();
        let of_all = |value: Option<f64>| value.filter(|_| !says);
        Self {
            camera_model: self.camera_model.or_else(|| all.camera_model.clone()),
            camera_angle_x: self.camera_angle_x.or(of_all(all.camera_angle_x)),
            fl_x: self.fl_x.or(of_all(all.fl_x)),
            fl_y: self.fl_y.or(of_all(all.fl_y)),
            cx: self.cx.or(all.cx),
            cy: self.cy.or(all.cy),
            w: self.w.or(all.w),
            h: self.h.or(all.h),
            k1: self.k1.or(all.k1),
            k2: self.k2.or(all.k2),
            k3: self.k3.or(all.k3),
            k4: self.k4.or(all.k4),
            p1: self.p1.or(all.p1),
            p2: self.p2.or(all.p2),
        }
    }

    /// Vertical field of view in radians.
    fn yfov(&self) -> Result<f64, String> {
        const PINHOLES: [&str; 4] = ["OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "PERSPECTIVE"];
        if let Some(model) = self.camera_model.as_ref().filter(|m| !PINHOLES.contains(&m.as_str())) {
            return Err(format!("camera_model is {model}: only pinhole cameras can be scored"));
        }
        let bends = [
            ("k1", self.k1),
            ("k2", self.k2),
            ("k3", self.k3),
            ("k4", self.k4),
            ("p1", self.p1),
            ("p2", self.p2),
        ];
        if let Some((name, value)) = bends.iter().find_map(|&(n, v)| Some((n, v.filter(|v| *v != 0.0)?))) {
            return Err(format!(
                "{name} is {value}: pictures of a lens that distorts cannot be scored; undistort them, and leave {name} out"
            ));
        }
        let centred = |at: Option<f64>, size: Option<f64>| match (at, size) {
            (Some(at), Some(size)) => (at - 0.5 * size).abs() <= 0.5,
            _ => true,
        };
        if !centred(self.cx, self.w) || !centred(self.cy, self.h) {
            return Err("cx and cy are off the centre: lenses that are shifted cannot be scored".into());
        }
        match (self.fl_y.or(self.fl_x), self.h, self.camera_angle_x, self.w) {
            (Some(focal), Some(height), ..) => Ok(2.0 * (0.5 * height / focal).atan()),
            (_, Some(height), Some(xfov), Some(width)) if width > 0.0 => {
                Ok(2.0 * ((0.5 * xfov).tan() * height / width).atan())
            }
            // A square picture, as NeRF's own have; the pictures' size is checked against it.
            (_, _, Some(xfov), _) => Ok(xfov),
            _ => Err("has neither camera_angle_x nor fl_y with h".into()),
        }
    }

    /// Whether the field of view holds for a square picture alone.
    fn is_square(&self) -> bool {
        let has_focal = self.fl_y.or(self.fl_x).is_some() && self.h.is_some();
        !has_focal && (self.w.is_none() || self.h.is_none())
    }
}

/// "./train/r_12.png" is 12.
fn trailing_number(file: &str) -> Option<u32> {
    let name = file.rsplit(['/', '\\']).next()?;
    let stem =
        name.rsplit_once('.').filter(|(_, end)| end.parse::<u32>().is_err()).map_or(name, |(stem, _)| stem);
    let digits = stem.len() - stem.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    stem[stem.len() - digits..].parse().ok()
}
