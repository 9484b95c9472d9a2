//! The CPU back end: the kernel's body, compiled natively.

use super::{Backend, BackendError, Parts, Query};
use crate::picture::Picture;
use crate::progress::Progress;
use crate::scene::Scene;
use glam::{UVec2, Vec4, uvec2};
use oktant_shared::box_test::{KayKajiya, Williams};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use oktant_shared::render::{hit_pixel, render_pixel};
use oktant_shared::revelles::Revelles;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_shared::triangle_test::{MollerTrumbore, Watertight};
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Renders with all threads of rayon's pool.
pub struct Cpu {
    scene: Arc<Scene>,
}

/// Edge of the square tiles that threads take, pixels: rays of a tile meet the same nodes.
const TILE: u32 = 16;

impl Cpu {
    /// A back end for a scene.
    pub fn new(scene: Arc<Scene>) -> Self {
        Cpu { scene }
    }

    /// Adds one pass of samples to a picture of the frame's size; the first pass overwrites. Returns false, with the
    /// picture part done, if `cancel` was raised meanwhile.
    pub fn render_pass(
        &self,
        frame: &Frame,
        picture: &mut Picture,
        cancel: &AtomicBool,
        progress: Progress<'_>,
    ) -> bool {
        let world = self.scene.world();
        let size = frame.size();
        let body = if self.scene.is_plain() {
            render_pixel::<Standard, false>
        } else {
            render_pixel::<Standard, true>
        };
        let overwrite = frame.first_sample == 0;
        let rows = size.y.div_ceil(TILE);
        let done = AtomicU32::new(0);
        let mut pixels: Vec<_> = picture.sums.iter_mut().zip(&mut picture.work).collect();
        for_each_tile(
            &mut pixels,
            size.x,
            |pixel, (sum, work): &mut (&mut Vec4, &mut Vec4)| {
                let pixel = body(frame, &world, pixel);
                if overwrite {
                    (**sum, **work) = (pixel.sum, pixel.work);
                } else {
                    **sum += pixel.sum;
                    **work += pixel.work;
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
}

impl Backend for Cpu {
    fn name(&self) -> String {
        format!("CPU, {} threads", rayon::current_num_threads())
    }

    fn render(&mut self, frame: &Frame, progress: Progress<'_>) -> Result<Picture, BackendError> {
        let size = frame.size();
        let mut picture = Picture::unwritten(size.x, size.y);
        self.render_pass(frame, &mut picture, &AtomicBool::new(false), progress);
        Ok(picture)
    }

    fn hits(&mut self, frame: &Frame) -> Result<Vec<Hit>, BackendError> {
        let world = self.scene.world();
        let size = frame.size();
        let mut hits = vec![Hit::miss(0.0); size.x as usize * size.y as usize];
        for_each_tile(
            &mut hits,
            size.x,
            |pixel, hit| *hit = hit_pixel::<Standard>(frame, &world, pixel),
            || true,
        );
        Ok(hits)
    }

    fn cast(&mut self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, BackendError> {
        Ok(match parts {
            Parts::KayKajiyaWatertight => cast::<Revelles<KayKajiya, Watertight>>(&self.scene, query, rays),
            Parts::WilliamsMollerTrumbore => cast::<Revelles<Williams, MollerTrumbore>>(&self.scene, query, rays),
        })
    }
}

fn cast<V: Traversal>(scene: &Scene, query: Query, rays: &[Ray]) -> Vec<Hit> {
    let scene = scene.view();
    rays.par_iter()
        .with_min_len(256)
        .map(|ray| match query {
            Query::Closest => V::closest_hit(&scene, ray),
            Query::Any if V::any_hit(&scene, ray) => Hit {
                triangle: 0,
                ..Hit::miss(0.0)
            },
            Query::Any => Hit::miss(ray.t_max),
        })
        .collect()
}

/// Calls `body` for every pixel, tile by tile in parallel; `after_row`, called after a row of tiles, says whether to go
/// on.
fn for_each_tile<T: Send>(
    pixels: &mut [T],
    width: u32,
    body: impl Fn(UVec2, &mut T) + Sync,
    after_row: impl Fn() -> bool + Sync,
) {
    let stopped = AtomicBool::new(false);
    pixels
        .par_chunks_mut((width * TILE) as usize)
        .enumerate()
        .for_each(|(row, band)| {
            // Bands are as wide as the picture and split among threads column by column, so that the rest of a picture is
            // shared too.
            let mut lines: Vec<&mut [T]> = band.chunks_mut(width as usize).collect();
            let mut tiles: Vec<(u32, Vec<&mut [T]>)> = Vec::new();
            let mut left = 0;
            while left < width {
                let columns = TILE.min(width - left) as usize;
                let tile = lines
                    .iter_mut()
                    .map(|line| {
                        let (tile, rest) = std::mem::take(line).split_at_mut(columns);
                        *line = rest;
                        tile
                    })
                    .collect();
                tiles.push((left, tile));
                left += TILE;
            }
            tiles.into_par_iter().for_each(|(left, tile)| {
                if stopped.load(Ordering::Relaxed) {
                    return;
                }
                for (y, line) in tile.into_iter().enumerate() {
                    for (x, pixel) in line.iter_mut().enumerate() {
                        body(uvec2(left + x as u32, row as u32 * TILE + y as u32), pixel);
                    }
                }
            });
            if !after_row() {
                stopped.store(true, Ordering::Relaxed);
            }
        });
}
