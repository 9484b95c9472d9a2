// What the kernels of this folder have in common: the buffers of oktant's entry points that cast (kernel/src/cast.rs), rays,
// and triangle tests. Where oktant says why something is done, it is not said again here.
//
// `all`, `any` and `mix` stand where one would write `&&`, `||` and `? :`, which are branches to glslang. Loops without an
// end are written `for (;;)`, because naga does not understand what glslang makes of `while (true)`.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 2, std430) readonly buffer Triangles { vec4 triangles[]; };
layout(set = 0, binding = 3, std430) readonly buffer Ids { uint ids[]; };
layout(set = 1, binding = 0, std140) uniform Frame {
    layout(offset = 80) vec3 root_low;
    layout(offset = 96) vec3 root_high;
};
layout(set = 2, binding = 0, std430) writeonly buffer Hits { uvec4 hits[]; };
layout(set = 2, binding = 1, std430) readonly buffer Rays { vec4 rays[]; };

const uint ROW = 64u * 32768u;
const uint NO_TRIANGLE = 0xffffffffu;
const uint INFINITY_BITS = 0x7f800000u;
const float NEGLIGIBLE = 7.888609e-31;
const float KEPT_BACK = 1.0 / 1048576.0;
const float NEARBY = 4.0;

struct Ray {
    vec3 origin;
    vec3 direction;
    float t_min;
    float t_max;
    // What its t is multiplied with to become that of the ray as it was given.
    float scale;
    // What has been taken off its t.
    float advance;
    bool valid;
};

// A ray along a direction whose largest component is 1 to 2.
Ray prepared(vec4 origin, vec4 direction) {
    vec3 size = abs(direction.xyz);
    uint exponent = floatBitsToUint(max(size.x, max(size.y, size.z))) >> 23;
    Ray ray;
    ray.t_min = max(origin.w, 0.0);
    uvec3 numbers = max(floatBitsToUint(abs(origin.xyz)), floatBitsToUint(size));
    uvec2 limits = floatBitsToUint(abs(vec2(origin.w, direction.w)));
    bool is_finite = all(lessThan(numbers, uvec3(INFINITY_BITS)));
    bool has_limits = all(lessThanEqual(limits, uvec2(INFINITY_BITS)));
    ray.valid = all(bvec4(is_finite, has_limits, exponent - 1u < 252u, ray.t_min <= direction.w));
    exponent = ray.valid ? exponent : 127u;
    float unscale = uintBitsToFloat(exponent << 23);
    ray.scale = uintBitsToFloat((254u - exponent) << 23);
    vec3 scaled = direction.xyz * ray.scale;
    ray.origin = origin.xyz;
    ray.direction = mix(scaled, vec3(0.0), lessThan(abs(scaled), vec3(NEGLIGIBLE)));
    ray.t_min *= unscale;
    ray.t_max = direction.w * unscale;
    ray.advance = 0.0;
    return ray;
}

// Takes a ray to the scene, whose box it is in from `interval.x` to `interval.y`; returns whether it meets that at all.
bool enter(inout Ray ray, vec2 interval) {
    float near = interval.x * (1.0 - KEPT_BACK);
    bool inside = all(bvec4(ray.valid, interval.x <= interval.y, interval.y >= ray.t_min, near <= ray.t_max));
    vec3 edges = root_high - root_low;
    if (all(bvec2(inside, interval.x > NEARBY * max(edges.x, max(edges.y, edges.z))))) {
        ray.advance = near;
        ray.origin = fma(vec3(near), ray.direction, ray.origin);
        ray.t_min = max(ray.t_min - near, 0.0);
        ray.t_max -= near;
    }
    return inside;
}

#ifdef MOLLER_TRUMBORE
#include "moller_trumbore.glsl"
#else
#include "watertight.glsl"
#endif

struct Hit {
    float t;
    uint slot;
    vec2 weights;
};

// Tests a triangle; returns whether nothing more is to be looked for.
bool test_triangle(TriangleTest test, Ray ray, uint slot, inout Hit best) {
    vec3 found;
    bool is_crossed = crosses(test, slot, found);
    if (all(bvec3(is_crossed, found.x >= ray.t_min, found.x <= best.t))) {
#ifdef ANY
        best.slot = slot;
        return true;
#else
        bool wins = any(bvec2(found.x < best.t, best.slot == NO_TRIANGLE));
        if (!wins) {
            wins = ids[slot] < ids[best.slot];
        }
        if (wins) {
            best = Hit(found.x, slot, found.yz);
        }
#endif
    }
    return false;
}

Hit trace(inout Ray ray);

void main() {
    uint index = gl_GlobalInvocationID.y * ROW + gl_GlobalInvocationID.x;
    if (index >= hits.length() || 2u * index + 1u >= rays.length()) {
        return;
    }
    vec4 direction = rays[2u * index + 1u];
    Ray ray = prepared(rays[2u * index], direction);
    Hit hit = trace(ray);
    uvec4 row = uvec4(floatBitsToUint(direction.w), NO_TRIANGLE, 0u, 0u);
    if (hit.slot != NO_TRIANGLE) {
#ifdef ANY
        row = uvec4(0u);
#else
        float t = (hit.t + ray.advance) * ray.scale;
        row = uvec4(floatBitsToUint(t), ids[hit.slot], floatBitsToUint(hit.weights));
#endif
    }
    hits[index] = row;
}
