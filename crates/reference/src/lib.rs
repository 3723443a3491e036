//! Ground truth: what a shadow technique is compared with.
//!
//! A [`Tracer`] casts its own camera rays ([`Tracer::primary`]) and finds, at surface points, the
//! unoccluded fraction of an area light ([`Tracer::truth`]) in two ways that must agree: plain rays
//! through obvhs (the arbiter) and shafts (fast). [`Cache`] keeps results on disk by content.
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
