//! What depends on the surface: Fresnel terms, bump and normal maps.

use crate::device::shading;

operations! {
    family surface;

    /// Reflectance of a dielectric. Cycles, Fresnel.
    fresnel_factor(ior: F1, normal: F3, incoming: F3, backfacing: F1) -> F1 {
        cost: 2.0, error: 1e-3,
        eval: shading::fresnel_factor,
    }

    /// Cycles, Layer Weight, *Fresnel*.
    layer_weight_fresnel(blend: F1, normal: F3, incoming: F3, backfacing: F1) -> F1 {
        cost: 1.8, error: 1e-3,
        eval: shading::layer_weight_fresnel,
    }

    /// Cycles, Layer Weight, *Facing*.
    layer_weight_facing(blend: F1, normal: F3, incoming: F3) -> F1 {
        cost: 3.0, error: 1e-4,
        eval: shading::layer_weight_facing,
    }

    /// Change of a height along both footprint axes from three heights. Cycles, Bump.
    bump_change(h: F1, h_a: F1, h_b: F1, width: F1) -> F2 {
        cost: 0.5, error: 1e-3,
        eval: shading::bump_change,
    }

    /// A height's change with u and v from its changes along two UV vectors.
    uv_gradient(change: F2, uv_a: F2, uv_b: F2) -> Gradient {
        cost: 0.6, error: 1e-2,
        eval: shading::uv_gradient,
    }

    /// Gradient of a height on the surface (M. Mikkelsen 2010). Cycles, Bump.
    bump_surface_gradient(normal: F3, axis_a: F3, axis_b: F3, change: F2) -> F3 {
        cost: 0.9, error: 1e-2,
        eval: shading::bump_surface_gradient,
    }

    /// A normal bent by a surface gradient. Cycles, Bump.
    bump_bend(normal: F3, gradient: F3, strength: F1, distance: F1) -> Normal {
        cost: 2.5, error: 1e-3,
        eval: shading::bump_bend,
    }

    /// Cycles, Normal Map, *Tangent Space*.
    normal_map_tangent(color: F3, strength: F1, normal: F3, tangent: F3, sign: F1, backfacing: F1) -> Normal {
        cost: 1.7, error: 1e-3,
        eval: shading::normal_map_tangent,
    }

    /// The vector that a colour names. Cycles, Normal Map.
    normal_map_vector(color: F3) -> F3 {
        cost: 0.1, error: 1e-5,
        eval: shading::normal_map_vector,
    }

    /// Cycles, Normal Map, world and object space.
    normal_map_mix(n: F3, strength: F1, normal: F3, backfacing: F1) -> Normal {
        cost: 2.5, error: 1e-3,
        eval: shading::normal_map_mix,
    }

    /// |a| / |b|, 1 where b is zero.
    length_ratio(a: F3, b: F3) -> F1 {
        cost: 1.0, error: 1e-3,
        eval: shading::length_ratio,
    }

    /// Tangent about an axis of the generated box. Cycles, Tangent, *Radial*.
    tangent_radial(p: F3, normal: F3, axis: U32) -> Normal {
        cost: 1.4, error: 1e-3,
        eval: shading::tangent_radial,
    }

    /// A unit vector at right angles to a unit normal.
    any_tangent(n: F3) -> Normal {
        cost: 0.6, error: 1e-4,
        domain: [0.1, 0.6],
        eval: shading::any_tangent,
    }
}
