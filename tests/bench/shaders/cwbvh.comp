#version 460
#extension GL_GOOGLE_include_directive : require
#include "cast.glsl"
#include "slabs.glsl"

// Through the nodes that obvhs makes, as in H. Ylitie, T. Karras, S. Laine, "Efficient incoherent ray traversal on GPUs
// through compressed wide BVHs", HPG 2017. Deviations: no postponed triangles; the triangle test is open.
//
// A node is 20 words: the raster's corner; its exponents and which children are inner nodes, a byte each; the first inner
// child, the first triangle; a byte a child that says what it is; for x, y and z each the low faces of the children and the
// high ones, a byte each. The byte that says what a child is: of an inner node 001 and 24 plus its slot, of a leaf as many
// ones as it has triangles and the place of the first, of an empty slot 0.

const uint STACK = 32u;

// Marks of what is behind the children that are met, four at a time. A leaf's are its triangles, in the lower 24 bits; an
// inner node's is 24 plus its slot XOR `far`, so that the highest is the nearest.
uint marks(uint kinds, uvec4 met, uint far) {
    uint is_inner = (kinds & kinds << 1) >> 4 & 0x01010101u;
    uint places = (kinds ^ (far * 0x01010101u & is_inner * 0xffu)) & 0x1f1f1f1fu;
    uint ones = kinds >> 5 & 0x07070707u;
    uvec4 shifts = uvec4(0u, 8u, 16u, 24u);
    uvec4 each = (uvec4(ones) >> shifts & 7u) << (uvec4(places) >> shifts & 31u);
    each *= met;
    return each.x | each.y | each.z | each.w;
}

Hit trace(inout Ray ray) {
    vec3 slope = reciprocal(ray.direction);
    bool inside = enter(ray, interval(slope, -ray.origin * slope, root_low, root_high));
    Hit best = Hit(ray.t_max, NO_TRIANGLE, vec2(0.0));
    if (!inside) {
        return best;
    }
    TriangleTest test = prepared_test(ray);
    bvec3 backwards = lessThan(slope, vec3(0.0));
    uint far = (backwards.x ? 0u : 4u) | (backwards.y ? 0u : 2u) | (backwards.z ? 0u : 1u);
    // Index of the first inner child, then the marks of those to visit above the slots that have one. It begins with the root
    // as the only child of nothing.
    uvec2 group = uvec2(0u, 0x80000000u);
    uvec2 waiting[STACK];
    uint count = 0u;
    for (;;) {
        uint mark = uint(findMSB(group.y));
        uint slot = (mark - 24u) ^ far;
        uint node = group.x + bitCount(group.y & ((1u << slot) - 1u));
        group.y &= ~(1u << mark);
        if (group.y > 0x00ffffffu) {
            waiting[count++] = group;
        }
        uvec4 frame = nodes[5u * node];
        uvec4 links = nodes[5u * node + 1u];
        uvec4 x = nodes[5u * node + 2u];
        uvec4 y = nodes[5u * node + 3u];
        uvec4 z = nodes[5u * node + 4u];
        vec3 step = steps(frame.w) * slope;
        vec3 start = (uintBitsToFloat(frame.xyz) - ray.origin) * slope;
        uvec4 lower = meets(uvec3(x.x, y.x, z.x), uvec3(x.z, y.z, z.z), step, start, backwards, ray.t_min, best.t);
        uvec4 upper = meets(uvec3(x.y, y.y, z.y), uvec3(x.w, y.w, z.w), step, start, backwards, ray.t_min, best.t);
        uint met = marks(links.z, lower, far) | marks(links.w, upper, far);
        for (uint places = met & 0x00ffffffu; places != 0u; places &= places - 1u) {
            if (test_triangle(test, ray, links.y + uint(findLSB(places)), best)) {
                return best;
            }
        }
        group = uvec2(links.x, (met & 0xff000000u) | frame.w >> 24);
        if (group.y <= 0x00ffffffu) {
            if (count == 0u) {
                return best;
            }
            group = waiting[--count];
        }
    }
}
