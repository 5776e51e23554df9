//! From a closure's rows to its lobes.

use super::albedo::{Sides, estimate, preserve_energy};
use super::principled::prepare_principled;
use super::set::{LobeSet, WEIGHT_CUTOFF, mean};
use super::tables::sheen_fit;
use crate::device::fresnel::{FRESNEL_REMAPPED, fresnel_f0};
use crate::device::lobe::{
    ClosureFrame, ClosureLobe, LOBE_ASHIKHMIN_SHIRLEY, LOBE_BECKMANN, LOBE_DIFFUSE, LOBE_GGX,
    LOBE_OREN_NAYAR, LOBE_SHEEN, LOBE_TRANSLUCENT, LOBE_VELVET,
};
use crate::device::lobe_microfacet::lobe_lambda;
use crate::device::lobe_soft::lobe_oren_nayar_loss;
use crate::device::mapping::mapping_frame;
use crate::device::shading_normal::shading_normal_valid;
use glam::Vec3;
use matcha_shade::closure::{ClosureKind, Distribution, SheenModel};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, PI};

/// What the path so far means for a hit's closures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosureContext {
    /// α below which glossy lobes are blurred (Cycles' "filter glossy"), 0 to 0.5.
    pub blur: f32,
    /// Glossy reflection is wanted: the setting, or no diffuse bounce just before.
    pub reflective_caustics: bool,
    /// Likewise refraction.
    pub refractive_caustics: bool,
    /// Lobes are wanted; without, only emission, transparency and holdout are gathered
    /// (shadow rays, paths that end here).
    pub scatter: bool,
}

impl Default for ClosureContext {
    fn default() -> Self {
        Self {
            blur: 0.0,
            reflective_caustics: true,
            refractive_caustics: true,
            scatter: true,
        }
    }
}

/// Reads parameters in the order of `closure.rs`. What is not finite reads 0.
pub(super) struct Reader<'a> {
    rows: &'a [f32],
}

impl Reader<'_> {
    pub(super) fn f1(&mut self) -> f32 {
        let value = self.rows[0];
        self.rows = &self.rows[1..];
        if value.is_finite() { value } else { 0.0 }
    }

    pub(super) fn f3(&mut self) -> Vec3 {
        Vec3::new(self.f1(), self.f1(), self.f1())
    }
}

/// Where lobes are made: a hit, its context, and the set that collects them.
pub(super) struct Workbench<'a> {
    pub frame: &'a ClosureFrame,
    pub context: &'a ClosureContext,
    pub set: &'a mut LobeSet,
}

/// Adds the lobes of one closure to `set`, which must have been begun with the same frame.
///
/// `rows` are the closure's weight and parameters as `matcha_shade::closure` lays them out
/// ([`ClosureKind::rows`] numbers); fewer make no lobe. Numbers that are not finite
/// count as 0, and a normal of length 0 becomes the shading normal.
pub fn prepare_closure(
    kind: ClosureKind,
    rows: &[f32],
    frame: &ClosureFrame,
    context: &ClosureContext,
    set: &mut LobeSet,
) {
    if rows.len() < kind.rows() {
        return;
    }
    let mut read = Reader { rows };
    let weight = read.f3();
    let mut bench = Workbench {
        frame,
        context,
        set,
    };
    match kind {
        ClosureKind::Emission | ClosureKind::Background => {
            bench.set.emission += weight;
        }
        ClosureKind::Transparent => bench.set.add_transparency(weight),
        ClosureKind::Holdout => {
            bench.set.holdout += weight;
        }
        ClosureKind::Principled(d) => prepare_principled(&mut bench, weight, d, &mut read),
        // Already in the frame.
        ClosureKind::ShadingNormal => {}
        _ if !context.scatter => {}
        ClosureKind::Diffuse => {
            let (roughness, normal) = (read.f1(), bench.normal(read.f3()));
            bench.diffuse(weight, roughness, normal, read.f3());
        }
        ClosureKind::Translucent => {
            let normal = bench.normal(read.f3());
            let normal = bench.valid(normal);
            bench.lambert(LOBE_TRANSLUCENT, weight, normal);
        }
        ClosureKind::Subsurface => {
            let _scale_radius_ior_anisotropy = (read.f1(), read.f3(), read.f1(), read.f1());
            let normal = bench.normal(read.f3());
            let normal = bench.valid(normal);
            bench.lambert(LOBE_DIFFUSE, weight, normal);
        }
        ClosureKind::Sheen(model) => {
            let (roughness, normal) = (read.f1(), bench.normal(read.f3()));
            match model {
                SheenModel::Ashikhmin => bench.velvet(weight, roughness, normal),
                SheenModel::Microfiber => {
                    bench.sheen(weight, roughness, normal);
                }
            }
        }
        ClosureKind::Glossy(d) => glossy(&mut bench, weight, d, &mut read),
        ClosureKind::Glass(d) => glass(&mut bench, weight, d, &mut read),
        ClosureKind::Refraction(d) => refraction(&mut bench, weight, d, &mut read),
    }
}

fn glossy(bench: &mut Workbench, weight: Vec3, d: Distribution, read: &mut Reader) {
    if !bench.context.reflective_caustics {
        return;
    }
    let roughness = unit(read.f1());
    let anisotropy = read.f1().clamp(-0.99, 0.99);
    let rotation = read.f1();
    let normal = bench.normal(read.f3());
    let normal = bench.valid(normal);
    let tangent = read.f3();
    let alpha = roughness * roughness;
    let Some(mut lobe) = bench.lobe(distribution(d), weight, normal) else {
        return;
    };
    if anisotropy.abs() > 1.0e-4 {
        lobe.tangent = across(normal, turn(tangent, normal, rotation));
        // Positive values stretch the highlight along the tangent's bitangent.
        let (small, large) = (1.0 - anisotropy.abs(), 1.0 / (1.0 - anisotropy.abs()));
        let (x, y) = if anisotropy < 0.0 {
            (large, small)
        } else {
            (small, large)
        };
        (lobe.alpha_x, lobe.alpha_y) = (alpha * x, alpha * y);
    } else {
        (lobe.alpha_x, lobe.alpha_y) = (alpha, alpha);
    }
    let least = if d == Distribution::AshikhminShirley {
        1.0e-4
    } else {
        0.0
    };
    lobe.alpha_x = lobe.alpha_x.clamp(least, 1.0);
    lobe.alpha_y = lobe.alpha_y.clamp(least, 1.0);
    if d == Distribution::MultiGgx {
        preserve_energy(&mut lobe, Sides::Reflection, read.f3().max(Vec3::ZERO));
    }
    lobe.albedo = lobe.weight;
    bench.finish(lobe);
}

fn glass(bench: &mut Workbench, weight: Vec3, d: Distribution, read: &mut Reader) {
    let context = *bench.context;
    if !(context.reflective_caustics || context.refractive_caustics) {
        return;
    }
    let roughness = unit(read.f1());
    let ior = read.f1().max(1.0e-5);
    let normal = bench.normal(read.f3());
    let normal = bench.valid(normal);
    let color = if d == Distribution::MultiGgx {
        read.f3().max(Vec3::ZERO)
    } else {
        Vec3::ONE
    };
    let Some(mut lobe) = bench.lobe(distribution(d), weight, normal) else {
        return;
    };
    (lobe.alpha_x, lobe.alpha_y) = (roughness * roughness, roughness * roughness);
    bench.glass_sides(&mut lobe, ior, Vec3::splat(fresnel_f0(ior)), Vec3::ONE);
    // The weight has the colour already; further bounces are tinted by transmission.
    let tint = match (d, context.refractive_caustics) {
        (Distribution::MultiGgx, true) => Some(color),
        (Distribution::MultiGgx, false) => {
            Some(color * super::principled::mean_remapped(lobe.ior, lobe.f0))
        }
        _ => None,
    };
    bench.finish_fresnel(lobe, Sides::Both, tint);
}

fn refraction(bench: &mut Workbench, weight: Vec3, d: Distribution, read: &mut Reader) {
    if !bench.context.refractive_caustics {
        return;
    }
    let roughness = unit(read.f1());
    let ior = read.f1().max(1.0e-5);
    let normal = bench.normal(read.f3());
    let normal = bench.valid(normal);
    let Some(mut lobe) = bench.lobe(distribution(d), weight, normal) else {
        return;
    };
    (lobe.alpha_x, lobe.alpha_y) = (roughness * roughness, roughness * roughness);
    lobe.ior = if bench.frame.backfacing {
        1.0 / ior
    } else {
        ior
    };
    lobe.reflect_tint = Vec3::ZERO;
    lobe.transmit_tint = Vec3::ONE;
    lobe.albedo = lobe.weight;
    bench.finish(lobe);
}

impl Workbench<'_> {
    /// A parameter's normal, unit; the shading normal where it is zero or not a number.
    pub(super) fn normal(&self, normal: Vec3) -> Vec3 {
        normal.try_normalize().unwrap_or(self.frame.n)
    }

    /// The normal that glossy lobes use for a parameter's normal.
    pub(super) fn valid(&self, normal: Vec3) -> Vec3 {
        if !self.frame.bump_correction || normal == self.frame.ng {
            return normal;
        }
        shading_normal_valid(self.frame.ng, self.frame.wo, normal)
    }

    /// A lobe with its weights, or none where they are too small.
    pub(super) fn lobe(&self, kind: u32, weight: Vec3, normal: Vec3) -> Option<ClosureLobe> {
        let weight = weight.max(Vec3::ZERO);
        let sample_weight = mean(weight);
        // This way round, so that what is not a number makes no lobe.
        let enough =
            self.context.scatter && sample_weight >= WEIGHT_CUTOFF && sample_weight.is_finite();
        enough.then(|| ClosureLobe {
            kind,
            weight,
            sample_weight,
            albedo: weight,
            normal,
            bent: normal != self.frame.n,
            tangent: mapping_frame(normal).x,
            cos_wo: normal.dot(self.frame.wo),
            ..LobeSet::blank()
        })
    }

    /// Blurs, completes and keeps a lobe.
    pub(super) fn finish(&mut self, mut lobe: ClosureLobe) {
        lobe.alpha_x = lobe.alpha_x.max(self.context.blur);
        lobe.alpha_y = lobe.alpha_y.max(self.context.blur);
        if lobe.kind == LOBE_GGX || lobe.kind == LOBE_BECKMANN {
            lobe.lambda_wo = lobe_lambda(lobe, self.frame.wo);
        }
        self.set.push(lobe);
    }

    /// Weighs sampling by the lobe's reflectance, gives back lost energy where `tint` is
    /// given, keeps the lobe, and returns what it reflects with its weight.
    pub(super) fn finish_fresnel(
        &mut self,
        mut lobe: ClosureLobe,
        sides: Sides,
        tint: Option<Vec3>,
    ) -> Vec3 {
        let reflectance = estimate(&lobe);
        lobe.sample_weight *= mean(reflectance.reflected + reflectance.transmitted);
        if let Some(tint) = tint {
            preserve_energy(&mut lobe, sides, tint);
        }
        let reflected = lobe.weight * reflectance.reflected;
        lobe.albedo = reflected + lobe.weight * reflectance.transmitted;
        self.finish(lobe);
        reflected
    }

    /// Makes a lobe a dielectric's two sides, of the index `ior` seen from the front.
    pub(super) fn glass_sides(&self, lobe: &mut ClosureLobe, ior: f32, f0: Vec3, tint: Vec3) {
        let wanted = |yes: bool| if yes { 1.0 } else { 0.0 };
        lobe.ior = if self.frame.backfacing {
            1.0 / ior
        } else {
            ior
        };
        lobe.fresnel = FRESNEL_REMAPPED;
        lobe.f0 = f0.clamp(Vec3::ZERO, Vec3::ONE);
        lobe.reflect_tint = Vec3::splat(wanted(self.context.reflective_caustics));
        lobe.transmit_tint = tint * wanted(self.context.refractive_caustics);
    }

    fn lambert(&mut self, kind: u32, weight: Vec3, normal: Vec3) {
        if let Some(lobe) = self.lobe(kind, weight, normal) {
            self.set.push(lobe);
        }
    }

    /// Lambert, or Oren–Nayar where `roughness` is above zero; `color` tints its multiple
    /// scattering (OpenPBR 1.1, section "Base substrate"; σ as Fujii's).
    pub(super) fn diffuse(&mut self, weight: Vec3, roughness: f32, normal: Vec3, color: Vec3) {
        let Some(mut lobe) = self.lobe(LOBE_DIFFUSE, weight, normal) else {
            return;
        };
        let sigma = unit(roughness);
        if sigma > 0.0 {
            let a = 1.0 / (PI + sigma * (FRAC_PI_2 - 2.0 / 3.0));
            let b = sigma * a;
            let color = color.clamp(Vec3::ZERO, Vec3::ONE);
            let mean_albedo = a * PI + b * (2.0 * PI - 5.6) / 3.0;
            let lost = 1.0 - mean_albedo;
            let towards_wo = a * PI + b * lobe_oren_nayar_loss(lobe.cos_wo.max(0.0));
            let series =
                color * color * (FRAC_1_PI * mean_albedo / lost) / (Vec3::ONE - color * lost);
            lobe.kind = LOBE_OREN_NAYAR;
            lobe.lambda_wo = a;
            lobe.alpha_y = b;
            lobe.extra = series * (1.0 - towards_wo);
        }
        self.set.push(lobe);
    }

    fn velvet(&mut self, weight: Vec3, roughness: f32, normal: Vec3) {
        if let Some(mut lobe) = self.lobe(LOBE_VELVET, weight, normal) {
            lobe.alpha_x = unit(roughness).max(0.01);
            self.set.push(lobe);
        }
    }

    /// Sheen; returns what it reflects with its weight, none where it vanishes.
    pub(super) fn sheen(&mut self, weight: Vec3, roughness: f32, normal: Vec3) -> Option<Vec3> {
        let mut lobe = self.lobe(LOBE_SHEEN, weight, normal)?;
        let fit = sheen_fit(unit(roughness).max(1.0e-3), lobe.cos_wo);
        if fit.a.abs() < 1.0e-5 || fit.albedo < 1.0e-5 {
            return None;
        }
        lobe.alpha_x = fit.a;
        lobe.alpha_y = fit.b;
        lobe.weight *= fit.albedo;
        lobe.sample_weight *= fit.albedo;
        lobe.albedo = lobe.weight;
        lobe.tangent = across(normal, self.frame.wo);
        self.set.push(lobe);
        Some(lobe.weight)
    }
}

/// Part of `v` across the unit vector `normal`, unit; any such vector where there is none.
pub(super) fn across(normal: Vec3, v: Vec3) -> Vec3 {
    (v - normal * normal.dot(v))
        .try_normalize()
        .unwrap_or_else(|| mapping_frame(normal).x)
}

/// `v` turned around the unit vector `axis` by `turns` full turns (Rodrigues).
pub(super) fn turn(v: Vec3, axis: Vec3, turns: f32) -> Vec3 {
    if turns == 0.0 || !turns.is_finite() {
        return v;
    }
    let (s, c) = (turns * 2.0 * PI).sin_cos();
    v * c + axis.cross(v) * s + axis * (axis.dot(v) * (1.0 - c))
}

/// Limited to [0, 1]; 0 where it is not a number.
pub(super) fn unit(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

fn distribution(d: Distribution) -> u32 {
    match d {
        Distribution::Ggx | Distribution::MultiGgx => LOBE_GGX,
        Distribution::Beckmann => LOBE_BECKMANN,
        Distribution::AshikhminShirley => LOBE_ASHIKHMIN_SHIRLEY,
    }
}
