//! What a scene needs of the kernel, and the variants of its body that are compiled.
//!
//! Work that a scene does not need is not in the variant that renders it: every function below
//! [`crate::render::render_pixel`] has the needs as a constant, and what is not among them is no code.

use core::fmt;

/// More than one material, or one beside the first.
pub const MATERIALS: u32 = 1;
/// More than one light, or one with an area.
pub const LIGHTS: u32 = 2;
/// Planes without end.
pub const PLANES: u32 = 4;
/// Textures or bumps on surfaces.
pub const TEXTURES: u32 = 8;
/// An image around everything.
pub const IMAGE: u32 = 16;
/// Materials that mirror: rays go on as one ray.
pub const MIRRORS: u32 = 32;
/// Materials that light goes through: rays become trees, know what they are inside of, and shadows have colours.
pub const GLASS: u32 = 64;

/// [`Variant::Plain`].
pub const PLAIN: u32 = 0;
/// [`Variant::Opaque`].
pub const OPAQUE: u32 = MATERIALS | LIGHTS | PLANES | TEXTURES | IMAGE;
/// [`Variant::Mirrors`].
pub const MIRRORED: u32 = OPAQUE | MIRRORS;
/// [`Variant::Everything`].
pub const EVERYTHING: u32 = MIRRORED | GLASS;

/// A variant of the kernel's body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variant {
    /// One opaque material without textures, one light that is no area, nothing around but a gradient.
    Plain,
    /// All that has no further rays than those for shadows.
    Opaque,
    /// The same with mirrors: a ray goes on as one ray.
    Mirrors,
    /// All that there is.
    #[default]
    Everything,
}

impl Variant {
    /// All of them, the one that can least first.
    pub const ALL: [Variant; 4] = [Variant::Plain, Variant::Opaque, Variant::Mirrors, Variant::Everything];

    /// What it can, as bits.
    pub const fn offers(self) -> u32 {
        match self {
            Variant::Plain => PLAIN,
            Variant::Opaque => OPAQUE,
            Variant::Mirrors => MIRRORED,
            Variant::Everything => EVERYTHING,
        }
    }

    /// Whether it renders a scene with these needs.
    pub const fn suffices(self, needs: u32) -> bool {
        needs & !self.offers() == 0
    }

    /// The least that suffices.
    pub fn least(needs: u32) -> Self {
        let mut variants = Self::ALL.into_iter();
        variants
            .find(|variant| variant.suffices(needs))
            .unwrap_or(Variant::Everything)
    }

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Variant::Plain => "plain",
            Variant::Opaque => "opaque",
            Variant::Mirrors => "mirrors",
            Variant::Everything => "everything",
        }
    }

    /// The kernel's entry point that renders all pixels with it.
    pub const fn entry_point(self) -> &'static str {
        match self {
            Variant::Plain => "render_plain",
            Variant::Opaque => "render_opaque",
            Variant::Mirrors => "render_mirrors",
            Variant::Everything => "render",
        }
    }

    /// The entry point that renders the pixels of a list with it.
    pub const fn entry_point_of_lists(self) -> &'static str {
        match self {
            Variant::Plain => "render_listed_plain",
            Variant::Opaque => "render_listed_opaque",
            Variant::Mirrors => "render_listed_mirrors",
            Variant::Everything => "render_listed",
        }
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_variant_that_suffices_is_taken() {
        for needs in 0..=EVERYTHING {
            let least = Variant::least(needs);
            assert!(least.suffices(needs), "{needs:b}");
            for variant in Variant::ALL {
                assert!(variant >= least || !variant.suffices(needs), "{needs:b}: {variant}");
            }
        }
        assert_eq!(Variant::least(0), Variant::Plain);
        assert_eq!(Variant::least(IMAGE), Variant::Opaque);
        assert_eq!(Variant::least(MIRRORS), Variant::Mirrors);
        assert_eq!(Variant::least(GLASS), Variant::Everything);
    }
}
