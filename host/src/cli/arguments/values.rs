//! Values on the command line.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use oktant::aov::Aov;
use oktant::grid::GridOptions;
use oktant::octree::OctreeOptions;
use oktant::oracle::whitted::Takes;
use oktant::picture::{DEFAULT_SIZE, LARGEST_PICTURE, LARGEST_SIDE};
use oktant::preferences::Preferences;
use oktant::tree::BuildPreset;
use oktant::wires::Selection;
use oktant_shared::octree::MAX_DEPTH;
use oktant_shared::parts::{BoxKind, TraversalKind, TriangleKind};

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    pub width: u32,
    pub height: u32,
}

impl Default for Size {
    fn default() -> Self {
        DEFAULT_SIZE.into()
    }
}

impl Size {
    /// The size of pictures for which nobody says one.
    pub fn preferred() -> Self {
        Preferences::of_process().size.into()
    }
}

impl From<[u32; 2]> for Size {
    fn from([width, height]: [u32; 2]) -> Self {
        Size { width, height }
    }
}

pub fn size(text: &str) -> Result<Size, String> {
    let wanted = "give width and height in pixels, for example 1280x968";
    let (width, height) = text.split_once(['x', 'X']).ok_or(wanted)?;
    let side = |text: &str| text.trim().parse::<u32>().map_err(|_| wanted);
    let size = Size {
        width: side(width)?,
        height: side(height)?,
    };
    if size.width == 0 || size.height == 0 {
        return Err("a picture needs at least 1x1 pixels".into());
    }
    let pixels = u64::from(size.width) * u64::from(size.height);
    if size.width.max(size.height) > LARGEST_SIDE || pixels > LARGEST_PICTURE {
        return Err(format!(
            "give at most {LARGEST_SIDE} pixels a side and {LARGEST_PICTURE} in all"
        ));
    }
    Ok(size)
}

/// Samples of the reference: a square number, or nothing for those that the scene asks for.
pub fn takes(text: &str) -> Result<Takes, String> {
    if text.is_empty() {
        return Ok(Takes::View);
    }
    let side = text.trim().parse::<u32>().ok().map(u32::isqrt);
    match side {
        Some(side) if (1..=64).contains(&side) && text.trim() == (side * side).to_string() => Ok(Takes::Grid(side)),
        _ => Err("give the square of a whole number from 1 to 64: 1, 4, 9, ... 4096".into()),
    }
}

/// Limits of the octree as given; what is not given keeps its default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Octree(pub OctreeOptions);

pub fn octree(text: &str) -> Result<Octree, String> {
    let mut options = OctreeOptions::default();
    let mut given = Vec::new();
    for part in text.split(',').filter(|part| !part.trim().is_empty()) {
        let wanted = "give any of depth=0..13, leaf=N and budget=N, separated by commas";
        let (name, value) = part.split_once('=').ok_or(wanted)?;
        let value: u32 = value.trim().parse().map_err(|_| wanted)?;
        match once(name.trim(), &mut given)? {
            "depth" if value <= MAX_DEPTH => options.depth = value,
            "leaf" if value >= 1 => options.leaf = Some(value),
            "budget" if (1..=256).contains(&value) => options.budget = value,
            "depth" => return Err(format!("depth is at most {MAX_DEPTH}")),
            "leaf" => return Err("leaf is at least 1".into()),
            "budget" => return Err("budget is 1 to 256".into()),
            _ => return Err(wanted.into()),
        }
    }
    Ok(Octree(options))
}

/// Limits of the grid as given; what is not given keeps its default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grid(pub GridOptions);

pub fn grid(text: &str) -> Result<Grid, String> {
    let mut options = GridOptions::default();
    let mut given = Vec::new();
    for part in text.split(',').filter(|part| !part.trim().is_empty()) {
        let wanted = "give any of density=0.01..100 and budget=1..256, separated by commas";
        let (name, value) = part.split_once('=').ok_or(wanted)?;
        let value = value.trim();
        match once(name.trim(), &mut given)? {
            "density" => options.density = value.parse().map_err(|_| wanted)?,
            "budget" => options.budget = value.parse().map_err(|_| wanted)?,
            _ => return Err(wanted.into()),
        }
    }
    if !(0.01..=100.0).contains(&options.density) {
        return Err("density is 0.01 to 100".into());
    }
    if !(1..=256).contains(&options.budget) {
        return Err("budget is 1 to 256".into());
    }
    Ok(Grid(options))
}

/// The name of a limit, unless it is among those that were given before.
fn once<'a>(name: &'a str, given: &mut Vec<&'a str>) -> Result<&'a str, String> {
    if given.contains(&name) {
        return Err(format!("give {name} once"));
    }
    given.push(name);
    Ok(name)
}

macro_rules! names {
    ($(#[$doc:meta])* $function:ident, $kind:ty) => {
        $(#[$doc])*
        pub fn $function() -> impl TypedValueParser<Value = $kind> {
            let names = <$kind>::ALL.iter().map(|kind| kind.description().name);
            PossibleValuesParser::new(names).try_map(|name| <$kind>::from_name(&name).ok_or("there is no such part"))
        }
    };
}

names!(
    /// Reads the name of a traversal, and knows all of them.
    traversal,
    TraversalKind
);
names!(
    /// Reads the name of a triangle test, and knows all of them.
    triangle,
    TriangleKind
);
names!(
    /// Reads the name of a box test, and knows all of them.
    box_test,
    BoxKind
);

/// Reads the name of a way to build, and knows all of them.
pub fn preset() -> impl TypedValueParser<Value = BuildPreset> {
    let names = BuildPreset::ALL.map(BuildPreset::name);
    PossibleValuesParser::new(names).try_map(|name| {
        let preset = BuildPreset::ALL.into_iter().find(|preset| preset.name() == name);
        preset.ok_or("there is no such way to build")
    })
}

/// What is to be told of pixels beside their colour, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Aovs(pub Vec<Aov>);

pub fn aovs(text: &str) -> Result<Aovs, String> {
    let mut list = Vec::new();
    for name in text.split(',').map(str::trim).filter(|name| !name.is_empty()) {
        match Aov::ALL.into_iter().find(|aov| aov.name() == name) {
            Some(aov) => list.push(aov),
            None if name == "all" => list.extend(Aov::ALL),
            None => {
                let names = Aov::ALL.map(Aov::name).join(", ");
                return Err(format!("give any of {names}, separated by commas, or all"));
            }
        }
    }
    list.sort();
    list.dedup();
    Ok(Aovs(list))
}

/// Cells to draw.
pub fn cells(text: &str) -> Result<Selection, String> {
    let wanted = "give all, a level such as 3, or a pixel such as 640,480";
    let whole = |text: &str| text.trim().parse::<u32>().map_err(|_| wanted.to_owned());
    match text.split_once(',') {
        Some((x, y)) => Ok(Selection::Pixel([whole(x)?, whole(y)?])),
        None if text == "all" => Ok(Selection::Leaves),
        None => whole(text).map(Selection::Level),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selections_of_cells() {
        assert_eq!(cells("all"), Ok(Selection::Leaves));
        assert_eq!(cells("3"), Ok(Selection::Level(3)));
        assert_eq!(cells("640, 12"), Ok(Selection::Pixel([640, 12])));
        for bad in ["", "some", "-1", "1.5", "1,2,3", "1,"] {
            assert!(cells(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sizes() {
        assert_eq!(
            size("640x480"),
            Ok(Size {
                width: 640,
                height: 480
            })
        );
        for bad in [
            "",
            "640",
            "640x",
            "0x10",
            "10x0",
            "-1x5",
            "1e3x5",
            "99999x1",
            "32768x32768",
        ] {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn lists_of_aovs() {
        assert_eq!(aovs("").unwrap().0, []);
        assert_eq!(aovs("rays, depth,rays").unwrap().0, [Aov::Depth, Aov::Rays]);
        assert_eq!(aovs("all").unwrap().0, Aov::ALL);
        assert!(aovs("colour").unwrap_err().contains("barycentrics"));
    }

    #[test]
    fn grid_limits() {
        assert_eq!(grid("").unwrap().0, GridOptions::default());
        let options = grid("density=0.5, budget=8").unwrap().0;
        assert_eq!((options.density, options.budget), (0.5, 8));
        for bad in [
            "density",
            "density=0",
            "density=NaN",
            "density=101",
            "budget=0",
            "budget=257",
            "leaf=3",
            "density=1,density=1",
        ] {
            assert!(grid(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn octree_limits() {
        assert_eq!(octree("").unwrap().0, OctreeOptions::default());
        let options = octree("depth=5, leaf=3").unwrap().0;
        assert_eq!((options.depth, options.leaf), (5, Some(3)));
        for bad in ["depth", "depth=14", "leaf=0", "budget=0", "size=3", "depth=-1"] {
            assert!(octree(bad).is_err(), "{bad}");
        }
        assert_eq!(octree("leaf=4, leaf=5"), Err("give leaf once".into()));
    }
}
