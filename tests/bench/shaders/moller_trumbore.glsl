// T. Moller, B. Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997, two-sided: what most programs have,
// and not watertight.

struct TriangleTest {
    vec3 origin;
    vec3 direction;
};

TriangleTest prepared_test(Ray ray) {
    return TriangleTest(ray.origin, ray.direction);
}

// Whether the line crosses the triangle at a slot; `found` is where: t, then the weights of its second and third corner.
bool crosses(TriangleTest test, uint slot, out vec3 found) {
    vec3 corner = triangles[3u * slot].xyz;
    vec3 edge_b = triangles[3u * slot + 1u].xyz - corner;
    vec3 edge_c = triangles[3u * slot + 2u].xyz - corner;
    vec3 across = cross(test.direction, edge_c);
    vec3 from_corner = test.origin - corner;
    vec3 turned = cross(from_corner, edge_b);
    float determinant = dot(edge_b, across);
    found = vec3(dot(edge_c, turned), dot(from_corner, across), dot(test.direction, turned)) / determinant;
    bvec4 inside = bvec4(determinant != 0.0, found.y >= 0.0, found.z >= 0.0, found.y + found.z <= 1.0);
    return all(inside);
}
