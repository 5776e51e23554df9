//! Albedos of microfacet and sheen lobes, tabulated: loading. Device code
//! (`crate::device::closure_tables`) says how the entries lie and interpolates.
//!
//! `tables.bin` is written by `cargo run --release -p matcha-render --example
//! closure_tables`; a test derives it anew. `sheen.bin` is measured (docs/closures.md).

use crate::device::closure_tables::{
    CLOSURE_GLASS_NODES, CLOSURE_REFLECTION_NODES, CLOSURE_TABLE_DIELECTRIC, CLOSURE_TABLE_END,
    CLOSURE_TABLE_GLASS, CLOSURE_TABLE_GLASS_INSIDE, CLOSURE_TABLE_GLASS_INSIDE_MEAN,
    CLOSURE_TABLE_GLASS_MEAN, CLOSURE_TABLE_REFLECTION, CLOSURE_TABLE_REFLECTION_MEAN,
    CLOSURE_TABLE_SCHLICK, CLOSURE_TABLE_SHEEN, ClosureTables,
};
use std::sync::LazyLock;

/// Nodes on each axis of the reflection table.
pub const REFLECTION: usize = CLOSURE_REFLECTION_NODES as usize;
/// Nodes on each axis of the tables with an index of refraction.
pub const GLASS: usize = CLOSURE_GLASS_NODES as usize;

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

/// First entries of the parts in the file's order, and where the last one ends.
const STARTS: [u32; 9] = [
    CLOSURE_TABLE_REFLECTION,
    CLOSURE_TABLE_REFLECTION_MEAN,
    CLOSURE_TABLE_GLASS,
    CLOSURE_TABLE_GLASS_MEAN,
    CLOSURE_TABLE_GLASS_INSIDE,
    CLOSURE_TABLE_GLASS_INSIDE_MEAN,
    CLOSURE_TABLE_DIELECTRIC,
    CLOSURE_TABLE_SCHLICK,
    CLOSURE_TABLE_SHEEN,
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
        let mut part = |i: usize| -> Vec<f32> {
            (STARTS[i]..STARTS[i + 1])
                .map(|_| words.next().unwrap_or(0.0) / SCALE)
                .collect()
        };
        Self {
            reflection: part(0),
            reflection_mean: part(1),
            glass: part(2),
            glass_mean: part(3),
            glass_inside: part(4),
            glass_inside_mean: part(5),
            dielectric: part(6),
            schlick: part(7),
        }
    }
}

/// The committed microfacet tables.
pub fn tables() -> Tables {
    Tables::from_bytes(include_bytes!("tables.bin"))
}

/// All entries as device code reads them.
static ENTRIES: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let mut entries = tables().parts().map(Vec::as_slice).concat();
    // Three planes of roughness × cosine: a, b, albedo.
    let sheen: &[u8] = include_bytes!("sheen.bin");
    entries.extend(
        sheen
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
    );
    assert_eq!(entries.len(), CLOSURE_TABLE_END as usize, "closure tables");
    entries
});

/// The tables of all closures.
pub fn closure_tables() -> ClosureTables<'static> {
    ClosureTables { entry: &ENTRIES }
}
