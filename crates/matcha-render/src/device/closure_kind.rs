//! Closures by number, and where their parameters lie in their rows.
//!
//! `crate::closure::code` gives the number of a `ClosureKind`; a test holds both it and the
//! row numbers against `matcha_shade::closure`, which defines the rows.

/// Emission of a surface or light.
pub const CLOSURE_EMISSION: u32 = 0;
/// Emission of the world.
pub const CLOSURE_BACKGROUND: u32 = 1;
/// Lambert or Oren–Nayar.
pub const CLOSURE_DIFFUSE: u32 = 2;
/// Lambert through the surface.
pub const CLOSURE_TRANSLUCENT: u32 = 3;
/// Straight through.
pub const CLOSURE_TRANSPARENT: u32 = 4;
/// Reflection off microfacets.
pub const CLOSURE_GLOSSY: u32 = 5;
/// Reflection and refraction.
pub const CLOSURE_GLASS: u32 = 6;
/// Refraction only.
pub const CLOSURE_REFRACTION: u32 = 7;
/// Cloth.
pub const CLOSURE_SHEEN: u32 = 8;
/// Subsurface scattering.
pub const CLOSURE_SUBSURFACE: u32 = 9;
/// The Principled closure.
pub const CLOSURE_PRINCIPLED: u32 = 10;
/// Makes the film transparent.
pub const CLOSURE_HOLDOUT: u32 = 11;
/// The shading normal where displacement bends it.
pub const CLOSURE_SHADING_NORMAL: u32 = 12;

/// A closure's code is one of the constants above plus this times its model.
pub const CLOSURE_MODEL_STEP: u32 = 16;
/// Trowbridge–Reitz.
pub const CLOSURE_MODEL_GGX: u32 = 0;
/// Trowbridge–Reitz with the energy of multiple scattering given back.
pub const CLOSURE_MODEL_MULTI_GGX: u32 = 1;
/// Beckmann.
pub const CLOSURE_MODEL_BECKMANN: u32 = 2;
/// Ashikhmin–Shirley.
pub const CLOSURE_MODEL_ASHIKHMIN_SHIRLEY: u32 = 3;
/// Sheen as a linearly transformed cosine.
pub const CLOSURE_MODEL_MICROFIBER: u32 = 0;
/// Sheen as Ashikhmin's velvet.
pub const CLOSURE_MODEL_ASHIKHMIN: u32 = 1;

/// Row of every closure's weight, three numbers.
pub const CLOSURE_ROW_WEIGHT: u32 = 0;

/// Row of Diffuse and Sheen: roughness.
pub const DIFFUSE_ROW_ROUGHNESS: u32 = 3;
/// Row of Diffuse and Sheen: normal.
pub const DIFFUSE_ROW_NORMAL: u32 = 4;
/// Row of Diffuse: its own colour.
pub const DIFFUSE_ROW_COLOR: u32 = 7;

/// Row of Translucent and of the shading normal: normal.
pub const NORMAL_ROW_NORMAL: u32 = 3;

/// Row of Subsurface: normal.
pub const SUBSURFACE_ROW_NORMAL: u32 = 9;

/// Row of Glossy: roughness.
pub const GLOSSY_ROW_ROUGHNESS: u32 = 3;
/// Row of Glossy: anisotropy.
pub const GLOSSY_ROW_ANISOTROPY: u32 = 4;
/// Row of Glossy: rotation of the tangent, turns.
pub const GLOSSY_ROW_ROTATION: u32 = 5;
/// Row of Glossy: normal.
pub const GLOSSY_ROW_NORMAL: u32 = 6;
/// Row of Glossy: tangent.
pub const GLOSSY_ROW_TANGENT: u32 = 9;
/// Row of Glossy with multiple scattering: its own colour.
pub const GLOSSY_ROW_COLOR: u32 = 12;

/// Row of Glass and Refraction: roughness.
pub const GLASS_ROW_ROUGHNESS: u32 = 3;
/// Row of Glass and Refraction: index of refraction.
pub const GLASS_ROW_IOR: u32 = 4;
/// Row of Glass and Refraction: normal.
pub const GLASS_ROW_NORMAL: u32 = 5;
/// Row of Glass with multiple scattering: its own colour.
pub const GLASS_ROW_COLOR: u32 = 8;

/// Row of Principled: base colour.
pub const PRINCIPLED_ROW_BASE_COLOR: u32 = 3;
/// Row of Principled: share of metal.
pub const PRINCIPLED_ROW_METALLIC: u32 = 6;
/// Row of Principled: roughness.
pub const PRINCIPLED_ROW_ROUGHNESS: u32 = 7;
/// Row of Principled: index of refraction.
pub const PRINCIPLED_ROW_IOR: u32 = 8;
/// Row of Principled: opacity.
pub const PRINCIPLED_ROW_ALPHA: u32 = 9;
/// Row of Principled: normal.
pub const PRINCIPLED_ROW_NORMAL: u32 = 10;
/// Row of Principled: roughness of the diffuse base.
pub const PRINCIPLED_ROW_DIFFUSE_ROUGHNESS: u32 = 13;
/// Row of Principled: share of subsurface scattering.
pub const PRINCIPLED_ROW_SUBSURFACE_WEIGHT: u32 = 14;
/// Row of Principled: reflectance at normal incidence, 0.5 for what the index says.
pub const PRINCIPLED_ROW_SPECULAR_IOR_LEVEL: u32 = 21;
/// Row of Principled: colour of the specular layer; of metal, its edge.
pub const PRINCIPLED_ROW_SPECULAR_TINT: u32 = 22;
/// Row of Principled: anisotropy, 0 to 1.
pub const PRINCIPLED_ROW_ANISOTROPIC: u32 = 25;
/// Row of Principled: rotation of the tangent, turns.
pub const PRINCIPLED_ROW_ANISOTROPIC_ROTATION: u32 = 26;
/// Row of Principled: tangent.
pub const PRINCIPLED_ROW_TANGENT: u32 = 27;
/// Row of Principled: share of glass.
pub const PRINCIPLED_ROW_TRANSMISSION_WEIGHT: u32 = 30;
/// Row of Principled: weight of the coat.
pub const PRINCIPLED_ROW_COAT_WEIGHT: u32 = 31;
/// Row of Principled: roughness of the coat.
pub const PRINCIPLED_ROW_COAT_ROUGHNESS: u32 = 32;
/// Row of Principled: index of refraction of the coat.
pub const PRINCIPLED_ROW_COAT_IOR: u32 = 33;
/// Row of Principled: what the coat lets through.
pub const PRINCIPLED_ROW_COAT_TINT: u32 = 34;
/// Row of Principled: normal of the coat.
pub const PRINCIPLED_ROW_COAT_NORMAL: u32 = 37;
/// Row of Principled: weight of the sheen.
pub const PRINCIPLED_ROW_SHEEN_WEIGHT: u32 = 40;
/// Row of Principled: roughness of the sheen.
pub const PRINCIPLED_ROW_SHEEN_ROUGHNESS: u32 = 41;
/// Row of Principled: colour of the sheen.
pub const PRINCIPLED_ROW_SHEEN_TINT: u32 = 42;
/// Row of Principled: emitted colour.
pub const PRINCIPLED_ROW_EMISSION_COLOR: u32 = 45;
/// Row of Principled: strength of the emission.
pub const PRINCIPLED_ROW_EMISSION_STRENGTH: u32 = 48;
