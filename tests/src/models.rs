//! Small models and scene files, written by hand as a user would.

use std::fmt::Write as _;
use std::path::Path;

/// Corners and four-sided faces, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// In metres, y up.
    pub positions: Vec<[f32; 3]>,
    /// Indices into `positions`.
    pub quads: Vec<[u32; 4]>,
}

impl Mesh {
    /// A plate at 1 m, a tall box and a low one over a floor of 12 x 12 m.
    pub fn boxes_on_a_floor() -> Self {
        let mut mesh = Self::default();
        mesh.quad([[-6.0, 0.0, -6.0], [-6.0, 0.0, 6.0], [6.0, 0.0, 6.0], [6.0, 0.0, -6.0]]);
        mesh.cuboid([-1.0, 1.0, -0.8], [0.6, 1.1, 0.8]);
        mesh.cuboid([1.2, 0.0, -1.0], [1.6, 1.6, -0.6]);
        mesh.cuboid([-2.4, 0.0, 0.2], [-1.8, 0.5, 1.0]);
        mesh
    }

    /// Adds a face.
    pub fn quad(&mut self, corners: [[f32; 3]; 4]) {
        let first = self.positions.len() as u32;
        self.positions.extend(corners);
        self.quads.push([0, 1, 2, 3].map(|k| first + k));
    }

    /// Adds a box between two corners.
    pub fn cuboid(&mut self, low: [f32; 3], high: [f32; 3]) {
        let first = self.positions.len() as u32;
        // Corner k takes the high x, y or z where bit 0, 1 or 2 is set.
        let pick = |k: usize, axis: usize| if k >> axis & 1 == 1 { high[axis] } else { low[axis] };
        self.positions.extend((0..8).map(|k| [pick(k, 0), pick(k, 1), pick(k, 2)]));
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        self.quads.extend(faces.map(|face: [u32; 4]| face.map(|k| first + k)));
    }

    /// As a Wavefront OBJ.
    pub fn to_obj(&self) -> String {
        let mut text = String::from("# by hand\no boxes\n");
        for [x, y, z] in &self.positions {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for quad in &self.quads {
            let [a, b, c, d] = quad.map(|k| k + 1);
            let _ = writeln!(text, "f {a} {b} {c} {d}");
        }
        text
    }

    /// As `<name>.gltf` with its `<name>.bin`.
    ///
    /// # Panics
    /// When a file cannot be written.
    pub fn write_gltf(&self, folder: &Path, name: &str) {
        let positions: Vec<u8> = self.positions.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let triangles = self.quads.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]);
        let indices: Vec<u8> = triangles.flat_map(u32::to_le_bytes).collect();
        let axis = |k: usize| self.positions.iter().map(move |p| p[k]);
        let low = [0, 1, 2].map(|k| axis(k).fold(f32::INFINITY, f32::min));
        let high = [0, 1, 2].map(|k| axis(k).fold(f32::NEG_INFINITY, f32::max));
        let (split, end) = (positions.len(), indices.len());
        let file = serde_json::json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "name": "boxes", "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "count": self.positions.len(), "type": "VEC3",
                  "min": low, "max": high },
                { "bufferView": 1, "componentType": 5125, "count": 6 * self.quads.len(), "type": "SCALAR" },
            ],
            "bufferViews": [
                { "buffer": 0, "byteOffset": 0, "byteLength": split },
                { "buffer": 0, "byteOffset": split, "byteLength": end },
            ],
            "buffers": [{ "uri": format!("{name}.bin"), "byteLength": split + end }],
        });
        std::fs::write(folder.join(format!("{name}.gltf")), file.to_string()).expect("written");
        std::fs::write(folder.join(format!("{name}.bin")), [positions, indices].concat()).expect("written");
    }
}

/// A `scene.toml` about `model.obj` with one light (the fields of its table) and one path P1 (the
/// fields of its motion).
pub fn scene_toml(light: &str, motion: &str) -> String {
    format!(
        "title = \"by hand\"\n\n[geometry]\nfiles = [\"model.obj\"]\n\n[shadow_region]\n\
         centre = [0.0, 0.5, 0.0]\nwidth_world = 10.0\nreference_gap_world = 1.0\n\n\
         [[light]]\n{light}\n\n[[path]]\nname = \"P1\"\nmotion = {{ {motion} }}\n"
    )
}
