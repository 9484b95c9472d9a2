//! Numbers in buffers.

use super::buffers::Buffers;
use super::document::{Accessor, Document};
use super::fault::{Fault, Place};

/// Elements that may be zero without a byte of data, but for the sparse ones that are not.
const MOST_ZEROS: u64 = 1 << 20;

/// The type of a component, by its number in OpenGL.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Component {
    I8 = 5120,
    U8 = 5121,
    I16 = 5122,
    U16 = 5123,
    U32 = 5125,
    F32 = 5126,
}

impl Component {
    fn of(number: u32) -> Option<Self> {
        use Component::{F32, I8, I16, U8, U16, U32};
        [I8, U8, I16, U16, U32, F32]
            .into_iter()
            .find(|kind| *kind as u32 == number)
    }

    fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// The number in as many bytes as it has; of 0 to 1, or -1 to 1, where it is normalised.
    fn number(self, bytes: &[u8], normalized: bool) -> f32 {
        let word = self.word(bytes);
        let (value, most) = match self {
            Component::F32 => return f32::from_bits(word),
            Component::I8 => (f32::from(word as u8 as i8), 127.0),
            Component::U8 => (f32::from(word as u8), 255.0),
            Component::I16 => (f32::from(word as u16 as i16), 32_767.0),
            Component::U16 => (f32::from(word as u16), 65_535.0),
            Component::U32 => (word as f32, u32::MAX as f32),
        };
        if normalized { (value / most).max(-1.0) } else { value }
    }

    /// The bits of the number.
    fn word(self, bytes: &[u8]) -> u32 {
        let mut word = [0; 4];
        word[..self.size()].copy_from_slice(&bytes[..self.size()]);
        u32::from_le_bytes(word)
    }
}

/// What an accessor may be where it is used.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// "SCALAR", "VEC2" and so on.
    pub(super) kinds: &'static [&'static str],
    /// The same in words, with the types of components.
    pub(super) words: &'static str,
}

/// Reads vectors of f32, of which those with fewer components than `N` are filled up with `rest`.
pub(super) fn vectors<const N: usize>(
    document: &Document,
    buffers: &Buffers<'_>,
    id: usize,
    wanted: Wanted,
    rest: f32,
) -> Result<Vec<[f32; N]>, Fault> {
    let normalized = document.accessor(id)?.normalized;
    read(document, buffers, id, wanted, |component, bytes| {
        let mut vector = [rest; N];
        for (value, bytes) in vector.iter_mut().zip(bytes.chunks_exact(component.size())) {
            *value = component.number(bytes, normalized);
        }
        Ok(vector)
    })
}

/// Reads indices.
pub(super) fn indices(document: &Document, buffers: &Buffers<'_>, id: usize) -> Result<Vec<u32>, Fault> {
    let wanted = Wanted {
        kinds: &["SCALAR"],
        words: "SCALAR of unsigned integers (5121, 5123 or 5125)",
    };
    let accessor = document.accessor(id)?;
    read(document, buffers, id, wanted, |component, bytes| match component {
        Component::U8 | Component::U16 | Component::U32 => Ok(component.word(bytes)),
        _ => Err(wrong_kind(accessor, id, wanted)),
    })
}

fn wrong_kind(accessor: &Accessor, id: usize, wanted: Wanted) -> Fault {
    Fault::Kind {
        place: Place::of("accessors", id),
        found: format!(
            "{} of components {}",
            accessor.kind.escape_debug().take(40).collect::<String>(),
            accessor.component_type
        ),
        wanted: wanted.words,
    }
}

fn read<T: Clone>(
    document: &Document,
    buffers: &Buffers<'_>,
    id: usize,
    wanted: Wanted,
    element: impl Fn(Component, &[u8]) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let accessor = document.accessor(id)?;
    let place = Place::of("accessors", id);
    let component = Component::of(accessor.component_type);
    let components = match accessor.kind.as_str() {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 0,
    };
    let Some(component) = component.filter(|_| wanted.kinds.contains(&accessor.kind.as_str()) && components > 0) else {
        return Err(wrong_kind(accessor, id, wanted));
    };
    let size = components * component.size();
    let mut all = match accessor.buffer_view {
        Some(view) => {
            let stride = document.view(view)?.byte_stride.unwrap_or(size as u64);
            if stride < size as u64 {
                return Err(Fault::Stride {
                    place: Place::of("bufferViews", view),
                    stride,
                    size: size as u64,
                });
            }
            let bytes = strided(
                buffers.view(document, view)?,
                accessor.byte_offset,
                accessor.count,
                stride,
                size,
                &place,
            )?;
            bytes
                .map(|bytes| element(component, bytes))
                .collect::<Result<Vec<T>, Fault>>()?
        }
        None if accessor.count > MOST_ZEROS => {
            return Err(Fault::TooManyZeros {
                place,
                count: accessor.count,
                most: MOST_ZEROS,
            });
        }
        None => vec![element(component, &[0; 16][..size])?; accessor.count as usize],
    };
    let Some(sparse) = &accessor.sparse else {
        return Ok(all);
    };
    let place = place.field("sparse");
    let index = match Component::of(sparse.indices.component_type) {
        Some(index @ (Component::U8 | Component::U16 | Component::U32)) => index,
        _ => {
            return Err(Fault::Value {
                place: place.field("indices.componentType"),
                value: f64::from(sparse.indices.component_type),
                wanted: "5121, 5123 or 5125",
            });
        }
    };
    let part = |part: &super::document::SparsePart, size: usize| {
        let view = buffers.view(document, part.buffer_view)?;
        strided(view, part.byte_offset, sparse.count, size as u64, size, &place)
    };
    for (at, bytes) in part(&sparse.indices, index.size())?.zip(part(&sparse.values, size)?) {
        let at = index.word(at);
        let count = all.len();
        let slot = all.get_mut(at as usize).ok_or_else(|| Fault::NoSuch {
            place: Place::of(&format!("the element of accessors[{id}]"), at as usize),
            count,
        })?;
        *slot = element(component, bytes)?;
    }
    Ok(all)
}

/// The bytes of `count` elements, `stride` apart, which is not less than their size.
fn strided<'a>(
    view: &'a [u8],
    offset: u64,
    count: u64,
    stride: u64,
    size: usize,
    place: &Place,
) -> Result<impl Iterator<Item = &'a [u8]>, Fault> {
    let reach = match count {
        0 => offset,
        count => (count - 1)
            .saturating_mul(stride)
            .saturating_add(offset)
            .saturating_add(size as u64),
    };
    if reach > view.len() as u64 {
        return Err(Fault::Beyond {
            place: place.clone(),
            reach,
            length: view.len() as u64,
        });
    }
    Ok((0..count as usize).map(move |i| &view[offset as usize + i * stride as usize..][..size]))
}
