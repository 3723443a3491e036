//! From the GPU back to memory.

use super::Gpu;
use crate::recording::{Format, Recording, TextureInfo};
use crate::{Dump, ShadowError};
use umbrage_frame::Image;

impl Gpu {
    /// Submits, waits, and returns the values and the milliseconds of `timed` passes.
    pub(super) fn submit_and_read(
        &self,
        mut encoder: wgpu::CommandEncoder,
        values: Option<(&wgpu::Buffer, u64)>,
        timed: u32,
    ) -> Result<(Vec<f32>, Vec<f64>), ShadowError> {
        let staging = values.map(|(buffer, bytes)| {
            let staging = self.device.staging(bytes);
            encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, bytes);
            staging
        });
        let queries = self.timestamps.as_ref().filter(|_| timed > 0);
        let times = queries.map(|queries| self.device.resolve(&mut encoder, queries, 2 * timed));
        self.device.queue.submit([encoder.finish()]);
        self.device.check()?;
        let floats = staging.map(|s| self.device.read::<f32>(&s)).transpose()?.unwrap_or_default();
        let ticks = times.map(|s| self.device.read::<u64>(&s)).transpose()?.unwrap_or_default();
        self.device.wait()?;
        let period_ms = f64::from(self.device.queue.get_timestamp_period()) * 1e-6;
        let ms = ticks.chunks_exact(2).map(|t| t[1].saturating_sub(t[0]) as f64 * period_ms).collect();
        Ok((floats, ms))
    }

    /// Reads every level of every texture of a recording that was just run, but for depth buffers;
    /// integers as the nearest float.
    pub(crate) fn read_textures(&mut self, recording: &Recording) -> Result<Vec<Dump>, ShadowError> {
        let allocated = self.textures.allocate(&self.device.device, recording);
        let mut dumps = Vec::new();
        for (info, texture) in recording.textures.iter().zip(&allocated.textures) {
            for level in 0..info.mips {
                dumps.extend(self.read_level(info, texture, level)?);
            }
        }
        self.device.check()?;
        Ok(dumps)
    }

    /// One level of a texture; nothing of a depth buffer.
    fn read_level(
        &self,
        info: &TextureInfo,
        texture: &wgpu::Texture,
        level: u32,
    ) -> Result<Option<Dump>, ShadowError> {
        let (texel_bytes, channels) = match info.format {
            Format::R32Float => (4, 1),
            Format::Rg32Float | Format::Rg32Uint => (8, 2),
            Format::Rgba16Float => (8, 4),
            Format::Depth32Float => return Ok(None),
        };
        let [width, height] = info.size(level);
        // Rows of a copy are aligned to 256 bytes.
        let row_bytes = (width * texel_bytes).next_multiple_of(256);
        let staging = self.device.staging(u64::from(row_bytes) * u64::from(height));
        let mut encoder = self.device.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row_bytes),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        self.device.queue.submit([encoder.finish()]);
        let bytes = self.device.read::<u8>(&staging)?;
        let texel = |x: u32, y: u32, c: u32| {
            let at = (y * row_bytes + x * texel_bytes) as usize;
            match info.format {
                Format::Rgba16Float => half(&bytes, at + 2 * c as usize),
                Format::Rg32Uint => float(&bytes, at + 4 * c as usize).to_bits() as f32,
                _ => float(&bytes, at + 4 * c as usize),
            }
        };
        let channel = |c| Image::from_fn(width, height, |x, y| texel(x, y, c));
        Ok(Some(Dump { label: info.label, level, channels: (0..channels).map(channel).collect() }))
    }
}

fn float(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

/// IEEE half to float; the targets hold no infinities.
fn half(bytes: &[u8], at: usize) -> f32 {
    let bits = u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let (sign, exponent, mantissa) = (bits >> 15, (bits >> 10) & 31, bits & 1023);
    let magnitude = match exponent {
        0 => f32::from(mantissa) * 2f32.powi(-24),
        e => (1.0 + f32::from(mantissa) / 1024.0) * 2f32.powi(i32::from(e) - 15),
    };
    if sign == 1 { -magnitude } else { magnitude }
}
