//! Drawing the panel on the CPU: triangles with colours and textures, laid over what is there.

use super::painting::{Painting, Texture};
use egui::epaint::{Mesh, Primitive, Vertex};
use egui::{Color32, Rect, TextureFilter};
use glam::{Vec2, Vec4, vec2, vec4};
use std::ops::Range;

/// Corners are rounded to this part of a pixel, so that two triangles with an edge in common agree about it.
const SUBPIXELS: f32 = 256.0;

/// Draws it over the pixels of a surface, sRGB-encoded as `0x00RRGGBB`.
pub fn paint(painting: &Painting, surface: [u32; 2], pixels: &mut [u32]) {
    for clipped in &painting.primitives {
        // Nothing else is ever made.
        let Primitive::Mesh(mesh) = &clipped.primitive else {
            continue;
        };
        let Some(texture) = painting.textures.get(&mesh.texture_id) else {
            continue;
        };
        let area = Area::new(clipped.clip_rect, painting.scale, surface);
        let mut canvas = Canvas {
            pixels,
            width: surface[0] as usize,
            area,
        };
        canvas.draw(mesh, texture, painting.scale);
    }
}

/// Columns and rows that may be drawn on.
#[derive(Clone, Debug, PartialEq)]
struct Area {
    columns: Range<i64>,
    rows: Range<i64>,
}

impl Area {
    /// Of a rectangle in points, rounded to whole pixels.
    fn new(clip: Rect, scale: f32, surface: [u32; 2]) -> Self {
        let range = |from: f32, to: f32, most: u32| {
            let [from, to] = [from, to].map(|edge| ((edge * scale).round() as i64).clamp(0, i64::from(most)));
            from..to
        };
        Area {
            columns: range(clip.min.x, clip.max.x, surface[0]),
            rows: range(clip.min.y, clip.max.y, surface[1]),
        }
    }
}

/// A corner: its place in parts of a pixel, its place on the texture from 0 to 1, and its colour from 0 to 1,
/// sRGB-encoded and multiplied with its opacity.
#[derive(Clone, Copy)]
struct Corner {
    x: i64,
    y: i64,
    uv: Vec2,
    color: Vec4,
}

impl Corner {
    fn new(vertex: &Vertex, scale: f32) -> Self {
        let fixed = |coordinate: f32| (coordinate * scale * SUBPIXELS).round() as i64;
        Corner {
            x: fixed(vertex.pos.x),
            y: fixed(vertex.pos.y),
            uv: vec2(vertex.uv.x, vertex.uv.y),
            color: vector(vertex.color),
        }
    }
}

fn vector(color: Color32) -> Vec4 {
    let [red, green, blue, opacity] = color.to_array().map(f32::from);
    vec4(red, green, blue, opacity) / 255.0
}

/// The half plane at the right of an edge, seen along it, with y downwards.
struct Edge {
    /// What a pixel to the right adds, and a row down.
    step: [i64; 2],
    /// At the centre of the pixel in the first column and row; 0 and up is inside.
    start: i64,
}

impl Edge {
    /// The edge from one corner to another. Centres of pixels on it are inside if it is an upper or a left one, so that they
    /// belong to one of two triangles.
    fn new(from: &Corner, to: &Corner) -> Self {
        let pixel = SUBPIXELS as i64;
        let (right, down) = (to.x - from.x, to.y - from.y);
        let is_upper_left = down < 0 || (down == 0 && right > 0);
        let (x, y) = (pixel / 2 - from.x, pixel / 2 - from.y);
        Edge {
            step: [-down * pixel, right * pixel],
            start: right * y - down * x - i64::from(!is_upper_left),
        }
    }

    fn at(&self, column: i64, row: i64) -> i64 {
        self.start + self.step[0] * column + self.step[1] * row
    }
}

/// What is drawn on.
struct Canvas<'a> {
    pixels: &'a mut [u32],
    width: usize,
    area: Area,
}

impl Canvas<'_> {
    fn draw(&mut self, mesh: &Mesh, texture: &Texture, scale: f32) {
        for corners in mesh.indices.chunks_exact(3) {
            let corner = |i: usize| mesh.vertices.get(corners[i] as usize);
            if let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) {
                self.triangle([a, b, c].map(|vertex| Corner::new(vertex, scale)), texture);
            }
        }
    }

    fn triangle(&mut self, [a, mut b, mut c]: [Corner; 3], texture: &Texture) {
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area == 0 {
            return;
        }
        if area < 0 {
            (b, c) = (c, b);
        }
        let corners = [a, b, c];
        let pixel = SUBPIXELS as i64;
        let reach = |low: i64, high: i64, range: &Range<i64>| {
            low.div_euclid(pixel).max(range.start)..(high.div_euclid(pixel) + 1).min(range.end)
        };
        let [xs, ys] = [corners.map(|corner| corner.x), corners.map(|corner| corner.y)];
        let columns = reach(
            xs[0].min(xs[1]).min(xs[2]),
            xs[0].max(xs[1]).max(xs[2]),
            &self.area.columns,
        );
        let rows = reach(
            ys[0].min(ys[1]).min(ys[2]),
            ys[0].max(ys[1]).max(ys[2]),
            &self.area.rows,
        );
        let edges = [Edge::new(&b, &c), Edge::new(&c, &a), Edge::new(&a, &b)];
        let is_even = corners
            .iter()
            .all(|corner| corner.uv == a.uv && corner.color == a.color);
        let even = a.color * looked_up(texture, a.uv);
        let whole = 1.0 / area.abs() as f32;
        for row in rows {
            let mut inside = [0, 1, 2].map(|i| edges[i].at(columns.start, row));
            for column in columns.clone() {
                if inside.iter().all(|value| *value >= 0) {
                    let color = if is_even {
                        even
                    } else {
                        let weights = inside.map(|value| value as f32 * whole);
                        let mean = |values: [Vec4; 3]| {
                            values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
                        };
                        let uv = mean(corners.map(|corner| corner.uv.extend(0.0).extend(0.0)));
                        mean(corners.map(|corner| corner.color)) * looked_up(texture, vec2(uv.x, uv.y))
                    };
                    let pixel = &mut self.pixels[row as usize * self.width + column as usize];
                    *pixel = over(color, *pixel);
                }
                for (value, edge) in inside.iter_mut().zip(&edges) {
                    *value += edge.step[0];
                }
            }
        }
    }
}

/// The colour of a texture at a place, as its options say.
fn looked_up(texture: &Texture, uv: Vec2) -> Vec4 {
    let [width, height] = texture.image.size;
    let at = uv * vec2(width as f32, height as f32);
    if texture.options.magnification == TextureFilter::Nearest {
        let cell = at.floor();
        return vector(texture.texel(cell.x as i32, cell.y as i32));
    }
    let at = at - Vec2::splat(0.5);
    let (cell, part) = (at.floor(), at - at.floor());
    let texel = |right: i32, down: i32| vector(texture.texel(cell.x as i32 + right, cell.y as i32 + down));
    let upper = texel(0, 0).lerp(texel(1, 0), part.x);
    let lower = texel(0, 1).lerp(texel(1, 1), part.x);
    upper.lerp(lower, part.y)
}

/// A colour that is multiplied with its opacity over a pixel.
fn over(color: Vec4, pixel: u32) -> u32 {
    let left = 1.0 - color.w.clamp(0.0, 1.0);
    let channel = |shift: u32, above: f32| {
        let below = (pixel >> shift & 255) as f32;
        ((above * 255.0 + below * left + 0.5) as u32).min(255) << shift
    };
    channel(16, color.x) | channel(8, color.y) | channel(0, color.z)
}

#[cfg(test)]
mod tests;
