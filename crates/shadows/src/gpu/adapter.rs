//! Finding an adapter.

use crate::ShadowError;

/// Which adapter is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AdapterChoice {
    /// Part of its name, in any case; without it, real GPUs come before software.
    pub name: Option<String>,
    /// `vulkan`, `metal`, `dx12`, or `noop` (a backend that computes nothing: tests of pipelines).
    pub backend: Option<String>,
}

/// What a report says about an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterDescription {
    /// As the driver names it.
    pub name: String,
    /// Driver and version.
    pub driver: String,
    /// `vulkan`, `metal`, ...
    pub backend: String,
    /// `discrete`, `integrated`, `virtual`, `software`, `other`.
    pub device_type: &'static str,
}

impl AdapterDescription {
    /// Whether its times say nothing about a GPU's.
    pub fn is_software(&self) -> bool {
        self.device_type == "software"
    }
}

/// Every adapter, real GPUs first.
pub fn adapters() -> Vec<AdapterDescription> {
    list(&AdapterChoice::default()).into_iter().map(|(_, description)| description).collect()
}

pub(super) fn choose(choice: &AdapterChoice) -> Result<(wgpu::Adapter, AdapterDescription), ShadowError> {
    let all = list(choice);
    let found: Vec<String> = all.iter().map(|a| a.1.name.clone()).collect();
    let wanted = choice.name.as_ref().map(|n| n.to_lowercase());
    let fits = |name: &str| wanted.as_ref().is_none_or(|w| name.to_lowercase().contains(w));
    all.into_iter().find(|a| fits(&a.1.name)).ok_or_else(|| ShadowError::NoAdapter {
        wanted: choice.name.as_ref().map(|n| format!(" named \"{n}\"")).unwrap_or_default(),
        found: if found.is_empty() { "none".into() } else { found.join(", ") },
    })
}

fn list(choice: &AdapterChoice) -> Vec<(wgpu::Adapter, AdapterDescription)> {
    let backends = match choice.backend.as_deref() {
        Some("vulkan") => wgpu::Backends::VULKAN,
        Some("metal") => wgpu::Backends::METAL,
        Some("dx12") => wgpu::Backends::DX12,
        Some("noop") => wgpu::Backends::NOOP,
        _ => wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12,
    };
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    descriptor.backend_options.noop.enable = backends == wgpu::Backends::NOOP;
    let instance = wgpu::Instance::new(descriptor);
    let mut all: Vec<_> = pollster::block_on(instance.enumerate_adapters(backends))
        .into_iter()
        .map(|adapter| {
            let description = describe(&adapter.get_info());
            (adapter, description)
        })
        .collect();
    let rank = |d: &AdapterDescription| {
        ["discrete", "integrated", "virtual", "other"].iter().position(|&t| t == d.device_type)
    };
    all.sort_by_key(|(_, d)| rank(d).unwrap_or(usize::MAX));
    all
}

fn describe(info: &wgpu::AdapterInfo) -> AdapterDescription {
    AdapterDescription {
        name: info.name.clone(),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_string(),
        backend: info.backend.to_string(),
        device_type: match info.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete",
            wgpu::DeviceType::IntegratedGpu => "integrated",
            wgpu::DeviceType::VirtualGpu => "virtual",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "other",
        },
    }
}
