//! PNG files.

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
        let failed = |error| match error {
            EncodingError::IoError(error) => error,
            other => io::Error::other(other),
        };
        let mut encoder = Encoder::new(writer, self.width, self.height);
        encoder.set_compression(Compression::Balanced);
        encoder.set_filter(Filter::Adaptive);
        let (color, depth, bytes) = match &self.pixels {
            Pixels::Rgb8(channels) => (ColorType::Rgb, BitDepth::Eight, Cow::Borrowed(channels.as_ref())),
            Pixels::Rgb16(channels) => (ColorType::Rgb, BitDepth::Sixteen, big_endian(channels)),
            Pixels::Gray16(channels) => (ColorType::Grayscale, BitDepth::Sixteen, big_endian(channels)),
        };
        encoder.set_color(color);
        encoder.set_depth(depth);
        match &self.description {
            Some(description) => encoder
                .add_text_chunk("Description".into(), description.clone())
                .map_err(failed)?,
            None => encoder.set_source_srgb(SrgbRenderingIntent::Perceptual),
        }
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(&bytes).map_err(failed)?;
        writer.finish().map_err(failed)
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
