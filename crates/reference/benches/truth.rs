//! Seconds that truth takes, alone or in turns with another program.
//!
//! `cargo bench -p umbrage-reference --bench truth -- CASE [--models DIR] [--size WxH] [--samples N]
//! [--rounds N] [--method NAME]... [--on cpu|gpu [--adapter NAME]] [--export FILE] [--serve] [--rays FILE]`. Without
//! `--models` there is only the case `colonnade`. `--export` writes the triangles, the receivers and the light for
//! `tests/peers/embree`; `--serve` waits for a line on standard input before each round, so that a
//! script can let two programs take turns; `--rays` says what given rays hit, for the same folder.
#![expect(clippy::print_stdout, reason = "a program, not a library")]

use glam::{Mat4, Vec3, Vec4};
use rayon::prelude::*;
use std::error::Error;
use std::io::{BufRead, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;
use umbrage_frame::View;
use umbrage_reference::{
    AdapterChoice, GpuTracer, GroundTruth, Method, Points, Tracer, TruthGpu, TruthSettings,
};
use umbrage_scene::{AreaLight, Camera, Geometry, Scene};

const CASES: [&str; 11] = [
    "colonnade",
    "sponza-sun",
    "atrium-sun",
    "atrium-rect",
    "atrium-disk",
    "atrium-sphere",
    "atrium4-sun",
    "atrium4-rect",
    "atrium-wide",
    "atrium-real-sun",
    "thicket",
];

struct Options {
    case: String,
    models: PathBuf,
    size: [u32; 2],
    samples: u32,
    rounds: usize,
    methods: Vec<Method>,
    on_gpu: bool,
    adapter: Option<String>,
    export: Option<PathBuf>,
    serve: bool,
    rays: Option<PathBuf>,
    leaves: usize,
    layers: f32,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = options()?;
    let (scene, camera, light) = case(&options)?;
    if let Some(path) = &options.rays {
        return answer(path, scene);
    }
    let (tracer, seconds) = timed(|| Tracer::new(&scene));
    let tracer = tracer?;
    println!("{}: {} triangles, tree in {seconds:.2} s", options.case, scene.geometry.triangles.len());
    let view = view(&camera, options.size);
    let (hits, seconds) = timed(|| tracer.primary(&view));
    let points = hits.points();
    println!("{} points, camera rays in {seconds:.3} s; {light:?}", points.len());
    if let Some(path) = &options.export {
        return export(path, &scene, &points, &light, (&camera, &view, options.samples));
    }
    let settings = |method| TruthSettings {
        samples: options.samples / 2,
        basis_samples: 0,
        method,
        ..Default::default()
    };
    if options.serve {
        for line in std::io::stdin().lock().lines() {
            let seconds = match line?.as_str() {
                "camera" => timed(|| tracer.primary(&view)).1,
                _ => timed(|| tracer.truth(&points, &light, &settings(options.methods[0]))).1,
            };
            println!("{{\"seconds\": {seconds}}}");
        }
        return Ok(());
    }
    if options.on_gpu {
        return on_gpu(&options, (&tracer, &points, &light), &settings(Method::Scanlines));
    }
    for method in &options.methods {
        let find = || Ok(tracer.truth(&points, &light, &settings(*method)));
        tell(&format!("{method:?}"), rounds(options.rounds, find)?);
    }
    Ok(())
}

fn on_gpu(
    options: &Options,
    (tracer, points, light): (&Tracer, &Points, &AreaLight),
    settings: &TruthSettings,
) -> Result<(), Box<dyn Error>> {
    let choice = AdapterChoice { name: options.adapter.clone(), backend: None };
    let gpu = TruthGpu::open(&choice)?;
    let adapter = gpu.description().clone();
    let software = adapter.is_software();
    println!("on {} ({}, {}, {})", adapter.name, adapter.device_type, adapter.backend, adapter.driver);
    let (found, seconds) = timed(|| GpuTracer::new(tracer, &gpu));
    let mut found = found?;
    println!("scene uploaded in {seconds:.4} s");
    let (first, seconds) = timed(|| found.truth(points, light, settings));
    first?;
    println!("first frame, with the compilation of its kernels: {seconds:.3} s");
    let mut kernels = Vec::new();
    let find = || {
        let truth = found.truth(points, light, settings)?;
        kernels.push(found.share().kernels);
        Ok(truth)
    };
    tell("Scanlines on the GPU", rounds(options.rounds, find)?);
    let share = found.share();
    let of = |n: usize| n as f64 / points.len() as f64;
    println!(
        "{:.4} looked at, {:.4} below their horizon, {:.5} on the CPU",
        of(share.gpu),
        of(share.below),
        of(share.cpu)
    );
    let timed: Option<Vec<_>> = kernels.into_iter().collect();
    let Some(mut timed) = timed else {
        println!("no timestamps: GPU time unknown");
        return Ok(());
    };
    timed.sort_by(|a, b| a.all().total_cmp(&b.all()));
    let all = |k: &umbrage_reference::KernelSeconds| 1e3 * k.all();
    let median = timed[timed.len() / 2];
    println!(
        "{}: {:.3} ms ({:.3} to {:.3}): walk {:.3}, glance {:.3}, look {:.3}",
        if software { "timestamps of a software adapter, no GPU cost" } else { "GPU time" },
        all(&median),
        all(&timed[0]),
        all(&timed[timed.len() - 1]),
        1e3 * median.walk,
        1e3 * median.glance,
        1e3 * median.look
    );
    Ok(())
}

/// The last result, and the seconds of all rounds in order of size.
fn rounds(
    count: usize,
    mut find: impl FnMut() -> Result<GroundTruth, Box<dyn Error>>,
) -> Result<(GroundTruth, Vec<f64>), Box<dyn Error>> {
    let mut seconds = Vec::new();
    let mut found = None;
    for _ in 0..count {
        let (truth, took) = timed(&mut find);
        seconds.push(took);
        found = Some(truth?);
    }
    seconds.sort_by(f64::total_cmp);
    Ok((found.ok_or("no round")?, seconds))
}

fn tell(what: &str, (truth, seconds): (GroundTruth, Vec<f64>)) {
    let points = truth.mean.len() as f64;
    let share = |f: &dyn Fn(f32) -> bool| truth.mean.iter().filter(|&&m| f(m)).count() as f64 / points;
    let mean = truth.mean.iter().map(|&m| f64::from(m)).sum::<f64>() / points;
    let error = (truth.variance.iter().map(|&v| f64::from(v)).sum::<f64>() / points).sqrt();
    let median = seconds[seconds.len() / 2];
    let samples = truth.samples.first().copied().unwrap_or_default();
    println!(
        "{what} x {samples}: {median:.4} s ({:.4} to {:.4}), {:.1} Msamples/s; V {mean:.6}, standard error {error:.5} (RMS); {:.3} lit, {:.3} hidden",
        seconds[0],
        seconds[seconds.len() - 1],
        points * f64::from(samples) / median / 1e6,
        share(&|m| m == 1.0),
        share(&|m| m == 0.0),
    );
}

fn options() -> Result<Options, Box<dyn Error>> {
    let mut options = Options {
        case: "colonnade".into(),
        models: PathBuf::new(),
        size: [480, 270],
        samples: 1024,
        rounds: 1,
        methods: Vec::new(),
        on_gpu: false,
        adapter: None,
        export: None,
        serve: false,
        rays: None,
        leaves: 100_000,
        layers: 2.0,
    };
    // Cargo adds `--bench`.
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--models" => options.models = value()?.into(),
            "--size" => {
                let text = value()?;
                let (width, height) = text.split_once('x').ok_or("WxH")?;
                options.size = [width.parse()?, height.parse()?];
            }
            "--leaves" => options.leaves = value()?.parse()?,
            "--layers" => options.layers = value()?.parse()?,
            "--samples" => options.samples = value()?.parse()?,
            "--rounds" => options.rounds = value()?.parse()?,
            "--method" => options.methods.push(match value()?.as_str() {
                "rays" => Method::Rays,
                "shafts" => Method::Shafts,
                "scanlines" => Method::Scanlines,
                "scanline-rays" => Method::ScanlineRays,
                other => return Err(format!("no method {other}").into()),
            }),
            "--on" => match value()?.as_str() {
                "cpu" => options.on_gpu = false,
                "gpu" => options.on_gpu = true,
                other => return Err(format!("--on {other}: cpu or gpu").into()),
            },
            "--adapter" => options.adapter = Some(value()?),
            "--export" => options.export = Some(value()?.into()),
            "--serve" => options.serve = true,
            "--rays" => options.rays = Some(value()?.into()),
            name if CASES.contains(&name) => options.case = name.into(),
            other => return Err(format!("{other} is none of {CASES:?} and no option").into()),
        }
    }
    if options.methods.is_empty() {
        options.methods.push(Method::Scanlines);
    }
    Ok(options)
}

fn case(options: &Options) -> Result<(Scene, Camera, AreaLight), Box<dyn Error>> {
    let camera = |eye: [f32; 3], target: [f32; 3]| {
        Camera::look_at(eye.into(), target.into(), 60f32.to_radians(), 0.05, 500.0)
    };
    let sun = |direction: [f32; 3], degrees: f32| AreaLight::Sun {
        direction_to_light: Vec3::from(direction).normalize(),
        angular_diameter_radians: degrees.to_radians(),
    };
    if options.case == "colonnade" {
        let scene = Scene::builtin("colonnade")?;
        let frame = scene.paths[0].frames[scene.paths[0].frames.len() / 2];
        return Ok((scene, frame.camera, frame.light));
    }
    if options.case == "thicket" {
        let (scene, light) = thicket(options.leaves, options.layers)?;
        return Ok((scene, camera([0.0, 1.0, 5.0], [0.0, 0.3, 0.0]), light));
    }
    let model = if options.case.starts_with("sponza") { "crytek_sponza.obj" } else { "atrium.obj" };
    let mut scene = Scene::load(Path::new(&options.models.join(model)))?;
    if options.case.starts_with("sponza") {
        return Ok((scene, camera([10.5, 1.8, -0.4], [-10.0, 3.5, -0.4]), sun([0.15, 0.95, 0.25], 2.0)));
    }
    if options.case.starts_with("atrium4") {
        split(&mut scene);
    }
    let centre = Vec3::new(-3.0, 7.6, 0.8);
    let (u, v) = (Vec3::X, Vec3::new(0.0, 0.6, 0.8));
    let rect = |half: f32| AreaLight::Rect { centre, half_u: u * half, half_v: v * half };
    let light = match options.case.rsplit_once('-').map_or("", |(_, kind)| kind) {
        "rect" => rect(0.3),
        "wide" => rect(3.0),
        "disk" => {
            let normal = Vec3::new(0.2, -1.0, 0.1).normalize();
            AreaLight::Disk { centre, normal, radius_world: 0.3 }
        }
        "sphere" => AreaLight::Sphere { centre, radius_world: 0.3 },
        _ => sun([0.25, 0.9, 0.35], if options.case.contains("real") { 0.53 } else { 2.0 }),
    };
    Ok((scene, camera([-9.5, 2.6, 1.6], [1.0, 2.3, -1.2]), light))
}

/// Triangles that have no edge in common, in a layer of 8 x 2 x 8 m over a floor; a lamp of 1 m half-size above. What
/// edges are worst at.
fn thicket(leaves: usize, layers: f32) -> Result<(Scene, AreaLight), Box<dyn Error>> {
    let mut state = 1u64;
    let mut unit = move || {
        // Constants of Knuth's MMIX.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 24) as f32
    };
    let mut positions = vec![];
    let floor = [[-10.0, -10.0], [-10.0, 10.0], [10.0, 10.0], [10.0, -10.0]];
    positions.extend(floor.map(|[x, z]| Vec3::new(x, 0.0, z)));
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    // A triangle at random in a cube has 0.08 of a side's area on average, of which one half is seen.
    let size = (layers * 64.0 / leaves as f32).sqrt();
    for _ in 0..leaves {
        let middle = Vec3::new(8.0 * unit() - 4.0, 2.0 + 2.0 * unit(), 8.0 * unit() - 4.0);
        let first = positions.len() as u32;
        for _ in 0..3 {
            positions.push(middle + (Vec3::new(unit(), unit(), unit()) - 0.5) * 2.0 * size);
        }
        triangles.push([first, first + 1, first + 2]);
    }
    let material = vec![0; triangles.len()];
    let mut scene = Scene::builtin("colonnade")?;
    scene.geometry = Geometry { positions, triangles, material, ..Geometry::default() };
    let light = AreaLight::Rect { centre: Vec3::Y * 6.0, half_u: Vec3::X, half_v: Vec3::Z };
    Ok((scene, light))
}

/// Four triangles in place of each.
fn split(scene: &mut Scene) {
    let geometry = &mut scene.geometry;
    let old = std::mem::take(&mut geometry.triangles);
    let material = std::mem::take(&mut geometry.material);
    for (triangle, material) in old.into_iter().zip(material) {
        let [a, b, c] = triangle;
        let first = geometry.positions.len() as u32;
        let middle = |p: u32, q: u32| (geometry.positions[p as usize] + geometry.positions[q as usize]) * 0.5;
        let middles = [middle(a, b), middle(b, c), middle(c, a)];
        geometry.positions.extend(middles);
        let [ab, bc, ca] = [first, first + 1, first + 2];
        geometry.triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        geometry.material.extend([material; 4]);
    }
}

fn export(
    path: &Path,
    scene: &Scene,
    points: &Points,
    light: &AreaLight,
    (camera, view, samples): (&Camera, &View, u32),
) -> Result<(), Box<dyn Error>> {
    let (kind, a, b, c) = match *light {
        AreaLight::Sun { direction_to_light, angular_diameter_radians } => {
            (0, direction_to_light, Vec3::X * angular_diameter_radians, Vec3::ZERO)
        }
        AreaLight::Disk { centre, normal, radius_world } => (1, centre, normal, Vec3::X * radius_world),
        AreaLight::Rect { centre, half_u, half_v } => (2, centre, half_u, half_v),
        AreaLight::Sphere { centre, radius_world } => (3, centre, Vec3::X * radius_world, Vec3::ZERO),
    };
    let mut out = BufWriter::new(std::fs::File::create(path)?);
    let count = scene.geometry.triangles.len() as u32;
    let rays = view.width * view.height;
    for word in [0x554d_4231, count, points.len() as u32, kind, samples, rays, 0, 0] {
        out.write_all(&word.to_le_bytes())?;
    }
    let mut put = |v: Vec3| v.to_array().iter().try_for_each(|c| out.write_all(&c.to_le_bytes()));
    for v in [a, b, c] {
        put(v)?;
    }
    for triangle in 0..count {
        scene.geometry.corners(triangle as usize).into_iter().try_for_each(&mut put)?;
    }
    for (&position, &normal) in points.position.iter().zip(&points.normal) {
        put(position)?;
        put(normal)?;
    }
    put(camera.eye())?;
    let world_from_clip = view.clip_from_world.inverse();
    for index in 0..rays {
        let x = ((index % view.width) as f32 + 0.5) / view.width as f32 * 2.0 - 1.0;
        let y = 1.0 - ((index / view.width) as f32 + 0.5) / view.height as f32 * 2.0;
        put((world_from_clip.project_point3(Vec3::new(x, y, 0.5)) - camera.eye()).normalize())?;
    }
    Ok(())
}

/// What each ray of a file hits, written beside it (`.answers`). The rays are f32 and not rounded on
/// the way, so that another program can be asked about the very same ones. The file: u32 kind, u32
/// count, then f32s. Kind 0, whether anything is hit (a byte a ray): origin, direction, and 1 if the
/// ray ends short of origin + direction, which must be an f32 itself, or 0 if it goes on. Kind 1, the
/// triangle that is hit first (u32 a ray, `u32::MAX` for none): the eye once, then directions whose
/// largest component is 1 or -1; the scene is moved so that the eye is at 0.
fn answer(path: &Path, mut scene: Scene) -> Result<(), Box<dyn Error>> {
    let bytes = std::fs::read(path)?;
    let (words, _) = bytes.as_chunks::<4>();
    let [kind, _count, rest @ ..] = words else { return Err("no header".into()) };
    let numbers: Vec<f32> = rest.iter().map(|&word| f32::from_le_bytes(word)).collect();
    let answers: Vec<u8> = if u32::from_le_bytes(*kind) == 0 {
        let tracer = Tracer::new(&scene)?;
        numbers.as_chunks::<7>().0.par_iter().map(|ray| u8::from(hidden(&tracer, ray))).collect()
    } else {
        let (eye, directions) = numbers.split_at(3);
        let eye = Vec3::from_slice(eye);
        scene.geometry.positions.iter_mut().for_each(|p| *p -= eye);
        let tracer = Tracer::new(&scene)?;
        let first = |d: &[f32; 3]| tracer.primary(&narrow(Vec3::from(*d))).triangle.pixels()[0];
        directions.as_chunks::<3>().0.par_iter().flat_map_iter(|d| first(d).to_le_bytes()).collect()
    };
    std::fs::write(path.with_extension("answers"), answers)?;
    Ok(())
}

/// Whether an any-hit ray from a point in mid-air hits something: a light without size has one place.
fn hidden(tracer: &Tracer, &[x, y, z, dx, dy, dz, ends]: &[f32; 7]) -> bool {
    let (origin, direction) = (Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
    let light = if ends == 0.0 {
        AreaLight::Sun { direction_to_light: direction, angular_diameter_radians: 0.0 }
    } else {
        AreaLight::Disk { centre: origin + direction, normal: Vec3::Y, radius_world: 0.0 }
    };
    let point = Points { position: vec![origin], normal: vec![Vec3::ZERO], triangle: vec![u32::MAX] };
    let settings = TruthSettings {
        samples: 1,
        replicates: 2,
        basis_samples: 0,
        method: Method::Rays,
        ..Default::default()
    };
    tracer.truth(&point, &light, &settings).mean[0] == 0.0
}

/// A picture of one pixel from 0 along a direction whose largest component is 1 or -1: a shear, which
/// is its own inverse, so that the direction stays what it is. No near or far plane.
fn narrow(direction: Vec3) -> View {
    let main = direction.abs().max_position();
    let (u, v) = ((main + 1) % 3, (main + 2) % 3);
    // Camera's x, y and z are the world's u, v and main axis; along -z it is `direction`.
    let mut camera_from_world = Mat4::ZERO;
    let sign = direction[main];
    camera_from_world.col_mut(u)[0] = 1.0;
    camera_from_world.col_mut(v)[1] = 1.0;
    let mut column = Vec4::new(-direction[u] * sign, -direction[v] * sign, -sign, 0.0);
    std::mem::swap(camera_from_world.col_mut(main), &mut column);
    camera_from_world.w_axis = Vec4::W;
    View { width: 1, height: 1, clip_from_world: Mat4::ZERO, camera_from_world, yfov_radians: 1.0 }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let started = Instant::now();
    let result = work();
    (result, started.elapsed().as_secs_f64())
}

fn view(camera: &Camera, [width, height]: [u32; 2]) -> View {
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera.camera_from_world(),
        camera_from_world: camera.camera_from_world(),
        yfov_radians: camera.yfov_radians,
    }
}
