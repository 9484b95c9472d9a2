//! Binary files: 80 bytes of comment, the number of facets, and for each its normal, its corners (f32) and 2 bytes.

use super::fault::Fault;
use super::welder::Welder;
use glam::{DVec3, Vec3};

/// Bytes before the first facet.
const HEADER: usize = 84;
/// Bytes of a facet.
const FACET: usize = 50;
/// Facets between two reports of progress.
const BLOCK: usize = 1 << 16;

/// How many facets the header promises; none where there is no whole header.
fn promised(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

/// Whether the file is as long as its header says.
pub(super) fn is_exact(bytes: &[u8]) -> bool {
    promised(bytes).is_some_and(|count| count > 0 && (bytes.len() - HEADER) as u64 == u64::from(count) * FACET as u64)
}

/// Reads all facets.
pub(super) fn read(bytes: &[u8], name: &str, welder: &mut Welder, progress: impl Fn(f32)) -> Result<(), Fault> {
    let promised = promised(bytes).ok_or(Fault::NotStl)?;
    let facets = &bytes[HEADER..];
    let length = u64::from(promised) * FACET as u64;
    if (facets.len() as u64) < length {
        return Err(Fault::CutShort {
            promised,
            found: facets.len() / FACET,
        });
    }
    // Not more than there are bytes in memory.
    let (facets, surplus) = facets.split_at(length as usize);
    if !surplus.is_empty() {
        tracing::warn!("{name}: {} bytes after the last facet are ignored", surplus.len());
    }
    for (i, facet) in facets.chunks_exact(FACET).enumerate() {
        if i % BLOCK == 0 {
            progress((i as f64 / f64::from(promised)) as f32);
        }
        let mut corners = [DVec3::ZERO; 3];
        for (corner, bytes) in corners.iter_mut().zip(facet[12..48].as_chunks::<12>().0) {
            let mut coordinates = bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes));
            let mut next = || coordinates.next().unwrap_or_default();
            let position = Vec3::new(next(), next(), next());
            if !position.is_finite() {
                return Err(Fault::NotFinite {
                    facet: i,
                    byte: HEADER + i * FACET,
                });
            }
            *corner = position.as_dvec3();
        }
        welder.add(corners)?;
    }
    Ok(())
}
