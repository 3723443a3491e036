//! A scene on a graphics adapter: masks for frames, values for anchors, intermediate targets.

use crate::layout::Anchor;
use crate::triangles::Triangles;
use crate::{Bias, Gpu, Info, Inputs, Kernels, LightMap, Recording, Seeding, ShadowError, Timing, VariantId};
use crate::{Projection, Receivers, VARIANTS, own, stages};
use glam::Vec3;
use umbrage_frame::{Anchors, Gbuffer, Image, View};
use umbrage_scene::{AreaLight, Scene};

/// Renders one scene.
pub struct Renderer<'a> {
    gpu: &'a mut Gpu,
    scene: &'a Scene,
    map_texels: u32,
    geometry_key: u64,
    has_cutouts: bool,
    light_maps: Vec<(AreaLight, Projection, LightMap)>,
    bias: Option<Bias>,
    past: Vec<View>,
}

/// A variant's answer at each receiver.
#[derive(Clone, Debug)]
pub struct Shaded {
    /// The unoccluded fraction of the light per pixel (row order) or anchor.
    pub values: Vec<f32>,
    /// GPU time of each pass that ran; empty without timestamp queries.
    pub timings: Vec<Timing>,
}

/// An intermediate target.
#[derive(Clone, Debug)]
pub struct Dump {
    /// `shadow-map`, `penumbra-mask`, ...
    pub label: &'static str,
    /// Level of a texture that has several; 0 is the finest.
    pub level: u32,
    /// One image a channel.
    pub channels: Vec<Image<f32>>,
}

/// What is rendered: a variant, from where, under which light, with which pattern.
struct Job<'a> {
    variant: VariantId,
    view: &'a View,
    receivers: Receivers,
    seeding: Seeding,
    pattern: [u32; 2],
}

impl<'a> Renderer<'a> {
    /// Uploads the scene.
    ///
    /// # Errors
    /// A shadow map or scene that is too large for the adapter.
    pub fn new(gpu: &'a mut Gpu, scene: &'a Scene, map_texels: u32) -> Result<Self, ShadowError> {
        let limit = gpu.largest_texture();
        if map_texels == 0 || map_texels > limit {
            return Err(ShadowError::TooLarge {
                what: "a shadow map",
                wanted: map_texels.into(),
                limit: limit.into(),
            });
        }
        let triangles = Triangles::of(scene);
        let geometry_key = gpu.upload_scene(&triangles)?;
        Ok(Self {
            gpu,
            scene,
            map_texels,
            geometry_key,
            has_cutouts: !triangles.cut.is_empty(),
            light_maps: Vec::new(),
            bias: None,
            past: Vec::new(),
        })
    }

    /// Replaces the calibrations' own bias, for curves over it.
    pub fn set_bias(&mut self, bias: Bias) {
        self.bias = Some(bias);
    }

    /// Where the camera was in the frames before the next one, newest first: for techniques with a
    /// history. Without any, it stood still.
    pub fn set_past(&mut self, views: Vec<View>) {
        self.past = views;
    }

    /// Lets go of kept maps, so that the next frame renders (and times) them again.
    pub fn forget(&mut self) {
        self.gpu.forget();
    }

    /// The projection of the light's single map.
    pub fn light_map(&mut self, light: &AreaLight) -> LightMap {
        self.light_map_of(light, Projection::Single)
    }

    fn light_map_of(&mut self, light: &AreaLight, projection: Projection) -> LightMap {
        let known = self.light_maps.iter().find(|(of, laid, _)| of == light && *laid == projection);
        if let Some((.., map)) = known {
            return *map;
        }
        // A light that moves would fill the list.
        self.light_maps.retain(|(of, ..)| of == light);
        let map = LightMap::with(self.scene, light, (self.map_texels, projection));
        self.light_maps.push((*light, projection, map));
        map
    }

    /// Sets the surface points that `shade_anchors` shades.
    ///
    /// # Errors
    /// More than the adapter's buffers hold.
    pub fn set_anchors(&mut self, anchors: &Anchors) -> Result<(), ShadowError> {
        let anchor = |(p, n): (&Vec3, &Vec3)| Anchor {
            position: p.extend(1.0).to_array(),
            normal: n.extend(0.0).to_array(),
        };
        let all: Vec<Anchor> = anchors.position.iter().zip(&anchors.normal).map(anchor).collect();
        self.gpu.upload_anchors(&all)
    }

    /// A variant over the pixels of a view, as a game would show it.
    ///
    /// # Errors
    /// Too large a picture, or a driver that fails.
    pub fn shade_frame(
        &mut self,
        variant: VariantId,
        (view, light): (&View, &AreaLight),
        (seeding, pattern): (Seeding, [u32; 2]),
    ) -> Result<Shaded, ShadowError> {
        let job = Job { variant, view, receivers: Receivers::Frame, seeding, pattern };
        let recording = self.record(&job, light)?;
        own::judged(variant, self.gpu.run(&recording))
    }

    /// GPU times of a variant's frame, without its values; empty without timestamp queries.
    ///
    /// # Errors
    /// As for frames.
    pub fn time_frame(
        &mut self,
        variant: VariantId,
        (view, light): (&View, &AreaLight),
        (seeding, pattern): (Seeding, [u32; 2]),
    ) -> Result<Vec<Timing>, ShadowError> {
        let recording = self.recording(variant, (view, light), (seeding, pattern))?;
        self.gpu.time(&recording)
    }

    /// A variant at the anchors set before: its last pass is dispatched over them, all passes
    /// before it over the frame. `pattern` is frame and seed.
    ///
    /// # Errors
    /// As for frames.
    pub fn shade_anchors(
        &mut self,
        variant: VariantId,
        (view, light): (&View, &AreaLight),
        (seeding, pattern): (Seeding, [u32; 2]),
    ) -> Result<Shaded, ShadowError> {
        let receivers = Receivers::Anchors { count: self.gpu.anchors() };
        let recording = self.record(&Job { variant, view, receivers, seeding, pattern }, light)?;
        own::judged(variant, self.gpu.run(&recording))
    }

    /// A variant's passes over the pixels of a view, as data: what a result depends on.
    ///
    /// # Errors
    /// Too large a picture.
    pub fn recording(
        &mut self,
        variant: VariantId,
        (view, light): (&View, &AreaLight),
        (seeding, pattern): (Seeding, [u32; 2]),
    ) -> Result<Recording, ShadowError> {
        let job = Job { variant, view, receivers: Receivers::Frame, seeding, pattern };
        self.record(&job, light)
    }

    /// Every intermediate target of a variant's frame, after `shade_frame`'s passes.
    ///
    /// # Errors
    /// As for frames.
    pub fn dump(
        &mut self,
        variant: VariantId,
        (view, light): (&View, &AreaLight),
        (seeding, pattern): (Seeding, [u32; 2]),
    ) -> Result<(Shaded, Vec<Dump>), ShadowError> {
        let job = Job { variant, view, receivers: Receivers::Frame, seeding, pattern };
        let recording = self.record(&job, light)?;
        let shaded = own::judged(variant, self.gpu.run(&recording))?;
        let dumps = self.gpu.read_textures(&recording)?;
        Ok((shaded, dumps))
    }

    /// What the raster pipeline sees: the witness that truth's own rays are compared with.
    ///
    /// # Errors
    /// As for frames.
    pub fn gbuffer(&mut self, view: &View, light: &AreaLight) -> Result<Gbuffer, ShadowError> {
        self.check_size(view)?;
        let map = self.light_map(light);
        let inputs = Inputs {
            view,
            light: &map,
            calibration: crate::Calibration::LightMatched,
            bias: crate::Calibration::LightMatched.default_bias(),
            receivers: Receivers::Frame,
            seeding: Seeding::Frozen,
            geometry_key: self.geometry_key,
            has_cutouts: self.has_cutouts,
            past: &[],
            age: 0,
        };
        let mut recording = Recording::new(inputs.globals(0, 0));
        stages::depth_prepass(&mut recording, &inputs);
        self.gpu.run(&recording)?;
        let dumps = self.gpu.read_textures(&recording)?;
        Ok(gbuffer_from(view, &dumps))
    }

    /// The passes of a variant, as data.
    ///
    /// # Errors
    /// Too large a picture.
    fn record(&mut self, job: &Job<'_>, light: &AreaLight) -> Result<Recording, ShadowError> {
        self.check_size(job.view)?;
        job.variant.check_light(light)?;
        let technique = job.variant.variant.technique;
        let map = self.light_map_of(light, technique.projection());
        self.check_map(&map)?;
        let inputs = Inputs {
            view: job.view,
            light: &map,
            calibration: job.variant.calibration,
            bias: self.bias.unwrap_or(job.variant.calibration.default_bias()),
            receivers: job.receivers,
            seeding: job.seeding,
            geometry_key: self.geometry_key,
            has_cutouts: self.has_cutouts,
            past: &self.past,
            age: 0,
        };
        Ok(inputs.recorded(job.variant, job.pattern))
    }

    /// A cube's faces lie in one texture, wider than a single map.
    fn check_map(&self, map: &LightMap) -> Result<(), ShadowError> {
        let (limit, [width, _]) = (self.gpu.largest_texture(), map.size());
        if width > limit {
            return Err(ShadowError::TooLarge {
                what: "a cube map",
                wanted: width.into(),
                limit: limit.into(),
            });
        }
        Ok(())
    }

    fn check_size(&self, view: &View) -> Result<(), ShadowError> {
        let limit = self.gpu.largest_texture();
        let wanted = view.width.max(view.height);
        if wanted > limit || view.width == 0 || view.height == 0 {
            return Err(ShadowError::TooLarge {
                what: "a picture",
                wanted: wanted.into(),
                limit: limit.into(),
            });
        }
        Ok(())
    }
}

impl VariantId {
    /// The technique's description.
    pub fn info(&self) -> Info {
        self.variant.technique.info()
    }

    /// Whether the technique can do a light.
    ///
    /// # Errors
    /// `WrongLight`, with the names of those that can.
    pub fn check_light(&self, light: &AreaLight) -> Result<(), ShadowError> {
        let lights = self.variant.technique.lights();
        if lights.contain(light) {
            return Ok(());
        }
        let able = VARIANTS.iter().filter(|v| v.technique.lights().contain(light)).map(|v| v.name);
        Err(ShadowError::WrongLight {
            variant: self.name(),
            light: if light.centre().is_some() { "a light that has a place" } else { "a sun" },
            wants: lights.describe(),
            able: able.collect::<Vec<_>>().join(", "),
        })
    }

    /// Passes of one frame, in order (those of a static light's map first), without those that
    /// belong to the frames before it.
    pub fn passes(&self, scene: &Scene) -> Vec<&'static str> {
        let view = View {
            width: 64,
            height: 64,
            clip_from_world: glam::Mat4::IDENTITY,
            camera_from_world: glam::Mat4::IDENTITY,
            yfov_radians: 1.0,
        };
        let technique = self.variant.technique;
        let map = LightMap::with(scene, &scene.lights[0], (2048, technique.projection()));
        let inputs = Inputs {
            view: &view,
            light: &map,
            calibration: self.calibration,
            bias: self.calibration.default_bias(),
            receivers: Receivers::Frame,
            seeding: Seeding::Fresh,
            geometry_key: 0,
            has_cutouts: scene.has_masks(),
            past: &[],
            age: 0,
        };
        let recording = inputs.recorded(*self, [0, 0]);
        recording.passes.iter().filter(|p| !p.is_earlier()).map(|p| p.label()).collect()
    }

    /// The three kinds of bias, in words.
    pub fn bias(&self) -> String {
        self.calibration.default_bias().describe()
    }

    /// Search radius, kernel, its cap and the radius convention, in words.
    pub fn kernels(&self) -> Kernels {
        self.variant.technique.kernels(self.calibration)
    }
}

/// Linear depth and normals as the frame crate has them.
fn gbuffer_from(view: &View, dumps: &[Dump]) -> Gbuffer {
    let channels =
        |label| dumps.iter().find(|d| d.label == label).map(|d| d.channels.as_slice()).unwrap_or_default();
    let (depths, normals) = (channels("camera-depth"), channels("camera-normal"));
    let depth = depths[0].map(|&d| if d > 0.0 { d } else { f32::INFINITY });
    let world_from_camera = view.camera_from_world.inverse();
    let tan = (0.5 * view.yfov_radians).tan();
    let aspect = view.width as f32 / view.height as f32;
    let position = Image::from_fn(view.width, view.height, |x, y| {
        let d = *depth.at(x, y);
        let ndc_x = (x as f32 + 0.5) / view.width as f32 * 2.0 - 1.0;
        let ndc_y = 1.0 - (y as f32 + 0.5) / view.height as f32 * 2.0;
        let camera = Vec3::new(ndc_x * tan * aspect, ndc_y * tan, -1.0) * d;
        if d.is_finite() { world_from_camera.transform_point3(camera) } else { Vec3::ZERO }
    });
    let normal = Image::from_fn(view.width, view.height, |x, y| {
        let n = Vec3::new(*normals[0].at(x, y), *normals[1].at(x, y), *normals[2].at(x, y));
        n.normalize_or_zero()
    });
    Gbuffer { view: *view, depth, position, normal }
}
