// The walk of a ray through the hierarchy that `trace/` lays out: nodes of eight boxes, and
// placed meshes among them. The processor's walk (matcha-render, `accel/traverse.rs`) is its twin.
//
// Entries of the stack, at least the hierarchy's levels.
//@ constant TRACE_STACK 64

//@ read4 bvh_nodes 5
//@ read4 bvh_triangles 3

// A ray in the space of a hierarchy.
struct TraceSpace {
    origin: vec3f,
    direction: vec3f,
    inverse: vec3f,
    // Bits 0, 1 and 2: the direction goes down x, y, z.
    octant: u32,
}

fn trace_space(origin: vec3f, direction: vec3f) -> TraceSpace {
    let inverse = box_inverse(direction);
    let down = select(vec3u(0u), vec3u(1u, 2u, 4u), inverse < vec3f(0.0));
    return TraceSpace(origin, direction, inverse, down.x | down.y | down.z);
}

// Bit `i` of eight moves to bit `i ^ octant`.
fn trace_turned(bits: u32, octant: u32) -> u32 {
    var turned = bits;
    if (octant & 1u) != 0u {
        turned = ((turned & 0x55u) << 1u) | ((turned >> 1u) & 0x55u);
    }
    if (octant & 2u) != 0u {
        turned = ((turned & 0x33u) << 2u) | ((turned >> 2u) & 0x33u);
    }
    if (octant & 4u) != 0u {
        turned = ((turned & 0x0fu) << 4u) | ((turned >> 4u) & 0x0fu);
    }
    return turned;
}

// Which of four boxes a ray meets; a byte of `near` and of `far` is a side of each, in steps.
fn trace_four_boxes(near: vec3u, far: vec3u, step: vec3f, start: vec3f, t_min: f32, t_max: f32) -> u32 {
    let near_x = vec4f(unpack4xU8(near.x)) * step.x + start.x;
    let near_y = vec4f(unpack4xU8(near.y)) * step.y + start.y;
    let near_z = vec4f(unpack4xU8(near.z)) * step.z + start.z;
    let far_x = vec4f(unpack4xU8(far.x)) * step.x + start.x;
    let far_y = vec4f(unpack4xU8(far.y)) * step.y + start.y;
    let far_z = vec4f(unpack4xU8(far.z)) * step.z + start.z;
    let entry = max(max(near_x, near_y), max(near_z, vec4f(t_min)));
    let exit = min(min(min(far_x, far_y), far_z) * BOX_FAR_SLACK, vec4f(t_max));
    let met = select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), entry <= exit);
    return met.x | met.y | met.z | met.w;
}

// Which of a node's slots a ray meets, a bit each; empty slots, too.
fn trace_boxes(at: u32, grid: vec4u, space: TraceSpace, t_min: f32, t_max: f32) -> u32 {
    let exponents = vec3u(grid.w, grid.w >> 8u, grid.w >> 16u) & vec3u(255u);
    let step = bitcast<vec3f>(exponents << vec3u(23u)) * space.inverse;
    let start = (bitcast<vec3f>(grid.xyz) - space.origin) * space.inverse;
    let x = quad_bvh_nodes(at + 2u);
    let y = quad_bvh_nodes(at + 3u);
    let z = quad_bvh_nodes(at + 4u);
    let down = space.inverse < vec3f(0.0);
    let near_x = select(x.xy, x.zw, down.x);
    let near_y = select(y.xy, y.zw, down.y);
    let near_z = select(z.xy, z.zw, down.z);
    let far_x = select(x.zw, x.xy, down.x);
    let far_y = select(y.zw, y.xy, down.y);
    let far_z = select(z.zw, z.xy, down.z);
    let near_0 = vec3u(near_x.x, near_y.x, near_z.x);
    let near_1 = vec3u(near_x.y, near_y.y, near_z.y);
    let far_0 = vec3u(far_x.x, far_y.x, far_z.x);
    let far_1 = vec3u(far_x.y, far_y.y, far_z.y);
    return trace_four_boxes(near_0, far_0, step, start, t_min, t_max)
        | (trace_four_boxes(near_1, far_1, step, start, t_min, t_max) << 4u);
}

// Takes a triangle if it is nearer than what was found; true if so. `inside` is the placed
// instance that it belongs to, or TRACE_NOTHING.
fn trace_triangle(at: u32, ray: TraceRay, space: TraceSpace, inside: u32, found: ptr<function, TraceHit>) -> bool {
    let q = quad_bvh_triangles(3u * at);
    let r = quad_bvh_triangles(3u * at + 1u);
    let s = quad_bvh_triangles(3u * at + 2u);
    let a = bitcast<vec3f>(q.xyz) - space.origin;
    let b = bitcast<vec3f>(vec3u(q.w, r.xy)) - space.origin;
    let c = bitcast<vec3f>(vec3u(r.zw, s.x)) - space.origin;
    let sides = triangle_sides(a, b, c, space.direction);
    if !triangle_inside(sides) {
        return false;
    }
    let t = triangle_distance(a, b, c, space.direction);
    if !(t > ray.t_min && t < (*found).t) {
        return false;
    }
    let instance = select(inside, s.z, inside == TRACE_NOTHING);
    let left = s.y == ray.excluded_primitive && instance == ray.excluded_instance;
    if left || (s.w & ray.mask) == 0u {
        return false;
    }
    let weights = triangle_weights(sides);
    *found = TraceHit(t, weights.x, weights.y, instance, s.y);
    return true;
}

// Tests the leaves of a node whose boxes were met; `links` is the node's second quad. True if a
// triangle was taken.
fn trace_leaves(links: vec4u, met: u32, ray: TraceRay, space: TraceSpace, inside: u32, found: ptr<function, TraceHit>, any: bool) -> bool {
    var wanted = (links.z >> 8u) & met;
    var leaves = (links.z >> 8u) & 255u;
    var at = links.y;
    var taken = false;
    while wanted != 0u {
        let slot = firstTrailingBit(leaves);
        leaves &= leaves - 1u;
        let end = at + ((links.w >> (4u * slot)) & 15u) + 1u;
        if (wanted & (1u << slot)) != 0u {
            wanted &= ~(1u << slot);
            for (var i = at; i < end; i++) {
                taken = trace_triangle(i, ray, space, inside, found) || taken;
                if any && taken {
                    return true;
                }
            }
        }
        at = end;
    }
    return taken;
}

// The nearest hit of a ray, or with `any` the first that the walk finds.
fn trace_walk(ray: TraceRay, any: bool) -> TraceHit {
    var found = trace_no_hit(ray);
    if !ray_is_sound(ray.origin, ray.direction) {
        return found;
    }
    let world = trace_space(ray.origin, ray.direction);
    var space = world;
    var inside = TRACE_NOTHING;
    // Entries of the stack when the walk went into a placed mesh.
    var outside = 0u;
    var stack: array<vec2u, TRACE_STACK>;
    var top = 0u;
    // Siblings: the first's index; in bits 0 to 7 those to visit, in the order of visits; in
    // bits 8 to 15 the slots that they have in their parent. Here it is the root alone.
    var group = vec2u(0u, 256u | (1u << space.octant));
    loop {
        if (group.y & 255u) == 0u {
            if inside != TRACE_NOTHING && top == outside {
                space = world;
                inside = TRACE_NOTHING;
            }
            if top == 0u {
                break;
            }
            top -= 1u;
            group = stack[top];
        }
        let visit = firstTrailingBit(group.y);
        group.y &= group.y - 1u;
        let before = (1u << (visit ^ space.octant)) - 1u;
        let at = 5u * (group.x + countOneBits((group.y >> 8u) & before));
        if (group.y & 255u) != 0u {
            stack[top] = group;
            top += 1u;
        }
        let grid = quad_bvh_nodes(at);
        let links = quad_bvh_nodes(at + 1u);
        if (grid.w >> 24u) == 0u {
            let met = trace_boxes(at, grid, space, ray.t_min, found.t);
            if trace_leaves(links, met, ray, space, inside, &found, any) && any {
                break;
            }
            let nodes = links.z & 255u;
            group = vec2u(links.x, trace_turned(nodes & met, space.octant) | (nodes << 8u));
            continue;
        }
        group.y = 0u;
        let z_axis = quad_bvh_nodes(at + 2u);
        let translation = quad_bvh_nodes(at + 3u);
        if (translation.w & ray.mask) != 0u {
            let x = bitcast<vec3f>(grid.xyz);
            let y = bitcast<vec3f>(links.xyz);
            let z = bitcast<vec3f>(z_axis.xyz);
            let d = x * ray.direction.x + y * ray.direction.y + z * ray.direction.z;
            let o = x * ray.origin.x + y * ray.origin.y + z * ray.origin.z;
            space = trace_space(o + bitcast<vec3f>(translation.xyz), d);
            inside = z_axis.w;
            outside = top;
            group = vec2u(links.w, 256u | (1u << space.octant));
        }
    }
    return found;
}

// The nearest hit.
fn trace_closest(ray: TraceRay) -> TraceHit {
    return trace_walk(ray, false);
}

// True if anything is hit.
fn trace_occluded(ray: TraceRay) -> bool {
    return trace_walk(ray, true).instance != TRACE_NOTHING;
}
