//! What pixels tell, held against what is counted elsewhere.

use super::*;
use crate::balls;
use crate::bench::count;
use crate::model::{Model, plain_material};
use crate::progress::silent;
use crate::sampling::Samples;
use crate::stereo::{Stereo, StereoMode};
use crate::structure::StructureOptions;
use crate::trace::Trace;
use crate::view::View;
use glam::{UVec2, Vec3};
use oktant_shared::material::Material;
use oktant_shared::parts::TraversalKind;
use oktant_shared::plane::Plane;
use oktant_shared::texture::{CHECKERBOARD, Texture};

const SIZE: [u32; 2] = [48, 36];

struct Subject {
    scene: Arc<Scene>,
    frame: Frame,
}

impl Subject {
    fn new(traversal: TraversalKind, planes: Vec<Plane>) -> Self {
        let mut model = Model::of_mesh(balls::balls());
        model.planes = planes;
        Subject::of(model, traversal, &View::default())
    }

    fn of(model: Model, traversal: TraversalKind, view: &View) -> Self {
        let scene = Arc::new(Scene::of_model(model, &StructureOptions::of(traversal), &silent).unwrap());
        let frame = view.frame(&scene, SIZE[0], SIZE[1]);
        Subject { scene, frame }
    }

    fn asked(&self, aspect: Aspect) -> Insight {
        let never = AtomicBool::new(false);
        let insight = Insight::new(aspect, &self.scene, &self.frame, &never, &silent).unwrap();
        insight.expect("nobody cancels it")
    }

    fn numbers(&self, aspect: Aspect) -> Vec<f32> {
        self.asked(aspect).numbers().expect("numbers").to_vec()
    }

    fn ray(&self, index: usize) -> Ray {
        let pixel = UVec2::new(index as u32 % SIZE[0], index as u32 / SIZE[0]);
        sample_ray(&middles(&self.frame), pixel, 0)
    }
}

fn with_structure() -> impl Iterator<Item = TraversalKind> {
    TraversalKind::ALL
        .iter()
        .copied()
        .filter(|kind| *kind != TraversalKind::Brute)
}

/// Oracle: `oktant trace`, which writes down every step.
#[test]
fn pixels_tell_what_their_rays_are_traced_to_do() {
    let mesh = balls::balls();
    for traversal in with_structure() {
        let subject = Subject::new(traversal, Vec::new());
        let [steps, tests, fill, references] =
            [Aspect::Steps, Aspect::Tests, Aspect::LeafFill, Aspect::References].map(|aspect| subject.numbers(aspect));
        let depths = (traversal != TraversalKind::Grid).then(|| subject.numbers(Aspect::LeafDepth));
        let mut hits = 0;
        for index in (0..steps.len()).step_by(23) {
            let trace = Trace::new(&mesh, &subject.scene, &subject.ray(index));
            let is_leaf = |visit: &&Visit| visit.kind != "node";
            let has_nodes = trace.visits.iter().any(|visit| visit.kind == "node");
            let visited = trace
                .visits
                .iter()
                .filter(|visit| !has_nodes || !is_leaf(visit))
                .count();
            assert_eq!(steps[index], visited as f32, "{traversal}, pixel {index}");
            assert_eq!(tests[index], trace.tests.len() as f32, "{traversal}, pixel {index}");
            let Some(hit) = trace.hit else {
                let nothing = [fill[index], references[index]];
                assert!(
                    nothing.iter().all(|number| number.is_nan()),
                    "{traversal}, pixel {index}"
                );
                continue;
            };
            hits += 1;
            // Leaves and cells hand their triangles over one after the other.
            let place = trace
                .tests
                .iter()
                .position(|tested| tested.triangle == hit.triangle)
                .unwrap();
            let of_leaves = trace.visits.iter().filter(is_leaf);
            let fitting = of_leaves.clone().filter(|visit| {
                visit.triangles as f32 == fill[index]
                    && depths.as_ref().is_none_or(|depths| visit.depth as f32 == depths[index])
            });
            assert!(fitting.count() > 0, "{traversal}, pixel {index}");
            if matches!(traversal, TraversalKind::Octree | TraversalKind::Grid) {
                let mut before = 0;
                let found = of_leaves.clone().find(|visit| {
                    before += visit.triangles as usize;
                    before > place
                });
                assert_eq!(
                    found.unwrap().triangles as f32,
                    fill[index],
                    "{traversal}, pixel {index}"
                );
            } else {
                assert_eq!(references[index], 1.0, "{traversal}");
            }
            assert!(references[index] >= 1.0);
        }
        assert!(hits > 5, "{traversal}: {hits}");
    }
}

/// Oracle: what `oktant bench` counts of the same rays altogether.
#[test]
fn sums_are_those_that_are_measured() {
    for traversal in TraversalKind::ALL.iter().copied() {
        let subject = Subject::new(traversal, Vec::new());
        let rays: Vec<Ray> = (0..(SIZE[0] * SIZE[1]) as usize)
            .map(|index| subject.ray(index))
            .collect();
        let counts = count(&subject.scene, subject.scene.parts, Query::Closest, &rays);
        let sum = |aspect| subject.numbers(aspect).into_iter().map(f64::from).sum::<f64>();
        assert_eq!(sum(Aspect::Tests), counts.triangle_tests as f64, "{traversal}");
        if traversal != TraversalKind::Brute {
            assert_eq!(sum(Aspect::Steps), counts.nodes as f64, "{traversal}");
        }
        assert!(counts.triangle_tests > 100, "{traversal}");
    }
}

#[test]
fn rays_are_those_of_the_picture() {
    let subject = Subject::new(TraversalKind::Octants, Vec::new());
    let picture = Cpu::new(subject.scene.clone()).render(&subject.frame, &silent).unwrap();
    let (rays, shadow_rays) = (subject.numbers(Aspect::Rays), subject.numbers(Aspect::ShadowRays));
    for (index, work) in picture.work.iter().enumerate() {
        assert_eq!((rays[index], shadow_rays[index]), (work.x + work.y, work.y));
    }
    assert!(shadow_rays.iter().any(|number| *number > 0.0));
}

/// Oracle: before a mirror that fills the picture, each look through a pixel is one ray there and one back, on which nothing is.
#[test]
fn a_mirror_is_asked_for_as_often_as_it_is_seen() {
    let bare = Subject::new(TraversalKind::Octants, Vec::new());
    let camera = &bare.frame.camera;
    let mut model = Model::of_mesh(balls::balls());
    // Squares of some ten pixels, so that adaptive sampling finds something to do, but not everywhere.
    model.textures.push(Texture {
        first: 0,
        width: 0xff_ffff,
        height: 0,
        kind: CHECKERBOARD,
        repeats: 500.0,
        reserved: [0; 3],
    });
    model.materials.push(Material {
        mirror: Vec3::splat(0.5),
        diffuse: 0.5,
        texture: 0,
        ..plain_material()
    });
    model.planes = vec![Plane::new(camera.eye + camera.forward * 1e-2, -camera.forward, 1)];
    let anaglyph = Some(Stereo::new(StereoMode::Anaglyph));
    for (samples, adaptive, block, stereo) in [
        (Samples::One, false, 1, None),
        (Samples::Four, false, 1, None),
        (Samples::Four, false, 1, anaglyph),
        (Samples::Sixteen, true, 1, None),
        (Samples::Sixteen, true, 1, anaglyph),
        (Samples::Sixteen, true, 8, None),
        (Samples::One, true, 8, None),
    ] {
        let view = View {
            samples,
            adaptive,
            block,
            stereo,
            depth: 1,
            cutoff: 0.0,
            ..View::default()
        };
        let name = format!("{view:?}");
        let subject = Subject::of(model.clone(), TraversalKind::Octants, &view);
        let [recursion, shadow, all] =
            [Aspect::RecursionRays, Aspect::ShadowRays, Aspect::Rays].map(|aspect| subject.numbers(aspect));
        for (index, number) in recursion.iter().enumerate() {
            assert_eq!(2.0 * number + shadow[index], all[index], "{name}, pixel {index}");
        }
        let eyes = if stereo.is_some() { 2.0 } else { 1.0 };
        let [least, greatest] = [f32::min, f32::max].map(|of| recursion.iter().copied().reduce(of).unwrap());
        if adaptive {
            assert_eq!(least, if block > 1 { 0.0 } else { eyes }, "{name}");
            let most = if samples == Samples::One { eyes } else { 17.0 * eyes };
            assert!(greatest >= most, "{name}: {greatest}");
        } else {
            let each = samples.count() as f32 * eyes;
            assert_eq!([least, greatest], [each, each], "{name}");
        }
    }
    assert!(bare.numbers(Aspect::RecursionRays).iter().all(|number| *number == 0.0));
}

/// Rays end at planes, and what is seen there is in no leaf.
#[test]
fn planes_are_in_no_leaf() {
    let bare = Subject::new(TraversalKind::Octants, Vec::new());
    // Between the camera and the balls.
    let before = Plane::new(
        bare.frame.camera.eye + bare.frame.camera.forward * 1e-3,
        bare.frame.camera.forward,
        0,
    );
    let hidden = Subject::new(TraversalKind::Octants, vec![before]);
    assert!(bare.numbers(Aspect::Tests).iter().sum::<f32>() > 0.0);
    assert_eq!(hidden.numbers(Aspect::Tests).iter().sum::<f32>(), 0.0);
    for aspect in [Aspect::LeafDepth, Aspect::LeafFill, Aspect::References] {
        assert!(hidden.numbers(aspect).iter().all(|number| number.is_nan()), "{aspect}");
    }
    assert!(hidden.numbers(Aspect::Depth).iter().all(|depth| *depth > 0.0));
    // Below all: what is above is as it was.
    let low = bare.scene.low - Vec3::Y * 100.0;
    let floored = Subject::new(TraversalKind::Octants, vec![Plane::new(low, Vec3::Y, 0)]);
    let [with, without] = [&floored, &bare].map(|subject| subject.numbers(Aspect::LeafFill));
    assert_eq!(with.len(), without.len());
    assert!(with.iter().zip(&without).all(|(a, b)| a.to_bits() == b.to_bits()));
}

#[test]
fn what_means_nothing_is_refused_and_all_else_is_told() {
    for traversal in TraversalKind::ALL.iter().copied() {
        let subject = Subject::new(traversal, Vec::new());
        for aspect in Aspect::ALL {
            match aspect.check(traversal) {
                Ok(()) => {
                    let insight = subject.asked(aspect);
                    assert_eq!(insight.numbers().is_some(), aspect.is_number());
                    let scale = Legend::new(&insight, traversal, None).scale;
                    let pixels = (SIZE[0] * SIZE[1]) as usize;
                    let colors = (0..pixels).map(|index| insight.color(index, scale.as_ref()));
                    let nothing = colors.filter(|color| *color == NOTHING).count();
                    assert!(nothing < pixels, "{traversal}, {aspect}");
                }
                Err(refused) => {
                    assert!(refused.to_string().ends_with("take another traversal."), "{refused}");
                    assert!(
                        matches!(traversal, TraversalKind::Brute | TraversalKind::Grid),
                        "{refused}"
                    );
                }
            }
        }
    }
}

#[test]
fn whoever_wants_no_more_gets_nothing() {
    let subject = Subject::new(TraversalKind::Octants, Vec::new());
    let cancelled = AtomicBool::new(true);
    for aspect in [Aspect::Steps, Aspect::LeafFill, Aspect::RecursionRays, Aspect::Rays] {
        let insight = Insight::new(aspect, &subject.scene, &subject.frame, &cancelled, &silent);
        assert_eq!(insight.unwrap(), None, "{aspect}");
    }
}
