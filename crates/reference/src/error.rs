//! What can go wrong, each told once.

use std::path::PathBuf;

/// Why there is no ground truth.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// Nothing to trace.
    #[error("the scene has no triangles")]
    NoTriangles,
    /// More than 2^31 triangles: node indices are 32 bits wide and a tree has two nodes for each.
    #[error("{0} triangles are more than a tree of 32-bit indices can hold")]
    TooManyTriangles(usize),
    /// A vertex is NaN or infinite.
    #[error("vertex {0} is not finite")]
    VertexNotFinite(usize),
    /// A triangle names a vertex that does not exist.
    #[error("triangle {0} names a vertex that does not exist")]
    NoSuchVertex(usize),
    /// A triangle names a material that does not exist, or has none.
    #[error("triangle {0} names a material that does not exist")]
    NoSuchMaterial(usize),
    /// The GPU that truth was asked of.
    #[error("truth on the GPU: {0}")]
    Device(#[from] umbrage_device::DeviceError),
    /// The kernels know no masks.
    #[error("the scene has cut-out materials, which truth on the GPU does not read")]
    MasksOnGpu,
    /// The cache folder or a file in it cannot be used.
    #[error("the cache of ground truth at {path} cannot be used: {source}")]
    Cache {
        /// The folder or file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}
