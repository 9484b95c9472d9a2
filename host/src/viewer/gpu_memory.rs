//! What the viewer keeps in a GPU's memory.

use super::depth_paces::DepthPaces;
use super::passes::rays;
use crate::backend::BackendError;
use crate::backend::gpu::{Gpu, GpuPicture, GpuScene};
use crate::scene::Scene;
use oktant_shared::frame::Frame;
use std::sync::{Arc, Weak};
use std::time::Duration;

/// A pass on the GPU takes no longer, if it has more than one sample, so that it can be given up.
const GPU_PASS: Duration = Duration::from_millis(25);
/// Pictures in the GPU's memory that are kept to be written again.
const SPARE_PICTURES: usize = 3;

/// A scene, and pictures to be written again.
#[derive(Default)]
pub struct GpuMemory {
    uploaded: Option<Uploaded>,
    spare: Vec<Arc<GpuPicture>>,
}

/// A scene in a GPU's memory, which one it is, and how fast it is rendered.
struct Uploaded {
    gpu: Weak<Gpu>,
    scene: Weak<Scene>,
    there: GpuScene,
    paces: DepthPaces,
}

impl GpuMemory {
    /// Frees all that nobody else keeps.
    pub fn clear(&mut self) {
        self.uploaded = None;
        self.spare.clear();
    }

    /// Whether all samples of a frame can be taken in one pass.
    pub fn is_quick(&mut self, gpu: &Arc<Gpu>, scene: &Arc<Scene>, frame: &Frame) -> Result<bool, BackendError> {
        Ok(self.upload(gpu, scene)?.paces.time(frame.depth, rays(frame)) <= GPU_PASS)
    }

    /// The samples of a pixel that a pass of a frame that is sampled adaptively may have: those of a third of the pixels are
    /// to be as quick as [`GpuMemory::is_quick`] asks, and software takes one at a time, see [`Gpu::most_at_once`].
    pub fn samples_of_a_pass(
        &mut self,
        gpu: &Arc<Gpu>,
        scene: &Arc<Scene>,
        frame: &Frame,
    ) -> Result<u32, BackendError> {
        let single = self.upload(gpu, scene)?.paces.time(frame.depth, rays(frame) / 3);
        let quick = GPU_PASS.as_secs_f64() / single.as_secs_f64().max(1e-9);
        let most = gpu.most_at_once(frame.most_samples);
        Ok((quick as u32).clamp(1, most.max(1)))
    }

    /// Adds a pass to a picture; returns its milliseconds.
    pub fn render_pass(
        &mut self,
        gpu: &Arc<Gpu>,
        scene: &Arc<Scene>,
        picture: &GpuPicture,
        pass: &Frame,
    ) -> Result<f64, BackendError> {
        let uploaded = self.upload(gpu, scene)?;
        let milliseconds = gpu.render_pass_timed(&uploaded.there, picture, pass)?;
        if pass.is_listed == 0 {
            uploaded.paces.measured(pass.depth, rays(pass), milliseconds);
        }
        Ok(milliseconds)
    }

    /// The scene in the GPU's memory.
    fn upload(&mut self, gpu: &Arc<Gpu>, scene: &Arc<Scene>) -> Result<&mut Uploaded, BackendError> {
        let there = self
            .uploaded
            .take()
            .filter(|uploaded| std::ptr::eq(uploaded.gpu.as_ptr(), Arc::as_ptr(gpu)) && uploaded.there.shares(scene));
        // An old one is gone by now: both may not fit.
        let uploaded = match there {
            Some(uploaded) if std::ptr::eq(uploaded.scene.as_ptr(), Arc::as_ptr(scene)) => uploaded,
            there => Uploaded {
                gpu: Arc::downgrade(gpu),
                scene: Arc::downgrade(scene),
                there: match there {
                    Some(uploaded) => gpu.restage(scene, uploaded.there)?,
                    None => gpu.upload(scene)?,
                },
                paces: DepthPaces::guessed(scene.is_plain()),
            },
        };
        Ok(self.uploaded.insert(uploaded))
    }

    /// A picture in the GPU's memory that nobody looks at.
    pub fn spare_picture(
        &mut self,
        gpu: &Arc<Gpu>,
        size: [u32; 2],
        is_adaptive: bool,
    ) -> Result<Arc<GpuPicture>, BackendError> {
        let free = |picture: &&Arc<GpuPicture>| {
            Arc::strong_count(picture) == 1
                && [picture.width, picture.height] == size
                && picture.is_adaptive() == is_adaptive
        };
        if let Some(picture) = self.spare.iter().find(free) {
            gpu.forget(picture);
            return Ok(picture.clone());
        }
        let picture = Arc::new(gpu.picture(size[0], size[1], is_adaptive)?);
        if self.spare.len() >= SPARE_PICTURES {
            self.spare.remove(0);
        }
        self.spare.push(picture.clone());
        Ok(picture)
    }
}
