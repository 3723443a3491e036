//! Textures: kept by label as long as their key is the same, the others pooled by shape.

use super::pipelines::wgpu_format;
use crate::recording::{Format, Recording, TextureInfo};
use std::collections::HashMap;

/// Width, height, format, levels.
type Shape = (u32, u32, Format, u32);

/// Owns every texture of a device.
#[derive(Default)]
pub(super) struct Textures {
    /// Label -> shape and key, texture, and whether its passes have run.
    kept: HashMap<&'static str, (TextureInfo, wgpu::Texture, bool)>,
    pool: HashMap<Shape, Vec<wgpu::Texture>>,
}

/// The textures of one recording.
pub(super) struct Allocated {
    pub(super) textures: Vec<wgpu::Texture>,
    /// Per texture: its contents are already there.
    pub(super) ready: Vec<bool>,
}

impl Textures {
    /// A texture for each of the recording's.
    pub(super) fn allocate(&mut self, device: &wgpu::Device, recording: &Recording) -> Allocated {
        let mut allocated = Allocated { textures: Vec::new(), ready: Vec::new() };
        let mut used: HashMap<Shape, usize> = HashMap::new();
        for info in &recording.textures {
            let (texture, ready) = match info.kept {
                Some(_) => self.kept(device, info),
                None => {
                    let shape = (info.width, info.height, info.format, info.mips);
                    let next = used.entry(shape).or_default();
                    *next += 1;
                    let pool = self.pool.entry(shape).or_default();
                    if pool.len() < *next {
                        pool.push(create(device, info));
                    }
                    (pool[*next - 1].clone(), false)
                }
            };
            allocated.textures.push(texture);
            allocated.ready.push(ready);
        }
        // A camera path has one size: shapes that this recording does not use are let go.
        self.pool.retain(|shape, _| used.contains_key(shape));
        allocated
    }

    fn kept(&mut self, device: &wgpu::Device, info: &TextureInfo) -> (wgpu::Texture, bool) {
        let entry =
            self.kept.entry(info.label).or_insert_with(|| (info.clone(), create(device, info), false));
        if entry.0 != *info {
            let same_shape = TextureInfo { kept: info.kept, ..entry.0.clone() } == *info;
            let texture = if same_shape { entry.1.clone() } else { create(device, info) };
            *entry = (info.clone(), texture, false);
        }
        (entry.1.clone(), entry.2)
    }

    /// Lets go of what is kept.
    pub(super) fn forget(&mut self) {
        self.kept.clear();
    }

    /// Marks every kept texture of a recording as filled, after its passes ran.
    pub(super) fn filled(&mut self, recording: &Recording) {
        for info in recording.textures.iter().filter(|t| t.kept.is_some()) {
            if let Some(entry) = self.kept.get_mut(info.label) {
                entry.2 = true;
            }
        }
    }
}

fn create(device: &wgpu::Device, info: &TextureInfo) -> wgpu::Texture {
    use wgpu::TextureUsages as Usage;
    let common = Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT | Usage::COPY_SRC;
    let usage = match info.format {
        Format::R32Float | Format::Rg32Float | Format::Rg32Uint => common | Usage::STORAGE_BINDING,
        Format::Rgba16Float => common,
        Format::Depth32Float => Usage::RENDER_ATTACHMENT,
    };
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(info.label),
        size: wgpu::Extent3d { width: info.width, height: info.height, depth_or_array_layers: 1 },
        mip_level_count: info.mips,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu_format(info.format),
        usage,
        view_formats: &[],
    })
}
