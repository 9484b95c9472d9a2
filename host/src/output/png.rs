//! PNG files.

use super::Bits;
use crate::picture::Picture;
use crate::tone::Tone;
use ::png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter, SrgbRenderingIntent};
use std::borrow::Cow;
use std::io::{self, Write};

/// A picture as a PNG file has it.
pub struct Png<'a> {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row by row from the upper left.
    pub pixels: Pixels<'a>,
    /// What the pixels mean, for files that hold anything but sRGB colours.
    pub description: Option<String>,
}

/// Channels, pixel by pixel.
pub enum Pixels<'a> {
    /// Red, green and blue.
    Rgb8(Cow<'a, [u8]>),
    /// Red, green and blue.
    Rgb16(Vec<u16>),
    /// Grey.
    Gray16(Vec<u16>),
}

impl Png<'_> {
    /// Writes the file.
    pub fn write(&self, writer: impl Write) -> io::Result<()> {
        let size = [self.width, self.height];
        let encoder = encoder(writer, size, &self.pixels, self.description.as_deref()).map_err(failed)?;
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(&self.pixels.bytes()).map_err(failed)?;
        writer.finish().map_err(failed)
    }
}

impl Pixels<'_> {
    /// The colours of a picture, with so many bits.
    pub fn of(picture: &Picture, tone: &Tone, bits: Bits) -> Self {
        match bits {
            Bits::Eight => Pixels::Rgb8(picture.to_rgb8(tone).into()),
            Bits::Sixteen => Pixels::Rgb16(picture.to_rgb16(tone)),
        }
    }

    /// The channels as they stand in a file before they are compressed.
    pub fn bytes(&self) -> Cow<'_, [u8]> {
        match self {
            Pixels::Rgb8(channels) => Cow::Borrowed(channels.as_ref()),
            Pixels::Rgb16(channels) | Pixels::Gray16(channels) => big_endian(channels),
        }
    }
}

/// What writes pictures with channels like those of `pixels`, sRGB colours unless a description says what they are.
pub fn encoder<W: Write>(
    writer: W,
    [width, height]: [u32; 2],
    pixels: &Pixels<'_>,
    description: Option<&str>,
) -> Result<Encoder<'static, W>, EncodingError> {
    let mut encoder = Encoder::new(writer, width, height);
    encoder.set_compression(Compression::Balanced);
    encoder.set_filter(Filter::Adaptive);
    let (color, depth) = match pixels {
        Pixels::Rgb8(_) => (ColorType::Rgb, BitDepth::Eight),
        Pixels::Rgb16(_) => (ColorType::Rgb, BitDepth::Sixteen),
        Pixels::Gray16(_) => (ColorType::Grayscale, BitDepth::Sixteen),
    };
    encoder.set_color(color);
    encoder.set_depth(depth);
    match description {
        Some(description) => encoder.add_text_chunk("Description".into(), description.into())?,
        None => encoder.set_source_srgb(SrgbRenderingIntent::Perceptual),
    }
    Ok(encoder)
}

/// What the system said, where it was the system.
pub fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

fn big_endian(channels: &[u16]) -> Cow<'static, [u8]> {
    channels.iter().flat_map(|channel| channel.to_be_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ColorType, DynamicImage};

    fn written(pixels: Pixels<'_>, description: Option<&str>) -> Vec<u8> {
        let mut bytes = Vec::new();
        Png {
            width: 2,
            height: 1,
            pixels,
            description: description.map(String::from),
        }
        .write(&mut bytes)
        .unwrap();
        bytes
    }

    fn read(bytes: &[u8]) -> DynamicImage {
        image::load_from_memory(bytes).unwrap()
    }

    #[test]
    fn all_kinds_come_back() {
        let eight = read(&written(Pixels::Rgb8(Cow::Borrowed(&[0, 1, 2, 253, 254, 255])), None));
        assert_eq!(eight.color(), ColorType::Rgb8);
        assert_eq!(eight.into_rgb8().into_raw(), [0, 1, 2, 253, 254, 255]);
        let sixteen = read(&written(Pixels::Rgb16(vec![0, 1, 258, 513, 65_534, 65_535]), None));
        assert_eq!(sixteen.color(), ColorType::Rgb16);
        assert_eq!(sixteen.into_rgb16().into_raw(), [0, 1, 258, 513, 65_534, 65_535]);
        let gray = read(&written(Pixels::Gray16(vec![258, 65_535]), None));
        assert_eq!(gray.color(), ColorType::L16);
        assert_eq!(gray.into_luma16().into_raw(), [258, 65_535]);
    }

    #[test]
    fn a_file_says_what_it_holds() {
        let chunks = |bytes: &[u8]| {
            let reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
            let info = reader.info();
            let text = info.uncompressed_latin1_text.first();
            (info.srgb.is_some(), text.map(|chunk| chunk.text.clone()))
        };
        let gray = || Pixels::Gray16(vec![0, 1]);
        assert_eq!(chunks(&written(gray(), None)), (true, None));
        assert_eq!(chunks(&written(gray(), Some("depth"))), (false, Some("depth".into())));
    }
}
