//! What was rendered: images, G-buffers, anchors and frames, and the EXR files that hold them.
//!
//! A leaf crate: the vocabulary that truth, pipeline and scores share. It knows no scene, no
//! renderer and no score.

mod anchors;
mod exr_file;
mod gbuffer;
mod image;
mod picture;
mod sequence;
mod view;

pub use anchors::{Agreement, AgreementLimits, Anchors};
pub use exr_file::{ExrError, Layer, read_exr, write_exr};
pub use gbuffer::{Frame, Gbuffer, Sequence};
pub use image::{Image, ShadowMask};
pub use picture::{Picture, Transfer};
pub use sequence::{NumberedFiles, SequenceError};
pub use view::View;
