//! What is kept on the GPU from call to call.

use super::prepare::Prepared;
use umbrage_device::{Device, DeviceError};
use wgpu::BufferUsages as Usage;

/// Bytes of the pool of candidates, 40 for each, where a binding holds as much.
const POOL_BYTES: u64 = 1 << 29;

/// As large as was needed so far.
pub(super) struct Buffers {
    pub(super) receivers: wgpu::Buffer,
    pub(super) order: wgpu::Buffer,
    pub(super) groups: wgpu::Buffer,
    pub(super) results: wgpu::Buffer,
    pub(super) staging: wgpu::Buffer,
    pub(super) pool: wgpu::Buffer,
    pub(super) heads: wgpu::Buffer,
    pub(super) next_free: wgpu::Buffer,
}

impl Buffers {
    pub(super) fn new(device: &Device, groups: usize) -> Self {
        let limits = device.device.limits();
        let pool = POOL_BYTES.min(limits.max_storage_buffer_binding_size).min(limits.max_buffer_size) / 4 * 4;
        let none = || buffer(device, "points", 64, Usage::STORAGE | Usage::COPY_DST);
        Self {
            receivers: none(),
            order: none(),
            groups: none(),
            results: buffer(device, "results", 64, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST),
            staging: device.staging(64),
            pool: buffer(device, "candidates", pool, Usage::STORAGE),
            heads: buffer(device, "lists", groups as u64 * 8, Usage::STORAGE),
            next_free: buffer(device, "next free", 4, Usage::STORAGE | Usage::COPY_DST),
        }
    }

    pub(super) fn fit(&mut self, device: &Device, prepared: &Prepared) -> Result<(), DeviceError> {
        let grow = |into: &mut wgpu::Buffer, bytes: usize| -> Result<(), DeviceError> {
            let bytes = bytes as u64;
            if into.size() < bytes {
                device.fits(bytes, Usage::STORAGE)?;
                *into = buffer(device, "points", bytes, Usage::STORAGE | Usage::COPY_DST);
            }
            Ok(())
        };
        let results = 16 * prepared.words.len() as u64;
        grow(&mut self.receivers, size_of_val(&prepared.receivers[..]))?;
        grow(&mut self.order, size_of_val(&prepared.order[..]))?;
        grow(&mut self.groups, size_of_val(&prepared.groups[..]))?;
        if self.results.size() < results {
            device.fits(results, Usage::STORAGE)?;
            self.results =
                buffer(device, "results", results, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST);
        }
        if self.staging.size() < results {
            self.staging = device.staging(results);
        }
        Ok(())
    }
}

pub(super) fn buffer(device: &Device, label: &str, size: u64, usage: Usage) -> wgpu::Buffer {
    device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage,
        mapped_at_creation: false,
    })
}
