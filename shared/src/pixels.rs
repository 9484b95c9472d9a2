//! Entry points that look at pixels.
//!
//! rust-gpu makes an entry point of a function where that is, so [`pixels`](crate::pixels!) makes one in the crate that it is for: what
//! renders all pixels is in one module, what renders listed ones in another, which a driver reads when there is a list.

/// Workgroups of a row of a dispatch over an array: devices allow 65,535 along an axis.
pub const ROW: u32 = 32_768;

/// An entry point that looks at pixels: `$inputs` are its arguments beside the scene, `$body` what it does with `$frame` and
/// `$world`.
#[macro_export]
macro_rules! pixels {
    (
        $doc:literal, $entry:literal, $name:ident, { $($inputs:tt)+ },
        $frame:ident $world:ident $body:block
    ) => {
        #[doc = $doc]
        #[spirv_std::spirv(compute(threads(8, 16), entry_point_name = $entry))]
        pub fn $name(
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[glam::UVec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[glam::Vec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] ids: &[u32],
            #[spirv(uniform, descriptor_set = 1, binding = 0)] $frame: &$crate::frame::Frame,
            #[spirv(storage_buffer, descriptor_set = 3, binding = 0)] vertices: &[$crate::triangle::Vertex],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 1)] coordinates: &[glam::Vec2],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 2)] material_ids: &[u32],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 3)] materials: &[$crate::material::Material],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 4)] lights: &[$crate::light::Light],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 5)] planes: &[$crate::plane::Plane],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 6)] textures: &[$crate::texture::Texture],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 7)] texels: &[u32],
            $($inputs)+
        ) {
            let $world = $crate::scene::World {
                scene: $crate::scene::Scene {
                    root: $frame.root,
                    nodes,
                    references,
                    triangles,
                    ids,
                    parts: $frame.parts(),
                },
                appearance: $crate::scene::Appearance {
                    vertices,
                    coordinates,
                    material_ids,
                    materials,
                    lights,
                    planes,
                    textures,
                    texels,
                },
            };
            $body
        }
    };
}
