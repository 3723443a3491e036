//! The only place that knows wgpu: adapters, device, and the execution of recordings.

mod adapter;
mod execute;
mod pipelines;
mod readback;
mod textures;

pub use adapter::{AdapterChoice, AdapterDescription, adapters};
pub use execute::Timing;

use crate::ShadowError;
use crate::layout::{Anchor, Vertex};
use pipelines::Pipelines;
use std::sync::{Arc, Mutex};
use textures::Textures;

/// A device with everything that outlives a frame.
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    description: AdapterDescription,
    pipelines: Pipelines,
    textures: Textures,
    timestamps: Option<wgpu::QuerySet>,
    vertices: Option<(wgpu::Buffer, u32)>,
    anchors: Option<(wgpu::Buffer, u32)>,
    /// What validation or the driver said outside of any call's result.
    complaints: Arc<Mutex<Vec<String>>>,
}

/// Passes of a recording that are timed.
const MAX_TIMED_PASSES: u32 = 96;

impl Gpu {
    /// Opens an adapter.
    ///
    /// # Errors
    /// An unknown backend, no adapter that fits, or one that gives no device.
    pub fn new(choice: &AdapterChoice) -> Result<Self, ShadowError> {
        let (adapter, description) = adapter::choose(choice)?;
        let wanted = wgpu::Features::TIMESTAMP_QUERY;
        let request = wgpu::DeviceDescriptor {
            label: Some("umbrage"),
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&request)).map_err(|e| {
            ShadowError::NoDevice { adapter: description.name.clone(), reason: e.to_string() }
        })?;
        let complaints = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&complaints);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut list) = sink.lock() {
                list.push(error.to_string());
            }
        }));
        let timestamps = device.features().contains(wanted).then(|| {
            device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MAX_TIMED_PASSES,
            })
        });
        let (pipelines, textures) = (Pipelines::new(&device), Textures::default());
        Ok(Self {
            device,
            queue,
            description,
            pipelines,
            textures,
            timestamps,
            vertices: None,
            anchors: None,
            complaints,
        })
    }

    /// Which adapter this is.
    pub fn description(&self) -> &AdapterDescription {
        &self.description
    }

    /// Largest side of a texture.
    pub fn largest_texture(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
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
    pub(crate) fn upload_scene(&mut self, vertices: &[Vertex]) -> Result<u64, ShadowError> {
        let bytes: &[u8] = bytemuck::cast_slice(vertices);
        let buffer = self.upload("scene", bytes, wgpu::BufferUsages::VERTEX)?;
        self.vertices = Some((buffer, vertices.len() as u32));
        let words = bytes.chunks_exact(8).map(|c| u64::from_le_bytes(c.try_into().unwrap_or_default()));
        Ok(words.fold(0xcbf2_9ce4_8422_2325, |hash, w| (hash ^ w).wrapping_mul(0x0100_0000_01b3)))
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
        let limits = self.device.limits();
        let limit = match usage {
            wgpu::BufferUsages::STORAGE => limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
            _ => limits.max_buffer_size,
        };
        if bytes.len() as u64 > limit {
            return Err(ShadowError::TooLarge { what: "a buffer", wanted: bytes.len() as u64, limit });
        }
        use wgpu::util::DeviceExt as _;
        // Bindings of zero bytes are invalid.
        let contents = if bytes.is_empty() { &[0; 32] } else { bytes };
        Ok(self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage,
        }))
    }

    /// Errors that wgpu reported since the last call.
    fn check(&self) -> Result<(), ShadowError> {
        let mut list = self.complaints.lock().map_err(|_| ShadowError::Gpu("a callback panicked".into()))?;
        if list.is_empty() {
            Ok(())
        } else {
            Err(ShadowError::Gpu(list.drain(..).collect::<Vec<_>>().join("; ")))
        }
    }
}
