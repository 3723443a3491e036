//! Everything needed to run it again, in the scorecard's words.

use super::Settings;
use super::extras::{PATTERN_FRAMES, PATTERN_SEEDS};
use super::truths::PIXEL_SAMPLES;
use crate::suite::Plan;
use umbrage_frame::AgreementLimits;
use umbrage_metrics::{Bootstrap, TILE_PX, Viewing};
use umbrage_reference::{TruthGpu, TruthSettings};
use umbrage_report::{AdapterCard, Provenance, SceneCard, TruthCard};
use umbrage_scene::{AreaLight, Scene};
use umbrage_shadows::{Gpu, LightKind, LightMap};

/// What was run, on what.
pub(super) fn provenance(plan: &Plan, settings: &Settings, gpu: &Gpu) -> Provenance {
    Provenance {
        tool_version: env!("CARGO_PKG_VERSION").into(),
        date: settings.now.rfc3339.clone(),
        command: settings.command.clone(),
        suite: plan.name.clone(),
        adapter: adapter_card(gpu),
        width: plan.sampling.size.0,
        height: plan.sampling.size.1,
        frames: plan.sampling.window,
        seeds: plan.sampling.seeds,
        first_seed: plan.sampling.first_seed,
        tile_px: TILE_PX,
        shadow_map_texels: settings.map_texels,
        truth: TruthCard {
            samples_per_half: plan.sampling.samples,
            basis_samples: plan.sampling.basis_samples,
            tolerance: plan.sampling.tolerance,
            method: format!(
                "scanlines: every triangle between point and light covers runs of samples on jittered lines{}",
                on(settings.truth_gpu.as_ref())
            ),
        },
        scenes: plan.jobs.iter().map(|job| scene_card(&job.scene, settings.map_texels)).collect(),
        notes: notes(plan, settings),
    }
}

/// Where truth was found.
pub(super) fn on(gpu: Option<&TruthGpu>) -> String {
    gpu.map(TruthGpu::description).map(|a| format!(", on {} ({})", a.name, a.driver)).unwrap_or_default()
}

/// What rendered the variants.
pub(crate) fn adapter_card(gpu: &Gpu) -> AdapterCard {
    let adapter = gpu.description();
    AdapterCard {
        name: adapter.name.clone(),
        driver: adapter.driver.clone(),
        backend: adapter.backend.clone(),
        device_type: adapter.device_type.into(),
        is_cpu: adapter.is_software(),
    }
}

/// The rest of what is part of a score (METRICS section 2, last paragraph).
fn notes(plan: &Plan, settings: &Settings) -> Vec<String> {
    let (limits, bootstrap, viewing) = (AgreementLimits::default(), Bootstrap::default(), Viewing::default());
    let mut notes = vec![
        format!(
            "{} frames from the middle of each path, in windows of {}",
            plan.frames, plan.sampling.window
        ),
        format!(
            "truth: {} replicates in all; the pixel reading's truth has {PIXEL_SAMPLES} samples in each half",
            TruthSettings::default().replicates
        ),
        format!(
            "an anchor counts where the raster's surface in its pixel lies within {} of the depth and {:.0} degrees",
            limits.plane_per_depth,
            limits.normal_radians.to_degrees()
        ),
        format!(
            "intervals: {} resamples of clusters of {n} x {n} tiles, seed {}",
            bootstrap.replicates,
            bootstrap.seed,
            n = bootstrap.cluster_tiles
        ),
        format!(
            "FLIP: of the scene shaded through the mask, {} pixels per degree, exposure {} stops",
            viewing.pixels_per_degree, viewing.exposure_stops
        ),
    ];
    notes.push(format!(
        "lag-1 correlations: {} frames and {} seeds of frozen and of animated patterns",
        PATTERN_FRAMES.min(plan.sampling.window as usize),
        PATTERN_SEEDS
    ));
    if let Some(bias) = settings.bias {
        notes.push(format!("the bias of all variants was replaced: {}", bias.describe()));
    }
    notes
}

fn scene_card(scene: &Scene, texels: u32) -> SceneCard {
    let light = &scene.lights[0];
    let map = LightMap::new(scene, light, texels);
    let projection = match map.kind {
        LightKind::Sun => format!("orthographic, {:.4} m wide", 1.0 / map.scale),
        LightKind::Local => {
            format!("perspective, {:.1} degrees", 2.0 * (0.5 / map.scale).atan().to_degrees())
        }
        LightKind::Cube => "six perspective faces".into(),
    };
    SceneCard {
        name: scene.name.clone(),
        content_hash: hash_of(scene),
        light: describe_light(light),
        shadow_map: format!(
            "{projection}, centred on {}, depths up to {:.2} m, nearest blocker at {:.2} m, {texels}² texels of {:.2} mm; \
             fixed kernels are set for blockers {} m away",
            scene.shadow_region.centre,
            map.far,
            map.nearest_blocker,
            1000.0 * map.texel_world(),
            map.reference_gap
        ),
        notes: scene.notes.clone(),
    }
}

/// Hash of geometry and lights, for people.
pub(super) fn hash_of(scene: &Scene) -> String {
    scene.content_hash().iter().take(16).map(|b| format!("{b:02x}")).collect()
}

pub(crate) fn describe_light(light: &AreaLight) -> String {
    match *light {
        AreaLight::Sun { angular_diameter_radians, direction_to_light: d } => format!(
            "sun, {:.3} degrees across, elevation {:.1} degrees, azimuth {:.1} degrees (+x to +z)",
            angular_diameter_radians.to_degrees(),
            d.y.asin().to_degrees(),
            d.z.atan2(d.x).to_degrees()
        ),
        AreaLight::Disk { radius_world, centre, normal } => {
            format!("disk, radius {radius_world} m, at {centre}, normal {normal}")
        }
        AreaLight::Rect { half_u, half_v, centre } => {
            format!("rectangle, half-sides {half_u} and {half_v} m, at {centre}")
        }
        AreaLight::Sphere { radius_world, centre } => format!("sphere, radius {radius_world} m, at {centre}"),
    }
}
