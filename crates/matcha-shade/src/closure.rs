//! The closures that a program can return, as one table: everything that stores,
//! prints or reads a closure's parameters derives their layout from here.

use serde::{Deserialize, Serialize};

/// Type of a value in a graph; a value of `n` components takes `n` rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Ty {
    /// One number.
    F1,
    /// Two: texture coordinates and their gradients.
    F2,
    /// Three: colours (linear Rec.709), vectors, points, normals.
    F3,
    /// Four: colour with alpha.
    F4,
}

impl Ty {
    /// Number of components.
    pub const fn width(self) -> usize {
        match self {
            Ty::F1 => 1,
            Ty::F2 => 2,
            Ty::F3 => 3,
            Ty::F4 => 4,
        }
    }
}

/// Microfacet distribution of a glossy, glass or refraction closure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Distribution {
    /// Trowbridge–Reitz.
    Ggx,
    /// Trowbridge–Reitz with the energy of multiple scattering given back.
    MultiGgx,
    /// Beckmann.
    Beckmann,
    /// Ashikhmin–Shirley.
    AshikhminShirley,
}

/// Sheen model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum SheenModel {
    /// Ashikhmin and Premože 2007.
    Ashikhmin,
    /// Zeltner, Burley and Chiang 2022.
    Microfiber,
}

/// A leaf closure. Its weight (3 rows: the product of colour, strength and all mix
/// factors above it) comes before its parameters and is not one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ClosureKind {
    /// Emitted radiance is the weight, W·sr⁻¹·m⁻².
    Emission,
    /// Emission of the world.
    Background,
    /// Lambert, or Oren–Nayar where roughness is above zero.
    Diffuse,
    /// Lambert through the surface.
    Translucent,
    /// Straight through.
    Transparent,
    /// Reflection off microfacets.
    Glossy(Distribution),
    /// Reflection and refraction.
    Glass(Distribution),
    /// Refraction only.
    Refraction(Distribution),
    /// Cloth.
    Sheen(SheenModel),
    /// Burley's subsurface, random walk; rendered as diffuse until it is supported.
    Subsurface,
    /// Principled v2; weight is white times the mix factors.
    Principled(Distribution),
    /// Makes the film transparent.
    Holdout,
    /// Scatters nothing: gives the surface's shading normal where displacement bends it.
    /// Other closures are told apart from it (bump shadowing), not from the mesh's normal.
    ShadingNormal,
}

/// A named parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// As in the closure's documentation.
    pub name: &'static str,
    /// Its type.
    pub ty: Ty,
}

const fn p(name: &'static str, ty: Ty) -> Parameter {
    Parameter { name, ty }
}

const NORMAL: Parameter = p("normal", Ty::F3);
const ROUGHNESS: Parameter = p("roughness", Ty::F1);

const GLOSSY: &[Parameter] = &[
    ROUGHNESS,
    p("anisotropy", Ty::F1),
    p("rotation", Ty::F1),
    NORMAL,
    p("tangent", Ty::F3),
];

/// The closure's own colour, without mix factors: light that scatters several times
/// inside the closure is tinted each time, so that the weight alone is not enough.
const COLOR: Parameter = p("color", Ty::F3);

const GLOSSY_MULTIPLE: &[Parameter] = &[
    ROUGHNESS,
    p("anisotropy", Ty::F1),
    p("rotation", Ty::F1),
    NORMAL,
    p("tangent", Ty::F3),
    COLOR,
];

const SUBSURFACE: &[Parameter] = &[
    p("scale", Ty::F1),
    p("radius", Ty::F3),
    p("ior", Ty::F1),
    p("anisotropy", Ty::F1),
    NORMAL,
];

/// Parameters of the Principled closure, in row order.
pub const PRINCIPLED: &[Parameter] = &[
    p("base_color", Ty::F3),
    p("metallic", Ty::F1),
    ROUGHNESS,
    p("ior", Ty::F1),
    p("alpha", Ty::F1),
    NORMAL,
    p("diffuse_roughness", Ty::F1),
    p("subsurface_weight", Ty::F1),
    p("subsurface_radius", Ty::F3),
    p("subsurface_scale", Ty::F1),
    p("subsurface_ior", Ty::F1),
    p("subsurface_anisotropy", Ty::F1),
    p("specular_ior_level", Ty::F1),
    p("specular_tint", Ty::F3),
    p("anisotropic", Ty::F1),
    p("anisotropic_rotation", Ty::F1),
    p("tangent", Ty::F3),
    p("transmission_weight", Ty::F1),
    p("coat_weight", Ty::F1),
    p("coat_roughness", Ty::F1),
    p("coat_ior", Ty::F1),
    p("coat_tint", Ty::F3),
    p("coat_normal", Ty::F3),
    p("sheen_weight", Ty::F1),
    p("sheen_roughness", Ty::F1),
    p("sheen_tint", Ty::F3),
    p("emission_color", Ty::F3),
    p("emission_strength", Ty::F1),
    p("thin_film_thickness", Ty::F1),
    p("thin_film_ior", Ty::F1),
];

impl ClosureKind {
    /// The parameters after the weight, in row order.
    pub const fn parameters(self) -> &'static [Parameter] {
        match self {
            ClosureKind::Emission
            | ClosureKind::Background
            | ClosureKind::Transparent
            | ClosureKind::Holdout => &[],
            ClosureKind::Diffuse => const { &[ROUGHNESS, NORMAL, COLOR] },
            ClosureKind::Sheen(_) => const { &[ROUGHNESS, NORMAL] },
            ClosureKind::Translucent | ClosureKind::ShadingNormal => const { &[NORMAL] },
            ClosureKind::Glossy(Distribution::MultiGgx) => GLOSSY_MULTIPLE,
            ClosureKind::Glossy(_) => GLOSSY,
            ClosureKind::Glass(Distribution::MultiGgx) => {
                const { &[ROUGHNESS, p("ior", Ty::F1), NORMAL, COLOR] }
            }
            ClosureKind::Glass(_) | ClosureKind::Refraction(_) => {
                const { &[ROUGHNESS, p("ior", Ty::F1), NORMAL] }
            }
            ClosureKind::Subsurface => SUBSURFACE,
            ClosureKind::Principled(_) => PRINCIPLED,
        }
    }

    /// Whether the last parameter is the closure's own colour, which
    /// `ClosureTree::leaf` takes from the leaf's weight.
    pub fn carries_color(self) -> bool {
        self.parameters().last() == Some(&COLOR)
    }

    /// Rows of weight and parameters together.
    pub fn rows(self) -> usize {
        3 + self
            .parameters()
            .iter()
            .map(|p| p.ty.width())
            .sum::<usize>()
    }
}
