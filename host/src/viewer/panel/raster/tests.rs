//! What triangles do to pixels.

use super::*;
use egui::epaint::ImageDelta;
use egui::{ClippedPrimitive, ColorImage, ImageData, TextureId, TextureOptions, TexturesDelta, pos2};

const WHITE: Color32 = Color32::WHITE;

/// Triangles that may be drawn on `clip`, on a texture of two times two texels: white and black above, black and white below.
fn painting(
    clip: Rect,
    corners: &[([f32; 2], [f32; 2], Color32)],
    indices: &[u32],
    options: TextureOptions,
) -> Painting {
    let mut mesh = Mesh::with_texture(TextureId::Managed(0));
    mesh.vertices = corners
        .iter()
        .map(|(at, uv, color)| Vertex {
            pos: pos2(at[0], at[1]),
            uv: pos2(uv[0], uv[1]),
            color: *color,
        })
        .collect();
    mesh.indices = indices.to_vec();
    let primitive = ClippedPrimitive {
        clip_rect: clip,
        primitive: Primitive::Mesh(mesh),
    };
    let image = ColorImage::new([2, 2], vec![WHITE, Color32::BLACK, Color32::BLACK, WHITE]);
    let delta = ImageDelta::full(ImageData::Color(image.into()), options);
    let mut changed = TexturesDelta::default();
    changed.push(TextureId::Managed(0), delta);
    let mut painting = Painting::default();
    painting.update(vec![primitive], 1.0, changed);
    painting
}

fn everywhere() -> Rect {
    Rect::from_min_max(pos2(0.0, 0.0), pos2(1e4, 1e4))
}

/// Where the texture is white.
const ON_WHITE: [f32; 2] = [0.0, 0.0];

#[test]
fn neighbours_share_their_edge_and_no_pixel() {
    // A fan about a point in the middle, in both orders of corners: a pixel that two triangles take is too bright.
    let half = Color32::from_rgba_premultiplied(100, 100, 100, 128);
    for (center, flips) in [([7.3, 8.1], false), ([8.0, 8.0], true), ([8.5, 7.5], false)] {
        let rim = [
            [2.0, 2.0],
            [9.0, 2.0],
            [14.0, 2.0],
            [14.0, 9.5],
            [14.0, 14.0],
            [2.0, 14.0],
        ];
        let mut corners = vec![(center, ON_WHITE, half)];
        corners.extend(rim.map(|at| (at, ON_WHITE, half)));
        let fan: Vec<u32> = (1..=6)
            .flat_map(|i| {
                let next = i % 6 + 1;
                if flips && i % 2 == 0 {
                    [0, next, i]
                } else {
                    [0, i, next]
                }
            })
            .collect();
        let mut pixels = vec![0x0020_4060; 16 * 16];
        paint(
            &painting(everywhere(), &corners, &fan, TextureOptions::NEAREST),
            [16, 16],
            &mut pixels,
        );
        // 100 + 127 of 255 of what was there.
        let wanted = over(vector(half), 0x0020_4060);
        assert_eq!(wanted, 116 << 16 | 132 << 8 | 148);
        for (pixel, i) in pixels.iter().zip(0..) {
            let (x, y) = (i % 16, i / 16);
            let is_inside = (2..14).contains(&x) && (2..14).contains(&y);
            assert_eq!(
                *pixel,
                if is_inside { wanted } else { 0x0020_4060 },
                "{x} {y} about {center:?}"
            );
        }
    }
}

#[test]
fn nothing_is_drawn_outside_of_the_rectangle_and_the_surface() {
    let clip = Rect::from_min_max(pos2(2.6, 1.0), pos2(5.0, 1e9));
    let corners = [[-50.0, -50.0], [90.0, -50.0], [-50.0, 90.0]].map(|at| (at, ON_WHITE, WHITE));
    let mut pixels = vec![0; 8 * 4];
    paint(
        &painting(clip, &corners, &[0, 1, 2], TextureOptions::NEAREST),
        [8, 4],
        &mut pixels,
    );
    for (pixel, i) in pixels.iter().zip(0..) {
        let is_inside = (3..5).contains(&(i % 8)) && i / 8 >= 1;
        assert_eq!(*pixel, if is_inside { 0x00ff_ffff } else { 0 }, "{i}");
    }
}

#[test]
fn textures_and_colours_are_interpolated() {
    let red = Color32::from_rgb(255, 0, 0);
    let corners = [
        ([0.0, 0.0], [0.0, 0.0], WHITE),
        ([4.0, 0.0], [1.0, 0.0], red),
        ([4.0, 4.0], [1.0, 1.0], red),
        ([0.0, 4.0], [0.0, 1.0], WHITE),
    ];
    let drawn = |options| {
        let mut pixels = vec![0; 16];
        paint(
            &painting(everywhere(), &corners, &[0, 1, 2, 0, 2, 3], options),
            [4, 4],
            &mut pixels,
        );
        pixels
    };
    let nearest = drawn(TextureOptions::NEAREST);
    // From white to red, an eighth of the way at the first centre; the texture is white there, and black beyond the middle.
    assert_eq!(nearest[0], 0x00ff_dfdf);
    assert_eq!((nearest[2], nearest[3]), (0, 0));
    assert_eq!(nearest[15] >> 16, 255, "white below at the right");
    let linear = drawn(TextureOptions::LINEAR);
    // Centres of pixels lie a quarter of a texel from those of texels: (0.25, 0.25) from white, (0.75, 0.25) next to it.
    assert_eq!(
        linear[0] >> 16,
        255,
        "beyond the texel's centre there is only its own colour"
    );
    let between = 0.75 * 0.75 + 0.25 * 0.25;
    assert_eq!(linear[5] >> 16, (255.0_f32 * between + 0.5) as u32);
}

#[test]
fn parts_of_textures_are_replaced() {
    let corners =
        [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|at: [f32; 2]| (at, [at[0] / 2.0, at[1] / 2.0], WHITE));
    let mut painting = painting(everywhere(), &corners, &[0, 1, 2, 0, 2, 3], TextureOptions::NEAREST);
    let before = painting.textures[&TextureId::Managed(0)].version;
    let image = ColorImage::new([1, 1], vec![Color32::from_rgb(1, 2, 3)]);
    let delta = ImageDelta::partial([1, 0], ImageData::Color(image.into()), TextureOptions::NEAREST);
    let mut changed = TexturesDelta::default();
    changed.push(TextureId::Managed(0), delta);
    let primitives = painting.primitives.clone();
    painting.update(primitives, 1.0, changed);
    let mut pixels = vec![0x0007_0707; 4];
    paint(&painting, [2, 2], &mut pixels);
    assert_eq!(pixels, [0x00ff_ffff, 0x0001_0203, 0, 0x00ff_ffff]);
    assert!(painting.textures[&TextureId::Managed(0)].version > before);
    let mut gone = TexturesDelta::default();
    gone.free(TextureId::Managed(0));
    let primitives = painting.primitives.clone();
    painting.update(primitives, 1.0, gone);
    let mut pixels = vec![7; 4];
    paint(&painting, [2, 2], &mut pixels);
    assert_eq!(pixels, [7; 4], "what has no texture is not drawn");
}
