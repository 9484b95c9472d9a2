//! Where the bytes of a buffer or image are.

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;
use std::path::{Path, PathBuf};

/// Some programs leave the padding out.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Whether a URI holds its bytes itself.
pub(super) fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// The bytes that a URI holds itself; none where it does not, or not in base64.
pub(super) fn data(uri: &str) -> Option<Vec<u8>> {
    if !is_data(uri) {
        return None;
    }
    let (kind, data) = uri.split_once(',')?;
    if !kind.ends_with(";base64") {
        return None;
    }
    BASE64.decode(data).ok()
}

/// The path of the file in `folder` that a URI names; none for other URIs.
pub(super) fn path(uri: &str, folder: &Path) -> Option<PathBuf> {
    // One letter before the colon is a drive.
    let scheme = uri.split_once(':').map_or("", |(scheme, _)| scheme);
    if scheme.len() > 1
        && scheme
            .bytes()
            .all(|byte| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte))
    {
        return None;
    }
    let decoded = percent_decode_str(uri).decode_utf8_lossy();
    let path = folder.join(decoded.as_ref());
    // Some programs write names as they are.
    Some(if path.exists() {
        path
    } else {
        Some(folder.join(uri)).filter(|raw| raw.exists()).unwrap_or(path)
    })
}
