//! Everything that can be wrong with a scene, said so that its author can mend it.

use std::path::PathBuf;

/// Why a scene could not be read. Each message names the file and, where known, the place in it.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// A file is missing or cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Not a scene folder, a `scene.toml`, or a model.
    #[error("{} is neither a folder with a scene.toml, a .toml file, nor a .obj, .gltf or .glb model", path.display())]
    NotAScene {
        /// Which file.
        path: PathBuf,
    },
    /// Text that does not parse, or an unknown field.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Syntax {
        /// Which file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// What is wrong, in the parser's words.
        message: String,
    },
    /// A value that parses but makes no sense.
    #[error("{}: {message}", path.display())]
    Value {
        /// Which file.
        path: PathBuf,
        /// What is wrong, and what would be right.
        message: String,
    },
    /// An OBJ file that does not parse.
    #[error("{}:{line}: {message} (the OBJ file is truncated or damaged there, or in the object before)", path.display())]
    Obj {
        /// Which file.
        path: PathBuf,
        /// The last line read, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A glTF file that does not parse, or whose parts do not fit together.
    #[error("{}: {message}", path.display())]
    Gltf {
        /// Which file.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// A vertex that is NaN or infinite.
    #[error("{}: vertex {vertex} of object '{object}' is not finite ({position})", path.display())]
    VertexNotFinite {
        /// Which file.
        path: PathBuf,
        /// In which object.
        object: String,
        /// From 0, within the object.
        vertex: usize,
        /// As read.
        position: glam::DVec3,
    },
    /// A triangle that uses a vertex that does not exist.
    #[error(
        "{}: triangle {triangle} of object '{object}' uses vertex {vertex}, but there are only {vertices}",
        path.display()
    )]
    IndexOutOfRange {
        /// Which file.
        path: PathBuf,
        /// In which object.
        object: String,
        /// From 0, within the object.
        triangle: usize,
        /// The index.
        vertex: u32,
        /// How many vertices the object has.
        vertices: usize,
    },
    /// Nothing to see.
    #[error("{}: no triangle with an area", path.display())]
    NoTriangles {
        /// Which file.
        path: PathBuf,
    },
    /// A name that nothing has.
    #[error("there is no {kind} called '{name}'{}", did_you_mean(suggestion))]
    UnknownName {
        /// "scene", "object", "camera".
        kind: &'static str,
        /// As asked for.
        name: String,
        /// The nearest that exists.
        suggestion: Option<String>,
    },
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!("; did you mean '{name}'?")).unwrap_or_default()
}

impl SceneError {
    pub(crate) fn value(path: &std::path::Path, message: impl Into<String>) -> Self {
        Self::Value { path: path.to_owned(), message: message.into() }
    }

    pub(crate) fn unknown<'a>(
        kind: &'static str,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let suggestion = crate::suggest(name, candidates).map(str::to_owned);
        Self::UnknownName { kind, name: name.to_owned(), suggestion }
    }
}
