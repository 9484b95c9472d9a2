//! A picture on its way into a file.

use super::gpu_memory::GpuMemory;
use super::notice::SaveError;
use super::passes::ordered_passes;
use super::pictures;
use super::task::{Destination, Engine, Task};
use crate::backend::cpu::Cpu;
use crate::backend::gpu::{Gpu, GpuPicture};
use crate::output::PictureFile;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::tone::Tone;
use oktant_shared::frame::Frame;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The picture that the command `render` makes, taken pass by pass, so that something else can be done between them.
/// Dropped, it leaves nothing behind.
pub struct Saving {
    path: PathBuf,
    file: PictureFile,
    scene: Arc<Scene>,
    tone: Tone,
    canvas: Canvas,
    passes: VecDeque<Frame>,
    pass_count: usize,
}

/// Where the samples are summed up.
enum Canvas {
    Cpu(Picture),
    Gpu(Arc<Gpu>, Arc<GpuPicture>),
}

impl Saving {
    /// Makes sure that the file can be written.
    pub fn begin(task: Task, destination: &Destination, memory: &mut GpuMemory) -> Result<Self, SaveError> {
        let path = match destination {
            Destination::File(path) => path.clone(),
            Destination::Folder(folder) => pictures::next_free(folder),
        };
        let file = PictureFile::create(&path)?;
        let [width, height] = task.size;
        let frame = task.view.frame(&task.scene, width, height);
        let size: [u32; 2] = frame.size().into();
        let mut passes: VecDeque<Frame> = ordered_passes(&frame, frame.most_samples).into();
        let canvas = match task.engine {
            Engine::Cpu => Canvas::Cpu(Picture::unwritten(size[0], size[1])),
            Engine::Gpu(gpu) => {
                if frame.most_samples != 0 {
                    passes = ordered_passes(&frame, memory.samples_of_a_pass(&gpu, &task.scene, &frame)?).into();
                } else if memory.is_quick(&gpu, &task.scene, &frame)? {
                    passes = [frame].into();
                }
                let picture = memory.spare_picture(&gpu, size, frame.most_samples != 0)?;
                Canvas::Gpu(gpu, picture)
            }
        };
        Ok(Saving {
            path,
            file,
            scene: task.scene,
            tone: task.view.tone,
            canvas,
            pass_count: passes.len(),
            passes,
        })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Takes a pass, unless it is stopped; `progress` hears of the whole picture's. Returns whether that was the last.
    pub fn pass(
        &mut self,
        memory: &mut GpuMemory,
        stop: &AtomicBool,
        progress: Progress<'_>,
    ) -> Result<bool, SaveError> {
        let Some(pass) = self.passes.pop_front() else {
            return Ok(true);
        };
        let before = self.pass_count - self.passes.len() - 1;
        let of_all = |stage, fraction| progress(stage, (before as f32 + fraction) / self.pass_count as f32);
        match &mut self.canvas {
            Canvas::Cpu(picture) => {
                if !Cpu::new(self.scene.clone()).render_pass(&pass, picture, stop, &of_all) {
                    return Ok(false);
                }
            }
            Canvas::Gpu(gpu, picture) => {
                memory.render_pass(gpu, &self.scene, picture, &pass)?;
                of_all("rendering", 1.0);
            }
        }
        Ok(self.passes.is_empty())
    }

    /// Writes the file, now that all passes are taken.
    pub fn finish(self) -> Result<PathBuf, SaveError> {
        let picture = match self.canvas {
            Canvas::Cpu(picture) => picture,
            Canvas::Gpu(gpu, picture) => Picture::of_sums(picture.width, picture.height, gpu.read_picture(&picture)?),
        };
        self.file.save(&picture, &self.tone)?;
        Ok(self.path)
    }
}

#[cfg(test)]
mod tests {
    use super::super::task::Purpose;
    use super::*;
    use crate::backend::Backend;
    use crate::mesh_source::MeshSource;
    use crate::progress::silent;
    use crate::sampling::Samples;
    use crate::structure::StructureOptions;
    use crate::view::View;
    use std::fs;
    use std::sync::Mutex;

    fn task(destination: &Destination) -> Task {
        let mesh = MeshSource::Balls.load(&silent).unwrap();
        Task {
            engine: Engine::Cpu,
            scene: Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent).unwrap()),
            view: View {
                samples: Samples::Sixteen,
                ..View::default()
            },
            size: [40, 30],
            purpose: Purpose::Save(destination.clone()),
        }
    }

    #[test]
    fn passes_make_the_picture_of_the_command() {
        let folder = tempfile::tempdir().unwrap();
        let destination = Destination::Folder(folder.path().to_path_buf());
        let (task, mut memory) = (task(&destination), GpuMemory::default());
        let frame = task.view.frame(&task.scene, 40, 30);
        let wanted = Cpu::new(task.scene.clone()).render(&frame, &silent).unwrap();
        let tone = task.view.tone;
        let fractions = Mutex::new(Vec::new());
        let progress = |_, fraction| fractions.lock().unwrap().push(fraction);
        let mut saving = Saving::begin(task, &destination, &mut memory).unwrap();
        let go = AtomicBool::new(false);
        let passes = 1
            + (0..100)
                .position(|_| saving.pass(&mut memory, &go, &progress).unwrap())
                .unwrap();
        assert_eq!(passes, 16);
        let path = saving.finish().unwrap();
        assert_eq!(path, folder.path().join("oktant-0001.png"));
        assert_eq!(
            image::open(&path).unwrap().to_rgb8().into_raw(),
            wanted.to_rgb8(&tone),
            "sample after sample, to the last bit"
        );
        let mut fractions = fractions.into_inner().unwrap();
        fractions.sort_by(f32::total_cmp);
        assert!(fractions.iter().all(|fraction| (0.0..=1.0).contains(fraction)));
        assert_eq!(fractions.last(), Some(&1.0));
    }

    #[test]
    fn what_is_stopped_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        let destination = Destination::File(path.clone());
        let mut memory = GpuMemory::default();
        let mut saving = Saving::begin(task(&destination), &destination, &mut memory).unwrap();
        assert_eq!(saving.path(), path);
        assert!(!saving.pass(&mut memory, &AtomicBool::new(false), &silent).unwrap());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file");
        assert!(!saving.pass(&mut memory, &AtomicBool::new(true), &silent).unwrap());
        drop(saving);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
