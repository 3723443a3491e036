//! The only place here that knows wgpu: the execution of recordings.

mod execute;
mod pipelines;
mod readback;
mod textures;

pub use execute::Timing;

use crate::ShadowError;
use crate::layout::Anchor;
use crate::triangles::Triangles;
use pipelines::Pipelines;
use std::time::Duration;
use textures::Textures;
use umbrage_device::{AdapterChoice, AdapterDescription, Device, DeviceError};

/// A device with everything that outlives a frame.
pub struct Gpu {
    device: Device,
    pipelines: Pipelines,
    textures: Textures,
    timestamps: Option<wgpu::QuerySet>,
    scene: Option<Uploaded>,
    anchors: Option<(wgpu::Buffer, u32)>,
}

/// A scene's triangles and how many vertices they have: whole ones, cut-out ones and their masks.
struct Uploaded {
    whole: (wgpu::Buffer, u32),
    cut: (wgpu::Buffer, u32),
    masks: wgpu::Buffer,
}

/// Passes of a recording that are timed.
const MAX_TIMED_PASSES: u32 = 96;

impl Gpu {
    /// Opens an adapter.
    ///
    /// # Errors
    /// An unknown backend, no adapter that fits, or one that gives no device.
    pub fn new(choice: &AdapterChoice) -> Result<Self, ShadowError> {
        let device = Device::open(choice)?;
        let timestamps = device.timestamps("pass times", 2 * MAX_TIMED_PASSES);
        let (pipelines, textures) = (Pipelines::new(&device.device), Textures::default());
        Ok(Self { device, pipelines, textures, timestamps, scene: None, anchors: None })
    }

    /// Which adapter this is.
    pub fn description(&self) -> &AdapterDescription {
        self.device.description()
    }

    /// How long a frame may take; five minutes otherwise.
    pub fn set_patience(&mut self, patience: Duration) {
        self.device.set_patience(patience);
    }

    /// Largest side of a texture.
    pub fn largest_texture(&self) -> u32 {
        self.device.device.limits().max_texture_dimension_2d
    }

    /// Lets go of kept textures.
    pub(crate) fn forget(&mut self) {
        self.textures.forget();
    }

    /// Anchors uploaded last.
    pub(crate) fn anchors(&self) -> u32 {
        self.anchors.as_ref().map_or(0, |a| a.1)
    }

    /// Replaces the triangles; returns a key of their contents.
    pub(crate) fn upload_scene(&mut self, triangles: &Triangles) -> Result<u64, ShadowError> {
        let whole: &[u8] = bytemuck::cast_slice(&triangles.whole);
        let cut: &[u8] = bytemuck::cast_slice(&triangles.cut);
        let masks: &[u8] = bytemuck::cast_slice(&triangles.masks);
        let vertices = wgpu::BufferUsages::VERTEX;
        self.scene = Some(Uploaded {
            whole: (self.upload("scene", whole, vertices)?, triangles.whole.len() as u32),
            cut: (self.upload("cut-out", cut, vertices)?, triangles.cut.len() as u32),
            masks: self.upload("masks", masks, wgpu::BufferUsages::STORAGE)?,
        });
        let hash = |hash: u64, bytes: &[u8]| {
            let words = bytes.chunks(8).map(|chunk| {
                let mut word = [0; 8];
                word[..chunk.len()].copy_from_slice(chunk);
                u64::from_le_bytes(word)
            });
            words.fold(hash, |hash, w| (hash ^ w).wrapping_mul(0x0100_0000_01b3))
        };
        Ok([whole, cut, masks].into_iter().fold(0xcbf2_9ce4_8422_2325, hash))
    }

    /// Replaces the anchors.
    pub(crate) fn upload_anchors(&mut self, anchors: &[Anchor]) -> Result<(), ShadowError> {
        let buffer = self.upload("anchors", bytemuck::cast_slice(anchors), wgpu::BufferUsages::STORAGE)?;
        self.anchors = Some((buffer, anchors.len() as u32));
        Ok(())
    }

    fn upload(
        &self,
        label: &str,
        bytes: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, ShadowError> {
        self.device.upload(label, bytes, usage).map_err(|error| match error {
            DeviceError::TooLarge { wanted, limit } => {
                ShadowError::TooLarge { what: "a buffer", wanted, limit }
            }
            other => other.into(),
        })
    }
}
