// Slabs by one multiplication and one addition a face, for boxes on a node's own raster.

const float LEAST_SLOPE = 1.0 / 1152921504606846976.0;

// One over the direction, of components that hardly move over the slope that counts as none.
vec3 reciprocal(vec3 direction) {
    return 1.0 / mix(direction, vec3(LEAST_SLOPE), lessThan(abs(direction), vec3(LEAST_SLOPE)));
}

vec2 interval(vec3 reciprocal, vec3 offset, vec3 low, vec3 high) {
    vec3 at_low = fma(low, reciprocal, offset);
    vec3 at_high = fma(high, reciprocal, offset);
    vec3 near = min(at_low, at_high);
    vec3 far = max(at_low, at_high);
    return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}

vec4 bytes(uint word) {
    return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 0xffu);
}

// Which of four boxes the ray is in somewhere between `t_min` and `limit`. A word of `low` or `high` has a byte of each: its
// faces across an axis. A face at q is crossed at q * step + start.
uvec4 meets(uvec3 low, uvec3 high, vec3 step, vec3 start, bvec3 backwards, float t_min, float limit) {
    uvec3 near = mix(low, high, backwards);
    uvec3 far = mix(high, low, backwards);
    vec4 near_x = fma(bytes(near.x), step.xxxx, start.xxxx);
    vec4 near_y = fma(bytes(near.y), step.yyyy, start.yyyy);
    vec4 near_z = fma(bytes(near.z), step.zzzz, start.zzzz);
    vec4 far_x = fma(bytes(far.x), step.xxxx, start.xxxx);
    vec4 far_y = fma(bytes(far.y), step.yyyy, start.yyyy);
    vec4 far_z = fma(bytes(far.z), step.zzzz, start.zzzz);
    vec4 enters = max(max(near_x, near_y), max(near_z, vec4(t_min)));
    vec4 leaves = min(min(far_x, far_y), min(far_z, vec4(limit)));
    return uvec4(lessThanEqual(enters, leaves));
}

// The edge lengths of a raster's cells, whose exponents are the lower three bytes.
vec3 steps(uint exponents) {
    return uintBitsToFloat((uvec3(exponents, exponents >> 8, exponents >> 16) & 0xffu) << 23);
}
