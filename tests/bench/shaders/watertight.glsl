// S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013.

const float LEAST_POSITIVE = 1.17549435e-38;

struct TriangleTest {
    vec3 origin;
    uint axis;
    vec3 shear;
};

// The components in cyclic order, the one at `axis` last.
vec3 rotated(vec3 v, uint axis) {
    return mix(mix(v, v.zxy, bvec3(axis == 1u)), v.yzx, bvec3(axis == 0u));
}

TriangleTest prepared_test(Ray ray) {
    vec3 size = abs(ray.direction);
    bool is_x = size.x >= max(size.y, size.z);
    TriangleTest test;
    test.axis = is_x ? 0u : (size.y >= size.z ? 1u : 2u);
    test.origin = rotated(ray.origin, test.axis);
    vec3 direction = rotated(ray.direction, test.axis);
    float reciprocal = 1.0 / direction.z;
    test.shear = vec3(direction.xy * reciprocal, reciprocal);
    return test;
}

vec3 sheared(TriangleTest test, vec3 corner) {
    vec3 p = rotated(corner, test.axis) - test.origin;
    return vec3(fma(-test.shear.xy, p.zz, p.xy), p.z * test.shear.z);
}

// a * b - c * d by Kahan.
vec3 difference_of_products(vec3 a, vec3 b, vec3 c, vec3 d) {
    vec3 product = c * d;
    return fma(a, b, -product) + fma(-c, d, product);
}

// Whether the line crosses the triangle at a slot; `found` is where: t, then the weights of its second and third corner.
bool crosses(TriangleTest test, uint slot, out vec3 found) {
    vec3 a = sheared(test, triangles[3u * slot].xyz);
    vec3 b = sheared(test, triangles[3u * slot + 1u].xyz);
    vec3 c = sheared(test, triangles[3u * slot + 2u].xyz);
    vec3 weights = difference_of_products(vec3(c.x, a.x, b.x), vec3(b.y, c.y, a.y), vec3(c.y, a.y, b.y), vec3(b.x, c.x, a.x));
    float determinant = weights.x + weights.y + weights.z;
    float reciprocal = 1.0 / determinant;
    float distance = weights.x * a.z + weights.y * b.z + weights.z * c.z;
    found = vec3(distance, weights.yz) * reciprocal;
    bvec2 inside = bvec2(all(greaterThanEqual(weights, vec3(0.0))), all(lessThanEqual(weights, vec3(0.0))));
    return all(bvec2(any(inside), abs(determinant) > LEAST_POSITIVE));
}
