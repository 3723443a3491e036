//! The bytes that Rust and WGSL share; a test compares them with naga's own layout.

use bytemuck::{Pod, Zeroable};

/// Twin of `Globals` in `wgsl/globals.wgsl`: what every pass may read.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Globals {
    /// Columns of the camera's pose.
    pub world_from_camera: [[f32; 4]; 4],
    /// Columns of the camera's projection.
    pub clip_from_world: [[f32; 4]; 4],
    /// Columns of the light's view matrix.
    pub light_from_world: [[f32; 4]; 4],
    /// Columns of the light's projection.
    pub light_clip_from_world: [[f32; 4]; 4],
    /// Pixels of the frame.
    pub frame_size: [u32; 2],
    /// Pixels or anchors to shade.
    pub receivers: u32,
    /// Texels of the shadow map's side.
    pub map_size: u32,
    /// Half the picture at depth 1.
    pub half_extent: [f32; 2],
    /// Map widths per metre (sun) or per unit of slope (local light).
    pub map_scale: f32,
    /// Tangent of the sun's angular radius, or a local light's radius in metres.
    pub light_size: f32,
    /// Light-space depth before which there is no blocker.
    pub nearest_blocker: f32,
    /// Blocker distance for which fixed kernels are set.
    pub reference_gap: f32,
    /// The pattern's frame.
    pub pattern_frame: u32,
    /// The pattern's seed.
    pub pattern_seed: u32,
    /// Number of the frame, for what alternates from frame to frame.
    pub frame_index: u32,
    /// Depth of the shadow region's centre, metres.
    pub eye_distance: f32,
    /// Depth of the map's far plane, metres.
    pub far: f32,
    /// Side of one face of a cube map in texels; 0 for a single map.
    pub face_size: u32,
}

/// Twin of `Anchor` in `wgsl/receiver_anchor.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Anchor {
    pub(crate) position: [f32; 4],
    pub(crate) normal: [f32; 4],
}

/// Vertex of both raster passes: position, flat normal.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) normal: [f32; 3],
}

/// Vertex of a cut-out triangle: also its place in a mask, and where that begins.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct CutVertex {
    pub(crate) position: [f32; 3],
    pub(crate) normal: [f32; 3],
    pub(crate) uv: [f32; 2],
    pub(crate) mask: u32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::{offset_of, size_of};

    /// Offsets of a WGSL struct's members, from naga.
    fn wgsl_layout(source: &str, name: &str) -> (Vec<(String, u32)>, u32) {
        let module = naga::front::wgsl::parse_str(source).expect("parses");
        let found = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name));
        let naga::TypeInner::Struct { members, span } = &found.expect("declared").1.inner else {
            panic!("{name} is no struct");
        };
        (members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect(), *span)
    }

    #[test]
    fn globals_have_the_same_layout_in_rust_and_wgsl() {
        let (members, span) = wgsl_layout(include_str!("wgsl/globals.wgsl"), "Globals");
        macro_rules! offsets { ($($field:ident),*) => { vec![$((stringify!($field).to_string(), offset_of!(Globals, $field) as u32)),*] } }
        let rust = offsets!(
            world_from_camera,
            clip_from_world,
            light_from_world,
            light_clip_from_world,
            frame_size,
            receivers,
            map_size,
            half_extent,
            map_scale,
            light_size,
            nearest_blocker,
            reference_gap,
            pattern_frame,
            pattern_seed,
            frame_index,
            eye_distance,
            far,
            face_size
        );
        assert_eq!((members, span as usize), (rust, size_of::<Globals>()));
    }

    #[test]
    fn anchors_have_the_same_layout_in_rust_and_wgsl() {
        let source = [include_str!("wgsl/globals.wgsl"), include_str!("wgsl/receiver_anchor.wgsl")].concat();
        let (members, span) = wgsl_layout(&source, "Anchor");
        let rust =
            vec![("position".to_string(), 0), ("normal".to_string(), offset_of!(Anchor, normal) as u32)];
        assert_eq!((members, span as usize), (rust, size_of::<Anchor>()));
    }
}
