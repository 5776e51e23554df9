//! Numerical integration of the albedo tables: deterministic averages over visible normals.

use super::tables::{GLASS, REFLECTION, Tables};
use crate::device::fresnel::{
    fresnel_f0, fresnel_interface, fresnel_ior_of_f0, fresnel_position, fresnel_schlick_power,
};
use crate::device::microfacet::{
    microfacet_alpha_tan_squared, microfacet_ggx_lambda, microfacet_ggx_sample,
};
use glam::{Vec2, Vec3};

/// What is averaged over the normals visible under one cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrand {
    /// Reflected energy, without Fresnel.
    Reflection,
    /// Reflected and refracted energy for a relative index of refraction.
    Glass(f32),
    /// Position of a dielectric's reflectance between F0 and 1, for a relative index.
    Dielectric(f32),
    /// (1 − cos)⁵.
    Schlick,
}

/// Average of an integrand over `samples` visible normals for the roughness √α.
pub fn average(integrand: Integrand, roughness: f32, cosine: f32, samples: u32) -> f32 {
    let alpha = roughness * roughness;
    let wo = Vec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    let mut sum = 0.0_f64;
    for i in 0..samples {
        let h = microfacet_ggx_sample(wo, alpha, alpha, point(i, samples));
        sum += f64::from(contribution(integrand, alpha, wo, h));
    }
    (sum / f64::from(samples)) as f32
}

/// Point of a rank-1 lattice with the golden ratio as its generator.
fn point(i: u32, samples: u32) -> Vec2 {
    let x = (f64::from(i) + 0.5) / f64::from(samples);
    let y = (0.5 + f64::from(i) * 0.618_033_988_749_894_9).fract();
    Vec2::new(x as f32, y as f32)
}

fn contribution(integrand: Integrand, alpha: f32, wo: Vec3, h: Vec3) -> f32 {
    let c = wo.dot(h);
    let mirrored = h * (2.0 * c) - wo;
    let reflected = if mirrored.z >= 0.0 { 1.0 } else { 0.0 };
    match integrand {
        Integrand::Reflection => reflected * masking(alpha, wo, mirrored),
        Integrand::Dielectric(ior) => {
            let f = fresnel_interface(c, ior).reflectance;
            reflected * fresnel_position(f, fresnel_f0(ior))
        }
        Integrand::Schlick => reflected * fresnel_schlick_power(c),
        Integrand::Glass(ior) => {
            let interface = fresnel_interface(c, ior);
            let f = interface.reflectance;
            // Seen from inside, some refracted directions stay on that side. They count:
            // the scaling is not meant to make up for a loss that microfacets cannot have.
            let refracted = h * (c / ior - interface.cos_transmitted) - wo / ior;
            let straight = (ior - 1.0).abs() < 1.0e-4;
            let passed = if straight {
                1.0
            } else {
                masking(alpha, wo, refracted)
            };
            f * reflected * masking(alpha, wo, mirrored) + (1.0 - f) * passed
        }
    }
}

/// Probability that what is visible from `wo` is visible from `wi` too.
fn masking(alpha: f32, wo: Vec3, wi: Vec3) -> f32 {
    let lambda = |v: Vec3| microfacet_ggx_lambda(microfacet_alpha_tan_squared(v, alpha, alpha));
    let o = 1.0 + lambda(wo);
    o / (o + lambda(wi))
}

/// Value of a node on an axis of `n`, kept away from the singular ends.
fn node(i: usize, n: usize, last: f32) -> f32 {
    (i as f32 / (n - 1) as f32).clamp(1.0e-4, last)
}

/// Index of refraction of a node on the axis of F0^¼.
fn node_ior(z: usize) -> f32 {
    let f = node(z, GLASS, 0.99);
    fresnel_ior_of_f0(f * f * f * f)
}

/// Cosine-weighted mean over `angles` directions.
fn mean(integrand: Integrand, roughness: f32, angles: u32, samples: u32) -> f32 {
    let at = |i: u32| {
        let cosine = (i as f32 + 0.5) / angles as f32;
        f64::from(2.0 * cosine * average(integrand, roughness, cosine, samples))
    };
    ((0..angles).map(at).sum::<f64>() / f64::from(angles)) as f32
}

fn cube(samples: u32, integrand: impl Fn(f32) -> Integrand) -> Vec<f32> {
    let mut out = Vec::with_capacity(GLASS * GLASS * GLASS);
    for z in 0..GLASS {
        for y in 0..GLASS {
            for x in 0..GLASS {
                let (rough, cosine) = (node(x, GLASS, 1.0), node(y, GLASS, 1.0));
                out.push(average(integrand(node_ior(z)), rough, cosine, samples));
            }
        }
    }
    out
}

fn means(samples: u32, integrand: impl Fn(f32) -> Integrand) -> Vec<f32> {
    let mut out = Vec::with_capacity(GLASS * GLASS);
    for z in 0..GLASS {
        for x in 0..GLASS {
            out.push(mean(
                integrand(node_ior(z)),
                node(x, GLASS, 1.0),
                32,
                samples,
            ));
        }
    }
    out
}

/// All tables, with about `samples` directions for each entry.
pub fn integrate_tables(samples: u32) -> Tables {
    let few = (samples / 8).max(16);
    let mut reflection = Vec::with_capacity(REFLECTION * REFLECTION);
    for y in 0..REFLECTION {
        for x in 0..REFLECTION {
            let (rough, cosine) = (node(x, REFLECTION, 1.0), node(y, REFLECTION, 1.0));
            reflection.push(average(Integrand::Reflection, rough, cosine, samples));
        }
    }
    let mut schlick = Vec::with_capacity(GLASS * GLASS);
    for y in 0..GLASS {
        for x in 0..GLASS {
            let (rough, cosine) = (node(x, GLASS, 1.0), node(y, GLASS, 1.0));
            schlick.push(average(Integrand::Schlick, rough, cosine, samples));
        }
    }
    Tables {
        reflection,
        reflection_mean: (0..REFLECTION)
            .map(|x| mean(Integrand::Reflection, node(x, REFLECTION, 1.0), 96, few))
            .collect(),
        glass: cube(samples, Integrand::Glass),
        glass_mean: means(few, Integrand::Glass),
        glass_inside: cube(samples, |ior| Integrand::Glass(1.0 / ior)),
        glass_inside_mean: means(few, |ior| Integrand::Glass(1.0 / ior)),
        dielectric: cube(samples, Integrand::Dielectric),
        schlick,
    }
}
