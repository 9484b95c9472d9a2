//! Running the kernel's probes, for tests that compare the two sides.

use super::{Gpu, LINE};
use crate::backend::BackendError;
use bytemuck::NoUninit;
use glam::Vec4;

impl Gpu {
    /// Runs a probe with one input; returns a result for each element.
    ///
    /// # Errors
    /// [`BackendError::Failed`], [`BackendError::TooLarge`].
    pub fn probe_one<A: NoUninit>(&self, entry: &'static str, input: &[A]) -> Result<Vec<Vec4>, BackendError> {
        let results = self.output("results", input.len() as u64 * 16)?;
        let input = self.input("input", input)?;
        let group = self.group(&self.layouts.cast, &[&results, &input]);
        self.run_probe(entry, &group, &results)
    }

    /// Runs a probe with two inputs of the same length; returns a result for each pair.
    ///
    /// # Errors
    /// As [`Gpu::probe_one`].
    pub fn probe_two<A: NoUninit, B: NoUninit>(
        &self,
        entry: &'static str,
        first: &[A],
        second: &[B],
    ) -> Result<Vec<Vec4>, BackendError> {
        let results = self.output("results", first.len() as u64 * 16)?;
        let first = self.input("first input", first)?;
        let second = self.input("second input", second)?;
        let group = self.group(&self.layouts.probe, &[&results, &first, &second]);
        self.run_probe(entry, &group, &results)
    }

    fn run_probe(
        &self,
        entry: &'static str,
        group: &wgpu::BindGroup,
        results: &wgpu::Buffer,
    ) -> Result<Vec<Vec4>, BackendError> {
        let pipeline = self.pipeline(entry)?;
        let mut encoder = self.encoder();
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups((results.size() as u32 / 16).div_ceil(LINE), 1, 1);
        }
        self.queue.submit([encoder.finish()]);
        self.read(results)
    }
}
