//! Codes of the quantities that programs read of a point, and how an input is packed into a
//! word: [`crate::input::Input::packed`] makes it on the processor, devices take it apart.
// Device code has no methods.
#![allow(clippy::manual_range_contains)]

/// UV set, by name.
pub const INPUT_UV: u32 = 0;
/// World position.
pub const INPUT_POSITION: u32 = 1;
/// Shading normal.
pub const INPUT_NORMAL: u32 = 2;
/// Geometric normal.
pub const INPUT_TRUE_NORMAL: u32 = 3;
/// Direction to the viewer.
pub const INPUT_INCOMING: u32 = 4;
/// Tangent of a UV set, by name.
pub const INPUT_TANGENT: u32 = 5;
/// Sign of a UV set's tangent frame, by name.
pub const INPUT_TANGENT_SIGN: u32 = 6;
/// Change of position with u, by name.
pub const INPUT_DP_DU: u32 = 7;
/// Change of position with v, by name.
pub const INPUT_DP_DV: u32 = 8;
/// Generated coordinates.
pub const INPUT_GENERATED: u32 = 9;
/// Object coordinates.
pub const INPUT_OBJECT: u32 = 10;
/// Camera coordinates.
pub const INPUT_CAMERA: u32 = 11;
/// Window coordinates.
pub const INPUT_WINDOW: u32 = 12;
/// Barycentric coordinates.
pub const INPUT_PARAMETRIC: u32 = 13;
/// Attribute, by name.
pub const INPUT_ATTRIBUTE: u32 = 14;
/// Back side.
pub const INPUT_BACKFACING: u32 = 15;
/// Curvature.
pub const INPUT_POINTINESS: u32 = 16;
/// Random number of the island.
pub const INPUT_RANDOM_PER_ISLAND: u32 = 17;
/// Object's location.
pub const INPUT_OBJECT_LOCATION: u32 = 18;
/// Object's colour.
pub const INPUT_OBJECT_COLOR: u32 = 19;
/// Object's alpha.
pub const INPUT_OBJECT_ALPHA: u32 = 20;
/// Object's pass index.
pub const INPUT_OBJECT_INDEX: u32 = 21;
/// Material's pass index.
pub const INPUT_MATERIAL_INDEX: u32 = 22;
/// Object's random number.
pub const INPUT_OBJECT_RANDOM: u32 = 23;
/// Camera ray. From here on the quantities are the path's.
pub const INPUT_IS_CAMERA_RAY: u32 = 24;
/// Shadow ray.
pub const INPUT_IS_SHADOW_RAY: u32 = 25;
/// Scattered by a diffuse closure.
pub const INPUT_IS_DIFFUSE_RAY: u32 = 26;
/// Scattered by a glossy closure.
pub const INPUT_IS_GLOSSY_RAY: u32 = 27;
/// Scattered by a perfectly sharp closure.
pub const INPUT_IS_SINGULAR_RAY: u32 = 28;
/// Reflected.
pub const INPUT_IS_REFLECTION_RAY: u32 = 29;
/// Transmitted.
pub const INPUT_IS_TRANSMISSION_RAY: u32 = 30;
/// Length of the last segment.
pub const INPUT_RAY_LENGTH: u32 = 31;
/// Bounces.
pub const INPUT_RAY_DEPTH: u32 = 32;
/// Diffuse bounces.
pub const INPUT_DIFFUSE_DEPTH: u32 = 33;
/// Glossy bounces.
pub const INPUT_GLOSSY_DEPTH: u32 = 34;
/// Transparent surfaces passed.
pub const INPUT_TRANSPARENT_DEPTH: u32 = 35;
/// Transmission bounces.
pub const INPUT_TRANSMISSION_DEPTH: u32 = 36;

/// The quantity itself.
pub const INPUT_PART_VALUE: u32 = 0;
/// Its change along the footprint's first axis.
pub const INPUT_PART_AXIS_A: u32 = 1;
/// Its change along the second one.
pub const INPUT_PART_AXIS_B: u32 = 2;

/// An input in one word: code in bits 0 to 7, part in 8 to 15, name in 16 to 31.
#[inline(always)]
pub fn input_pack(code: u32, part: u32, name: u32) -> u32 {
    code | (part << 8) | (name << 16)
}

/// The quantity: one of the `INPUT_` codes.
#[inline(always)]
pub fn input_code(packed: u32) -> u32 {
    packed & 0xff
}

/// One of the `INPUT_PART_` codes.
#[inline(always)]
pub fn input_part(packed: u32) -> u32 {
    (packed >> 8) & 0xff
}

/// Index of the UV set's or the attribute's name in the scene; 0 for other quantities.
#[inline(always)]
pub fn input_name(packed: u32) -> u32 {
    packed >> 16
}

/// Whether a quantity changes over the footprint, so that its parts along the axes exist.
#[inline(always)]
pub fn input_is_differentiable(code: u32) -> bool {
    code <= INPUT_NORMAL || (code >= INPUT_GENERATED && code <= INPUT_ATTRIBUTE)
}

/// Rows that a quantity takes.
#[inline(always)]
pub fn input_width(code: u32) -> u32 {
    if code == INPUT_UV || code == INPUT_PARAMETRIC {
        2
    } else if code == INPUT_ATTRIBUTE {
        4
    } else if code == INPUT_TANGENT_SIGN
        || (code >= INPUT_BACKFACING && code <= INPUT_RANDOM_PER_ISLAND)
        || code >= INPUT_OBJECT_ALPHA
    {
        1
    } else {
        3
    }
}
