//! The Principled closure, version 2: layers from the top down, each taking from what is
//! below the light that it reflects. Order and scalings are those of Cycles in Blender 4.5
//! ("Principled BSDF"). Subsurface scattering is rendered as diffuse reflection, thin films
//! not at all.

use super::albedo::Sides;
use super::prepare::{Reader, Workbench, across, turn, unit};
use super::set::WEIGHT_CUTOFF;
use crate::device::fresnel::{
    FRESNEL_DIELECTRIC, FRESNEL_F82, FRESNEL_REMAPPED, fresnel_f0, fresnel_f82_coefficient,
    fresnel_ior_of_f0, fresnel_mean_dielectric, fresnel_mean_f82, fresnel_position,
};
use crate::device::lobe::{LOBE_DIFFUSE, LOBE_GGX};
use glam::Vec3;
use matcha_shade::closure::Distribution;

/// Parameters after their limits.
struct Principled {
    base_color: Vec3,
    metallic: f32,
    roughness: f32,
    ior: f32,
    alpha: f32,
    normal: Vec3,
    diffuse_roughness: f32,
    subsurface: f32,
    specular_level: f32,
    specular_tint: Vec3,
    anisotropic: f32,
    rotation: f32,
    tangent: Vec3,
    transmission: f32,
    coat: f32,
    coat_roughness: f32,
    coat_ior: f32,
    coat_tint: Vec3,
    coat_normal: Vec3,
    sheen: f32,
    sheen_roughness: f32,
    sheen_tint: Vec3,
    emission: Vec3,
    /// Energy of multiple scattering is given back.
    multiple: bool,
}

impl Principled {
    /// In the order of `matcha_shade::closure::PRINCIPLED`.
    fn read(bench: &Workbench, d: Distribution, read: &mut Reader) -> Self {
        let base_color = read.f3().max(Vec3::ZERO);
        let metallic = unit(read.f1());
        let roughness = unit(read.f1());
        let ior = read.f1().max(1.0e-5);
        let alpha = unit(read.f1());
        let normal = bench.normal(read.f3());
        let diffuse_roughness = unit(read.f1());
        let subsurface = unit(read.f1());
        let _radius_scale_ior_anisotropy = (read.f3(), read.f1(), read.f1(), read.f1());
        let specular_level = read.f1().max(0.0);
        let specular_tint = read.f3().max(Vec3::ZERO);
        let anisotropic = unit(read.f1());
        let rotation = read.f1();
        let tangent = read.f3();
        let transmission = unit(read.f1());
        let coat = read.f1().max(0.0);
        let coat_roughness = unit(read.f1());
        let coat_ior = read.f1().max(1.0);
        let coat_tint = read.f3().max(Vec3::ZERO);
        let coat_normal = bench.normal(read.f3());
        let sheen = read.f1().max(0.0);
        let sheen_roughness = unit(read.f1());
        let sheen_tint = read.f3().max(Vec3::ZERO);
        let emission = read.f3();
        let emission = emission * read.f1();
        Self {
            base_color,
            metallic,
            roughness,
            ior,
            alpha,
            normal,
            diffuse_roughness,
            subsurface,
            specular_level,
            specular_tint,
            anisotropic,
            rotation,
            tangent,
            transmission,
            coat,
            coat_roughness,
            coat_ior,
            coat_tint,
            coat_normal,
            sheen,
            sheen_roughness,
            sheen_tint,
            emission,
            multiple: d == Distribution::MultiGgx,
        }
    }

    /// α along and across the tangent.
    fn alphas(&self) -> (f32, f32) {
        let alpha = self.roughness * self.roughness;
        let aspect = (1.0 - self.anisotropic * 0.9).sqrt();
        ((alpha / aspect).min(1.0), (alpha * aspect).min(1.0))
    }
}

/// What is left of `weight` under a layer that reflects `reflected` of it.
fn under(weight: Vec3, reflected: Vec3) -> Vec3 {
    let fraction = |r: f32, w: f32| if w != 0.0 { r / w } else { 0.0 };
    let x = fraction(reflected.x, weight.x);
    let y = fraction(reflected.y, weight.y);
    let z = fraction(reflected.z, weight.z);
    weight * unit(1.0 - x.max(y).max(z))
}

/// Mean of the remapped dielectric reflectance between `f0` and 1.
pub(super) fn mean_remapped(ior: f32, f0: Vec3) -> Vec3 {
    let s = fresnel_position(fresnel_mean_dielectric(ior), fresnel_f0(ior));
    f0 + (Vec3::ONE - f0) * s
}

/// Adds the lobes of a Principled closure.
pub(super) fn prepare_principled(
    bench: &mut Workbench,
    weight: Vec3,
    d: Distribution,
    read: &mut Reader,
) {
    let p = Principled::read(bench, d, read);
    let mut weight = weight;
    if p.alpha < 1.0 {
        bench.set.add_transparency(weight * (1.0 - p.alpha));
        weight *= p.alpha;
    }
    if p.sheen > WEIGHT_CUTOFF {
        let normal = bench.normal(p.normal.lerp(p.coat_normal, unit(p.coat)));
        let tinted = p.sheen_tint * weight * p.sheen;
        if let Some(reflected) = bench.sheen(tinted, p.sheen_roughness, normal) {
            weight = under(weight, reflected);
        }
    }
    if p.coat > WEIGHT_CUTOFF {
        weight = coat(bench, &p, weight);
    }
    let emitted = p.emission * weight;
    if emitted.is_finite() {
        bench.set.emission += emitted;
    }
    if !bench.context.scatter {
        return;
    }
    let normal = bench.valid(p.normal);
    if p.metallic > WEIGHT_CUTOFF {
        metal(bench, &p, weight * p.metallic, normal);
        weight *= 1.0 - p.metallic;
    }
    if p.transmission > WEIGHT_CUTOFF {
        transmission(bench, &p, weight * p.transmission, normal);
        weight *= 1.0 - p.transmission;
    }
    weight = specular(bench, &p, weight, normal);
    let clamped = p.base_color.min(Vec3::ONE);
    if let Some(lobe) = bench.lobe(LOBE_DIFFUSE, clamped * weight * p.subsurface, normal) {
        bench.set.push(lobe);
    }
    let rest = p.base_color * weight * (1.0 - p.subsurface);
    let rough = if p.diffuse_roughness < WEIGHT_CUTOFF {
        0.0
    } else {
        p.diffuse_roughness
    };
    bench.diffuse(rest, rough, p.normal, p.base_color);
}

/// The clear coat; returns what is left below.
fn coat(bench: &mut Workbench, p: &Principled, weight: Vec3) -> Vec3 {
    let mut left = weight;
    let normal = bench.valid(p.coat_normal);
    if bench.context.reflective_caustics
        && let Some(mut lobe) = bench.lobe(LOBE_GGX, weight * p.coat, normal)
    {
        lobe.ior = p.coat_ior;
        lobe.fresnel = FRESNEL_DIELECTRIC;
        lobe.alpha_x = p.coat_roughness * p.coat_roughness;
        lobe.alpha_y = lobe.alpha_x;
        let tint = Vec3::splat(fresnel_mean_dielectric(p.coat_ior));
        let reflected = bench.finish_fresnel(lobe, Sides::Reflection, Some(tint));
        left = under(weight, reflected);
    }
    if p.coat_tint != Vec3::ONE {
        // The tint is that of one thickness; light crosses more of it at an angle (Beer).
        let cosine = bench.frame.wo.dot(normal);
        let inside = (1.0 - (1.0 - cosine * cosine) / (p.coat_ior * p.coat_ior))
            .max(1.0e-6)
            .sqrt();
        let absorbed = p.coat_tint.powf(1.0 / inside);
        left *= Vec3::ONE + (absorbed - Vec3::ONE) * p.coat;
    }
    left
}

fn metal(bench: &mut Workbench, p: &Principled, weight: Vec3, normal: Vec3) {
    if !bench.context.reflective_caustics {
        return;
    }
    let Some(mut lobe) = bench.lobe(LOBE_GGX, weight, normal) else {
        return;
    };
    (lobe.alpha_x, lobe.alpha_y) = p.alphas();
    lobe.tangent = across(normal, turn(p.tangent, p.normal, p.rotation));
    lobe.fresnel = FRESNEL_F82;
    lobe.f0 = p.base_color.min(Vec3::ONE);
    lobe.extra = fresnel_f82_coefficient(lobe.f0, p.specular_tint.min(Vec3::ONE));
    let tint = p.multiple.then(|| fresnel_mean_f82(lobe.f0, lobe.extra));
    bench.finish_fresnel(lobe, Sides::Reflection, tint);
}

fn transmission(bench: &mut Workbench, p: &Principled, weight: Vec3, normal: Vec3) {
    let context = *bench.context;
    if !(context.reflective_caustics || context.refractive_caustics) {
        return;
    }
    let Some(mut lobe) = bench.lobe(LOBE_GGX, weight, normal) else {
        return;
    };
    lobe.alpha_x = p.roughness * p.roughness;
    lobe.alpha_y = lobe.alpha_x;
    let clamped = p.base_color.min(Vec3::ONE);
    // Light passes the surface twice, so that each pass takes the root.
    let color = Vec3::new(clamped.x.sqrt(), clamped.y.sqrt(), clamped.z.sqrt());
    bench.glass_sides(&mut lobe, p.ior, p.specular_tint * fresnel_f0(p.ior), color);
    let single = if lobe.transmit_tint == Vec3::ZERO {
        mean_remapped(lobe.ior, lobe.f0)
    } else {
        lobe.transmit_tint
    };
    bench.finish_fresnel(lobe, Sides::Both, p.multiple.then_some(single));
}

/// The dielectric surface over the diffuse base; returns what is left below.
fn specular(bench: &mut Workbench, p: &Principled, weight: Vec3, normal: Vec3) -> Vec3 {
    let mut ior = p.ior;
    let mut f0 = fresnel_f0(ior);
    if p.specular_level != 0.5 {
        f0 *= 2.0 * p.specular_level;
        ior = fresnel_ior_of_f0(f0);
        if p.ior < 1.0 {
            ior = 1.0 / ior;
        }
    }
    if !bench.context.reflective_caustics || ior == 1.0 {
        return weight;
    }
    let Some(mut lobe) = bench.lobe(LOBE_GGX, weight, normal) else {
        return weight;
    };
    (lobe.alpha_x, lobe.alpha_y) = p.alphas();
    lobe.tangent = across(normal, turn(p.tangent, p.normal, p.rotation));
    lobe.fresnel = FRESNEL_REMAPPED;
    lobe.ior = ior;
    lobe.f0 = (p.specular_tint * f0).clamp(Vec3::ZERO, Vec3::ONE);
    let tint = p.multiple.then(|| mean_remapped(ior, lobe.f0));
    let reflected = bench.finish_fresnel(lobe, Sides::Reflection, tint);
    under(weight, reflected)
}
