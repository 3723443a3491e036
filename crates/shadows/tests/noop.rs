//! Every pass that the registry can record, without a driver: naga validates its WGSL, evaluates
//! its constants, and wgpu's `noop` backend builds and dispatches it.

mod support;

use std::collections::{BTreeSet, HashSet};
use support::edited::all_variants;
use support::still_life;
use umbrage_frame::Anchors;
use umbrage_scene::AreaLight;
use umbrage_shadows::{
    AdapterChoice, Fragment, Gpu, Inputs, LightMap, Pass, RasterPass, Receivers, Recording, Renderer,
    Seeding, VariantId, fragments,
};

const SEEDINGS: [Seeding; 3] = [Seeding::Fresh, Seeding::Frozen, Seeding::Animated];

/// Every recording: variants, calibrations, lights, receivers, seedings.
fn recordings() -> Vec<Recording> {
    let scene = still_life::scene();
    let view = still_life::view_of(&still_life::camera());
    let past = [view; 3];
    let mut all = Vec::new();
    for (variant, light, receivers, seeding) in choices() {
        let map = LightMap::with(&scene, &light, (256, variant.variant.technique.projection()));
        let inputs = Inputs {
            view: &view,
            light: &map,
            calibration: variant.calibration,
            bias: variant.calibration.default_bias(),
            receivers,
            seeding,
            geometry_key: 0,
            has_cutouts: true,
            past: &past,
            age: 0,
        };
        all.push(inputs.recorded(variant, [0, 0]));
    }
    all
}

fn choices() -> Vec<(VariantId, AreaLight, Receivers, Seeding)> {
    let mut all = Vec::new();
    for variant in all_variants() {
        for light in still_life::lights_for(variant) {
            for receivers in [Receivers::Frame, Receivers::Anchors { count: 100 }] {
                // Seedings are slots of their own: one variant shows that each fits.
                let every = variant.variant.name == "chss-mask";
                let seedings = &SEEDINGS[..if every { 3 } else { 1 }];
                all.extend(seedings.iter().map(|&seeding| (variant, light, receivers, seeding)));
            }
        }
    }
    all
}

fn shader_of(pass: &Pass) -> &[Fragment] {
    match pass {
        Pass::Raster(raster) => &raster.shader,
        Pass::Compute(compute) => &compute.shader,
    }
}

/// A pass that draws cut-out triangles too becomes two, one for each of its shaders.
fn each_shader(pass: Pass) -> Vec<Pass> {
    match pass {
        Pass::Raster(pass) => {
            let cut = RasterPass { shader: pass.cut.clone(), ..pass.clone() };
            vec![Pass::Raster(pass), Pass::Raster(cut)]
        }
        compute @ Pass::Compute(_) => vec![compute],
    }
}

/// A pass's WGSL, and its constants as naga takes them: those that it declares.
fn wgsl(pass: &Pass) -> (String, Vec<(String, f64)>) {
    let source = shader_of(pass).iter().map(|f| f.source.as_ref()).collect::<Vec<_>>().join("\n");
    let constants = match pass {
        Pass::Raster(raster) => raster.constants.clone(),
        Pass::Compute(compute) => compute.constants.clone(),
    };
    let declared = constants.into_iter().filter(|(name, _)| source.contains(&format!("override {name}:")));
    let declared = declared.map(|(name, value)| (name.to_string(), value)).collect();
    (source, declared)
}

/// Every pass with WGSL, entry points or constants of its own, once.
fn distinct_passes() -> Vec<Pass> {
    let mut seen = HashSet::new();
    let all = recordings().into_iter().flat_map(|recording| recording.passes).flat_map(each_shader);
    let key = |pass: &Pass| {
        let (source, constants) = wgsl(pass);
        (source, pass.label(), constants.iter().map(|c| c.1.to_bits()).collect::<Vec<_>>())
    };
    all.filter(|pass| seen.insert(key(pass))).collect()
}

/// A validated module; no capability beyond WebGPU's own is granted (to which `pack2x16float` belongs,
/// whatever naga calls it).
fn validated(pass: &Pass) -> (naga::Module, naga::valid::ModuleInfo) {
    let (source, _) = wgsl(pass);
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|e| panic!("{}: {}", pass.label(), e.emit_to_string(&source)));
    let own = naga::valid::Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), own);
    let info = validator.validate(&module);
    (module, info.unwrap_or_else(|e| panic!("{}: {}", pass.label(), e.emit_to_string(&source))))
}

/// The module as a pipeline gets it, in naga's notation: constants evaluated, what the entry point
/// does not reach removed, the result validated again.
fn specialised(pass: &Pass, constants: &[(String, f64)]) -> Result<String, String> {
    let (module, info) = validated(pass);
    let constants: naga::back::PipelineConstants = constants.iter().cloned().collect();
    let mut modules = String::new();
    for entry in &module.entry_points {
        let entry = Some((entry.stage, entry.name.as_str()));
        let result = naga::back::pipeline_constants::process_overrides(&module, &info, entry, &constants);
        modules += &format!("{:?}", result.map_err(|e| format!("{e:?}"))?.0);
    }
    Ok(modules)
}

#[test]
fn every_pass_is_valid_wgsl_with_all_its_constants() {
    let passes = distinct_passes();
    for pass in &passes {
        let (_, constants) = wgsl(pass);
        specialised(pass, &constants).unwrap_or_else(|e| panic!("{}: {e}", pass.label()));
    }
    // 14 last passes for each of two lights and two receivers, at the least.
    assert!(passes.len() >= 56, "only {} passes", passes.len());
}

#[test]
fn every_compute_pass_names_an_entry_point_of_its_own() {
    for pass in distinct_passes() {
        let Pass::Compute(compute) = &pass else { continue };
        let (module, _) = validated(&pass);
        let names: Vec<_> = module.entry_points.iter().map(|e| e.name.as_str()).collect();
        assert_eq!(names, [compute.entry], "{}", compute.label);
    }
}

#[test]
fn a_forgotten_constant_is_an_error() {
    let passes = distinct_passes();
    let mut missed = BTreeSet::new();
    for pass in &passes {
        let (_, constants) = wgsl(pass);
        for (k, (name, value)) in constants.iter().enumerate() {
            let mut others = constants.clone();
            others.remove(k);
            match specialised(pass, &others) {
                Err(error) => {
                    assert!(error.contains("MissingValue"), "{} without {name}: {error}", pass.label());
                    missed.insert(name.clone());
                }
                // Then this pass's code does not reach it: another value changes nothing.
                Ok(_) => {
                    let mut changed = constants.clone();
                    changed[k].1 = value + 1.0;
                    let same = specialised(pass, &changed) == specialised(pass, &constants);
                    assert!(same, "{} uses {name} and does not miss it", pass.label());
                }
            }
        }
    }
    // Every constant of the pipeline is missed by some pass.
    let declared: BTreeSet<_> = passes.iter().flat_map(|p| wgsl(p).1).map(|c| c.0).collect();
    assert_eq!(missed, declared);
}

#[test]
fn no_constant_has_a_default() {
    let sources = distinct_passes().into_iter().map(|pass| wgsl(&pass).0).collect::<Vec<_>>().join("\n");
    for line in sources.lines().filter(|line| line.starts_with("override ")) {
        assert!(!line.contains('='), "a constant that one may forget: {line}");
    }
}

#[test]
fn every_shared_fragment_is_used() {
    let passes = distinct_passes();
    let used: HashSet<&Fragment> = passes.iter().flat_map(shader_of).collect();
    let unused: Vec<_> = fragments().into_iter().filter(|f| !used.contains(f)).map(|f| f.name).collect();
    assert!(unused.is_empty(), "no variant uses {unused:?}");
}

#[test]
fn every_pass_builds_and_runs_on_the_noop_backend() {
    let scene = still_life::leafy(still_life::leaf(umbrage_scene::Wrap::Repeat));
    let view = still_life::view_of(&still_life::camera());
    let choice = AdapterChoice { backend: Some("noop".into()), name: None };
    let mut gpu = Gpu::new(&choice).expect("noop needs no driver");
    let mut renderer = Renderer::new(&mut gpu, &scene, 64).expect("fits");
    let anchors = Anchors {
        view,
        pixel: vec![0; 100],
        position: vec![glam::Vec3::ZERO; 100],
        normal: vec![glam::Vec3::Y; 100],
    };
    renderer.set_anchors(&anchors).expect("fits");
    for (variant, light, receivers, seeding) in choices() {
        let (from, how) = ((&view, &light), (seeding, [0, 0]));
        let (shaded, expected) = match receivers {
            Receivers::Frame => (renderer.shade_frame(variant, from, how), view.width * view.height),
            Receivers::Anchors { count } => (renderer.shade_anchors(variant, from, how), count),
        };
        let shaded = shaded.unwrap_or_else(|e| panic!("{} {receivers:?} {seeding:?}: {e}", variant.name()));
        assert_eq!(shaded.values.len(), expected as usize, "{}", variant.name());
    }
}
