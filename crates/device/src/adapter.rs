//! Finding an adapter.

use crate::DeviceError;

/// Which adapter is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AdapterChoice {
    /// Part of its name, in any case; without it, real GPUs come before software.
    pub name: Option<String>,
    /// `vulkan` (`vk`), `metal` (`mtl`), `dx12` (`d3d12`), or `noop` (a backend that computes
    /// nothing: tests of pipelines), in any case. A comma list, as wgpu's own variable may hold,
    /// means those of its names that are known; nothing or blanks mean the first three.
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
    list(REAL).into_iter().map(|(_, description)| description).collect()
}

pub(crate) fn choose(choice: &AdapterChoice) -> Result<(wgpu::Adapter, AdapterDescription), DeviceError> {
    let all = list(backends(choice.backend.as_deref().unwrap_or_default())?);
    let found: Vec<String> = all.iter().map(|a| a.1.name.clone()).collect();
    let wanted = choice.name.as_ref().map(|n| n.to_lowercase());
    let fits = |name: &str| wanted.as_ref().is_none_or(|w| name.to_lowercase().contains(w));
    all.into_iter().find(|a| fits(&a.1.name)).ok_or_else(|| DeviceError::NoAdapter {
        wanted: choice.name.as_ref().map(|n| format!(" named \"{n}\"")).unwrap_or_default(),
        found: if found.is_empty() { "none".into() } else { found.join(", ") },
    })
}

/// The backends that compute something.
const REAL: wgpu::Backends = wgpu::Backends::VULKAN.union(wgpu::Backends::METAL).union(wgpu::Backends::DX12);

/// Those that a name or a comma list means.
fn backends(wanted: &str) -> Result<wgpu::Backends, DeviceError> {
    // An empty variable is as good as none.
    if wanted.trim().is_empty() {
        return Ok(REAL);
    }
    let known: wgpu::Backends = wanted.split(',').filter_map(|name| backend(name.trim())).collect();
    if known.is_empty() { Err(DeviceError::UnknownBackend { wanted: wanted.into() }) } else { Ok(known) }
}

fn backend(name: &str) -> Option<wgpu::Backends> {
    match name.to_lowercase().as_str() {
        "vulkan" | "vk" => Some(wgpu::Backends::VULKAN),
        "metal" | "mtl" => Some(wgpu::Backends::METAL),
        "dx12" | "d3d12" => Some(wgpu::Backends::DX12),
        "noop" => Some(wgpu::Backends::NOOP),
        _ => None,
    }
}

fn list(backends: wgpu::Backends) -> Vec<(wgpu::Adapter, AdapterDescription)> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    descriptor.backend_options.noop.enable = backends.contains(wgpu::Backends::NOOP);
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

#[cfg(test)]
mod tests {
    use super::*;
    use wgpu::Backends;

    #[test]
    fn backends_go_by_any_of_their_names() {
        for (wanted, expected) in [
            ("vulkan", Backends::VULKAN),
            ("VK", Backends::VULKAN),
            ("Metal", Backends::METAL),
            ("mtl", Backends::METAL),
            ("dx12", Backends::DX12),
            ("D3D12", Backends::DX12),
            ("noop", Backends::NOOP),
            ("vulkan, metal", Backends::VULKAN | Backends::METAL),
            ("gl,Vulkan", Backends::VULKAN),
            ("", REAL),
            (" ", REAL),
        ] {
            assert_eq!(backends(wanted).expect("known"), expected, "{wanted:?}");
        }
    }

    #[test]
    fn an_unknown_backend_is_refused_with_the_names_of_those_there_are() {
        for wanted in ["vulcan", "gl", "gl,opengl", ","] {
            let refused = backends(wanted).expect_err(wanted).to_string();
            assert!(refused.contains(&format!("\"{wanted}\"")), "{refused}");
            assert!(["vulkan", "metal", "dx12"].iter().all(|name| refused.contains(name)), "{refused}");
        }
    }

    #[test]
    fn an_unknown_backend_opens_no_other_adapter() {
        let choice = AdapterChoice { name: None, backend: Some("vulcan".into()) };
        assert!(matches!(crate::Device::open(&choice), Err(DeviceError::UnknownBackend { .. })));
    }
}
