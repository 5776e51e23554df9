//! Closure kinds as the numbers that device code knows them by.

use crate::device::closure_kind::{
    CLOSURE_BACKGROUND, CLOSURE_DIFFUSE, CLOSURE_EMISSION, CLOSURE_GLASS, CLOSURE_GLOSSY,
    CLOSURE_HOLDOUT, CLOSURE_MODEL_ASHIKHMIN, CLOSURE_MODEL_ASHIKHMIN_SHIRLEY,
    CLOSURE_MODEL_BECKMANN, CLOSURE_MODEL_GGX, CLOSURE_MODEL_MICROFIBER, CLOSURE_MODEL_MULTI_GGX,
    CLOSURE_MODEL_STEP, CLOSURE_PRINCIPLED, CLOSURE_REFRACTION, CLOSURE_SHADING_NORMAL,
    CLOSURE_SHEEN, CLOSURE_SUBSURFACE, CLOSURE_TRANSLUCENT, CLOSURE_TRANSPARENT,
};
use matcha_shade::closure::{ClosureKind, Distribution, SheenModel};

/// The number of a closure kind in device code.
pub const fn code(kind: ClosureKind) -> u32 {
    match kind {
        ClosureKind::Emission => CLOSURE_EMISSION,
        ClosureKind::Background => CLOSURE_BACKGROUND,
        ClosureKind::Diffuse => CLOSURE_DIFFUSE,
        ClosureKind::Translucent => CLOSURE_TRANSLUCENT,
        ClosureKind::Transparent => CLOSURE_TRANSPARENT,
        ClosureKind::Glossy(d) => CLOSURE_GLOSSY + distribution(d),
        ClosureKind::Glass(d) => CLOSURE_GLASS + distribution(d),
        ClosureKind::Refraction(d) => CLOSURE_REFRACTION + distribution(d),
        ClosureKind::Sheen(SheenModel::Ashikhmin) => {
            CLOSURE_SHEEN + CLOSURE_MODEL_STEP * CLOSURE_MODEL_ASHIKHMIN
        }
        ClosureKind::Sheen(SheenModel::Microfiber) => {
            CLOSURE_SHEEN + CLOSURE_MODEL_STEP * CLOSURE_MODEL_MICROFIBER
        }
        ClosureKind::Subsurface => CLOSURE_SUBSURFACE,
        ClosureKind::Principled(d) => CLOSURE_PRINCIPLED + distribution(d),
        ClosureKind::Holdout => CLOSURE_HOLDOUT,
        ClosureKind::ShadingNormal => CLOSURE_SHADING_NORMAL,
    }
}

/// Lobes that a closure of a kind makes at most. A device's set of lobes need not be larger
/// than what the closures of the largest program make together.
pub const fn most_lobes(kind: ClosureKind) -> u32 {
    match kind {
        ClosureKind::Emission
        | ClosureKind::Background
        | ClosureKind::Transparent
        | ClosureKind::Holdout
        | ClosureKind::ShadingNormal => 0,
        // Sheen, coat, metal, glass, specular layer, subsurface, diffuse.
        ClosureKind::Principled(_) => 7,
        _ => 1,
    }
}

const fn distribution(d: Distribution) -> u32 {
    let model = match d {
        Distribution::Ggx => CLOSURE_MODEL_GGX,
        Distribution::MultiGgx => CLOSURE_MODEL_MULTI_GGX,
        Distribution::Beckmann => CLOSURE_MODEL_BECKMANN,
        Distribution::AshikhminShirley => CLOSURE_MODEL_ASHIKHMIN_SHIRLEY,
    };
    CLOSURE_MODEL_STEP * model
}

#[cfg(test)]
mod tests {
    use super::{code, most_lobes};
    use crate::closure::fixtures::{Random, frame, lobes};
    use crate::device::closure_kind::*;
    use matcha_shade::closure::{ClosureKind, Distribution, SheenModel};

    const DISTRIBUTIONS: [Distribution; 4] = [
        Distribution::Ggx,
        Distribution::MultiGgx,
        Distribution::Beckmann,
        Distribution::AshikhminShirley,
    ];

    fn kinds() -> Vec<ClosureKind> {
        use ClosureKind::*;
        let mut all = vec![
            Emission,
            Background,
            Diffuse,
            Translucent,
            Transparent,
            Sheen(SheenModel::Ashikhmin),
            Sheen(SheenModel::Microfiber),
            Subsurface,
            Holdout,
            ShadingNormal,
        ];
        for d in DISTRIBUTIONS {
            all.extend([Glossy(d), Glass(d), Refraction(d), Principled(d)]);
        }
        all
    }

    #[test]
    fn codes_are_unique() {
        let mut codes: Vec<u32> = kinds().into_iter().map(code).collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), kinds().len());
    }

    #[test]
    fn no_kind_makes_more_lobes_than_stated() {
        let mut random = Random(4);
        let mut most = [0; 256];
        for kind in kinds() {
            for _ in 0..300 {
                let row: Vec<f32> = (0..kind.rows()).map(|_| random.f1()).collect();
                let count = lobes(kind, &row, &frame(0.7)).lobes().len() as u32;
                let seen = &mut most[code(kind) as usize];
                *seen = count.max(*seen);
            }
            assert_eq!(most[code(kind) as usize], most_lobes(kind), "{kind:?}");
        }
    }

    /// First row of a parameter, None where the kind does not have it.
    fn row(kind: ClosureKind, name: &str) -> Option<u32> {
        let mut at = CLOSURE_ROW_WEIGHT + 3;
        for parameter in kind.parameters() {
            if parameter.name == name {
                return Some(at);
            }
            at += parameter.ty.width() as u32;
        }
        None
    }

    fn check(kind: ClosureKind, named: &[(&str, u32)]) {
        for &(name, expected) in named {
            assert_eq!(row(kind, name), Some(expected), "{kind:?}: {name}");
        }
    }

    #[test]
    fn rows_are_those_of_the_shared_layout() {
        use ClosureKind::*;
        let soft = [
            ("roughness", DIFFUSE_ROW_ROUGHNESS),
            ("normal", DIFFUSE_ROW_NORMAL),
            ("color", DIFFUSE_ROW_COLOR),
        ];
        check(Diffuse, &soft);
        check(Sheen(SheenModel::Ashikhmin), &soft[..2]);
        check(Sheen(SheenModel::Microfiber), &soft[..2]);
        check(Translucent, &[("normal", NORMAL_ROW_NORMAL)]);
        check(ShadingNormal, &[("normal", NORMAL_ROW_NORMAL)]);
        check(Subsurface, &[("normal", SUBSURFACE_ROW_NORMAL)]);
        let glossy = [
            ("roughness", GLOSSY_ROW_ROUGHNESS),
            ("anisotropy", GLOSSY_ROW_ANISOTROPY),
            ("rotation", GLOSSY_ROW_ROTATION),
            ("normal", GLOSSY_ROW_NORMAL),
            ("tangent", GLOSSY_ROW_TANGENT),
        ];
        let glass = [
            ("roughness", GLASS_ROW_ROUGHNESS),
            ("ior", GLASS_ROW_IOR),
            ("normal", GLASS_ROW_NORMAL),
        ];
        for d in DISTRIBUTIONS {
            check(Glossy(d), &glossy);
            check(Glass(d), &glass);
            check(Refraction(d), &glass);
            check(Principled(d), PRINCIPLED);
        }
        let multiple = Distribution::MultiGgx;
        check(Glossy(multiple), &[("color", GLOSSY_ROW_COLOR)]);
        check(Glass(multiple), &[("color", GLASS_ROW_COLOR)]);
    }

    const PRINCIPLED: &[(&str, u32)] = &[
        ("base_color", PRINCIPLED_ROW_BASE_COLOR),
        ("metallic", PRINCIPLED_ROW_METALLIC),
        ("roughness", PRINCIPLED_ROW_ROUGHNESS),
        ("ior", PRINCIPLED_ROW_IOR),
        ("alpha", PRINCIPLED_ROW_ALPHA),
        ("normal", PRINCIPLED_ROW_NORMAL),
        ("diffuse_roughness", PRINCIPLED_ROW_DIFFUSE_ROUGHNESS),
        ("subsurface_weight", PRINCIPLED_ROW_SUBSURFACE_WEIGHT),
        ("specular_ior_level", PRINCIPLED_ROW_SPECULAR_IOR_LEVEL),
        ("specular_tint", PRINCIPLED_ROW_SPECULAR_TINT),
        ("anisotropic", PRINCIPLED_ROW_ANISOTROPIC),
        ("anisotropic_rotation", PRINCIPLED_ROW_ANISOTROPIC_ROTATION),
        ("tangent", PRINCIPLED_ROW_TANGENT),
        ("transmission_weight", PRINCIPLED_ROW_TRANSMISSION_WEIGHT),
        ("coat_weight", PRINCIPLED_ROW_COAT_WEIGHT),
        ("coat_roughness", PRINCIPLED_ROW_COAT_ROUGHNESS),
        ("coat_ior", PRINCIPLED_ROW_COAT_IOR),
        ("coat_tint", PRINCIPLED_ROW_COAT_TINT),
        ("coat_normal", PRINCIPLED_ROW_COAT_NORMAL),
        ("sheen_weight", PRINCIPLED_ROW_SHEEN_WEIGHT),
        ("sheen_roughness", PRINCIPLED_ROW_SHEEN_ROUGHNESS),
        ("sheen_tint", PRINCIPLED_ROW_SHEEN_TINT),
        ("emission_color", PRINCIPLED_ROW_EMISSION_COLOR),
        ("emission_strength", PRINCIPLED_ROW_EMISSION_STRENGTH),
    ];
}
