//! What a program can read of the point that is shaded, and how far that reaches.

use crate::device::input_code::*;
use serde::{Deserialize, Serialize};

/// How much of the shading point a value depends on; ordered, join is `max`
/// (with two different UV sets joining to [`Dependency::Surface`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Dependency {
    /// Nothing: folded at compile time.
    Constant,
    /// One UV set and its footprint.
    Uv(u16),
    /// The point on the surface, whoever looks at it.
    Surface,
    /// The direction of view.
    View,
    /// The path so far (ray type, length, depth).
    Path,
}

/// Which of three values an input row holds.
///
/// The footprint is the ellipse in which the ray cone meets the tangent plane
/// (Akenine-Möller et al. 2021). `AxisA` and `AxisB` hold the input's *change*
/// along the ellipse's two half axes, in the input's own unit; to evaluate a
/// network beside the hit, add a fraction of them to `Value`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Part {
    /// At the hit.
    Value,
    /// Change along the first axis.
    AxisA,
    /// Change along the second axis.
    AxisB,
}

impl Part {
    /// The part's code: one of the `INPUT_PART_` constants.
    #[inline]
    pub fn code(self) -> u32 {
        match self {
            Part::Value => INPUT_PART_VALUE,
            Part::AxisA => INPUT_PART_AXIS_A,
            Part::AxisB => INPUT_PART_AXIS_B,
        }
    }
}

/// A quantity of the shading point.
///
/// Spaces are Blender's: Z up, metres. For the world's background, `Position` is the
/// direction looked into and `Normal` and `Incoming` its opposite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum InputKind {
    /// UV set by index (2 rows), Blender's orientation (v up).
    Uv(u16),
    /// World position (3).
    Position,
    /// Shading normal before bump, facing the viewer (3).
    Normal,
    /// Geometric normal, facing the viewer (3).
    TrueNormal,
    /// Unit direction to the viewer (3).
    Incoming,
    /// Unit tangent of a UV set (3).
    Tangent(u16),
    /// Sign of the tangent frame of a UV set (1).
    TangentSign(u16),
    /// Change of world position with u (3), unnormalised.
    DpDu(u16),
    /// Change of world position with v (3), unnormalised.
    DpDv(u16),
    /// Generated coordinates: position in the texture space's box, 0 to 1 (3).
    Generated,
    /// Object coordinates (3).
    Object,
    /// Camera coordinates (3).
    Camera,
    /// Window coordinates, 0 to 1 (3).
    Window,
    /// Barycentric coordinates (2).
    Parametric,
    /// Colour or vector attribute of the mesh by index into `Scene` names (4).
    Attribute(u16),
    /// 1 where the back side is hit (1).
    Backfacing,
    /// Curvature measure, 0.5 is flat (1).
    Pointiness,
    /// Random number of the mesh island (1).
    RandomPerIsland,
    /// Object's location (3).
    ObjectLocation,
    /// Object's colour (3).
    ObjectColor,
    /// Object's colour, alpha (1).
    ObjectAlpha,
    /// Object's pass index (1).
    ObjectIndex,
    /// Material's pass index (1).
    MaterialIndex,
    /// Object's random number, 0 to 1 (1).
    ObjectRandom,
    /// 1 for camera rays (1). The other ray types likewise.
    IsCameraRay,
    /// 1 for shadow rays.
    IsShadowRay,
    /// 1 for rays scattered by a diffuse closure.
    IsDiffuseRay,
    /// 1 for rays scattered by a glossy closure.
    IsGlossyRay,
    /// 1 for rays scattered by a perfectly sharp closure.
    IsSingularRay,
    /// 1 for reflected rays.
    IsReflectionRay,
    /// 1 for transmitted rays.
    IsTransmissionRay,
    /// Length of the last ray segment, metres (1).
    RayLength,
    /// Number of bounces (1).
    RayDepth,
    /// Number of diffuse bounces (1).
    DiffuseDepth,
    /// Number of glossy bounces (1).
    GlossyDepth,
    /// Number of transparent surfaces passed (1).
    TransparentDepth,
    /// Number of transmission bounces (1).
    TransmissionDepth,
}

impl InputKind {
    /// The quantity's code, one of the `INPUT_` constants, and the index of the name that it
    /// has beside it (0: none).
    #[inline]
    pub fn code(self) -> (u32, u16) {
        use InputKind::*;
        match self {
            Uv(name) => (INPUT_UV, name),
            Position => (INPUT_POSITION, 0),
            Normal => (INPUT_NORMAL, 0),
            TrueNormal => (INPUT_TRUE_NORMAL, 0),
            Incoming => (INPUT_INCOMING, 0),
            Tangent(name) => (INPUT_TANGENT, name),
            TangentSign(name) => (INPUT_TANGENT_SIGN, name),
            DpDu(name) => (INPUT_DP_DU, name),
            DpDv(name) => (INPUT_DP_DV, name),
            Generated => (INPUT_GENERATED, 0),
            Object => (INPUT_OBJECT, 0),
            Camera => (INPUT_CAMERA, 0),
            Window => (INPUT_WINDOW, 0),
            Parametric => (INPUT_PARAMETRIC, 0),
            Attribute(name) => (INPUT_ATTRIBUTE, name),
            Backfacing => (INPUT_BACKFACING, 0),
            Pointiness => (INPUT_POINTINESS, 0),
            RandomPerIsland => (INPUT_RANDOM_PER_ISLAND, 0),
            ObjectLocation => (INPUT_OBJECT_LOCATION, 0),
            ObjectColor => (INPUT_OBJECT_COLOR, 0),
            ObjectAlpha => (INPUT_OBJECT_ALPHA, 0),
            ObjectIndex => (INPUT_OBJECT_INDEX, 0),
            MaterialIndex => (INPUT_MATERIAL_INDEX, 0),
            ObjectRandom => (INPUT_OBJECT_RANDOM, 0),
            IsCameraRay => (INPUT_IS_CAMERA_RAY, 0),
            IsShadowRay => (INPUT_IS_SHADOW_RAY, 0),
            IsDiffuseRay => (INPUT_IS_DIFFUSE_RAY, 0),
            IsGlossyRay => (INPUT_IS_GLOSSY_RAY, 0),
            IsSingularRay => (INPUT_IS_SINGULAR_RAY, 0),
            IsReflectionRay => (INPUT_IS_REFLECTION_RAY, 0),
            IsTransmissionRay => (INPUT_IS_TRANSMISSION_RAY, 0),
            RayLength => (INPUT_RAY_LENGTH, 0),
            RayDepth => (INPUT_RAY_DEPTH, 0),
            DiffuseDepth => (INPUT_DIFFUSE_DEPTH, 0),
            GlossyDepth => (INPUT_GLOSSY_DEPTH, 0),
            TransparentDepth => (INPUT_TRANSPARENT_DEPTH, 0),
            TransmissionDepth => (INPUT_TRANSMISSION_DEPTH, 0),
        }
    }

    /// Number of rows (f32 each) that a value takes.
    pub fn width(self) -> usize {
        use InputKind::*;
        match self {
            Uv(_) | Parametric => 2,
            Position | Normal | TrueNormal | Incoming | Tangent(_) | DpDu(_) | DpDv(_)
            | Generated | Object | Camera | Window | ObjectLocation | ObjectColor => 3,
            Attribute(_) => 4,
            _ => 1,
        }
    }

    /// What the quantity depends on.
    pub fn dependency(self) -> Dependency {
        use InputKind::*;
        match self {
            Uv(set) => Dependency::Uv(set),
            // Both face the viewer, but that flips with the side only, which is
            // already part of what a hit on the surface is.
            Position | Normal | TrueNormal | Tangent(_) | TangentSign(_) | DpDu(_) | DpDv(_)
            | Generated | Object | Parametric | Attribute(_) | Backfacing | Pointiness
            | RandomPerIsland | ObjectLocation | ObjectColor | ObjectAlpha | ObjectIndex
            | MaterialIndex | ObjectRandom => Dependency::Surface,
            Incoming | Camera | Window => Dependency::View,
            _ => Dependency::Path,
        }
    }

    /// True if the quantity changes over the footprint, so that its `AxisA` and
    /// `AxisB` parts exist. Others are constant over it.
    pub fn is_differentiable(self) -> bool {
        use InputKind::*;
        matches!(
            self,
            Uv(_)
                | Position
                | Generated
                | Object
                | Camera
                | Window
                | Parametric
                | Attribute(_)
                | Normal
        )
    }
}

/// One block of input rows that a program reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Input {
    /// Which quantity.
    pub kind: InputKind,
    /// Its value or one of its two derivatives.
    pub part: Part,
}

impl Input {
    /// The input in one word, as devices read it.
    pub fn packed(self) -> u32 {
        let (code, name) = self.kind.code();
        input_pack(code, self.part.code(), u32::from(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use InputKind::*;

    const NAMED: [fn(u16) -> InputKind; 6] =
        [Uv, Tangent, TangentSign, DpDu, DpDv, InputKind::Attribute];
    const PLAIN: [InputKind; 31] = [
        Position,
        Normal,
        TrueNormal,
        Incoming,
        Generated,
        Object,
        Camera,
        Window,
        Parametric,
        Backfacing,
        Pointiness,
        RandomPerIsland,
        ObjectLocation,
        ObjectColor,
        ObjectAlpha,
        ObjectIndex,
        MaterialIndex,
        ObjectRandom,
        IsCameraRay,
        IsShadowRay,
        IsDiffuseRay,
        IsGlossyRay,
        IsSingularRay,
        IsReflectionRay,
        IsTransmissionRay,
        RayLength,
        RayDepth,
        DiffuseDepth,
        GlossyDepth,
        TransparentDepth,
        TransmissionDepth,
    ];

    #[test]
    fn every_quantity_has_a_code_of_its_own_and_is_unpacked_as_it_was() {
        let kinds = NAMED.iter().map(|kind| kind(513)).chain(PLAIN);
        let mut seen = [false; 37];
        for kind in kinds {
            let (code, name) = kind.code();
            assert!(
                !std::mem::replace(&mut seen[code as usize], true),
                "{kind:?}"
            );
            assert_eq!(
                input_is_differentiable(code),
                kind.is_differentiable(),
                "{kind:?}"
            );
            assert_eq!(input_width(code) as usize, kind.width(), "{kind:?}");
            for part in [Part::Value, Part::AxisA, Part::AxisB] {
                let packed = Input { kind, part }.packed();
                let parts = (input_code(packed), input_part(packed), input_name(packed));
                assert_eq!(parts, (code, part.code(), u32::from(name)), "{kind:?}");
            }
        }
        assert_eq!(seen, [true; 37]);
    }
}
