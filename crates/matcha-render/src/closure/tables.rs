//! Albedos of microfacet lobes, tabulated. A host layer: device code gets the numbers that
//! these functions look up, never the tables.
//!
//! `tables.bin` is written by `cargo run --release -p matcha-render --example
//! closure_tables`; a test derives it anew. Axes, each linear from 0 to 1 over its nodes:
//! roughness √α, cosine, and for dielectrics the fourth root of F0.

use std::sync::LazyLock;

/// Nodes on each axis of the reflection table.
pub const REFLECTION: usize = 32;
/// Nodes on each axis of the tables with an index of refraction.
pub const GLASS: usize = 16;

/// All microfacet tables, values 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Tables {
    /// Albedo of GGX reflection: cosine × roughness.
    pub reflection: Vec<f32>,
    /// Its cosine-weighted mean: roughness.
    pub reflection_mean: Vec<f32>,
    /// Albedo of GGX glass seen from outside: F0 × cosine × roughness.
    pub glass: Vec<f32>,
    /// Its mean: F0 × roughness.
    pub glass_mean: Vec<f32>,
    /// As `glass`, seen from inside.
    pub glass_inside: Vec<f32>,
    /// As `glass_mean`, seen from inside.
    pub glass_inside_mean: Vec<f32>,
    /// Mean position between F0 and 1 of a dielectric's Fresnel factor:
    /// F0 × cosine × roughness.
    pub dielectric: Vec<f32>,
    /// Likewise of Schlick's: cosine × roughness.
    pub schlick: Vec<f32>,
}

const SIZES: [usize; 8] = [
    REFLECTION * REFLECTION,
    REFLECTION,
    GLASS * GLASS * GLASS,
    GLASS * GLASS,
    GLASS * GLASS * GLASS,
    GLASS * GLASS,
    GLASS * GLASS * GLASS,
    GLASS * GLASS,
];

const SCALE: f32 = 65535.0;

impl Tables {
    fn parts(&self) -> [&Vec<f32>; 8] {
        [
            &self.reflection,
            &self.reflection_mean,
            &self.glass,
            &self.glass_mean,
            &self.glass_inside,
            &self.glass_inside_mean,
            &self.dielectric,
            &self.schlick,
        ]
    }

    /// Largest difference between entries of two sets of tables.
    pub fn largest_difference(&self, other: &Self) -> f32 {
        let values = |t: &Self| {
            t.parts()
                .into_iter()
                .flatten()
                .copied()
                .collect::<Vec<f32>>()
        };
        values(self)
            .iter()
            .zip(values(other))
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f32::max)
    }

    /// As bytes: little-endian 16-bit fractions of 1.
    pub fn to_bytes(&self) -> Vec<u8> {
        let quantise = |v: &f32| ((v.clamp(0.0, 1.0) * SCALE + 0.5) as u16).to_le_bytes();
        self.parts()
            .into_iter()
            .flatten()
            .flat_map(quantise)
            .collect()
    }

    /// From [`Tables::to_bytes`]; missing bytes read 0.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        let mut words = bytes
            .chunks_exact(2)
            .map(|b| f32::from(u16::from_le_bytes([b[0], b[1]])));
        let mut part = |n: usize| -> Vec<f32> {
            (0..n)
                .map(|_| words.next().unwrap_or(0.0) / SCALE)
                .collect()
        };
        Self {
            reflection: part(SIZES[0]),
            reflection_mean: part(SIZES[1]),
            glass: part(SIZES[2]),
            glass_mean: part(SIZES[3]),
            glass_inside: part(SIZES[4]),
            glass_inside_mean: part(SIZES[5]),
            dielectric: part(SIZES[6]),
            schlick: part(SIZES[7]),
        }
    }
}

static TABLES: LazyLock<Tables> =
    LazyLock::new(|| Tables::from_bytes(include_bytes!("tables.bin")));

/// The committed tables.
pub fn tables() -> &'static Tables {
    &TABLES
}

/// Nodes on each axis of the sheen table.
pub const SHEEN: usize = 32;

/// Sheen coefficients for one angle and roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheenFit {
    /// First coefficient of the inverse transform.
    pub a: f32,
    /// Second coefficient.
    pub b: f32,
    /// Directional albedo.
    pub albedo: f32,
}

/// Three planes of roughness × cosine: a, b, albedo.
static SHEEN_TABLE: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let bytes: &[u8] = include_bytes!("sheen.bin");
    bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect()
});

/// Where a coordinate falls between nodes.
fn locate(x: f32, n: usize) -> (usize, usize, f32) {
    // Not a number becomes 0.
    let x = if x > 0.0 { x.min(1.0) } else { 0.0 } * (n - 1) as f32;
    let i = (x as usize).min(n - 1);
    (i, (i + 1).min(n - 1), x - i as f32)
}

fn linear(table: &[f32], n: usize, x: f32) -> f32 {
    let (i, j, t) = locate(x, n);
    table[i] + (table[j] - table[i]) * t
}

fn bilinear(table: &[f32], n: usize, x: f32, y: f32) -> f32 {
    let (i, j, t) = locate(y, n);
    let a = linear(&table[i * n..][..n], n, x);
    let b = linear(&table[j * n..][..n], n, x);
    a + (b - a) * t
}

fn trilinear(table: &[f32], n: usize, x: f32, y: f32, z: f32) -> f32 {
    let (i, j, t) = locate(z, n);
    let slice = n * n;
    let a = bilinear(&table[i * slice..][..slice], n, x, y);
    let b = bilinear(&table[j * slice..][..slice], n, x, y);
    a + (b - a) * t
}

/// Coordinate of a relative index of refraction in the tables, the same for its inverse.
fn ior_coordinate(ior: f32) -> f32 {
    ((ior - 1.0) / (ior + 1.0)).abs().sqrt()
}

/// Directional albedo of single-scattering GGX reflection without Fresnel, and its mean.
pub fn reflection_albedo(roughness: f32, cosine: f32) -> (f32, f32) {
    let t = tables();
    (
        bilinear(&t.reflection, REFLECTION, roughness, cosine),
        linear(&t.reflection_mean, REFLECTION, roughness),
    )
}

/// Directional albedo of single-scattering GGX glass, and its mean.
pub fn glass_albedo(roughness: f32, cosine: f32, ior: f32) -> (f32, f32) {
    let t = tables();
    let inside = ior < 1.0;
    let z = ior_coordinate(ior);
    let table = if inside { &t.glass_inside } else { &t.glass };
    let mean = if inside {
        &t.glass_inside_mean
    } else {
        &t.glass_mean
    };
    (
        trilinear(table, GLASS, roughness, cosine, z),
        bilinear(mean, GLASS, roughness, z),
    )
}

/// Mean position between F0 and 1 of a dielectric's reflectance over visible microfacets.
pub fn dielectric_position(roughness: f32, cosine: f32, ior: f32) -> f32 {
    trilinear(
        &tables().dielectric,
        GLASS,
        roughness,
        cosine,
        ior_coordinate(ior),
    )
}

/// Likewise of Schlick's approximation.
pub fn schlick_position(roughness: f32, cosine: f32) -> f32 {
    bilinear(&tables().schlick, GLASS, roughness, cosine)
}

/// Sheen coefficients.
pub fn sheen_fit(roughness: f32, cosine: f32) -> SheenFit {
    let plane = |i: usize| &SHEEN_TABLE[i * SHEEN * SHEEN..][..SHEEN * SHEEN];
    let read = |i: usize| bilinear(plane(i), SHEEN, cosine, roughness);
    SheenFit {
        a: read(0),
        b: read(1),
        albedo: read(2),
    }
}
