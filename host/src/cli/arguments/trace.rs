//! What `oktant trace` takes.

use super::StructureArguments;
use crate::cli::Failure;
use clap::Args;
use glam::{DVec3, Vec3};
use oktant::stability::row_ids_with_mesh;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct TraceArguments {
    /// A scene file (TOML), a mesh file (glTF, OBJ, PLY, STL, PTRI or MSH1), one of the built-in meshes `bunny`, `balls` and `stadium`,
    /// `lab:ROW` (the mesh of that row of `oktant stability`), or `box:x,y,z,x,y,z` (a box from corner to corner).
    #[arg(value_parser = source)]
    pub mesh: TraceSource,
    /// The ray: where it starts and where it goes, in the file's coordinates; then tmin and tmax if you like.
    #[arg(long, value_name = "ox,oy,oz,dx,dy,dz", value_parser = ray, allow_hyphen_values = true)]
    pub ray: RayArgument,
    /// Smallest t that counts, in lengths of the direction [default: 0].
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub tmin: Option<f32>,
    /// Largest t that counts [default: there is none].
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub tmax: Option<f32>,
    #[command(flatten)]
    pub structure: StructureArguments,
    /// Print everything as JSON.
    #[arg(long)]
    pub json: bool,
    /// Write the boxes of all that was visited, and the triangles that were tested, into a mesh file.
    #[arg(long, value_name = "FILE.ply|FILE.obj")]
    pub export: Option<PathBuf>,
}

/// What the ray is traced at.
#[derive(Clone, Debug)]
pub enum TraceSource {
    /// The mesh of a row of the lab.
    Row(&'static str),
    /// A box between two corners.
    Box(Vec3, Vec3),
    /// What a path, or the name of a built-in mesh, says.
    Path(PathBuf),
}

/// A ray as a person writes it. Numbers of f32 stay what they are.
#[derive(Clone, Copy, Debug)]
pub struct RayArgument {
    pub origin: DVec3,
    pub direction: DVec3,
    pub limits: Option<[f32; 2]>,
}

impl TraceArguments {
    /// Whether the export is an OBJ file.
    ///
    /// # Errors
    /// A name that says neither.
    pub fn is_obj(&self) -> Result<bool, Failure> {
        let Some(path) = &self.export else {
            return Ok(false);
        };
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("obj") => Ok(true),
            Some("ply") => Ok(false),
            _ => Err(Failure::usage(format!(
                "{}: the name says no format that can be written; let it end with .ply or .obj.",
                path.display()
            ))),
        }
    }
}

fn source(text: &str) -> Result<TraceSource, String> {
    if let Some(row) = text.strip_prefix("lab:") {
        let rows = row_ids_with_mesh();
        return match rows.iter().find(|id| **id == row) {
            Some(id) => Ok(TraceSource::Row(id)),
            None => Err(format!("give one of these rows: {}", rows.join(", "))),
        };
    }
    if let Some(corners) = text.strip_prefix("box:") {
        let wanted = "give the two corners of a box as six numbers, for example box:0,0,0,1,1,1";
        let [a, b, c, d, e, f] = numbers::<f32>(corners, wanted)?[..] else {
            return Err(wanted.into());
        };
        return Ok(TraceSource::Box(Vec3::new(a, b, c), Vec3::new(d, e, f)));
    }
    Ok(TraceSource::Path(text.into()))
}

fn ray(text: &str) -> Result<RayArgument, String> {
    let wanted = "give origin and direction as six numbers separated by commas, or eight with tmin and tmax";
    let (values, limits) = match numbers::<f64>(text, wanted)?[..] {
        [a, b, c, d, e, f] => ([a, b, c, d, e, f], None),
        [a, b, c, d, e, f, t_min, t_max] => ([a, b, c, d, e, f], Some([t_min as f32, t_max as f32])),
        _ => return Err(wanted.into()),
    };
    let [a, b, c, d, e, f] = values;
    Ok(RayArgument {
        origin: DVec3::new(a, b, c),
        direction: DVec3::new(d, e, f),
        limits,
    })
}

fn numbers<T: std::str::FromStr>(text: &str, wanted: &str) -> Result<Vec<T>, String> {
    let number = |part: &str| part.trim().parse().map_err(|_| wanted.to_owned());
    text.split(',').map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays() {
        let limited = ray("0.1, -2,3,1e-39,-0.0,inf, 0,3e38").unwrap();
        assert_eq!(limited.origin.as_vec3(), Vec3::new(0.1, -2.0, 3.0));
        assert_eq!(limited.direction.as_vec3().x, 1e-39);
        assert_eq!(limited.limits, Some([0.0, 3e38]));
        assert_eq!(ray("0,0,0,0,0,NaN").unwrap().limits, None);
        for bad in ["", "1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,4,5,6,7,8,9"] {
            assert!(ray(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sources() {
        assert!(matches!(source("lab:edges"), Ok(TraceSource::Row("edges"))));
        assert!(source("lab:edgy").unwrap_err().contains("edges-offset"));
        assert!(matches!(
            source("box:0,0,0,1,1,1"),
            Ok(TraceSource::Box(Vec3::ZERO, Vec3::ONE))
        ));
        assert!(source("box:1,2").is_err());
        assert!(matches!(source("bunny"), Ok(TraceSource::Path(_))));
    }
}
