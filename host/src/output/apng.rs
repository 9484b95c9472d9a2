//! Animated PNG files.

use super::png::{Pixels, encoder, failed};
use ::png::Writer;
use std::io::{self, Write};

/// A PNG file with frames that is written frame by frame, and is shown over and over. What knows no frames shows the first.
pub struct Apng<W: Write> {
    writer: Writer<W>,
}

impl<W: Write> Apng<W> {
    /// Begins a file of so many frames; `like` is one of them, or any with as many bits.
    pub fn new(
        writer: W,
        size: [u32; 2],
        like: &Pixels<'_>,
        frame_count: u32,
        frames_per_second: u16,
    ) -> io::Result<Self> {
        let mut encoder = encoder(writer, size, like, None).map_err(failed)?;
        encoder.set_animated(frame_count, 0).map_err(failed)?;
        encoder.set_frame_delay(1, frames_per_second).map_err(failed)?;
        let writer = encoder.write_header().map_err(failed)?;
        Ok(Apng { writer })
    }

    /// Adds a frame.
    pub fn add(&mut self, pixels: &Pixels<'_>) -> io::Result<()> {
        self.writer.write_image_data(&pixels.bytes()).map_err(failed)
    }

    /// Ends the file, which has all its frames.
    pub fn finish(self) -> io::Result<()> {
        self.writer.finish().map_err(failed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::png::Decoder;

    /// The bytes of each frame, and its delay in seconds as a fraction.
    fn decoded(bytes: &[u8]) -> Vec<(Vec<u8>, [u16; 2])> {
        let mut reader = Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let count = reader.info().animation_control().unwrap().num_frames;
        let mut frames = Vec::new();
        for _ in 0..count {
            let mut frame = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut frame).unwrap();
            let control = reader.info().frame_control().unwrap();
            frames.push((frame, [control.delay_num, control.delay_den]));
        }
        frames
    }

    #[test]
    fn frames_come_back_exactly() {
        let frames: [[u16; 6]; 3] = [[0, 1, 258, 513, 65_534, 65_535], [7; 6], [1, 2, 3, 4, 5, 6]];
        let pixels = |i: usize| Pixels::Rgb16(frames[i].to_vec());
        let mut bytes = Vec::new();
        let mut apng = Apng::new(&mut bytes, [2, 1], &pixels(0), 3, 25).unwrap();
        for i in 0..3 {
            apng.add(&pixels(i)).unwrap();
        }
        apng.finish().unwrap();
        let wanted = frames.map(|frame| {
            (
                frame.iter().flat_map(|channel| channel.to_be_bytes()).collect(),
                [1, 25],
            )
        });
        assert_eq!(decoded(&bytes), wanted);
    }
}
