//! Ground truth: what a shadow technique is compared with.
//!
//! A [`Tracer`] casts its own camera rays ([`Tracer::primary`]) and finds, at surface points, the
//! unoccluded fraction of an area light ([`Tracer::truth`]) in two ways that must agree: plain rays
//! through obvhs (the arbiter) and scanlines (fast). [`Cache`] keeps results on disk by content.
//!
//! In a test of your own: what a point between the columns of a standard scene sees of the sun.
//!
//! ```
//! use umbrage_frame::View;
//! use umbrage_reference::{Method, Tracer, TruthSettings};
//! use umbrage_scene::Scene;
//!
//! let scene = Scene::builtin("colonnade")?;
//! let frame = &scene.paths[0].frames[0];
//! let tracer = Tracer::new(&scene)?;
//! let camera_from_world = frame.camera.camera_from_world();
//! let view = View {
//!     width: 32,
//!     height: 18,
//!     clip_from_world: frame.camera.clip_from_camera(32.0 / 18.0) * camera_from_world,
//!     camera_from_world,
//!     yfov_radians: frame.camera.yfov_radians,
//! };
//! let points = tracer.primary(&view).points();
//! let settings = TruthSettings { samples: 128, ..TruthSettings::default() };
//! let truth = tracer.truth(&points, &frame.light, &settings);
//! // Some of the floor is lit, some in the umbra, some between; two halves, and their standard error.
//! assert!(truth.mean.contains(&1.0) && truth.mean.contains(&0.0));
//! let worst = truth.variance.iter().fold(0.0f32, |m, &v| m.max(v)).sqrt();
//! assert!(worst > 0.0 && worst < 0.05);
//! // The arbiter looks at the same samples ray by ray.
//! let rays = tracer.truth(&points, &frame.light, &TruthSettings { method: Method::ScanlineRays, ..settings });
//! let apart = truth.mean.iter().zip(&rays.mean).filter(|(a, b)| (*a - *b).abs() > 0.012).count();
//! assert_eq!(apart, 0, "more than 3 of 256 samples differ");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Deliberately absent: the real-time pipeline. This crate never sees `umbrage-shadows`, so that a
//! wrong matrix in either shows as disagreement. It prints nothing and reads neither the
//! environment nor the clock.

mod aim;
mod cache;
mod cutouts;
mod error;
mod finder;
mod gpu;
mod irradiance;
mod mates;
mod owen;
mod primary;
mod radiance;
mod rays;
mod receiver;
mod refine;
mod samples;
mod scanlines;
mod shafts;
mod surfaces;
mod tracer;
mod truth;
mod wide;

pub use cache::{Cache, Source, TruthKey};
pub use error::ReferenceError;
pub use finder::Finder;
pub use gpu::{GpuTracer, KernelSeconds, Share, TruthGpu};
pub use irradiance::Irradiance;
pub use primary::{Points, PrimaryHits};
pub use radiance::RadianceSettings;
pub use refine::Reached;
pub use tracer::Tracer;
pub use truth::{GroundTruth, MOST_ON_SCANLINES, Method, TruthSettings};
pub use umbrage_device::{AdapterChoice, AdapterDescription, DeviceError, adapters};
