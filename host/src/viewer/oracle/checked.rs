//! What the back end made, pixel by pixel, and what the oracle makes of it.

use super::Subject;
use super::findings::{Disagreement, Findings};
use crate::backend::cpu::Cpu;
use crate::backend::gpu::GpuBackend;
use crate::backend::{Backend, BackendError, Query};
use crate::oracle::whitted::{FirstHit, Reference, Sitting, Takes};
use crate::picture::Picture;
use crate::scene::Scene;
use crate::seen::{middles, surface_of};
use crate::slots::Slots;
use crate::tone::Tone;
use crate::viewer::notice::Image;
use crate::viewer::task::Engine;
use glam::{Vec3, Vec4, uvec2};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use oktant_shared::trace::nearest_plane;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How far depths may differ, in parts of them.
const DEPTH: f32 = 1e-5;
/// How far channels may differ, of 255.
const STEP: u8 = 1;
/// Rows are compared in this order in each eight, so that all of the picture is soon seen coarsely.
const ORDER: [usize; 8] = [0, 4, 2, 6, 1, 5, 3, 7];
/// What is found is told no more often than this.
const INTERVAL: Duration = Duration::from_millis(250);

/// A picture of a back end, ready to be compared.
pub struct Checked<'a> {
    sitting: Sitting<'a>,
    size: [u32; 2],
    tone: Tone,
    /// As [`Picture::sums`].
    sums: Vec<Vec4>,
    /// What is seen first through the middle of each pixel.
    hits: Vec<Hit>,
    /// Whether the first light reaches that.
    lit: Vec<bool>,
}

impl<'a> Checked<'a> {
    /// Asks the back end what it saw.
    pub fn new(subject: &Subject, reference: &'a Reference) -> Result<Self, String> {
        let Subject { scene, view, size, .. } = subject;
        let frame = middles(&view.frame(scene, size[0], size[1]));
        let shown = subject.image.size();
        if shown != <[u32; 2]>::from(frame.size()) {
            return Err(format!(
                "The picture that is shown is {} x {} pixels and not the window's {} x {}; change the view to have it rendered again.",
                shown[0], shown[1], size[0], size[1]
            ));
        }
        let (sums, hits, lit) = asked(subject, &frame).map_err(|error| error.to_string())?;
        Ok(Checked {
            sitting: reference.sitting(view, *size, Takes::View),
            size: frame.size().into(),
            tone: view.tone,
            sums,
            hits,
            lit,
        })
    }

    /// Compares all pixels, on all of rayon's threads, and tells what is found until then, and at the end; stops when
    /// `cancel` is raised.
    pub fn run(&self, cancel: &AtomicBool, tell: &dyn Fn(Arc<Findings>)) {
        let mut findings = Findings::new(self.size);
        let mut told = Instant::now();
        let [width, height] = self.size.map(|side| side as usize);
        let rows = ORDER.into_iter().flat_map(|first| (first..height).step_by(ORDER.len()));
        for y in rows {
            let row = &mut findings.pixels[y * width..(y + 1) * width];
            row.par_iter_mut().enumerate().for_each(|(x, pixel)| {
                if !cancel.load(Ordering::Relaxed) {
                    *pixel = self.disagreements([x as u32, y as u32]);
                }
            });
            if cancel.load(Ordering::Relaxed) {
                return;
            }
            if told.elapsed() >= INTERVAL {
                tell(Arc::new(findings.clone()));
                told = Instant::now();
            }
        }
        tell(Arc::new(findings));
    }

    /// In what a pixel disagrees, a bit each.
    fn disagreements(&self, [x, y]: [u32; 2]) -> u8 {
        let index = y as usize * self.size[0] as usize + x as usize;
        let FirstHit {
            hit: wanted, is_lit, ..
        } = self.sitting.first_hit([x, y]);
        let hit = self.hits[index];
        let mut bits = 0;
        if wanted.triangle != hit.triangle {
            bits |= Disagreement::Id.bit();
        } else if wanted.is_hit() && (wanted.t - hit.t).abs() > DEPTH * wanted.t {
            bits |= Disagreement::Depth.bit();
        }
        if is_lit != self.lit[index] {
            bits |= Disagreement::Shadow.bit();
        }
        let (sum, _) = self.sitting.pixel([x, y]);
        let pair = Picture::of_sums(2, 1, vec![sum, self.sums[index]]).to_rgb8(&self.tone);
        if (0..3).any(|channel| pair[channel].abs_diff(pair[channel + 3]) > STEP) {
            bits |= Disagreement::Color.bit();
        }
        bits
    }
}

type Answers = (Vec<Vec4>, Vec<Hit>, Vec<bool>);

/// The picture of a subject, what its back end sees first through the middle of each pixel, and whether the first light
/// reaches that.
fn asked(subject: &Subject, frame: &Frame) -> Result<Answers, BackendError> {
    let scene = &subject.scene;
    let mut backend: Box<dyn Backend> = match &subject.engine {
        Engine::Cpu => Box::new(Cpu::new(scene.clone())),
        Engine::Gpu(gpu) => Box::new(GpuBackend::new(gpu.clone(), scene)?),
    };
    let sums = match (&subject.image, &subject.engine) {
        (Image::Cpu(picture), _) => picture.sums.clone(),
        (Image::Gpu(picture), Engine::Gpu(gpu)) => gpu.read_picture(picture)?,
        // Shown by a GPU that is not to render any more.
        (Image::Gpu(_), Engine::Cpu) => {
            backend
                .render(
                    &subject.view.frame(scene, subject.size[0], subject.size[1]),
                    &crate::progress::silent,
                )?
                .sums
        }
    };
    let hits = backend.hits(frame)?;
    let rays = shadow_rays(scene, frame, &hits);
    let asked: Vec<Ray> = rays.iter().flatten().copied().collect();
    let hidden = backend.cast(scene.parts, Query::Any, &asked)?;
    let mut hidden = hidden.iter();
    let lit = rays.iter().map(|ray| match ray {
        Some(ray) => {
            let is_hidden = hidden.next().is_some_and(Hit::is_hit);
            !is_hidden && !nearest_plane(&scene.planes, scene.plane_count, ray).is_hit()
        }
        None => false,
    });
    Ok((sums, hits, lit.collect()))
}

/// The ray to the first light's first sample from what each pixel sees, where that is above it.
fn shadow_rays(scene: &Scene, frame: &Frame, hits: &[Hit]) -> Vec<Option<Ray>> {
    let world = scene.world();
    let slots = Slots::of(scene);
    let surface_of = surface_of(scene);
    let width = frame.size().x;
    let rays = hits.par_iter().enumerate().map(|(index, hit)| {
        if !hit.is_hit() {
            return None;
        }
        let pixel = uvec2(index as u32 % width, index as u32 / width);
        let ray = sample_ray(frame, pixel, 0);
        let surface = surface_of(frame, &world, &ray, &slots.placed(hit));
        let origin = surface.shadow_origin;
        let incident = frame.light.incident(0, origin, frame.root.size());
        let is_above = surface.side.dot(incident.direction) > 0.0 || surface.is_lifted;
        let is_faced = surface.normal.dot(incident.direction) > 0.0 && incident.color != Vec3::ZERO;
        (is_above && is_faced).then_some(Ray {
            origin,
            t_min: 0.0,
            direction: incident.direction,
            t_max: incident.reach,
        })
    });
    rays.collect()
}
