#version 460
#extension GL_GOOGLE_include_directive : require
#include "cast.glsl"

// The twin of `--traversal bvh2 --box williams`, by hand: the nodes, the order of visits and the arithmetic of
// shared/src/bvh2.rs and shared/src/box_test/williams.rs.

const uint LEAF = 0x80000000u;
const uint DONE = 0xffffffffu;
const uint COUNT_BITS = 3u;
const uint MAX_LEVEL = 96u;
const float FAR = 1e38;
const float EXIT_SLACK = 1.0 + 2.0 * 1.1920929e-7;

// A. Williams, S. Barrus, R. K. Morley, P. Shirley, "An efficient and robust ray-box intersection algorithm", JGT 10(1), 2005.
struct Williams {
    vec3 origin;
    vec3 reciprocal;
    bvec3 backwards;
    // Axes along which the ray does not move.
    bvec3 still;
};

Williams williams(Ray ray) {
    Williams test;
    test.origin = ray.origin;
    test.still = equal(ray.direction, vec3(0.0));
    test.reciprocal = mix(1.0 / ray.direction, vec3(0.0), test.still);
    test.backwards = lessThan(test.reciprocal, vec3(0.0));
    return test;
}

vec2 interval(Williams test, vec3 low, vec3 high) {
    vec3 near = (mix(low, high, test.backwards) - test.origin) * test.reciprocal;
    vec3 far = (mix(high, low, test.backwards) - test.origin) * test.reciprocal;
    if (any(test.still)) {
        vec3 outside = mix(vec3(-FAR), vec3(FAR), lessThan(min(test.origin - low, high - test.origin), vec3(0.0)));
        near = mix(near, outside, test.still);
        far = mix(far, -outside, test.still);
    }
    return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)) * EXIT_SLACK);
}

Hit trace(inout Ray ray) {
    bool inside = enter(ray, interval(williams(ray), root_low, root_high));
    Hit best = Hit(ray.t_max, NO_TRIANGLE, vec2(0.0));
    if (!inside) {
        return best;
    }
    Williams boxes = williams(ray);
    TriangleTest test = prepared_test(ray);
    uint waiting[MAX_LEVEL + 1u];
    uint count = 0u;
    uint link = 0u;
    for (;;) {
        while ((link & LEAF) == 0u) {
            uvec4 low0 = nodes[4u * link];
            uvec4 high0 = nodes[4u * link + 1u];
            uvec4 low1 = nodes[4u * link + 2u];
            uvec4 high1 = nodes[4u * link + 3u];
            vec2 first = interval(boxes, uintBitsToFloat(low0.xyz), uintBitsToFloat(high0.xyz));
            vec2 second = interval(boxes, uintBitsToFloat(low1.xyz), uintBitsToFloat(high1.xyz));
            bool meets0 = max(first.x, ray.t_min) <= min(first.y, best.t);
            bool meets1 = max(second.x, ray.t_min) <= min(second.y, best.t);
            bvec2 meets = bvec2(meets0, meets1);
            bool is_second_nearer = all(bvec2(meets1, any(bvec2(!meets0, second.x < first.x))));
            link = mix(low0.w, low1.w, is_second_nearer);
            if (all(meets)) {
                waiting[count++] = mix(low1.w, low0.w, is_second_nearer);
            }
            if (!any(meets)) {
                if (count == 0u) {
                    link = DONE;
                } else {
                    link = waiting[--count];
                }
            }
        }
        if (link == DONE) {
            return best;
        }
        uint slot = (link & ~LEAF) >> COUNT_BITS;
        uint end = slot + (link & ((1u << COUNT_BITS) - 1u));
        for (; slot < end; slot++) {
            if (test_triangle(test, ray, slot, best)) {
                return best;
            }
        }
        if (count == 0u) {
            return best;
        }
        link = waiting[--count];
    }
}
