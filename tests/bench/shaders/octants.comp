#version 460
#extension GL_GOOGLE_include_directive : require
#include "cast.glsl"
#include "slabs.glsl"

// The twin of `--traversal octants`, by hand: the nodes, the order of visits and the arithmetic of shared/src/octants.rs.

const uint MAX_LEVEL = 31u;

// Moves bit `slot` to bit `slot XOR octant`.
uint toward(uint slots, uint octant) {
    slots = mix(slots, (slots & 0x55u) << 1 | (slots >> 1 & 0x55u), (octant & 1u) != 0u);
    slots = mix(slots, (slots & 0x33u) << 2 | (slots >> 2 & 0x33u), (octant & 2u) != 0u);
    return mix(slots, (slots & 0x0fu) << 4 | slots >> 4, (octant & 4u) != 0u);
}

// The two numbers of a word.
vec2 halves(uint word) {
    return uintBitsToFloat(uvec2(word << 16, word));
}

// Bit 0 if the first and bit 1 if the second of two boxes is met between two limits, neither of them negative, so that the
// order of bits decides. Each word has two faces.
uint two(uvec3 near, uvec3 far, vec3 step, vec3 start, ivec2 limits) {
    ivec2 near_x = floatBitsToInt(fma(halves(near.x), step.xx, start.xx));
    ivec2 near_y = floatBitsToInt(fma(halves(near.y), step.yy, start.yy));
    ivec2 near_z = floatBitsToInt(fma(halves(near.z), step.zz, start.zz));
    ivec2 far_x = floatBitsToInt(fma(halves(far.x), step.xx, start.xx));
    ivec2 far_y = floatBitsToInt(fma(halves(far.y), step.yy, start.yy));
    ivec2 far_z = floatBitsToInt(fma(halves(far.z), step.zz, start.zz));
    ivec2 enters = max(max(max(near_x, near_y), near_z), limits.xx);
    ivec2 leaves = min(min(min(far_x, far_y), far_z), limits.yy);
    uvec2 met = uvec2(lessThanEqual(enters, leaves));
    return met.x | met.y << 1;
}

Hit trace(inout Ray ray) {
    vec3 slope = reciprocal(ray.direction);
    bool inside = enter(ray, interval(slope, -ray.origin * slope, root_low, root_high));
    Hit best = Hit(ray.t_max, NO_TRIANGLE, vec2(0.0));
    if (!inside) {
        return best;
    }
    TriangleTest test = prepared_test(ray);
    vec3 offset = -ray.origin * slope;
    uvec3 backwards = uvec3(lessThan(slope, vec3(0.0)));
    uint octant = backwards.x | backwards.y << 1 | backwards.z << 2;
    // Index of the first child, then the children to visit by `slot XOR octant`, and from bit 8 which slots have one.
    uvec2 group = uvec2(0u);
    uvec2 waiting[MAX_LEVEL + 1u];
    uint count = 0u;
    uint node = 0u;
    for (;;) {
        uint at = 8u * node;
        uvec4 frame = nodes[at];
        uvec4 links = nodes[at + 1u];
        uvec4 near_x = nodes[at + 2u + backwards.x];
        uvec4 far_x = nodes[at + 3u - backwards.x];
        uvec4 near_y = nodes[at + 4u + backwards.y];
        uvec4 far_y = nodes[at + 5u - backwards.y];
        uvec4 near_z = nodes[at + 6u + backwards.z];
        uvec4 far_z = nodes[at + 7u - backwards.z];
        vec3 step = steps(frame.w) * slope;
        vec3 start = fma(uintBitsToFloat(frame.xyz), slope, offset);
        ivec2 limits = floatBitsToInt(vec2(ray.t_min, best.t));
        uint met = two(uvec3(near_x.x, near_y.x, near_z.x), uvec3(far_x.x, far_y.x, far_z.x), step, start, limits)
            | two(uvec3(near_x.y, near_y.y, near_z.y), uvec3(far_x.y, far_y.y, far_z.y), step, start, limits) << 2
            | two(uvec3(near_x.z, near_y.z, near_z.z), uvec3(far_x.z, far_y.z, far_z.z), step, start, limits) << 4
            | two(uvec3(near_x.w, near_y.w, near_z.w), uvec3(far_x.w, far_y.w, far_z.w), step, start, limits) << 6;
        uint inner = frame.w >> 24;
        if ((group.y & 0xffu) != 0u) {
            waiting[count++] = group;
        }
        group = uvec2(links.x, toward(met & inner, octant) | inner << 8);
        uint places = 0u;
        uint leaves = met & ~inner;
        while (leaves != 0u) {
            uint slot = uint(findLSB(leaves));
            leaves &= leaves - 1u;
            uint leaf = mix(links.w, links.z, slot < 4u) >> (8u * (slot & 3u));
            places |= ((1u << (leaf >> 5 & 7u)) - 1u) << (leaf & 31u);
        }
        while (places != 0u) {
            uint place = uint(findLSB(places));
            places &= places - 1u;
            if (test_triangle(test, ray, links.y + place, best)) {
                return best;
            }
        }
        if ((group.y & 0xffu) == 0u) {
            if (count == 0u) {
                return best;
            }
            group = waiting[--count];
        }
        uint next = (uint(findLSB(group.y)) ^ octant) & 7u;
        node = group.x + bitCount(group.y >> 8 & ((1u << next) - 1u));
        group.y &= group.y - 1u;
    }
}
