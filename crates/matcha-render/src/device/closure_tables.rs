//! Albedos of microfacet and sheen lobes, tabulated: interpolation.
//!
//! The axes of all but the sheen's tables are linear from 0 to 1 over their nodes: roughness
//! √α, cosine, and for dielectrics the fourth root of F0. `crate::closure::tables` loads
//! them.

use matcha_shade::device::math::{abs, saturate, sqrt, to_int};

/// Nodes on each axis of the reflection tables.
pub const CLOSURE_REFLECTION_NODES: u32 = 32;
/// Nodes on each axis of the tables with an index of refraction, and of Schlick's.
pub const CLOSURE_GLASS_NODES: u32 = 16;
/// Nodes on each axis of the sheen's tables.
pub const CLOSURE_SHEEN_NODES: u32 = 32;

const CLOSURE_REFLECTION_SQUARE: u32 = CLOSURE_REFLECTION_NODES * CLOSURE_REFLECTION_NODES;
const CLOSURE_GLASS_SQUARE: u32 = CLOSURE_GLASS_NODES * CLOSURE_GLASS_NODES;
const CLOSURE_GLASS_CUBE: u32 = CLOSURE_GLASS_SQUARE * CLOSURE_GLASS_NODES;
const CLOSURE_SHEEN_SQUARE: u32 = CLOSURE_SHEEN_NODES * CLOSURE_SHEEN_NODES;

/// First entry: albedo of GGX reflection, cosine × roughness.
pub const CLOSURE_TABLE_REFLECTION: u32 = 0;
/// First entry: its cosine-weighted mean, roughness.
pub const CLOSURE_TABLE_REFLECTION_MEAN: u32 = CLOSURE_TABLE_REFLECTION + CLOSURE_REFLECTION_SQUARE;
/// First entry: albedo of GGX glass seen from outside, F0 × cosine × roughness.
pub const CLOSURE_TABLE_GLASS: u32 = CLOSURE_TABLE_REFLECTION_MEAN + CLOSURE_REFLECTION_NODES;
/// First entry: its mean, F0 × roughness.
pub const CLOSURE_TABLE_GLASS_MEAN: u32 = CLOSURE_TABLE_GLASS + CLOSURE_GLASS_CUBE;
/// First entry: as glass, seen from inside.
pub const CLOSURE_TABLE_GLASS_INSIDE: u32 = CLOSURE_TABLE_GLASS_MEAN + CLOSURE_GLASS_SQUARE;
/// First entry: its mean.
pub const CLOSURE_TABLE_GLASS_INSIDE_MEAN: u32 = CLOSURE_TABLE_GLASS_INSIDE + CLOSURE_GLASS_CUBE;
/// First entry: mean position between F0 and 1 of a dielectric's Fresnel factor,
/// F0 × cosine × roughness.
pub const CLOSURE_TABLE_DIELECTRIC: u32 = CLOSURE_TABLE_GLASS_INSIDE_MEAN + CLOSURE_GLASS_SQUARE;
/// First entry: likewise of Schlick's, cosine × roughness.
pub const CLOSURE_TABLE_SCHLICK: u32 = CLOSURE_TABLE_DIELECTRIC + CLOSURE_GLASS_CUBE;
/// First entry: coefficient a of the sheen, roughness × cosine; then b and the albedo.
pub const CLOSURE_TABLE_SHEEN: u32 = CLOSURE_TABLE_SCHLICK + CLOSURE_GLASS_SQUARE;
/// Number of entries.
pub const CLOSURE_TABLE_END: u32 = CLOSURE_TABLE_SHEEN + 3 * CLOSURE_SHEEN_SQUARE;

/// All tables, one after the other as `CLOSURE_TABLE_` numbers say.
#[derive(Clone, Copy, Debug)]
pub struct ClosureTables<'a> {
    /// Their entries.
    pub entry: &'a [f32],
}

/// Where a coordinate falls between an axis' nodes.
#[derive(Clone, Copy, Debug)]
pub struct ClosureNode {
    /// The node before it.
    pub low: u32,
    /// The node behind it; the same at the end.
    pub high: u32,
    /// Share of the node behind.
    pub share: f32,
}

/// An albedo.
#[derive(Clone, Copy, Debug)]
pub struct ClosureTableAlbedo {
    /// Of one direction.
    pub directional: f32,
    /// Cosine-weighted mean over all directions.
    pub mean: f32,
}

/// Sheen coefficients for one angle and roughness.
#[derive(Clone, Copy, Debug)]
pub struct ClosureSheenFit {
    /// First coefficient of the inverse transform.
    pub a: f32,
    /// Second coefficient.
    pub b: f32,
    /// Directional albedo.
    pub albedo: f32,
}

/// Node of the coordinate `x` on an axis of `nodes` nodes. Not a number reads as 0.
#[inline(always)]
pub fn closure_node(x: f32, nodes: u32) -> ClosureNode {
    let last = nodes - 1;
    let at = saturate(x) * last as f32;
    let low = to_int(at) as u32;
    ClosureNode {
        low,
        high: if low < last { low + 1 } else { last },
        share: at - low as f32,
    }
}

/// Value of the row of entries that starts at `start`.
#[inline(always)]
pub fn closure_linear(tables: ClosureTables, start: u32, x: ClosureNode) -> f32 {
    let a = tables.entry[(start + x.low) as usize];
    let b = tables.entry[(start + x.high) as usize];
    a + (b - a) * x.share
}

/// Value of the square that starts at `start`; `nodes` to a row.
#[inline(always)]
pub fn closure_bilinear(
    tables: ClosureTables,
    start: u32,
    nodes: u32,
    x: ClosureNode,
    y: ClosureNode,
) -> f32 {
    let a = closure_linear(tables, start + y.low * nodes, x);
    let b = closure_linear(tables, start + y.high * nodes, x);
    a + (b - a) * y.share
}

/// Value of the cube of [`CLOSURE_GLASS_NODES`] that starts at `start`.
#[inline]
pub fn closure_trilinear(
    tables: ClosureTables,
    start: u32,
    x: ClosureNode,
    y: ClosureNode,
    z: ClosureNode,
) -> f32 {
    let low = start + z.low * CLOSURE_GLASS_SQUARE;
    let high = start + z.high * CLOSURE_GLASS_SQUARE;
    let a = closure_bilinear(tables, low, CLOSURE_GLASS_NODES, x, y);
    let b = closure_bilinear(tables, high, CLOSURE_GLASS_NODES, x, y);
    a + (b - a) * z.share
}

/// Node of a relative index of refraction, the same for its inverse.
#[inline(always)]
pub fn closure_ior_node(ior: f32) -> ClosureNode {
    let coordinate = sqrt(abs((ior - 1.0) / (ior + 1.0)));
    closure_node(coordinate, CLOSURE_GLASS_NODES)
}

/// Albedo of single-scattering GGX reflection without Fresnel.
#[inline]
pub fn closure_reflection_albedo(
    tables: ClosureTables,
    roughness: f32,
    cosine: f32,
) -> ClosureTableAlbedo {
    let x = closure_node(roughness, CLOSURE_REFLECTION_NODES);
    let y = closure_node(cosine, CLOSURE_REFLECTION_NODES);
    ClosureTableAlbedo {
        directional: closure_bilinear(
            tables,
            CLOSURE_TABLE_REFLECTION,
            CLOSURE_REFLECTION_NODES,
            x,
            y,
        ),
        mean: closure_linear(tables, CLOSURE_TABLE_REFLECTION_MEAN, x),
    }
}

/// Albedo of single-scattering GGX glass.
#[inline]
pub fn closure_glass_albedo(
    tables: ClosureTables,
    roughness: f32,
    cosine: f32,
    ior: f32,
) -> ClosureTableAlbedo {
    let inside = ior < 1.0;
    let x = closure_node(roughness, CLOSURE_GLASS_NODES);
    let y = closure_node(cosine, CLOSURE_GLASS_NODES);
    let z = closure_ior_node(ior);
    let cube = if inside {
        CLOSURE_TABLE_GLASS_INSIDE
    } else {
        CLOSURE_TABLE_GLASS
    };
    let square = if inside {
        CLOSURE_TABLE_GLASS_INSIDE_MEAN
    } else {
        CLOSURE_TABLE_GLASS_MEAN
    };
    ClosureTableAlbedo {
        directional: closure_trilinear(tables, cube, x, y, z),
        mean: closure_bilinear(tables, square, CLOSURE_GLASS_NODES, x, z),
    }
}

/// Mean position between F0 and 1 of a dielectric's reflectance over visible microfacets.
#[inline]
pub fn closure_dielectric_position(
    tables: ClosureTables,
    roughness: f32,
    cosine: f32,
    ior: f32,
) -> f32 {
    let x = closure_node(roughness, CLOSURE_GLASS_NODES);
    let y = closure_node(cosine, CLOSURE_GLASS_NODES);
    closure_trilinear(
        tables,
        CLOSURE_TABLE_DIELECTRIC,
        x,
        y,
        closure_ior_node(ior),
    )
}

/// Likewise of Schlick's approximation.
#[inline]
pub fn closure_schlick_position(tables: ClosureTables, roughness: f32, cosine: f32) -> f32 {
    let x = closure_node(roughness, CLOSURE_GLASS_NODES);
    let y = closure_node(cosine, CLOSURE_GLASS_NODES);
    closure_bilinear(tables, CLOSURE_TABLE_SCHLICK, CLOSURE_GLASS_NODES, x, y)
}

/// Sheen coefficients.
#[inline]
pub fn closure_sheen_fit(tables: ClosureTables, roughness: f32, cosine: f32) -> ClosureSheenFit {
    let x = closure_node(cosine, CLOSURE_SHEEN_NODES);
    let y = closure_node(roughness, CLOSURE_SHEEN_NODES);
    let nodes = CLOSURE_SHEEN_NODES;
    let a = CLOSURE_TABLE_SHEEN;
    let b = a + CLOSURE_SHEEN_SQUARE;
    let albedo = b + CLOSURE_SHEEN_SQUARE;
    ClosureSheenFit {
        a: closure_bilinear(tables, a, nodes, x, y),
        b: closure_bilinear(tables, b, nodes, x, y),
        albedo: closure_bilinear(tables, albedo, nodes, x, y),
    }
}
