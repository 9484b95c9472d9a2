//! GIF files.

use ::gif::{Encoder, EncodingError, Frame, Repeat};
use std::io::{self, Write};

/// A GIF file that is written frame by frame, and is shown over and over.
pub struct Gif<W: Write> {
    encoder: Encoder<W>,
    size: [u16; 2],
    frames_per_second: u16,
    written: u32,
}

/// Of so many pixels one is looked at when 256 colours are chosen for a frame that has more.
const SPEED: i32 = 3;

impl<W: Write> Gif<W> {
    /// Begins a file. Pictures have at most 65,535 pixels a side.
    pub fn new(writer: W, size: [u32; 2], frames_per_second: u16) -> io::Result<Self> {
        let side = |pixels: u32| u16::try_from(pixels).map_err(io::Error::other);
        let size = [side(size[0])?, side(size[1])?];
        let mut encoder = Encoder::new(writer, size[0], size[1], &[]).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        Ok(Gif {
            encoder,
            size,
            frames_per_second,
            written: 0,
        })
    }

    /// Adds a frame from red, green and blue of each pixel, sRGB-encoded: as it is where it has at most 256 colours, else
    /// with the 256 that the NeuQuant algorithm chooses.
    pub fn add(&mut self, pixels: &[u8]) -> io::Result<()> {
        let mut frame = Frame::from_rgb_speed(self.size[0], self.size[1], pixels, SPEED);
        frame.delay = delay(self.written, self.frames_per_second);
        self.written += 1;
        self.encoder.write_frame(&frame).map_err(failed)
    }

    /// Ends the file.
    pub fn finish(self) -> io::Result<()> {
        self.encoder.into_inner().map_err(failed)?.flush()
    }
}

/// For how many hundredths of a second a frame is shown, so that all of them together take their time.
fn delay(frame: u32, frames_per_second: u16) -> u16 {
    let hundredths = |frames: u32| (f64::from(frames) * 100.0 / f64::from(frames_per_second)).round();
    (hundredths(frame + 1) - hundredths(frame)) as u16
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::gif::{ColorOutput, DecodeOptions};

    /// The delays of a file's frames, and their pixels without alpha.
    fn decoded(bytes: &[u8]) -> Vec<(u16, Vec<u8>)> {
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            let pixels = frame.buffer.as_chunks::<4>().0.iter();
            frames.push((
                frame.delay,
                pixels.flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(),
            ));
        }
        frames
    }

    fn written(size: [u32; 2], frames: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut gif = Gif::new(&mut bytes, size, 25).unwrap();
        for frame in frames {
            gif.add(frame).unwrap();
        }
        gif.finish().unwrap();
        bytes
    }

    #[test]
    fn few_colours_come_back_as_they_are() {
        let frames = [vec![0, 1, 2, 253, 254, 255], vec![9, 9, 9, 0, 0, 0]];
        let read = decoded(&written([2, 1], &frames));
        assert_eq!(read, frames.map(|frame| (4, frame)));
    }

    #[test]
    fn many_colours_come_back_nearly() {
        let pixel = |i: u32| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 128];
        let frame: Vec<u8> = (0..64 * 64).flat_map(pixel).collect();
        let read = decoded(&written([64, 64], std::slice::from_ref(&frame)));
        let off: u32 = frame
            .iter()
            .zip(&read[0].1)
            .map(|(is, was)| u32::from(is.abs_diff(*was)))
            .sum();
        let mean = f64::from(off) / frame.len() as f64;
        // 4096 colours of a square in 256: a grid of cells of 16 x 16 steps would be off by 2.7; the palette is found by a net
        // that learns, and learns it half as well.
        assert!(mean > 0.0 && mean < 2.0 * 8.0 / 3.0, "{mean}");
    }

    #[test]
    fn frames_take_their_time_together() {
        for rate in [1, 7, 24, 25, 30, 48, 50] {
            let all: u32 = (0..u32::from(rate) * 3)
                .map(|frame| u32::from(delay(frame, rate)))
                .sum();
            assert_eq!(all, 300, "{rate}");
            assert!((0..u32::from(rate)).all(|frame| delay(frame, rate) >= 2));
        }
    }
}
