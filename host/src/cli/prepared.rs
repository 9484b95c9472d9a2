//! A scene with everything that the command line says about its pictures.

use super::Failure;
use super::arguments::{LookArguments, MeshArguments, Size};
use super::engine::{Engine, EngineOptions};
use super::render::check_halves;
use oktant::aov::Aov;
use oktant::effort::Effort;
use oktant::picture::Picture;
use oktant::progress::Progress;
use oktant::scene::Scene;
use oktant::seen::Seen;
use oktant::standpoint::Origin;
use oktant::stereo::StereoMode;
use oktant::view::View;
use oktant_shared::frame::Frame;
use oktant_shared::parts::Parts;
use oktant_shared::variant::Variant;
use std::sync::Arc;
use std::time::Instant;

/// A scene that is ready to be rendered.
pub struct Prepared {
    pub scene: Arc<Scene>,
    pub view: View,
    pub size: Size,
    pub triangles: usize,
    /// Whether the scene is rendered by the variant of the kernel that was asked for.
    has_variant: bool,
}

/// A picture, and what it took.
pub struct Rendered {
    pub frame: Frame,
    pub picture: Picture,
    /// Empty where nothing was to be told beside the colour.
    pub seen: Seen,
    pub effort: Effort,
    /// Samples of a pixel, in the mean.
    pub mean_samples: f64,
    /// From the first pixel to the last, without what is told beside the colour.
    pub seconds: f64,
}

impl Prepared {
    /// Loads a scene and builds its structure, for a variant of the kernel if one is asked for.
    ///
    /// # Errors
    /// Of a scene that cannot be used, and of arguments that do not go with it.
    pub fn load(
        mesh: &MeshArguments,
        size: Option<Size>,
        look: &LookArguments,
        variant: Option<Variant>,
    ) -> Result<Self, Failure> {
        let loaded = mesh.load(&look.set)?;
        let size = size.or(loaded.size.map(Size::from)).unwrap_or_else(Size::preferred);
        let origin = Origin {
            focus: loaded.scene.focus,
            shift: loaded.shift,
        };
        let view = look.applied_with(look.view_file()?.as_ref(), loaded.view, &origin);
        look.check_eyes(view.stereo.is_some())?;
        look.check_projection(&view)?;
        look.check_sampling(view.adaptive)?;
        check_halves(&view, size)?;
        Ok(Prepared {
            scene: Arc::new(by_variant(loaded.scene, variant)?),
            view,
            size,
            triangles: loaded.triangles,
            has_variant: variant.is_some(),
        })
    }

    /// What renders it. Where that is a GPU that was not insisted on, and the triangles are too large for it, the scene is
    /// loaded once more, with triangles as indices; variants of the kernel have none.
    ///
    /// # Errors
    /// Of a GPU that was insisted on, and of a scene that cannot be loaded any more.
    pub fn engine(
        &mut self,
        mesh: &MeshArguments,
        look: &LookArguments,
        options: &EngineOptions,
    ) -> Result<Engine, Failure> {
        if self.has_variant {
            return Ok(Engine::new(options, &self.scene)?);
        }
        let (engine, scene) = Engine::of_any_size(options, &self.scene, || Ok(mesh.compact().load(&look.set)?.scene))?;
        self.scene = scene;
        Ok(engine)
    }

    /// Whether each eye's picture is a file of its own.
    pub fn is_pair(&self) -> bool {
        is_pair(&self.view)
    }

    /// What a view sees.
    pub fn frame(&self, view: &View) -> Frame {
        view.frame(&self.scene, self.size.width, self.size.height)
    }

    /// Renders what a view sees, and looks for what else is to be told of the pixels.
    pub fn render(
        &self,
        engine: &mut Engine,
        view: &View,
        aovs: &[Aov],
        progress: Progress<'_>,
    ) -> Result<Rendered, Failure> {
        let frame = self.frame(view);
        let start = Instant::now();
        let picture = engine.render(&frame, progress)?;
        let seconds = start.elapsed().as_secs_f64();
        let seen = if aovs.is_empty() {
            Seen::default()
        } else {
            Seen::new(&frame, &self.scene, |frame| engine.hits(frame))?
        };
        Ok(Rendered {
            effort: Effort::new(&picture, Some((&self.scene, &frame))),
            mean_samples: if view.adaptive {
                picture.mean_samples()
            } else {
                f64::from(view.samples.count())
            },
            frame,
            picture,
            seen,
            seconds,
        })
    }

    /// The samples of a pixel, for people; `mean_samples` are those of an adaptive picture.
    pub fn samples(&self, mean_samples: f64) -> String {
        let most = self.view.samples.count();
        if self.view.adaptive {
            format!("up to {most} samples, {mean_samples:.2} in the mean,")
        } else {
            super::render::counted(most as usize, "sample")
        }
    }
}

/// Whether a view makes a picture for each of two eyes.
pub fn is_pair(view: &View) -> bool {
    view.stereo.is_some_and(|stereo| stereo.mode == StereoMode::Sequential)
}

/// The scene, to be rendered by a variant of the kernel if one is asked for.
fn by_variant(scene: Scene, variant: Option<Variant>) -> Result<Scene, Failure> {
    let Some(variant) = variant else { return Ok(scene) };
    if scene.parts != Parts::default() {
        return Err(Failure::usage(
            "--variant is for the default parts: leave it out, or --traversal, --triangle and --box.",
        ));
    }
    let least = scene.variant;
    scene.rendered_by(variant).ok_or_else(|| {
        let greater = if least == Variant::Everything {
            ""
        } else {
            " or a greater one"
        };
        Failure::usage(format!(
            "The variant `{variant}` leaves out what this scene needs: leave --variant out, or give {least}{greater}."
        ))
    })
}
