//! Materials: reflectance, cut-outs and colours. Pictures come from buffers, data URIs and files.

use super::accessor::{Buffers, read_uri};
use crate::Material;
use crate::picture::{Opacity, Picture};
use crate::texture::{AlphaMask, Wrap};
use glam::{DVec2, Vec3};
use gltf::Document;
use gltf::material::AlphaMode;
use gltf::texture::{Info, WrappingMode};
use std::collections::HashMap;
use std::path::Path;

/// All of the file's, the default one (white) last, and what a reader should know of them.
pub(super) struct Materials {
    pub(super) all: Vec<Material>,
    /// How each one's pictures are laid on.
    pub(super) layouts: Vec<Option<Layout>>,
    pub(super) notes: Vec<String>,
}

/// Which of a mesh's sets of texture coordinates a material uses, and how (KHR_texture_transform).
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) set: u32,
    offset: DVec2,
    scale: DVec2,
    rotation_radians: f64,
}

/// Pictures that were decoded so far: materials share them.
struct Pictures<'a> {
    document: &'a Document,
    buffers: &'a Buffers,
    folder: &'a Path,
    decoded: HashMap<usize, Result<Picture, String>>,
}

/// What glTF takes alpha to be where it does not say.
const CUTOFF: f32 = 0.5;

impl Materials {
    pub(super) fn read(document: &Document, buffers: &Buffers, folder: &Path) -> Result<Self, String> {
        let mut pictures = Pictures { document, buffers, folder, decoded: HashMap::new() };
        let mut read = Self { all: Vec::new(), layouts: Vec::new(), notes: Vec::new() };
        for material in document.materials() {
            let layout = material.pbr_metallic_roughness().base_color_texture().map(|info| Layout::of(&info));
            let material = read.material(&material, &mut pictures)?;
            read.all.push(material);
            read.layouts.push(layout);
        }
        read.all.push(Material::plain("default", Vec3::ONE));
        read.layouts.push(None);
        Ok(read)
    }

    /// Without its picture a cut-out material would shadow what it should not: that is an error.
    /// Colours are for shaded pictures alone: a note.
    fn material(&mut self, material: &gltf::Material, pictures: &mut Pictures) -> Result<Material, String> {
        let colour = material.pbr_metallic_roughness();
        let [r, g, b, alpha] = colour.base_color_factor();
        let unnamed = || format!("material {}", material.index().unwrap_or_default());
        let name = material.name().map_or_else(unnamed, str::to_owned);
        let mut made = Material::plain(name.clone(), Vec3::new(r, g, b));
        let cutoff = material.alpha_cutoff().unwrap_or(CUTOFF);
        let is_cut_out = material.alpha_mode() == AlphaMode::Mask;
        if let Some(info) = colour.base_color_texture() {
            let wrap = [info.texture().sampler().wrap_s(), info.texture().sampler().wrap_t()].map(wrap_of);
            match pictures.get(info.texture().source().index()) {
                Ok(picture) => {
                    made.texture = Some(picture.texture(wrap));
                    made.mask =
                        is_cut_out.then(|| picture.mask(wrap, Opacity::Alpha { factor: alpha, cutoff }));
                }
                Err(message) if is_cut_out => {
                    return Err(format!(
                        "material '{name}' is cut out by its texture: {message}; put the file there, or set the \
                         material's alphaMode to OPAQUE"
                    ));
                }
                Err(message) => {
                    self.notes.push(format!("material '{name}' is shown without its texture: {message}"));
                }
            }
        } else if is_cut_out {
            made.mask = Some(AlphaMask::new([1, 1], [Wrap::Clamp; 2], |_, _| alpha >= cutoff));
        }
        // Nothing to ask for: the fast way of whole surfaces.
        made.mask = made.mask.filter(|mask| !mask.is_whole());
        Ok(made)
    }
}

impl Pictures<'_> {
    fn get(&mut self, index: usize) -> Result<&Picture, String> {
        if !self.decoded.contains_key(&index) {
            let picture = self.read(index);
            self.decoded.insert(index, picture);
        }
        self.decoded[&index].as_ref().map_err(Clone::clone)
    }

    fn read(&self, index: usize) -> Result<Picture, String> {
        let image = &self.document.as_json().images[index];
        if let Some(uri) = &image.uri {
            let shown = if uri.starts_with("data:") { format!("image {index}") } else { uri.clone() };
            return Picture::decode(&read_uri(uri, self.folder)?)
                .map_err(|error| format!("{shown}: {error}"));
        }
        let view = image.buffer_view.and_then(|view| self.document.views().nth(view.value()));
        let bytes = view.and_then(|view| self.buffers.view(&view));
        let bytes = bytes.ok_or_else(|| format!("image {index} reaches beyond its buffer"))?;
        Picture::decode(bytes).map_err(|error| format!("image {index}: {error}"))
    }
}

impl Layout {
    fn of(info: &Info) -> Self {
        let plain =
            Self { set: info.tex_coord(), offset: DVec2::ZERO, scale: DVec2::ONE, rotation_radians: 0.0 };
        info.texture_transform().map_or(plain, |transform| Self {
            set: transform.tex_coord().unwrap_or(plain.set),
            offset: glam::Vec2::from(transform.offset()).as_dvec2(),
            scale: glam::Vec2::from(transform.scale()).as_dvec2(),
            rotation_radians: transform.rotation().into(),
        })
    }

    /// Where a place stands in the picture: scaled, turned counter-clockwise on the picture, moved.
    pub(super) fn place(&self, uv: DVec2) -> DVec2 {
        let (sin, cos) = self.rotation_radians.sin_cos();
        let scaled = uv * self.scale;
        self.offset + DVec2::new(cos * scaled.x + sin * scaled.y, cos * scaled.y - sin * scaled.x)
    }
}

fn wrap_of(mode: WrappingMode) -> Wrap {
    match mode {
        WrappingMode::Repeat => Wrap::Repeat,
        WrappingMode::ClampToEdge => Wrap::Clamp,
        WrappingMode::MirroredRepeat => Wrap::Mirror,
    }
}
