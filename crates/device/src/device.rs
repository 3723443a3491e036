//! An open adapter.

use crate::adapter::choose;
use crate::{AdapterChoice, AdapterDescription, DeviceError};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// A frame on a software driver takes seconds at most; a hung driver is told from a slow one.
const PATIENCE: Duration = Duration::from_secs(300);

/// A device with its queue.
pub struct Device {
    /// Makes buffers and pipelines.
    pub device: wgpu::Device,
    /// Takes work.
    pub queue: wgpu::Queue,
    description: AdapterDescription,
    patience: Duration,
    /// What validation or the driver said outside of any call's result.
    complaints: Arc<Mutex<Vec<String>>>,
}

impl Device {
    /// Opens an adapter, with all that it can hold and timestamps where it has them.
    ///
    /// # Errors
    /// An unknown backend, no adapter that fits, or one that gives no device.
    pub fn open(choice: &AdapterChoice) -> Result<Self, DeviceError> {
        let (adapter, description) = choose(choice)?;
        let request = wgpu::DeviceDescriptor {
            label: Some("umbrage"),
            required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&request)).map_err(|e| {
            DeviceError::NoDevice { adapter: description.name.clone(), reason: e.to_string() }
        })?;
        let complaints = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&complaints);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut list) = sink.lock() {
                list.push(error.to_string());
            }
        }));
        Ok(Self { device, queue, description, patience: PATIENCE, complaints })
    }

    /// Which adapter this is.
    pub fn description(&self) -> &AdapterDescription {
        &self.description
    }

    /// How long [`Device::wait`] waits; five minutes otherwise.
    pub fn set_patience(&mut self, patience: Duration) {
        self.patience = patience;
    }

    /// A set of timestamps, where the adapter has them.
    pub fn timestamps(&self, label: &'static str, count: u32) -> Option<wgpu::QuerySet> {
        self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY).then(|| {
            self.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some(label),
                ty: wgpu::QueryType::Timestamp,
                count,
            })
        })
    }

    /// Copies timestamps to where they can be read: call [`Device::read`] after submission.
    pub fn resolve(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        queries: &wgpu::QuerySet,
        count: u32,
    ) -> wgpu::Buffer {
        let bytes = u64::from(count) * 8;
        let resolved = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("resolved times"),
            size: bytes,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let staging = self.staging(bytes);
        encoder.resolve_query_set(queries, 0..count, &resolved, 0);
        encoder.copy_buffer_to_buffer(&resolved, 0, &staging, 0, bytes);
        staging
    }

    /// A buffer with contents; one of 32 bytes where there are none, because bindings of zero bytes
    /// are invalid.
    ///
    /// # Errors
    /// Larger than the adapter takes.
    pub fn upload(
        &self,
        label: &str,
        bytes: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, DeviceError> {
        use wgpu::util::DeviceExt as _;
        self.fits(bytes.len() as u64, usage)?;
        let contents = if bytes.is_empty() { &[0; 32] } else { bytes };
        Ok(self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage,
        }))
    }

    /// Whether the adapter takes a buffer of so many bytes.
    ///
    /// # Errors
    /// It does not.
    pub fn fits(&self, bytes: u64, usage: wgpu::BufferUsages) -> Result<(), DeviceError> {
        let limits = self.device.limits();
        let limit = match usage.contains(wgpu::BufferUsages::STORAGE) {
            true => limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
            false => limits.max_buffer_size,
        };
        if bytes > limit { Err(DeviceError::TooLarge { wanted: bytes, limit }) } else { Ok(()) }
    }

    /// A buffer to read back from.
    pub fn staging(&self, bytes: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("staging"),
            size: bytes.max(4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        })
    }

    /// Waits for all submitted work, then reads a whole staging buffer.
    ///
    /// # Errors
    /// What the driver refused, or did not finish.
    pub fn read<T: bytemuck::Pod>(&self, staging: &wgpu::Buffer) -> Result<Vec<T>, DeviceError> {
        self.read_with(staging, bytemuck::pod_collect_to_vec)
    }

    /// As [`Device::read`], without a copy. The buffer can be used again.
    ///
    /// # Errors
    /// What the driver refused, or did not finish.
    pub fn read_with<T>(
        &self,
        staging: &wgpu::Buffer,
        look: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, DeviceError> {
        staging.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        self.wait()?;
        let found = {
            let range = staging.slice(..).get_mapped_range();
            look(&range.map_err(|e| DeviceError::Refused(e.to_string()))?)
        };
        staging.unmap();
        Ok(found)
    }

    /// Waits for all submitted work.
    ///
    /// # Errors
    /// What the driver refused, or did not finish.
    pub fn wait(&self) -> Result<(), DeviceError> {
        let waited =
            self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(self.patience) });
        match waited {
            Ok(_) => self.check(),
            Err(wgpu::PollError::Timeout) => {
                // A queue that is dropped waits for its work, which may never end: neither is dropped.
                std::mem::forget((self.device.clone(), self.queue.clone()));
                Err(DeviceError::Timeout { secs: self.patience.as_secs() })
            }
            Err(e) => Err(DeviceError::Refused(e.to_string())),
        }
    }

    /// Errors that wgpu reported since the last call.
    ///
    /// # Errors
    /// There are some.
    pub fn check(&self) -> Result<(), DeviceError> {
        let mut list =
            self.complaints.lock().map_err(|_| DeviceError::Refused("a callback panicked".into()))?;
        if list.is_empty() {
            Ok(())
        } else {
            Err(DeviceError::Refused(list.drain(..).collect::<Vec<_>>().join("; ")))
        }
    }
}
