//! The device's clock, and what it has computed.

use bytemuck::Pod;
use oktant::backend::BackendError;
use oktant::backend::gpu::Gpu;

/// Two timestamps around a compute pass.
pub struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
}

impl Clock {
    /// None where the device has no timestamps.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        Some(Clock {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        })
    }

    /// Milliseconds that the device takes for what `work` puts into a pass.
    ///
    /// # Errors
    /// Where the device gives up.
    pub fn time(&self, gpu: &Gpu, work: impl FnOnce(&mut wgpu::ComputePass<'_>)) -> Result<f64, BackendError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        work(&mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: None,
            timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                query_set: &self.queries,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            }),
        }));
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        gpu.queue.submit([encoder.finish()]);
        let ticks: Vec<u64> = read(gpu, &self.resolved)?;
        let passed = ticks
            .last()
            .zip(ticks.first())
            .map_or(0, |(end, begin)| end.saturating_sub(*begin));
        Ok(passed as f64 * f64::from(gpu.queue.get_timestamp_period()) / 1e6)
    }
}

/// The contents of a buffer, once everything queued before is done.
///
/// # Errors
/// Where the device gives up.
pub fn read<T: Pod>(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<T>, BackendError> {
    let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: buffer.size(),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
    gpu.queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait()?;
    let bytes = staging.get_mapped_range(..).map_err(|error| BackendError::Failed {
        adapter: gpu.name.clone(),
        reason: error.to_string(),
    })?;
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}
