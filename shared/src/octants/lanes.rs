//! The traversal for processors that have AVX2: eight boxes and four triangles at a time, in lanes, and two rays in turn;
//! eight rays that go much the same way together.
//!
//! Boxes are tested with fused multiply-add, triangles without it: a box may be met that the scalar twin passes by, hits are
//! the same bit for bit.

mod batch;
mod node;
mod packet;
mod pursuit;
mod start;
mod together;

use crate::hit::Hit;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::TriangleTest;
use pursuit::{pursue, pursue_one};
use std::sync::LazyLock;
use together::pursue_together;

/// Whether this processor has what the functions below need; asked once, then remembered.
#[inline(always)]
pub(super) fn are_there() -> bool {
    static ARE_THERE: LazyLock<bool> = LazyLock::new(|| {
        std::is_x86_feature_detected!("avx2")
            && std::is_x86_feature_detected!("fma")
            && std::is_x86_feature_detected!("bmi1")
            && std::is_x86_feature_detected!("bmi2")
            && std::is_x86_feature_detected!("lzcnt")
            && std::is_x86_feature_detected!("popcnt")
    });
    *ARE_THERE
}

/// What [`Traversal::closest_hit`] says.
///
/// # Safety
/// [`are_there`].
///
/// [`Traversal::closest_hit`]: crate::traversal::Traversal::closest_hit
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
pub(super) unsafe fn closest_hit<T: TriangleTest>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    pursue_one::<T, false>(scene, ray)
}

/// What [`Traversal::any_hit`] says.
///
/// # Safety
/// As of [`closest_hit`].
///
/// [`Traversal::any_hit`]: crate::traversal::Traversal::any_hit
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
pub(super) unsafe fn any_hit<T: TriangleTest>(scene: &Scene<'_>, ray: &Ray) -> bool {
    pursue_one::<T, true>(scene, ray).is_hit()
}

/// The closest hits of as many rays.
///
/// # Safety
/// As of [`closest_hit`].
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
pub(super) unsafe fn closest_hits<T: TriangleTest>(scene: &Scene<'_>, rays: &[Ray], hits: &mut [Hit]) {
    apart_or_together::<T, false>(scene, rays, |index, found| hits[index] = found);
}

/// Which of as many rays have a hit.
///
/// # Safety
/// As of [`closest_hit`].
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
pub(super) unsafe fn any_hits<T: TriangleTest>(scene: &Scene<'_>, rays: &[Ray], are_hit: &mut [bool]) {
    apart_or_together::<T, true>(scene, rays, |index, found| are_hit[index] = found.is_hit());
}

/// Searches for all rays, eight that go much the same way together. `tell` gets the index and what is found of each.
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
#[inline]
fn apart_or_together<T: TriangleTest, const ANY: bool>(
    scene: &Scene<'_>,
    rays: &[Ray],
    mut tell: impl FnMut(usize, Hit),
) {
    let (packets, _) = rays.as_chunks::<8>();
    // Those before are done, and those from there on go apart.
    let mut done = 0;
    for place in 0..=packets.len() {
        let found = packets
            .get(place)
            .and_then(|packet| pursue_together::<T, ANY>(scene, packet));
        let is_last = place == packets.len();
        if found.is_none() && !is_last {
            continue;
        }
        let end = if is_last { rays.len() } else { 8 * place };
        pursue::<T, ANY>(scene, &rays[done..end], |index, found| tell(done + index, found));
        for (lane, found) in found.into_iter().flatten().enumerate() {
            tell(end + lane, found);
        }
        done = end + 8;
    }
}
