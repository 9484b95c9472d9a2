//! What is counted, and what is kept of it.

use oktant_shared::ray::Ray;
use serde::Serialize;

/// How many of a method's answers are wrong, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rays in all.
    pub rays: usize,
    /// There is a hit, the method has none.
    pub missed: usize,
    /// The method has a hit where there is none, or a nearer one than there is.
    #[serde(rename = "false")]
    pub phantom: usize,
    /// The method has a hit behind the nearest one.
    pub farther: usize,
    /// A number of the answer is not finite.
    pub not_finite: usize,
    /// The ray crosses more triangles by the method than it does exactly; no error by itself. None where it is not counted.
    pub doubled: Option<usize>,
    /// Answers of the first three kinds that are not counted there: the ray passes so close to an edge, or an end of its
    /// `t`, that f32 cannot tell.
    pub excused: usize,
    /// Work or memory beyond its bound, see the row: rays that take more than twice that of others, or references.
    pub excess: usize,
}

impl Counts {
    /// Answers that no rounding excuses.
    pub fn wrong(&self) -> usize {
        self.missed + self.phantom + self.farther + self.not_finite + self.excess
    }
}

/// A wrong answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Failure {
    /// Which kind.
    pub kind: &'static str,
    /// The ray: origin and direction, separated by commas, each the shortest decimal number that is that f32; then its least
    /// and largest `t` where it has limits. None where no ray fails, but a build.
    pub ray: Option<String>,
    /// The command that traces it again; none where there is no mesh to trace it at.
    pub replay: Option<String>,
    /// What it meets: corners of a triangle, two opposite corners of a box, or normals and the way to a light.
    pub corners: Vec<Vec<[f32; 3]>>,
    /// Where it does; none where it meets nothing.
    pub right: Option<f64>,
    /// Where the method says that it does.
    pub answer: Option<f32>,
}

impl Failure {
    /// Of a ray.
    pub fn of_ray(ray: &Ray) -> Self {
        Failure {
            ray: Some(written(ray)),
            ..Failure::default()
        }
    }

    /// With the command that traces its ray again: at a mesh, and with options for the parts.
    pub fn replayed(self, mesh: &str, options: &str) -> Self {
        let replay = self
            .ray
            .as_ref()
            .map(|ray| format!("oktant trace {mesh} --ray {ray}{options}"));
        Failure { replay, ..self }
    }
}

/// A ray in numbers that give the same ray again.
fn written(ray: &Ray) -> String {
    let mut numbers: Vec<String> = ray
        .origin
        .to_array()
        .into_iter()
        .chain(ray.direction.to_array())
        .map(number)
        .collect();
    if ray.t_min != 0.0 || ray.t_max < oktant_shared::ray::T_MAX {
        numbers.extend([ray.t_min, ray.t_max].map(number));
    }
    numbers.join(",")
}

fn number(value: f32) -> String {
    format!("{value:?}")
}
