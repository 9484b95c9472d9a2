//! Running the kernel's probes, for tests that compare the two sides.

use super::{Gpu, LINE};
use crate::backend::BackendError;
use bytemuck::NoUninit;
use glam::Vec4;
use std::fmt;

/// How a device rounds a product and a sum that the kernel wants fused, which Vulkan leaves to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FusedMultiplyAdd {
    /// Once.
    Fused,
    /// Twice.
    Plain,
    /// The kernel has no entry point that tells.
    Unknown,
}

impl fmt::Display for FusedMultiplyAdd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            FusedMultiplyAdd::Fused => {
                "a fused multiply-add rounds once; the watertight test is tight by Kahan's difference"
            }
            FusedMultiplyAdd::Plain => {
                "a fused multiply-add rounds twice; the watertight test is tight by the plain difference of products"
            }
            FusedMultiplyAdd::Unknown => "the kernel does not tell how a fused multiply-add rounds",
        })
    }
}

impl Gpu {
    /// Asks the device how it rounds a fused multiply-add.
    pub fn fused_multiply_add(&self) -> FusedMultiplyAdd {
        // Its square is 2^-46 more than f32 holds.
        let above_one = 1.0 + f32::EPSILON;
        let operands = Vec4::new(above_one, above_one, -(1.0 + 2.0 * f32::EPSILON), 0.0);
        match self.probe_one("probe_arithmetic", &[operands]).as_deref() {
            Ok([result, ..]) if result.x == f32::EPSILON * f32::EPSILON => FusedMultiplyAdd::Fused,
            Ok([_, ..]) => FusedMultiplyAdd::Plain,
            _ => FusedMultiplyAdd::Unknown,
        }
    }

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
