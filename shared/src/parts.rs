//! The parts that can be exchanged, by name, and the combinations that are offered.
//!
//! This list is all that another part needs beside its own file: command line, tests, measurements and the kernel's entry
//! points are made from it.

use core::fmt;

/// What there is to say about a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Description {
    /// Its name on the command line.
    pub name: &'static str,
    /// Where it was published.
    pub paper: &'static str,
    /// What it costs: of a traversal a node, of a test a triangle or a box.
    pub cost: &'static str,
    /// Whether no ray passes between triangles that share an edge, of a triangle test; whether no hit is lost, of the others.
    pub is_watertight: bool,
}

macro_rules! kinds {
    (
        $(#[$doc:meta])* $kind:ident:
        $($(#[$part_doc:meta])* $part:ident { $name:literal, $paper:literal, $cost:literal, $watertight:literal })+
    ) => {
        $(#[$doc])*
        // Words, because rust-gpu knows no bytes.
        #[repr(u32)]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub enum $kind {
            $($(#[$part_doc])* $part),+
        }

        impl $kind {
            /// All of them.
            pub const ALL: &[$kind] = &[$($kind::$part),+];

            /// What there is to say about it.
            pub fn description(self) -> Description {
                match self {
                    $($kind::$part => Description {
                        name: $name,
                        paper: $paper,
                        cost: $cost,
                        is_watertight: $watertight,
                    }),+
                }
            }

            /// The one of that name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|kind| kind.description().name == name)
            }
        }

        impl fmt::Display for $kind {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.description().name)
            }
        }
    };
}

kinds! {
    /// Ways through a scene, each with its structure.
    TraversalKind:
    /// [`crate::octants::Octants`].
    #[default]
    Octants {
        "octants", "Ylitie, Karras, Laine 2017", "128 bytes; 8 boxes, 48 multiply-adds", true
    }
    /// [`crate::revelles::Revelles`].
    Octree {
        "octree", "Revelles, Urena, Lastra 2000", "8 bytes; 3 planes down, 3 planes on", true
    }
    /// [`crate::bvh2::Bvh2`].
    Bvh2 {
        "bvh2", "Aila, Laine 2009", "64 bytes; 2 boxes", true
    }
    /// [`crate::grid::Grid`].
    Grid {
        "grid", "Amanatides, Woo 1987", "8 bytes; 3 planes", true
    }
    /// [`crate::brute::Brute`].
    Brute {
        "brute", "none", "no nodes; all triangles, cast on the GPU in tiles of 64", true
    }
    /// [`crate::octants::Octants`] with [`crate::triangle_test::Indexed`] triangles.
    Compact {
        "compact", "Ylitie, Karras, Laine 2017", "as octants; a triangle is 12 bytes, its corners are looked up", true
    }
}

kinds! {
    /// Triangle tests.
    TriangleKind:
    /// [`crate::triangle_test::Watertight`].
    #[default]
    Watertight {
        "watertight", "Woop, Benthin, Wald 2013", "1 division, 33 other operations", true
    }
    /// [`crate::triangle_test::MollerTrumbore`].
    MollerTrumbore {
        "moller-trumbore", "Moller, Trumbore 1997", "1 division, 49 other operations", false
    }
    /// [`crate::triangle_test::BaldwinWeber`].
    BaldwinWeber {
        "baldwin-weber", "Baldwin, Weber 2016", "1 division, 38 other operations; 9 and 84 more where the transform is not stored", false
    }
    /// [`crate::triangle_test::Plucker`].
    Plucker {
        "plucker", "Amanatides, Choi 1997", "2 divisions, 101 other operations", false
    }
}

kinds! {
    /// Box tests.
    BoxKind:
    /// [`crate::box_test::KayKajiya`].
    #[default]
    KayKajiya {
        "kay-kajiya", "Kay, Kajiya 1986", "6 divisions, 6 subtractions", true
    }
    /// [`crate::box_test::Williams`].
    Williams {
        "williams", "Williams, Barrus, Morley, Shirley 2005", "6 multiplications, 6 subtractions", true
    }
}

/// A combination of parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Parts {
    /// The way through the scene.
    pub traversal: TraversalKind,
    /// The triangle test.
    pub triangle: TriangleKind,
    /// The box test.
    pub box_test: BoxKind,
}

impl TraversalKind {
    /// Whether it leaves the box test open; else it has one of its own, or tests no boxes.
    pub fn takes_box_test(self) -> bool {
        !matches!(
            self,
            TraversalKind::Octants | TraversalKind::Brute | TraversalKind::Compact
        )
    }

    /// Whether its triangles are three indices each, of corners that they share.
    pub const fn is_indexed(self) -> bool {
        matches!(self, TraversalKind::Compact)
    }
}

impl Parts {
    /// What pictures are rendered with unless told otherwise: [`crate::traversal::Standard`].
    pub const STANDARD: Parts = Parts {
        traversal: TraversalKind::Octants,
        triangle: TriangleKind::Watertight,
        box_test: BoxKind::KayKajiya,
    };

    /// The same in less memory: [`crate::traversal::Compact`].
    pub const COMPACT: Parts = Parts {
        traversal: TraversalKind::Compact,
        ..Parts::STANDARD
    };

    /// Whether this combination is in [`Parts::OFFERED`].
    pub fn is_offered(self) -> bool {
        self.entry_points().is_some()
    }

    /// The combination as a number below 256, as [`crate::general::General`] reads it: three bits of the traversal, two of
    /// the triangle test, the rest of the box test.
    pub fn number(self) -> u32 {
        self.traversal as u32 | (self.triangle as u32) << 3 | (self.box_test as u32) << 5
    }
}

impl fmt::Display for Parts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "--traversal {} --triangle {} --box {}",
            self.traversal, self.triangle, self.box_test
        )
    }
}

/// Hands the list of all combinations that are offered to a macro, the default one first: kinds of traversal, triangle test and box test, then
/// the entry points for closest hits and any hits, then the type that has the traversal.
#[macro_export]
macro_rules! offered_parts {
    ($($macro:ident)::+) => {
        $($macro)::+! {
            Octants Watertight KayKajiya closest_octants_watertight any_octants_watertight
                $crate::octants::Octants<$crate::triangle_test::Watertight>;
            Octants MollerTrumbore KayKajiya closest_octants_moller_trumbore any_octants_moller_trumbore
                $crate::octants::Octants<$crate::triangle_test::MollerTrumbore>;
            Octants BaldwinWeber KayKajiya closest_octants_baldwin_weber any_octants_baldwin_weber
                $crate::octants::Octants<$crate::triangle_test::BaldwinWeber>;
            Octants Plucker KayKajiya closest_octants_plucker any_octants_plucker
                $crate::octants::Octants<$crate::triangle_test::Plucker>;
            Octree Watertight KayKajiya closest_octree_watertight_kay_kajiya any_octree_watertight_kay_kajiya
                $crate::revelles::Revelles<$crate::box_test::KayKajiya, $crate::triangle_test::Watertight>;
            Octree MollerTrumbore Williams closest_octree_moller_trumbore_williams any_octree_moller_trumbore_williams
                $crate::revelles::Revelles<$crate::box_test::Williams, $crate::triangle_test::MollerTrumbore>;
            Bvh2 Watertight KayKajiya closest_bvh2_watertight_kay_kajiya any_bvh2_watertight_kay_kajiya
                $crate::bvh2::Bvh2<$crate::box_test::KayKajiya, $crate::triangle_test::Watertight>;
            Bvh2 Watertight Williams closest_bvh2_watertight_williams any_bvh2_watertight_williams
                $crate::bvh2::Bvh2<$crate::box_test::Williams, $crate::triangle_test::Watertight>;
            Grid Watertight KayKajiya closest_grid_watertight_kay_kajiya any_grid_watertight_kay_kajiya
                $crate::grid::Grid<$crate::box_test::KayKajiya, $crate::triangle_test::Watertight>;
            Brute Watertight KayKajiya closest_brute_watertight any_brute_watertight
                $crate::brute::Brute<$crate::triangle_test::Watertight>;
            Compact Watertight KayKajiya closest_compact_watertight any_compact_watertight
                $crate::octants::Octants<$crate::triangle_test::Indexed<$crate::triangle_test::Watertight>>;
        }
    };
}

macro_rules! entry_points {
    ($($traversal:ident $triangle:ident $box_test:ident $closest:ident $any:ident $kind:ty;)+) => {
        impl Parts {
            /// Everything that is offered.
            pub const OFFERED: &[Parts] = &[$(Parts {
                traversal: TraversalKind::$traversal,
                triangle: TriangleKind::$triangle,
                box_test: BoxKind::$box_test,
            }),+];

            /// The kernel's entry points for closest hits and for any hits; none where the combination is not offered.
            pub fn entry_points(self) -> Option<(&'static str, &'static str)> {
                match (self.traversal, self.triangle, self.box_test) {
                    $((TraversalKind::$traversal, TriangleKind::$triangle, BoxKind::$box_test) => {
                        Some((stringify!($closest), stringify!($any)))
                    })+
                    _ => None,
                }
            }
        }
    };
}

offered_parts!(entry_points);
