//! A light in the words of task.wgsl.

use crate::aim::{Aim, Spread};
use crate::owen::mix;
use crate::receiver::Receiver;
use crate::samples::light_seed;
use crate::scanlines::{Frame, bounds, sides};
use glam::{DVec3, Vec3};
use umbrage_scene::AreaLight;

/// `Task` of task.wgsl, field by field.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Task {
    centre: [f32; 3],
    radius: f32,
    u: [f32; 3],
    pub(super) extent: f32,
    v: [f32; 3],
    pub(super) first_group: u32,
    axis: [f32; 3],
    pub(super) pool_words: u32,
    rows: [[f32; 4]; 3],
    sides: [[f32; 4]; 4],
    corners: [[f32; 4]; 4],
    low: [f32; 4],
    high: [f32; 4],
    cone: [f32; 4],
    seed: [u32; 2],
    zero: u32,
    pub(super) root: u32,
}

/// Which constant of the kernels a light is.
pub(super) fn kind(light: &AreaLight) -> u32 {
    match light {
        AreaLight::Sun { .. } => 0,
        AreaLight::Rect { .. } => 1,
        AreaLight::Disk { .. } => 2,
        AreaLight::Sphere { .. } => 3,
    }
}

impl Task {
    /// `None` for a light that the kernels cannot hold: a sun without a size.
    pub(super) fn new(light: &AreaLight, seed: u64) -> Option<Self> {
        let mut task: Self = bytemuck::Zeroable::zeroed();
        let seed = mix(light_seed(seed, light));
        task.seed = [seed as u32, (seed >> 32) as u32];
        let [low, high] = bounds(light).map(finite);
        (task.low, task.high) = (low, high);
        let origin = Receiver::in_air(DVec3::ZERO);
        if let AreaLight::Sphere { centre, radius_world } = *light {
            (task.centre, task.radius) = (centre.to_array(), radius_world);
            return Some(task);
        }
        let aim = Aim::new(light, &origin)?;
        (task.u, task.v) = (array(aim.u), array(aim.v));
        match aim.spread {
            Spread::Area => {
                task.centre = array(aim.axis);
                task.axis = array(aim.u.cross(aim.v));
                let (a, u, v) = (aim.axis, aim.u, aim.v);
                task.corners = [a + u + v, a + u - v, a - u + v, a - u - v].map(|c| four(c, 0.0));
            }
            Spread::Cone { .. } => {
                let frame = Frame::new(&origin, &aim)?;
                task.axis = array(aim.axis);
                let rows = frame.light_from_world;
                task.rows = [0, 1, 2].map(|i| rows.row(i).extend(0.0).to_array());
                task.cone = frame.cone?.sizes();
                for (into, normal) in task.sides.iter_mut().zip(sides(&aim)) {
                    *into = four(normal, 1.0);
                }
            }
        }
        Some(task)
    }
}

fn array(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

fn four(v: DVec3, w: f32) -> [f32; 4] {
    v.as_vec3().extend(w).to_array()
}

/// The language of the kernels promises nothing about infinities.
fn finite(v: DVec3) -> [f32; 4] {
    let far = Vec3::splat(3e38);
    v.as_vec3().clamp(-far, far).extend(0.0).to_array()
}
