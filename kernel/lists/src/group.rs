//! How a workgroup shares the pixels of its stretch of the list.

use glam::{UVec4, Vec4, uvec4};
use oktant_shared::adaptive::{LIST_GROUP, Mark, of_entry, pixels_of_group, samples_at};
use oktant_shared::buffer::{get, load, put, store};
use oktant_shared::frame::Frame;
use oktant_shared::render::{Pixel, looks};
use oktant_shared::sampling::Batch;

/// Something of each invocation.
pub type OfEach<T> = [T; LIST_GROUP as usize];

/// A list, or rather the part of it that a workgroup renders.
#[derive(Clone, Copy)]
pub struct Stretch<'a> {
    /// The pass.
    pub frame: &'a Frame,
    /// The whole list.
    pub list: &'a [u32],
    /// Its length.
    pub count: &'a [u32],
    /// The first place that is the workgroup's.
    pub first: u32,
}

/// A pixel of it, and what it gets in this pass.
#[derive(Clone, Copy)]
pub struct Listed {
    /// In the picture.
    pub index: u32,
    /// Nothing where there is no such pixel.
    pub batch: Batch,
}

impl Stretch<'_> {
    /// The pixel at a place in the stretch.
    pub fn pixel(&self, place: u32) -> Listed {
        let mut listed = Listed {
            index: 0,
            batch: Batch {
                count: 0,
                ..Batch::of_frame(self.frame)
            },
        };
        if self.first + place < load(self.count, 0) {
            let (index, level) = of_entry(load(self.list, self.first + place));
            listed.index = index;
            listed.batch = samples_at(level).among(self.frame);
        }
        listed
    }

    /// How many looks an invocation's own pixel takes; none where it has no pixel.
    pub fn looks(&self, invocation: u32) -> u32 {
        if invocation < pixels_of_group(self.frame) {
            looks(self.frame, &self.pixel(invocation).batch)
        } else {
            0
        }
    }
}

/// The looks of the pixels up to an invocation's own, that included.
pub fn summed(frame: &Frame, looks: &OfEach<u32>, invocation: u32) -> u32 {
    let mut sum = 0;
    let mut other = 0;
    loop {
        sum += if other <= invocation { get(looks, other) } else { 0 };
        other += 1;
        if other >= pixels_of_group(frame) {
            break;
        }
    }
    sum
}

/// The pixel that has a look, which is less than the last of `ends`: the sums of [`summed`].
pub fn owner(ends: &OfEach<u32>, look: u32) -> u32 {
    let mut place = 0;
    let mut step = LIST_GROUP / 2;
    loop {
        if get(ends, place + step - 1) <= look {
            place += step;
        }
        step /= 2;
        if step == 0 {
            break;
        }
    }
    place
}

/// Where the looks of a pixel begin.
pub fn start(ends: &OfEach<u32>, place: u32) -> u32 {
    if place == 0 { 0 } else { get(ends, place - 1) }
}

/// What a turn of the workgroup found, in its memory.
pub struct Found<'a> {
    /// As [`Pixel::sum`].
    pub sums: &'a mut OfEach<Vec4>,
    /// As [`Pixel::work`].
    pub costs: &'a mut OfEach<Vec4>,
    /// As [`Pixel::mark`].
    pub marks: &'a mut OfEach<UVec4>,
}

impl Found<'_> {
    /// Keeps what an invocation found.
    pub fn put(&mut self, invocation: u32, pixel: Pixel) {
        let mark = pixel.mark;
        put(self.sums, invocation, pixel.sum);
        put(self.costs, invocation, pixel.work);
        // Memory of the workgroup takes no structures that buffers have.
        let words = uvec4(mark.seen, mark.nearness.to_bits(), mark.normal, mark.state);
        put(self.marks, invocation, words);
    }

    fn mark(&self, invocation: u32) -> Mark {
        let words = get(self.marks, invocation);
        Mark {
            seen: words.x,
            nearness: f32::from_bits(words.y),
            normal: words.z,
            state: words.w,
        }
    }

    /// Adds what was found for an invocation's own pixel in the turn of the looks from `turn` on. The pixel's first sample overwrites
    /// all but the numbers of rays, which were traced all the same. `work` may hold fewer pixels, or none.
    pub fn add(
        &self,
        stretch: &Stretch<'_>,
        ends: &OfEach<u32>,
        turn: u32,
        invocation: u32,
        picture: &mut [Vec4],
        work: &mut [Vec4],
        marks: &mut [Mark],
    ) {
        let (begin, end) = (start(ends, invocation), get(ends, invocation));
        let mut look = if begin > turn { begin } else { turn };
        let last = if end < turn + LIST_GROUP {
            end
        } else {
            turn + LIST_GROUP
        };
        let Listed { index, batch } = stretch.pixel(invocation);
        if (look < last) & (index < picture.len() as u32) & (index < marks.len() as u32) {
            let is_first = (batch.first == 0) & (look == begin);
            let mut sum = if is_first { Vec4::ZERO } else { load(picture, index) };
            let mut mark = load(marks, index);
            let mut cost = if index < work.len() as u32 {
                load(work, index)
            } else {
                Vec4::ZERO
            };
            cost.z = if is_first { 0.0 } else { cost.z };
            loop {
                let by = look - turn;
                sum += get(self.sums, by);
                cost += get(self.costs, by);
                mark = if look == begin {
                    self.mark(by).after(mark, &batch)
                } else {
                    mark.and(&self.mark(by), &batch, look - begin)
                };
                look += 1;
                if look >= last {
                    break;
                }
            }
            store(picture, index, sum);
            store(marks, index, mark);
            if index < work.len() as u32 {
                store(work, index, cost);
            }
        }
    }
}

#[cfg(test)]
mod tests;
