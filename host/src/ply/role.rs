//! What the loader uses of a PLY file's properties.

use super::element::Element;
use super::fault::Fault;

/// What a property is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    X,
    Y,
    Z,
    NormalX,
    NormalY,
    NormalZ,
    Red,
    Green,
    Blue,
    Alpha,
    TextureS,
    TextureT,
    Corners,
}

impl Role {
    /// The name under which ply-rs hands the property over.
    ///
    /// One letter, since ply-rs copies the name for every value; and independent of the file's names, of which two
    /// may be equal, which ply-rs would silently merge.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::NormalX => "u",
            Self::NormalY => "v",
            Self::NormalZ => "w",
            Self::Red => "r",
            Self::Green => "g",
            Self::Blue => "b",
            Self::Alpha => "a",
            Self::TextureS => "s",
            Self::TextureT => "t",
            Self::Corners => "c",
        }
    }

    /// The reverse of [`Self::key`].
    pub(super) fn of_key(key: &str) -> Option<Self> {
        Some(match key.as_bytes() {
            b"x" => Self::X,
            b"y" => Self::Y,
            b"z" => Self::Z,
            b"u" => Self::NormalX,
            b"v" => Self::NormalY,
            b"w" => Self::NormalZ,
            b"r" => Self::Red,
            b"g" => Self::Green,
            b"b" => Self::Blue,
            b"a" => Self::Alpha,
            b"s" => Self::TextureS,
            b"t" => Self::TextureT,
            b"c" => Self::Corners,
            _ => return None,
        })
    }

    pub(super) fn is_coordinate(self) -> bool {
        matches!(self, Self::X | Self::Y | Self::Z)
    }

    pub(super) fn is_color(self) -> bool {
        matches!(self, Self::Red | Self::Green | Self::Blue | Self::Alpha)
    }
}

/// Gives the properties of element `vertex` their roles.
pub(super) fn assign_to_vertex(element: &mut Element) -> Result<(), Fault> {
    for (property, role) in [("x", Role::X), ("y", Role::Y), ("z", Role::Z)] {
        let column = element.find(property, false)?.ok_or(Fault::NoCoordinate { property })?;
        element.columns[column].role = Some(role);
    }
    let normal = [
        element.find("nx", false)?,
        element.find("ny", false)?,
        element.find("nz", false)?,
    ];
    if let [Some(x), Some(y), Some(z)] = normal {
        element.columns[x].role = Some(Role::NormalX);
        element.columns[y].role = Some(Role::NormalY);
        element.columns[z].role = Some(Role::NormalZ);
    }
    assign_texture(element)?;
    assign_colors(element)
}

/// Gives the properties of element `face` or `tristrips` their roles.
pub(super) fn assign_to_face(element: &mut Element) -> Result<(), Fault> {
    let column = match element.find("vertex_indices", true)? {
        Some(column) => Some(column),
        None => element.find("vertex_index", true)?,
    };
    let column = column.ok_or_else(|| Fault::NoIndices {
        element: element.name.clone(),
    })?;
    element.columns[column].role = Some(Role::Corners);
    assign_colors(element)
}

fn assign_texture(element: &mut Element) -> Result<(), Fault> {
    for (s, t) in [
        ("s", "t"),
        ("u", "v"),
        ("texture_u", "texture_v"),
        ("texture_s", "texture_t"),
    ] {
        if let (Some(s), Some(t)) = (element.find(s, false)?, element.find(t, false)?) {
            element.columns[s].role = Some(Role::TextureS);
            element.columns[t].role = Some(Role::TextureT);
            break;
        }
    }
    Ok(())
}

fn assign_colors(element: &mut Element) -> Result<(), Fault> {
    for [red, green, blue, alpha] in [
        ["red", "green", "blue", "alpha"],
        ["diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"],
        ["r", "g", "b", "a"],
    ] {
        let color = [
            element.find(red, false)?,
            element.find(green, false)?,
            element.find(blue, false)?,
        ];
        if let [Some(red), Some(green), Some(blue)] = color {
            element.columns[red].role = Some(Role::Red);
            element.columns[green].role = Some(Role::Green);
            element.columns[blue].role = Some(Role::Blue);
            if let Some(alpha) = element.find(alpha, false)? {
                element.columns[alpha].role = Some(Role::Alpha);
            }
            break;
        }
    }
    Ok(())
}
