//! What depends on the surface: Fresnel terms, bump and normal maps.

use super::math::*;

/// Reflectance of a dielectric for unpolarised light (A. Fresnel 1823; form of Cook and
/// Torrance 1982). `eta` is the index of the far side over that of the near side.
#[inline(always)]
pub fn fresnel_reflectance(cosine: f32, eta: f32) -> f32 {
    let c = abs(cosine);
    let g2 = eta * eta - 1.0 + c * c;
    let g = sqrt(max(g2, 0.0));
    let a = safe_divide(g - c, g + c);
    let b = safe_divide(c * (g + c) - 1.0, c * (g - c) + 1.0);
    select(1.0, 0.5 * a * a * (1.0 + b * b), g2 > 0.0)
}

/// Cycles, node Fresnel. `backfacing` is 1 on the inner side.
#[inline(always)]
pub fn fresnel_factor(ior: f32, normal: Vec3, incoming: Vec3, backfacing: f32) -> f32 {
    let eta = max(ior, 0.000_01);
    let seen = select(eta, 1.0 / eta, backfacing > 0.5);
    fresnel_reflectance(dot(incoming, normal), seen)
}

/// Cycles, node Layer Weight, output Fresnel.
#[inline(always)]
pub fn layer_weight_fresnel(blend: f32, normal: Vec3, incoming: Vec3, backfacing: f32) -> f32 {
    let eta = max(1.0 - blend, 0.000_01);
    let seen = select(1.0 / eta, eta, backfacing > 0.5);
    fresnel_reflectance(dot(incoming, normal), seen)
}

/// Cycles, node Layer Weight, output Facing.
#[inline(always)]
pub fn layer_weight_facing(blend: f32, normal: Vec3, incoming: Vec3) -> f32 {
    let limited = clamp(blend, 0.0, 0.999_99);
    let exponent = select(0.5 / (1.0 - limited), 2.0 * limited, limited < 0.5);
    let cosine = abs(dot(incoming, normal));
    1.0 - select(pow_positive(cosine, exponent), cosine, blend == 0.5)
}

/// Gradient on the surface of a height with changes along two tangents (J. Blinn,
/// "Simulation of Wrinkled Surfaces", 1978; M. Mikkelsen, "Bump Mapping Unparametrized
/// Surfaces on the GPU", 2010).
#[inline(always)]
pub fn bump_surface_gradient(normal: Vec3, axis_a: Vec3, axis_b: Vec3, change: Vec2) -> Vec3 {
    let ra = cross(axis_b, normal);
    let rb = cross(normal, axis_a);
    let det = dot(axis_a, ra);
    let sum = ra * change.x + rb * change.y;
    sum * safe_divide(1.0, det)
}

/// Cycles, node Bump: the normal bent against a height's gradient. `distance` scales
/// heights, negative where the node inverts.
#[inline(always)]
pub fn bump_bend(normal: Vec3, gradient: Vec3, strength: f32, distance: f32) -> Vec3 {
    let bent = normalize(normal - gradient * distance);
    let kept = max(strength, 0.0);
    let mixed = normalize(bent * kept + normal * (1.0 - kept));
    select3(mixed, normal, dot(mixed, mixed) == 0.0)
}

/// Change of a height per footprint axis from three heights, `width` axes apart.
#[inline(always)]
pub fn bump_change(h: f32, h_a: f32, h_b: f32, width: f32) -> Vec2 {
    vec2((h_a - h) / width, (h_b - h) / width)
}

/// Gradient of a height in UV from its changes along two UV vectors.
#[inline(always)]
pub fn uv_gradient(change: Vec2, uv_a: Vec2, uv_b: Vec2) -> Vec2 {
    let det = uv_a.x * uv_b.y - uv_a.y * uv_b.x;
    let u = safe_divide(change.x * uv_b.y - change.y * uv_a.y, det);
    let v = safe_divide(change.y * uv_a.x - change.x * uv_b.x, det);
    vec2(u, v)
}

/// Cycles, node Normal Map, tangent space. `normal` faces the viewer; the map is
/// applied on the front and turned with the normal.
#[inline(always)]
pub fn normal_map_tangent(
    color: Vec3,
    strength: f32,
    normal: Vec3,
    tangent: Vec3,
    sign: f32,
    backfacing: f32,
) -> Vec3 {
    let front = select3(normal, -normal, backfacing > 0.5);
    let x = (2.0 * color.x - 1.0) * strength;
    let y = (2.0 * color.y - 1.0) * strength;
    let z = mix(1.0, 2.0 * color.z - 1.0, saturate(strength));
    let bitangent = cross(front, tangent) * sign;
    let sum = tangent * x + bitangent * y + front * z;
    let unit = normalize(sum);
    let seen = select3(unit, -unit, backfacing > 0.5);
    select3(seen, normal, dot(sum, sum) == 0.0)
}

/// Cycles, node Normal Map, world and object space: the vector that the colour names.
#[inline(always)]
pub fn normal_map_vector(color: Vec3) -> Vec3 {
    color * 2.0 - vec3(1.0, 1.0, 1.0)
}

/// The same: `n` facing the viewer, mixed with the surface's normal.
#[inline(always)]
pub fn normal_map_mix(n: Vec3, strength: f32, normal: Vec3, backfacing: f32) -> Vec3 {
    let unit = normalize(n);
    let seen = select3(unit, -unit, backfacing > 0.5);
    let mixed = normalize(normal + (seen - normal) * max(strength, 0.0));
    select3(mixed, normal, dot(mixed, mixed) == 0.0)
}

/// Ratio of two lengths, 1 where the second is 0.
#[inline(always)]
pub fn length_ratio(a: Vec3, b: Vec3) -> f32 {
    let l = length(b);
    select(1.0, length(a) / select(1.0, l, l > 0.0), l > 0.0)
}

/// Cycles, node Tangent, radial about the Z axis of `p` in [−1, 1]³: at right angles
/// to the normal.
#[inline(always)]
pub fn tangent_radial(p: Vec3, normal: Vec3, axis: u32) -> Vec3 {
    let about_x = vec3(0.0, 0.5 - p.z, p.y - 0.5);
    let about_y = vec3(0.5 - p.z, 0.0, p.x - 0.5);
    let about_z = vec3(0.5 - p.y, p.x - 0.5, 0.0);
    let t = select3(select3(about_z, about_y, axis == 1), about_x, axis == 0);
    cross(normal, normalize(cross(t, normal)))
}

/// Any unit vector at right angles to `n` (T. Duff et al., "Building an Orthonormal
/// Basis, Revisited", JCGT 2017).
#[inline(always)]
pub fn any_tangent(n: Vec3) -> Vec3 {
    let sign = negate_if(1.0, n.z < 0.0);
    let a = -1.0 / (sign + n.z);
    vec3(
        1.0 + sign * n.x * n.x * a,
        sign * n.x * n.y * a,
        -sign * n.x,
    )
}

/// UV of a direction in an equirectangular map.
#[inline(always)]
pub fn equirectangular_uv(d: Vec3) -> Vec2 {
    let u = -atan2(d.y, d.x) * (1.0 / TAU) + 0.5;
    let v = atan2(d.z, length2(vec2(d.x, d.y))) * (1.0 / PI) + 0.5;
    vec2(u, v)
}

/// UV of a direction in a photograph of a mirror ball.
#[inline(always)]
pub fn mirror_ball_uv(d: Vec3) -> Vec2 {
    let unit = normalize(d);
    let y = unit.y - 1.0;
    let div = 2.0 * sqrt(max(-0.5 * y, 0.0));
    let x = safe_divide(unit.x, div);
    let z = safe_divide(unit.z, div);
    vec2(0.5 * (x + 1.0), 0.5 * (z + 1.0))
}

/// UV of a point on a unit sphere about the origin.
#[inline(always)]
pub fn sphere_uv(p: Vec3) -> Vec2 {
    let l = length(p);
    let u = 0.5 - atan2(p.x, p.y) * (1.0 / TAU);
    let v = 1.0 - acos(clamp(safe_divide(p.z, l), -1.0, 1.0)) * (1.0 / PI);
    vec2(
        select(0.0, select(u, 0.0, (p.x == 0.0) & (p.y == 0.0)), l > 0.0),
        select(0.0, v, l > 0.0),
    )
}

/// UV of a point on a cylinder about the Z axis.
#[inline(always)]
pub fn tube_uv(p: Vec3) -> Vec2 {
    let l = length2(vec2(p.x, p.y));
    let u = (1.0 - atan2(safe_divide(p.x, l), safe_divide(p.y, l)) * (1.0 / PI)) * 0.5;
    vec2(
        select(0.0, u, l > 0.0),
        select(0.0, (p.z + 1.0) * 0.5, l > 0.0),
    )
}

/// Cycles, node Image Texture, projection Box: weights of the projections along X, Y
/// and Z for the object-space normal `n`.
#[inline(always)]
pub fn box_weights(n: Vec3, blend: f32) -> Vec3 {
    let a = abs3(n);
    let sum = a.x + a.y + a.z;
    let m = a * safe_divide(1.0, sum);
    let limit = 0.5 * (1.0 + blend);
    let only_x = (m.x > limit * (m.x + m.y)) & (m.x > limit * (m.x + m.z));
    let only_y = (m.y > limit * (m.x + m.y)) & (m.y > limit * (m.y + m.z));
    let only_z = (m.z > limit * (m.x + m.z)) & (m.z > limit * (m.y + m.z));
    let rest = 1.0 - limit;
    let no_z = m.z < rest * (m.x + m.y);
    let no_x = m.x < rest * (m.y + m.z);
    let no_y = m.y < rest * (m.x + m.z);
    let low = 0.5 * (1.0 - blend);
    let xy = saturate(safe_divide(safe_divide(m.x, m.x + m.y) - low, blend));
    let yz = saturate(safe_divide(safe_divide(m.y, m.y + m.z) - low, blend));
    let xz = saturate(safe_divide(safe_divide(m.x, m.x + m.z) - low, blend));
    let scale = safe_divide(1.0, 2.0 * limit - 1.0);
    let all = (m * (2.0 - limit) + vec3(limit - 1.0, limit - 1.0, limit - 1.0)) * scale;
    let w = select3(all, vec3(xz, 0.0, 1.0 - xz), no_y);
    let w = select3(w, vec3(0.0, yz, 1.0 - yz), no_x);
    let w = select3(w, vec3(xy, 1.0 - xy, 0.0), no_z);
    let w = select3(w, vec3(1.0, 0.0, 0.0), blend <= 0.0);
    let w = select3(w, vec3(0.0, 0.0, 1.0), only_z);
    let w = select3(w, vec3(0.0, 1.0, 0.0), only_y);
    select3(w, vec3(1.0, 0.0, 0.0), only_x)
}
