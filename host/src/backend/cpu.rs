//! The CPU back end: the kernel's body, compiled natively.

use super::{Backend, BackendError, MEASURING, Query, measured};
use crate::adaptive;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::scene::Scene;
use glam::{UVec2, uvec2};
use oktant_shared::adaptive::{Choice, Known, Mark, SINGLE, UNKNOWN, choose, entry, of_entry, samples_at};
use oktant_shared::frame::Frame;
use oktant_shared::general::General;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind, TriangleKind};
use oktant_shared::ray::Ray;
use oktant_shared::render::{Pixel, hit_pixel, render_pixel};
use oktant_shared::sampling::Batch;
use oktant_shared::scene::World;
use oktant_shared::traversal::{Compact, Standard, Traversal};
use oktant_shared::variant::{EVERYTHING, MIRRORED, OPAQUE, PLAIN, Variant};
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::Instant;

/// Renders with all threads of rayon's pool.
pub struct Cpu {
    scene: Arc<Scene>,
}

/// Edge of the square tiles that threads take, pixels: rays of a tile meet the same nodes.
const TILE: u32 = 16;
/// Rays that threads take at a time.
const RAYS: usize = 256;
/// Pixels of a list that are rendered before they are stored.
const PART: usize = 1 << 16;

impl Cpu {
    /// A back end for a scene.
    pub fn new(scene: Arc<Scene>) -> Self {
        Cpu { scene }
    }

    /// What it renders.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Milliseconds that tracing an array of rays takes by the wall's clock, `repeats` times over, after once that does not
    /// count; less often, but once, where that takes more than five seconds. Where the hits go is there before.
    pub fn time_cast(&self, parts: Parts, query: Query, rays: &[Ray], repeats: u32) -> Result<Vec<f64>, BackendError> {
        let mut hits = vec![Hit::miss(0.0); rays.len()];
        self.cast_into(parts, query, rays, &mut hits)?;
        measured(repeats, MEASURING, || {
            let start = Instant::now();
            self.cast_into(parts, query, rays, &mut hits)?;
            Ok(start.elapsed().as_secs_f64() * 1e3)
        })
    }

    fn cast_into(&self, parts: Parts, query: Query, rays: &[Ray], hits: &mut [Hit]) -> Result<(), BackendError> {
        if parts.traversal != self.scene.parts.traversal {
            return Err(BackendError::Parts(parts));
        }
        macro_rules! cast_with {
            ($($traversal:ident $triangle:ident $box_test:ident $closest:ident $any:ident $kind:ty;)+) => {
                match (parts.traversal, parts.triangle, parts.box_test) {
                    $((TraversalKind::$traversal, TriangleKind::$triangle, BoxKind::$box_test) => {
                        cast::<$kind>(&self.scene, query, rays, hits);
                        Ok(())
                    })+
                    _ => Err(BackendError::Parts(parts)),
                }
            };
        }
        oktant_shared::offered_parts!(cast_with)
    }

    /// Adds one pass of samples to a picture of the frame's size; the first pass overwrites. A pass of
    /// [`crate::adaptive::passes`] takes all samples of the pixels that it lists. Returns false, with the picture part done,
    /// if `cancel` was raised meanwhile.
    pub fn render_pass(
        &self,
        frame: &Frame,
        picture: &mut Picture,
        cancel: &AtomicBool,
        progress: Progress<'_>,
    ) -> bool {
        if frame.most_samples != 0 {
            return self.render_adaptive(frame, picture, cancel, progress);
        }
        let world = self.scene.world();
        let size = frame.size();
        let body = self.body();
        let batch = Batch::of_frame(frame);
        let overwrite = batch.first == 0;
        let rows = size.y.div_ceil(TILE);
        let done = AtomicU32::new(0);
        for_each_tile(
            (&mut picture.sums, &mut picture.work),
            size.x,
            |pixel, sum, work| {
                let pixel = body(frame, &world, pixel, &batch);
                if overwrite {
                    (*sum, *work) = (pixel.sum, pixel.work);
                } else {
                    *sum += pixel.sum;
                    *work += pixel.work;
                }
            },
            || {
                let finished = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress("rendering", finished as f32 / rows as f32);
                !cancel.load(Ordering::Relaxed)
            },
        );
        !cancel.load(Ordering::Relaxed)
    }

    /// Renders all samples of a frame; none where `cancel` was raised meanwhile.
    pub fn render_unless(&self, frame: &Frame, cancel: &AtomicBool, progress: Progress<'_>) -> Option<Picture> {
        self.render_watched(frame, cancel, progress, |_| ())
    }

    /// As [`Cpu::render_unless`]; `watch` sees the picture after each pass, of which an adaptive one takes several.
    pub fn render_watched(
        &self,
        frame: &Frame,
        cancel: &AtomicBool,
        progress: Progress<'_>,
        mut watch: impl FnMut(&Picture),
    ) -> Option<Picture> {
        let size = frame.size();
        let mut picture = Picture::unwritten(size.x, size.y);
        let passes = if frame.most_samples != 0 {
            adaptive::passes(frame, frame.most_samples)
        } else {
            vec![*frame]
        };
        for (before, pass) in passes.iter().enumerate() {
            let of_all = |stage, fraction| progress(stage, (before as f32 + fraction) / passes.len() as f32);
            if !self.render_pass(pass, &mut picture, cancel, &of_all) {
                return None;
            }
            watch(&picture);
        }
        Some(picture)
    }

    /// A pass over the pixels that a round of adaptive sampling lists, or over all.
    fn render_adaptive(
        &self,
        frame: &Frame,
        picture: &mut Picture,
        cancel: &AtomicBool,
        progress: Progress<'_>,
    ) -> bool {
        let size = frame.size();
        let pixels = size.x * size.y;
        if picture.marks.is_empty() {
            picture.marks = vec![Mark::default(); pixels as usize];
        }
        let list: Vec<u32> = if frame.is_listed == 0 {
            (0..pixels).map(|index| entry(index, SINGLE)).collect()
        } else {
            chosen(frame, picture)
        };
        let (world, body) = (self.scene.world(), self.body());
        for (before, part) in (0..).step_by(PART).zip(list.chunks(PART)) {
            let rendered: Vec<Pixel> = part
                .par_iter()
                .map(|entry| {
                    let (index, level) = of_entry(*entry);
                    let pixel = uvec2(index % size.x, index / size.x);
                    body(frame, &world, pixel, &samples_at(level))
                })
                .collect();
            for (entry, pixel) in part.iter().zip(rendered) {
                let (index, level) = of_entry(*entry);
                let index = index as usize;
                picture.sums[index] = pixel.sum;
                // What was left out of the samples that these replace is not in the picture; their rays were traced.
                picture.work[index].z = 0.0;
                picture.work[index] += pixel.work;
                picture.marks[index] = pixel.mark.after(picture.marks[index], &samples_at(level));
            }
            progress("rendering", (before + part.len()) as f32 / list.len() as f32);
            if cancel.load(Ordering::Relaxed) {
                return false;
            }
        }
        !cancel.load(Ordering::Relaxed)
    }

    /// The kernel's body for the scene.
    fn body(&self) -> fn(&Frame, &World<'_>, UVec2, &Batch) -> Pixel {
        match self.scene.parts {
            Parts::STANDARD => body::<Standard>(self.scene.variant),
            Parts::COMPACT => body::<Compact>(self.scene.variant),
            _ => render_pixel::<General, EVERYTHING>,
        }
    }
}

fn body<V: Traversal>(variant: Variant) -> fn(&Frame, &World<'_>, UVec2, &Batch) -> Pixel {
    match variant {
        Variant::Plain => render_pixel::<V, PLAIN>,
        Variant::Opaque => render_pixel::<V, OPAQUE>,
        Variant::Mirrors => render_pixel::<V, MIRRORED>,
        Variant::Everything => render_pixel::<V, EVERYTHING>,
    }
}

/// The pixels that a round of adaptive sampling wants traced; those that it interpolates are written.
fn chosen(frame: &Frame, picture: &mut Picture) -> Vec<u32> {
    let size = frame.size();
    let known = Known {
        marks: &picture.marks,
        sums: &picture.sums,
    };
    let choices: Vec<(u32, Choice)> = (0..size.x * size.y)
        .into_par_iter()
        .map(|index| (index, choose(frame, &known, uvec2(index % size.x, index / size.x))))
        .filter(|(_, choice)| *choice != Choice::NOTHING)
        .collect();
    for (index, choice) in &choices {
        if choice.is_interpolated {
            picture.sums[*index as usize] = choice.sum;
            picture.marks[*index as usize] = choice.mark;
        }
    }
    let listed = choices.iter().filter(|(_, choice)| choice.level != UNKNOWN);
    listed.map(|(index, choice)| entry(*index, choice.level)).collect()
}

impl Backend for Cpu {
    fn name(&self) -> String {
        format!("CPU, {} threads", rayon::current_num_threads())
    }

    fn render(&mut self, frame: &Frame, progress: Progress<'_>) -> Result<Picture, BackendError> {
        let picture = self.render_unless(frame, &AtomicBool::new(false), progress);
        Ok(picture.expect("nobody cancels it"))
    }

    fn hits(&mut self, frame: &Frame) -> Result<Vec<Hit>, BackendError> {
        let world = self.scene.world();
        let size = frame.size();
        let mut hits = vec![Hit::miss(0.0); size.x as usize * size.y as usize];
        let body = match self.scene.parts {
            Parts::STANDARD => hit_pixel::<Standard>,
            Parts::COMPACT => hit_pixel::<Compact>,
            _ => hit_pixel::<General>,
        };
        for_each_tile(
            (&mut hits, &mut vec![(); size.x as usize * size.y as usize]),
            size.x,
            |pixel, hit, ()| *hit = body(frame, &world, pixel),
            || true,
        );
        Ok(hits)
    }

    fn cast(&mut self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, BackendError> {
        let mut hits = vec![Hit::miss(0.0); rays.len()];
        self.cast_into(parts, query, rays, &mut hits)?;
        Ok(hits)
    }
}

fn cast<V: Traversal>(scene: &Scene, query: Query, rays: &[Ray], hits: &mut [Hit]) {
    let scene = scene.view();
    let rays = rays.par_chunks(RAYS).zip(hits.par_chunks_mut(RAYS));
    rays.for_each(|(rays, hits)| match query {
        Query::Closest => {
            V::closest_hits(&scene, rays, hits);
            for hit in hits {
                *hit = scene.identified(*hit);
            }
        }
        Query::Any => {
            let mut are_hit = [false; RAYS];
            V::any_hits(&scene, rays, &mut are_hit);
            for ((ray, hit), is_hit) in rays.iter().zip(hits).zip(are_hit) {
                *hit = if is_hit {
                    Hit {
                        triangle: 0,
                        ..Hit::miss(0.0)
                    }
                } else {
                    Hit::miss(ray.t_max)
                };
            }
        }
    });
}

/// Calls `body` for every pixel with its elements of two arrays, tile by tile in parallel; `after_row`, called after a row of
/// tiles, says whether to go on.
fn for_each_tile<T: Send, U: Send>(
    (first, second): (&mut [T], &mut [U]),
    width: u32,
    body: impl Fn(UVec2, &mut T, &mut U) + Sync,
    after_row: impl Fn() -> bool + Sync,
) {
    let stopped = AtomicBool::new(false);
    let band = (width * TILE) as usize;
    let bands = first.par_chunks_mut(band).zip(second.par_chunks_mut(band));
    bands.enumerate().for_each(|(row, (first, second))| {
        // Bands are as wide as the picture and split among threads column by column, so that the rest of a picture is
        // shared too.
        let tiles = tiles(first, width).into_par_iter().zip(tiles(second, width));
        tiles.enumerate().for_each(|(column, (first, second))| {
            if stopped.load(Ordering::Relaxed) {
                return;
            }
            let corner = uvec2(column as u32, row as u32) * TILE;
            for (y, (first, second)) in first.into_iter().zip(second).enumerate() {
                for (x, (first, second)) in first.iter_mut().zip(second).enumerate() {
                    body(corner + uvec2(x as u32, y as u32), first, second);
                }
            }
        });
        if !after_row() {
            stopped.store(true, Ordering::Relaxed);
        }
    });
}

/// The tiles of a band from left to right, each as its rows.
fn tiles<T>(band: &mut [T], width: u32) -> Vec<Vec<&mut [T]>> {
    let mut tiles: Vec<Vec<&mut [T]>> = Vec::new();
    tiles.resize_with(width.div_ceil(TILE) as usize, Vec::new);
    for line in band.chunks_mut(width as usize) {
        for (tile, row) in tiles.iter_mut().zip(line.chunks_mut(TILE as usize)) {
            tile.push(row);
        }
    }
    tiles
}
