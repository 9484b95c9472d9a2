//! Getting results and times back from the device.

use super::Gpu;
use crate::backend::BackendError;
use bytemuck::Pod;

impl Gpu {
    /// The contents of a buffer, once everything queued before is done.
    pub(super) fn read<T: Pod>(&self, buffer: &wgpu::Buffer) -> Result<Vec<T>, BackendError> {
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("staging"),
            size: buffer.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        staging.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let bytes = staging
            .get_mapped_range(..)
            .map_err(|error| self.failed(&error.to_string()))?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    /// Red, green and blue of the pixels of a texture with a byte each of red, green, blue and opacity, row by row, once
    /// everything queued before is done.
    ///
    /// # Errors
    /// [`BackendError::Failed`] where the device is lost.
    pub fn read_rgb8(&self, texture: &wgpu::Texture) -> Result<Vec<u8>, BackendError> {
        let row = texture.width() * 4;
        // Rows of a copy begin at multiples of 256 bytes.
        let stride = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.output("texture", u64::from(stride) * u64::from(texture.height()))?;
        let mut encoder = self.encoder();
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(stride),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        let bytes: Vec<u8> = self.read(&buffer)?;
        let rows = bytes.chunks_exact(stride as usize);
        Ok(rows
            .flat_map(|bytes| bytes[..row as usize].chunks_exact(4))
            .flat_map(|texel| [texel[0], texel[1], texel[2]])
            .collect())
    }
}

/// Two timestamps around compute passes.
pub(super) struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
}

impl Timer {
    /// None where the device has no timestamp queries.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        Some(Timer {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("time"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("time"),
                size: 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        })
    }

    /// For the descriptor of the only pass.
    pub fn writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// For the descriptor of a pass, whether it is the first and whether it is the last; none for one in between.
    pub fn writes_of(&self, is_first: bool, is_last: bool) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        (is_first || is_last).then_some(wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: is_first.then_some(0),
            end_of_pass_write_index: is_last.then_some(1),
        })
    }

    /// Submits the commands and returns the milliseconds between the timestamps.
    pub fn finish(&self, gpu: &Gpu, mut encoder: wgpu::CommandEncoder) -> Result<f64, BackendError> {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        gpu.queue.submit([encoder.finish()]);
        let ticks: Vec<u64> = gpu.read(&self.resolved)?;
        Ok(ticks[1].saturating_sub(ticks[0]) as f64 * f64::from(gpu.queue.get_timestamp_period()) / 1e6)
    }
}
