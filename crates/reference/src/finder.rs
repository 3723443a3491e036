//! Truth from wherever it was asked for.

use crate::{
    GpuTracer, GroundTruth, Method, Points, ReferenceError, Tracer, TruthGpu, TruthKey, TruthSettings,
};
use umbrage_scene::AreaLight;

/// Who finds the truth of a scene.
pub enum Finder<'a> {
    /// All cores.
    Cpu(&'a Tracer),
    /// A GPU, with the CPU for what it marks.
    Gpu(Box<GpuTracer<'a>>),
}

impl<'a> Finder<'a> {
    /// On the GPU if there is one here, and nothing is cut out: kernels know no masks.
    ///
    /// # Errors
    /// A scene that does not fit into the device, or what its driver refuses.
    pub fn new(tracer: &'a Tracer, gpu: Option<&'a TruthGpu>) -> Result<Self, ReferenceError> {
        Ok(match gpu {
            Some(gpu) if !tracer.has_masks() => Self::Gpu(Box::new(GpuTracer::new(tracer, gpu)?)),
            _ => Self::Cpu(tracer),
        })
    }

    /// The scene.
    pub fn tracer(&self) -> &'a Tracer {
        match self {
            Self::Cpu(tracer) => tracer,
            Self::Gpu(gpu) => gpu.tracer(),
        }
    }

    /// The truth at points: [`Tracer::truth`] or [`GpuTracer::truth`].
    ///
    /// # Errors
    /// What the GPU's driver refuses or does not finish.
    ///
    /// # Panics
    /// When the lists of `points` differ in length: a programming error, never a user's.
    pub fn truth(
        &mut self,
        points: &Points,
        light: &AreaLight,
        settings: &TruthSettings,
    ) -> Result<GroundTruth, ReferenceError> {
        match self {
            Self::Cpu(tracer) => Ok(tracer.truth(points, light, settings)),
            Self::Gpu(gpu) => gpu.truth(points, light, settings),
        }
    }

    /// The key of a truth that is found here: on a silhouette a GPU may decide otherwise than the CPU,
    /// and than another GPU.
    pub fn truth_key(&self, points: &Points, light: &AreaLight, settings: &TruthSettings) -> TruthKey {
        let key = self.tracer().truth_key(points, light, settings);
        match self {
            Self::Gpu(gpu) if settings.method == Method::Scanlines => key.on(gpu.adapter()),
            _ => key,
        }
    }
}
