//! `oktant trace`.

use super::Failure;
use super::arguments::{RayArgument, TraceArguments, TraceSource};
use super::progress_bar::ProgressBar;
use glam::{DVec3, Vec3};
use oktant::mesh::Mesh;
use oktant::model::Model;
use oktant::output::TextFile;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::stability::mesh_of_row;
use oktant::trace::{Trace, obj, ply, table};
use oktant_shared::ray::Ray;

/// Traces one ray, prints all that happens to it, and writes what it visited into a file.
pub fn run(arguments: &TraceArguments) -> Result<(), Failure> {
    let options = arguments.structure.options()?;
    let is_obj = arguments.is_obj()?;
    let export = arguments.export.as_deref().map(TextFile::create).transpose()?;
    let bar = ProgressBar::new();
    let progress = |stage: &'static str, fraction: f32| bar.show(stage, fraction);
    let model = match &arguments.mesh {
        TraceSource::Row(row) => Model::of_mesh(mesh_of_row(row)?),
        TraceSource::Box(low, high) => Model::of_mesh(cuboid(*low, *high)),
        TraceSource::Path(path) => Source::from_argument(Some(path)).load(&progress)?.model,
    };
    if !model.planes.is_empty() {
        return Err(Failure {
            sentence:
                "Rays are traced at triangles only, and this scene has planes; use a [[quad]] in the place of each \
                       [[plane]]."
                    .into(),
            code: 1,
        });
    }
    let mesh = model.mesh.clone();
    let scene = Scene::of_model(model, &options, &progress)?;
    drop(bar);
    let trace = Trace::new(&mesh, &scene, &ray(arguments, mesh.shift));
    let text = if arguments.json {
        format!("{}\n", serde_json::to_string_pretty(&trace)?)
    } else {
        table(&trace)
    };
    super::print(&text)?;
    if let Some(file) = export {
        file.save(&if is_obj { obj(&trace) } else { ply(&trace) })?;
    }
    Ok(())
}

/// The ray in the coordinates of the mesh as it was loaded.
fn ray(arguments: &TraceArguments, shift: DVec3) -> Ray {
    let RayArgument {
        origin,
        direction,
        limits,
    } = arguments.ray;
    // Without a shift, nothing is rounded: the numbers are those of f32.
    let mut ray = Ray::new((origin - shift).as_vec3(), direction.as_vec3());
    let [t_min, t_max] = limits.unwrap_or([ray.t_min, ray.t_max]);
    ray.t_min = arguments.tmin.unwrap_or(t_min);
    ray.t_max = arguments.tmax.unwrap_or(t_max);
    ray
}

/// The faces of a box, two triangles each.
fn cuboid(low: Vec3, high: Vec3) -> Mesh {
    let corner = |corner: usize| {
        Vec3::from_array([0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] }))
    };
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: vec![
            [0, 4, 6],
            [0, 6, 2],
            [1, 3, 7],
            [1, 7, 5],
            [0, 1, 5],
            [0, 5, 4],
            [2, 6, 7],
            [2, 7, 3],
            [0, 2, 3],
            [0, 3, 1],
            [4, 5, 7],
            [4, 7, 6],
        ],
        ..Mesh::default()
    }
}
