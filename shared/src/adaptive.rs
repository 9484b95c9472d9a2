//! Samples where they matter.
//!
//! A pixel begins with one sample in its middle. It gets 4, 16 or 64 instead where something says that one is not enough:
//! its neighbours see something else, another depth or another normal, or colours that bend. One pixel in thirteen is looked
//! into anyway: what is thinner than a pixel may pass between all middles. What pixels get at last is what they would have in
//! a picture that has as many samples everywhere, so a picture that was sampled adaptively is put together from pixels of those (T. Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980;
//! D. P. Mitchell, "Generating antialiased images at low sampling densities", SIGGRAPH 1987; here whole pixels are
//! subdivided, not the squares between samples, and contrast is that of the output).
//!
//! Below one ray a pixel: the corners of blocks are traced, and what lies between corners that agree is interpolated
//! (adaptive undersampling). Blocks are halved until they are pixels.
//!
//! Both work in rounds over the whole picture. A round looks at [`Mark`]s and colours, and lists the pixels that are to be
//! traced anew; none of them depends on another of its round, so the result does not depend on their order.

use crate::arithmetic::{greater, lesser, max_component};
use crate::buffer::{get, load};
use crate::display::encoded;
use crate::frame::Frame;
use crate::present::mean_color;
use crate::sampling::Batch;
use crate::stereo::EyeView;
use bytemuck::{Pod, Zeroable};
use glam::{UVec2, Vec3, Vec4, uvec2};

/// Of so many pixels side by side in a row, a column or a diagonal one is looked into, whatever its neighbours see. A prime: so
/// they lie on all lines alike.
const APART: u32 = 13;
/// How far one that is looked into in the next row lies from one in this, pixels.
const SHIFT: u32 = 5;
/// Rounds in which pixels get more samples. A thread that is thinner than a pixel is followed one pixel a round from where it was
/// found, in its row and into the next, so that it is found whole.
pub const ROUNDS: u32 = 2 + APART / 2;

const _: () = assert!(ROUNDS < 16, "marks have four bits for the round");

/// [`Mark::level`]: nothing is known of the pixel.
pub const UNKNOWN: u32 = 0;
/// [`Mark::level`]: it is interpolated.
pub const INTERPOLATED: u32 = 1;
/// [`Mark::level`]: it has one sample. The levels above have 4, 16 and 64.
pub const SINGLE: u32 = 2;

/// Normals whose cosine is less than this are apart.
const ALIKE: f32 = 0.9;
/// Where the nearness of pixels bends by more than this part of it, there is a step. On a plane it does not bend.
const STEP: f32 = 0.02;
/// Colours of a block that may be interpolated differ by at most so many tolerances.
const EVEN: f32 = 4.0;
/// Where no edge is known, a pixel may be off by this part of the bend of the colours: of a texture's edge by half, of a smooth
/// surface by a 24th, which there are many of.
const BENT: f32 = 1.5;
/// How much of a pixel four samples span along each axis: so much of a slope's step to the next pixel is between them.
const SPAN: f32 = 0.75;

/// What is known of a pixel.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Mark {
    /// A number made of the materials that its middle shows, directly and in reflections, and of which lights reach them.
    pub seen: u32,
    /// One by the depth of its middle, 0 where nothing is there: linear across the picture of a plane.
    pub nearness: f32,
    /// The normal of its middle, 10 bits a coordinate.
    pub normal: u32,
    /// From the lowest bits on: 4 bits of level, 4 of the round that traced it last, 0 for none, 12 each of the least and of the greatest brightness among its samples, in
    /// the output.
    pub state: u32,
}

const _: () = assert!(size_of::<Mark>() == 16);

impl Mark {
    /// Of a pixel of which nothing is known.
    pub const BLANK: Mark = Mark {
        seen: 0,
        nearness: 0.0,
        normal: 0,
        state: UNKNOWN,
    };

    /// One of [`UNKNOWN`], [`INTERPOLATED`], [`SINGLE`] or above.
    #[inline]
    pub fn level(&self) -> u32 {
        self.state & 0xf
    }

    /// The round that traced the pixel last, from 1 on; 0 where it was traced with all others.
    #[inline]
    fn round(&self) -> u32 {
        self.state >> 4 & 0xf
    }

    /// How far its samples differ in the output, 0 to 1.
    #[inline]
    pub fn range(&self) -> f32 {
        ((self.state >> 20) as f32 - (self.state >> 8 & 0xfff) as f32) / 4095.0
    }

    fn normal(&self) -> Vec3 {
        let part = |shift: u32| (self.normal >> shift & 0x3ff) as f32 / 511.0 - 1.0;
        Vec3::new(part(0), part(10), part(20))
    }

    /// Of a pixel before any of its samples in a pass.
    pub fn of_level(frame: &Frame, level: u32) -> Self {
        Mark {
            state: level | frame.is_listed << 4 | 0xfff << 8,
            ..Mark::BLANK
        }
    }

    /// With a sample of that colour, linear RGB.
    #[inline]
    #[must_use]
    pub fn with(mut self, frame: &Frame, color: Vec3) -> Self {
        let brightness = (encoded(frame, color).dot(Vec3::new(0.25, 0.5, 0.25)) * 4095.0) as u32;
        let (least, greatest) = (self.state >> 8 & 0xfff, self.state >> 20);
        let least = if brightness < least { brightness } else { least };
        let greatest = if brightness > greatest { brightness } else { greatest };
        self.state = self.state & 0xff | least << 8 | greatest << 20;
        self
    }

    /// With what one more look through the pixel brought, `number` of a batch's (see [`crate::render::looks`]), not the first. Of
    /// a pixel's only sample the other eye may see something else.
    #[inline]
    #[must_use]
    pub fn and(self, other: &Mark, batch: &Batch, number: u32) -> Self {
        let joined = self.joined(other);
        if batch.samples == 1 && number == 1 {
            Mark {
                seen: self.seen.rotate_left(16) ^ other.seen,
                state: joined.state,
                ..*other
            }
        } else {
            joined
        }
    }

    /// With the brightnesses of others of its samples.
    #[inline]
    #[must_use]
    fn joined(mut self, other: &Mark) -> Self {
        let (least, other_least) = (self.state >> 8 & 0xfff, other.state >> 8 & 0xfff);
        let (greatest, other_greatest) = (self.state >> 20, other.state >> 20);
        let least = if other_least < least { other_least } else { least };
        let greatest = if other_greatest > greatest {
            other_greatest
        } else {
            greatest
        };
        self.state = self.state & 0xff | least << 8 | greatest << 20;
        self
    }

    /// Of a pixel of which `before` was known, after a batch of its samples: what its middle sees stays, and the samples of
    /// earlier batches of the same level count, too.
    #[inline]
    #[must_use]
    pub fn after(mut self, before: Mark, batch: &Batch) -> Self {
        if batch.samples == 1 {
            return self;
        }
        if batch.first != 0 {
            self = self.joined(&before);
        }
        Mark {
            state: self.state,
            ..before
        }
    }
}

/// [`packed`] of no direction.
pub const NO_NORMAL: u32 = 511 | 511 << 10 | 511 << 20;

/// A normal in 10 bits a coordinate.
#[inline]
pub fn packed(normal: Vec3) -> u32 {
    let part = |value: f32| (lesser(greater(value, -1.0), 1.0) * 511.0 + 511.5) as u32;
    part(normal.x) | part(normal.y) << 10 | part(normal.z) << 20
}

/// Samples of a pixel at a level.
#[inline]
pub fn samples_at(level: u32) -> Batch {
    let per_side = if level <= SINGLE { 1 } else { 1 << (level - SINGLE) };
    Batch::whole(per_side)
}

/// The level of pixels with so many samples.
#[inline]
pub fn level_of(samples: u32) -> u32 {
    SINGLE + samples.trailing_zeros() / 2
}

/// What a round decides about a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The level at which it is to be traced; [`UNKNOWN`] if it is not.
    pub level: u32,
    /// Whether `sum` and `mark` are to be written: it is interpolated.
    pub is_interpolated: bool,
    /// A pixel of the picture.
    pub sum: Vec4,
    /// What is known of it.
    pub mark: Mark,
}

impl Choice {
    /// It stays as it is.
    pub const NOTHING: Choice = Choice {
        level: UNKNOWN,
        is_interpolated: false,
        sum: Vec4::ZERO,
        mark: Mark::BLANK,
    };
}

/// What has been found out so far, of each pixel row by row.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    /// The marks.
    pub marks: &'a [Mark],
    /// The picture.
    pub sums: &'a [Vec4],
}

impl Known<'_> {
    #[inline]
    fn color(&self, frame: &Frame, index: u32) -> Vec3 {
        encoded(frame, mean_color(load(self.sums, index)))
    }
}

/// Decides about a pixel: with blocks, about those in the middles of blocks and of their edges; without, about all.
pub fn choose(frame: &Frame, known: &Known<'_>, pixel: UVec2) -> Choice {
    if frame.block > 1 {
        filled(frame, known, pixel)
    } else {
        Choice {
            level: refined(frame, known, pixel),
            ..Choice::NOTHING
        }
    }
}

/// Whether a pixel in the grid of half a block is to be traced, or can be interpolated between the corners of its block. The
/// corners themselves are traced where they are not known yet, as they are in the first round only.
fn filled(frame: &Frame, known: &Known<'_>, pixel: UVec2) -> Choice {
    let (size, block) = (frame.size(), frame.block);
    let half = block / 2;
    let index = pixel.y * size.x + pixel.x;
    if (pixel.x | pixel.y) & (half - 1) != 0 {
        return Choice::NOTHING;
    }
    if load(known.marks, index).level() != UNKNOWN {
        return Choice::NOTHING;
    }
    let traced = Choice {
        level: SINGLE,
        ..Choice::NOTHING
    };
    // Half the block to either side, along the axes on which the pixel lies between corners.
    let x = if pixel.x & half != 0 { half } else { 0 };
    let y = if pixel.y & half != 0 { half } else { 0 };
    if ((x == 0) & (y == 0)) | (pixel.x + x >= size.x) | (pixel.y + y >= size.y) {
        return traced;
    }
    let corner = |right: bool, below: bool| {
        let across = if right { pixel.x + x } else { pixel.x - x };
        let down = if below { pixel.y + y } else { pixel.y - y };
        down * size.x + across
    };
    let places = [
        corner(false, false),
        corner(true, false),
        corner(false, true),
        corner(true, true),
    ];
    let first = load(known.marks, places[0]);
    let normal = first.normal();
    let mut agree = first.level() != UNKNOWN;
    let mut least = Vec3::ONE;
    let mut greatest = Vec3::ZERO;
    let mut sum = Vec3::ZERO;
    let mut nearness = 0.0;
    let mut bend = 0.0;
    let mut i = 0;
    while i < 4 {
        let place = get(&places, i);
        let mark = load(known.marks, place);
        agree &= (mark.level() != UNKNOWN) & (mark.seen == first.seen);
        agree &= (mark.nearness == 0.0) | (mark.normal().dot(normal) >= ALIKE);
        let light = mean_color(load(known.sums, place));
        let color = encoded(frame, light);
        least = least.min(color);
        greatest = greatest.max(color);
        sum += light * 0.25;
        nearness += mark.nearness * 0.25;
        bend += if (i == 0) | (i == 3) {
            mark.nearness
        } else {
            -mark.nearness
        };
        i += 1;
    }
    agree &= bend.abs() <= STEP * nearness;
    agree &= max_component(greatest - least) <= EVEN * frame.tolerance;
    if !agree {
        return traced;
    }
    Choice {
        level: UNKNOWN,
        is_interpolated: true,
        sum: sum.extend(1.0),
        mark: Mark { nearness, ..first }.at(INTERPOLATED),
    }
}

impl Mark {
    #[inline]
    fn at(mut self, level: u32) -> Self {
        self.state = self.state & !0xff | level;
        self
    }
}

/// Whether the round before this one traced a pixel or one of its neighbours; else what was decided then still holds.
fn is_news(frame: &Frame, known: &Known<'_>, pixel: UVec2) -> bool {
    let size = frame.size();
    let index = pixel.y * size.x + pixel.x;
    let left = if pixel.x > 0 { index - 1 } else { index };
    let right = if pixel.x + 1 < size.x { index + 1 } else { index };
    let above = if pixel.y > 0 { index - size.x } else { index };
    let below = if pixel.y + 1 < size.y { index + size.x } else { index };
    let places = [index, left, right, above, below];
    let mut is_news = frame.is_listed == 1;
    let mut i = 0;
    while i < 5 {
        is_news |= load(known.marks, get(&places, i)).round() + 1 == frame.is_listed;
        i += 1;
    }
    is_news
}

/// The level to which a pixel is to be refined, or [`UNKNOWN`].
fn refined(frame: &Frame, known: &Known<'_>, pixel: UVec2) -> u32 {
    let size = frame.size();
    let index = pixel.y * size.x + pixel.x;
    let own = load(known.marks, index);
    let (level, most) = (own.level(), level_of(frame.most_samples));
    if (level >= most) | !is_news(frame, known, pixel) {
        return UNKNOWN;
    }
    let color = known.color(frame, index);
    let normal = own.normal();
    let mut is_edge = false;
    let mut is_reached = false;
    let mut contrast = 0.0;
    let mut slope = 0.0;
    let mut bend = 0.0;
    let mut axis = 0;
    while axis < 2 {
        let (step, side, place) = if axis == 0 {
            (uvec2(1, 0), size.x, pixel.x)
        } else {
            (uvec2(0, 1), size.y, pixel.y)
        };
        axis += 1;
        let back = if place > 0 { pixel - step } else { pixel };
        let on = if place + 1 < side { pixel + step } else { pixel };
        let mut bent = -2.0 * color;
        let mut nearness = -2.0 * own.nearness;
        let mut steepest = 0.0;
        let mut i = 0;
        while i < 2 {
            let other = if i == 0 { back } else { on };
            i += 1;
            let place = other.y * size.x + other.x;
            let mark = load(known.marks, place);
            let beside = known.color(frame, place);
            is_edge |= mark.seen != own.seen;
            is_edge |= (own.nearness != 0.0) & (mark.nearness != 0.0) & (mark.normal().dot(normal) < ALIKE);
            let differs = max_component((beside - color).abs());
            // A neighbour that turned out to see several things: what it sees may reach over here.
            is_reached |= (mark.level() > SINGLE) & (mark.range() > 2.0 * frame.tolerance + SPAN * differs);
            contrast = greater(contrast, differs);
            steepest = greater(steepest, differs);
            bent += beside;
            nearness += mark.nearness;
        }
        slope += steepest;
        // At the picture's border there is no bend to be seen.
        if (place > 0) & (place + 1 < side) {
            bend = greater(bend, max_component(bent.abs()));
            is_edge |= nearness.abs() > STEP * own.nearness;
        }
    }
    if level > SINGLE {
        // What a slope makes of the samples is nothing that more of them would find.
        let range = own.range() - if is_edge { 0.0 } else { SPAN * slope };
        return if range > allowed(frame, level) {
            level + 1
        } else {
            UNKNOWN
        };
    }
    is_edge |= is_reached;
    let height = if is_edge { contrast } else { 2.0 * BENT * bend };
    let mut wanted = SINGLE;
    while (wanted < most) & (height > allowed(frame, wanted)) {
        wanted += 1;
    }
    let is_looked_into = (level == SINGLE) & (pixel.x + SHIFT * pixel.y).is_multiple_of(APART);
    if (is_edge | is_looked_into) & (wanted == SINGLE) {
        wanted = SINGLE + 1;
    }
    if wanted > SINGLE { wanted } else { UNKNOWN }
}

/// The highest edge of which the mean of a level's samples is off by no more than the tolerance: by half a sample.
#[inline]
fn allowed(frame: &Frame, level: u32) -> f32 {
    frame.tolerance * (2 << (2 * (level - SINGLE))) as f32
}

/// Invocations of a workgroup that renders pixels of a list.
pub const LIST_GROUP: u32 = 128;

/// How many pixels of a list such a workgroup renders in a pass that has a sample at least: most have four samples, so that each
/// invocation gets one; where a pass has fewer, more pixels.
#[inline]
pub fn pixels_of_group(frame: &Frame) -> u32 {
    let pixels = LIST_GROUP / (frame.sample_count * EyeView::eyes(frame));
    if pixels > LIST_GROUP / 4 {
        pixels
    } else {
        LIST_GROUP / 4
    }
}

/// A pixel of a list: its index in the picture, and the level at which it is to be traced.
#[inline]
pub fn entry(index: u32, level: u32) -> u32 {
    index | level << 28
}

/// Index in the picture and level of an entry.
#[inline]
pub fn of_entry(entry: u32) -> (u32, u32) {
    (entry & 0x0fff_ffff, entry >> 28)
}
