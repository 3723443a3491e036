//! What is kept on the GPU from call to call.

use super::prepare::TOGETHER;
use umbrage_device::{Device, DeviceError};
use wgpu::BufferUsages as Usage;

/// Bytes of the pool of candidates, 40 for each triangle and 28 for each edge, where a binding holds as much.
const POOL_BYTES: u64 = 1 << 29;

/// As large as was needed so far.
pub(super) struct Buffers {
    pub(super) receivers: wgpu::Buffer,
    pub(super) groups: wgpu::Buffer,
    pub(super) results: wgpu::Buffer,
    pub(super) staging: wgpu::Buffer,
    pub(super) pool: wgpu::Buffer,
    pub(super) heads: wgpu::Buffer,
    pub(super) next_free: wgpu::Buffer,
    /// Receivers that a glance does not suffice for, and their lists.
    pub(super) queue: wgpu::Buffer,
}

impl Buffers {
    pub(super) fn new(device: &Device, groups: usize) -> Self {
        let limits = device.device.limits();
        let pool = POOL_BYTES.min(limits.max_storage_buffer_binding_size).min(limits.max_buffer_size) / 4 * 4;
        let none = || buffer(device, "points", 64, Usage::STORAGE | Usage::COPY_DST);
        Self {
            receivers: none(),
            groups: none(),
            results: buffer(device, "results", 64, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST),
            staging: device.staging(64),
            pool: buffer(device, "candidates", pool, Usage::STORAGE),
            heads: buffer(device, "lists", groups as u64 * 16, Usage::STORAGE),
            queue: buffer(
                device,
                "queue",
                8 * (1 + (groups * TOGETHER) as u64),
                Usage::STORAGE | Usage::COPY_DST,
            ),
            next_free: buffer(device, "next free", 4, Usage::STORAGE | Usage::COPY_DST),
        }
    }

    /// Room for the receivers of so many points.
    pub(super) fn fit(&mut self, device: &Device, points: usize) -> Result<(), DeviceError> {
        // A receiver has as many bytes as a result.
        let bytes = 16 * points as u64;
        grow(device, &mut self.receivers, bytes, Usage::COPY_DST)?;
        grow(device, &mut self.results, bytes, Usage::COPY_SRC | Usage::COPY_DST)?;
        if self.staging.size() < bytes {
            self.staging = device.staging(bytes);
        }
        Ok(())
    }

    /// Room for groups.
    pub(super) fn fit_groups(&mut self, device: &Device, bytes: usize) -> Result<(), DeviceError> {
        grow(device, &mut self.groups, bytes as u64, Usage::COPY_DST)
    }
}

fn grow(device: &Device, into: &mut wgpu::Buffer, bytes: u64, usage: Usage) -> Result<(), DeviceError> {
    if into.size() < bytes {
        device.fits(bytes, Usage::STORAGE)?;
        *into = buffer(device, "points", bytes, Usage::STORAGE | usage);
    }
    Ok(())
}

pub(super) fn buffer(device: &Device, label: &str, size: u64, usage: Usage) -> wgpu::Buffer {
    device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage,
        mapped_at_creation: false,
    })
}
