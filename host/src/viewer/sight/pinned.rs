//! What becomes of the ray of a pixel.

use super::crossings::crossings;
use crate::backend::Query;
use crate::bench::{Counts, count_each};
use crate::insight::shortened;
use crate::scene::Scene;
use crate::seen::{middles, surface_of};
use crate::source::Source;
use crate::structure::StructureOptions;
use crate::trace::Cell;
use crate::viewer::overlay::{Line, Tone, wrap};
use crate::wires::visited;
use glam::{DVec3, UVec2, Vec3};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::plane::PLANE;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use oktant_shared::trace::nearest_plane;
use std::fmt::Write;

/// A ray, and what it met and visited.
#[derive(Clone, Debug)]
pub struct Pinned {
    pixel: [u32; 2],
    found: Option<Found>,
    /// What lies behind that on the ray's line.
    further: Vec<Hit>,
    /// What the structure cost.
    counts: Counts,
    /// What it visited, each once.
    pub cells: Vec<Cell>,
    /// The command that traces it again.
    pub command: Option<String>,
}

/// What a ray met.
#[derive(Clone, Copy, Debug)]
struct Found {
    /// With the triangle's id, or the plane.
    hit: Hit,
    /// The unit normal that shades.
    normal: Vec3,
    /// Index of the material.
    material: u32,
}

/// Crossings behind the first that the panel tells.
const FURTHER: usize = 6;
/// Levels of which the panel says how many cells were visited.
const LEVELS: u32 = 8;

impl Pinned {
    /// Traces the ray through the middle of a pixel.
    pub fn new(scene: &Scene, frame: &Frame, pixel: [u32; 2]) -> Self {
        let frame = middles(frame);
        let (world, ray) = (scene.world(), ray(&frame, pixel));
        let limited = shortened(scene, ray);
        let (in_slot, cells) = visited(scene, &limited);
        let nearest = if in_slot.is_hit() {
            in_slot
        } else {
            nearest_plane(&scene.planes, scene.plane_count, &ray)
        };
        let found = nearest.is_hit().then(|| {
            let surface = surface_of(scene)(&frame, &world, &ray, &nearest);
            let hit = if in_slot.is_hit() {
                world.scene.identified(in_slot)
            } else {
                nearest
            };
            Found {
                hit,
                normal: surface.normal,
                material: surface.material_id,
            }
        });
        let mut further = crossings(scene, &ray);
        if let Some(found) = &found {
            further.retain(|crossing| crossing.triangle != found.hit.triangle);
        }
        Pinned {
            pixel,
            found,
            further,
            counts: count_each(scene, scene.parts, Query::Closest, &[limited])
                .into_iter()
                .sum(),
            cells,
            command: None,
        }
    }

    /// With the command that traces the ray again, in a scene of that source whose mesh was moved by `shift`; `oktant trace`
    /// takes no planes, and one file.
    pub fn replayed(
        self,
        scene: &Scene,
        frame: &Frame,
        source: &Source,
        shift: DVec3,
        structure: &StructureOptions,
    ) -> Self {
        let is_taken = scene.plane_count == 0 && !matches!(source, Source::Several(_));
        let command = is_taken.then(|| {
            let Ray { origin, direction, .. } = ray(&middles(frame), self.pixel);
            let origin = origin.as_dvec3() + shift;
            // The shortest decimals that are the same f32 again, where nothing was moved.
            let places: Vec<String> = if shift == DVec3::ZERO {
                origin.as_vec3().to_array().map(|place| place.to_string()).into()
            } else {
                origin.to_array().map(|place| place.to_string()).into()
            };
            let numbers: Vec<String> = places
                .into_iter()
                .chain(direction.to_array().map(|part| part.to_string()))
                .collect();
            format!(
                "oktant trace {} --ray {}{}",
                quoted(&source.to_string()),
                numbers.join(","),
                options(structure)
            )
        });
        Pinned { command, ..self }
    }

    /// The panel about it, of so many characters a line.
    pub fn lines(&self, columns: usize) -> Vec<Line> {
        let mut panel = Vec::new();
        let mut add = |text: String, tone| {
            let lines = wrap(&text, columns).into_iter();
            panel.extend(lines.map(|text| Line { text, tone }));
        };
        let [x, y] = self.pixel;
        add(format!("pinned: the ray of pixel {x}, {y}   Esc: unpin"), Tone::Strong);
        match &self.found {
            Some(Found { hit, normal, material }) => {
                let place = if hit.triangle & PLANE == 0 {
                    format!(", u {:.4}, v {:.4}", hit.u, hit.v)
                } else {
                    String::new()
                };
                add(format!("{}{place}, t {}", named(hit), hit.t), Tone::Plain);
                let [x, y, z] = normal.to_array();
                add(
                    format!("normal {x:.3}, {y:.3}, {z:.3}, material {material}"),
                    Tone::Plain,
                );
            }
            None => add("hits nothing".into(), Tone::Plain),
        }
        for hit in self.further.iter().take(FURTHER) {
            add(format!("then {}, t {}", named(hit), hit.t), Tone::Plain);
        }
        if self.further.len() > FURTHER {
            add(format!("then {} more", self.further.len() - FURTHER), Tone::Plain);
        }
        add(
            format!(
                "{} steps, {} triangle tests, {} boxes",
                self.counts.nodes,
                self.counts.triangle_tests,
                self.cells.len()
            ),
            Tone::Plain,
        );
        let deepest = self.cells.iter().map(|cell| cell.depth).max().unwrap_or(0);
        let of_level = |level| self.cells.iter().filter(|cell| cell.depth == level).count();
        let levels: Vec<String> = (0..=deepest.min(LEVELS - 1))
            .map(|level| of_level(level).to_string())
            .collect();
        let more = if deepest >= LEVELS { ", ..." } else { "" };
        add(
            format!("by level from 0 to {deepest}: {}{more}", levels.join(", ")),
            Tone::Plain,
        );
        add(
            self.command
                .clone()
                .unwrap_or_else(|| "oktant trace takes one file, without planes".into()),
            Tone::Plain,
        );
        panel
    }

    /// What the step `print` says: the triangle, `t`, steps, triangle tests and boxes.
    pub fn report(&self) -> String {
        let hit = self
            .found
            .map(|found| format!("{} {}", found.hit.triangle, found.hit.t));
        format!(
            "{} {} {} {}",
            hit.unwrap_or_else(|| "- -".into()),
            self.counts.nodes,
            self.counts.triangle_tests,
            self.cells.len()
        )
    }
}

/// What was hit.
fn named(hit: &Hit) -> String {
    if hit.triangle & PLANE == 0 {
        format!("triangle {}", hit.triangle)
    } else {
        format!("plane {}", hit.triangle & !PLANE)
    }
}

/// The ray through the middle of a pixel.
fn ray(frame: &Frame, [x, y]: [u32; 2]) -> Ray {
    sample_ray(frame, UVec2::new(x, y), 0)
}

/// A name as shells take it.
fn quoted(name: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-+".contains(c);
    if name.chars().all(is_plain) {
        name.into()
    } else {
        format!("'{}'", name.replace('\'', r"'\''"))
    }
}

/// The options that lead to a structure, where they are not as usual.
fn options(structure: &StructureOptions) -> String {
    let usual = StructureOptions::default();
    let mut text = String::new();
    let Parts {
        traversal,
        triangle,
        box_test,
    } = structure.parts;
    for (name, is, usually) in [
        ("traversal", traversal.to_string(), usual.parts.traversal.to_string()),
        ("triangle", triangle.to_string(), usual.parts.triangle.to_string()),
        ("box", box_test.to_string(), usual.parts.box_test.to_string()),
        ("build", structure.preset.name().into(), usual.preset.name().into()),
    ] {
        if is != usually {
            let _ = write!(text, " --{name} {is}");
        }
    }
    // Limits of what it does not traverse are refused.
    let (octree, grid) = (structure.octree, structure.grid);
    let traversal = structure.parts.traversal;
    if traversal == TraversalKind::Octree && octree != usual.octree {
        let _ = write!(text, " --octree depth={},budget={}", octree.depth, octree.budget);
        if let Some(leaf) = octree.leaf {
            let _ = write!(text, ",leaf={leaf}");
        }
    }
    if traversal == TraversalKind::Grid && grid != usual.grid {
        let _ = write!(text, " --grid density={},budget={}", grid.density, grid.budget);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::mesh_source::MeshSource;
    use crate::progress::silent;
    use crate::trace::Trace;
    use crate::view::View;
    use oktant_shared::parts::TraversalKind;

    /// Oracle: `oktant trace` of the same ray.
    #[test]
    fn a_pinned_ray_is_traced_as_by_its_command() {
        let mesh = balls::balls();
        for traversal in [TraversalKind::Octants, TraversalKind::Grid] {
            let structure = StructureOptions::of(traversal);
            let scene = Scene::new(&mesh, &structure, &silent).unwrap();
            let frame = View::default().frame(&scene, 64, 48);
            let source = Source::Mesh(MeshSource::Balls);
            let mut hits = 0;
            for pixel in [[32, 24], [20, 24], [40, 30], [0, 0]] {
                let pinned = Pinned::new(&scene, &frame, pixel);
                let pinned = pinned.replayed(&scene, &frame, &source, DVec3::ZERO, &structure);
                let command = pinned.command.clone().unwrap();
                let numbers = command.split(' ').nth(4).unwrap().split(',');
                let numbers: Vec<f32> = numbers.map(|number| number.parse().unwrap()).collect();
                let ray = Ray::new(Vec3::from_slice(&numbers), Vec3::from_slice(&numbers[3..]));
                assert_eq!(ray, super::ray(&middles(&frame), pixel), "{command}");
                assert_eq!(command.ends_with(" --traversal grid"), traversal == TraversalKind::Grid);
                let trace = Trace::new(&mesh, &scene, &ray);
                let found = pinned.found.map(|found| (found.hit.triangle, f64::from(found.hit.t)));
                assert_eq!(found, trace.hit.map(|hit| (hit.triangle, hit.t)), "{pixel:?}");
                let further: Vec<u32> = pinned.further.iter().map(|hit| hit.triangle).collect();
                let beyond: Vec<u32> = trace.beyond.iter().map(|hit| hit.triangle).collect();
                assert_eq!(further, beyond, "{pixel:?}");
                assert_eq!(pinned.counts.triangle_tests as usize, trace.tests.len());
                assert_eq!(pinned.cells.len(), trace.visits.len(), "none is visited twice");
                hits += usize::from(trace.hit.is_some());
            }
            assert!((1..4).contains(&hits), "{traversal}: {hits}");
        }
    }

    #[test]
    fn what_is_behind_the_hit_is_told_up_to_six() {
        let at = |triangle: u32| Hit {
            t: 1.0 + 0.5 * triangle as f32,
            triangle,
            u: 0.0,
            v: 0.0,
        };
        let behind = |further: Vec<Hit>| -> Vec<String> {
            let pinned = Pinned {
                pixel: [0, 0],
                found: Some(Found {
                    hit: at(0),
                    normal: Vec3::Z,
                    material: 0,
                }),
                further,
                counts: Counts::default(),
                cells: Vec::new(),
                command: None,
            };
            let lines = pinned.lines(80).into_iter().map(|line| line.text);
            lines.filter(|line| line.starts_with("then ")).collect()
        };
        assert!(behind(Vec::new()).is_empty());
        let plane = Hit {
            triangle: PLANE | 4,
            ..at(3)
        };
        assert_eq!(
            behind(vec![at(1), plane]),
            ["then triangle 1, t 1.5", "then plane 4, t 2.5"]
        );
        let six = behind((1..=6).map(at).collect());
        assert_eq!((six.len(), &*six[5]), (6, "then triangle 6, t 4"));
        let many = behind((1..=8).map(at).collect());
        assert_eq!((many.len(), &many[..6], &*many[6]), (7, &six[..], "then 2 more"));
    }

    #[test]
    fn no_command_traces_several_meshes() {
        let structure = StructureOptions::default();
        let scene = Scene::new(&balls::balls(), &structure, &silent).unwrap();
        let frame = View::default().frame(&scene, 64, 48);
        let replayed = |source| {
            let pinned = Pinned::new(&scene, &frame, [32, 24]);
            pinned.replayed(&scene, &frame, &source, DVec3::ZERO, &structure)
        };
        let several = replayed(Source::Several(vec![MeshSource::Balls; 2]));
        assert_eq!(several.command, None);
        assert_eq!(
            several.lines(80)[0].text,
            "pinned: the ray of pixel 32, 24   Esc: unpin",
            "its parts stay apart"
        );
        let last = several.lines(80).pop().unwrap().text;
        assert_eq!(last, "oktant trace takes one file, without planes");
        assert!(replayed(Source::Mesh(MeshSource::Balls)).command.is_some());
    }

    #[test]
    fn names_and_options_are_as_a_shell_takes_them() {
        assert_eq!(quoted("a/b-1.ply"), "a/b-1.ply");
        assert_eq!(quoted("it's mine.ply"), r"'it'\''s mine.ply'");
        let mut structure = StructureOptions::of(TraversalKind::Octree);
        structure.octree.depth = 5;
        let text = options(&structure);
        assert_eq!(text, " --traversal octree --octree depth=5,budget=16");
        structure.octree.leaf = Some(8);
        assert!(options(&structure).ends_with(" --octree depth=5,budget=16,leaf=8"));
        assert_eq!(options(&StructureOptions::default()), "");
    }
}
