//! Pointiness: how convex a mesh is at a vertex. 0.5 is flat, more is convex.

use crate::scene::Mesh;
use glam::Vec3;
use std::collections::{HashMap, HashSet};

/// Pointiness of every vertex as Cycles defines the Geometry node's output: the angle between the
/// vertex normal and the mean direction of its edges, over π, then averaged with the neighbours'.
/// Vertices at the same place count as one. (Cycles walks the polygons' edges; here the diagonals
/// of its triangles count too.)
pub(super) fn pointiness(mesh: &Mesh) -> Vec<f32> {
    let welded = weld(&mesh.positions);
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    let mut edges = HashSet::new();
    for triangle in &mesh.indices {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        let normal = (b - a).cross(c - a);
        for corner in 0..3 {
            let [from, to] = [corner, (corner + 1) % 3].map(|k| welded[triangle[k] as usize]);
            normals[from as usize] += normal;
            if from != to {
                edges.insert((from.min(to), from.max(to)));
            }
        }
    }
    let mut edges: Vec<(u32, u32)> = edges.into_iter().collect();
    edges.sort_unstable();
    let raw = angles(&mesh.positions, &normals, &edges);
    let smooth = average(&raw, &edges);
    welded.iter().map(|&v| smooth[v as usize]).collect()
}

/// For every vertex the first one at its place.
fn weld(positions: &[Vec3]) -> Vec<u32> {
    let mut first: HashMap<[u32; 3], u32> = HashMap::new();
    positions
        .iter()
        .enumerate()
        // Adding zero makes −0 and 0 the same.
        .map(|(i, p)| {
            *first
                .entry((*p + Vec3::ZERO).to_array().map(f32::to_bits))
                .or_insert(i as u32)
        })
        .collect()
}

fn angles(positions: &[Vec3], normals: &[Vec3], edges: &[(u32, u32)]) -> Vec<f32> {
    let mut sums = vec![(Vec3::ZERO, 0u32); positions.len()];
    for &(a, b) in edges {
        let direction = (positions[b as usize] - positions[a as usize]).normalize_or_zero();
        for (vertex, direction) in [(a, direction), (b, -direction)] {
            sums[vertex as usize].0 += direction;
            sums[vertex as usize].1 += 1;
        }
    }
    let angle = |(i, (sum, count)): (usize, &(Vec3, u32))| {
        if *count == 0 {
            return 0.0;
        }
        let cosine = normals[i].normalize_or_zero().dot(*sum / *count as f32);
        cosine.clamp(-1.0, 1.0).acos() * std::f32::consts::FRAC_1_PI
    };
    sums.iter().enumerate().map(angle).collect()
}

fn average(raw: &[f32], edges: &[(u32, u32)]) -> Vec<f32> {
    let mut sums: Vec<(f32, u32)> = raw.iter().map(|&value| (value, 1)).collect();
    for &(a, b) in edges {
        for (vertex, other) in [(a, b), (b, a)] {
            sums[vertex as usize].0 += raw[other as usize];
            sums[vertex as usize].1 += 1;
        }
    }
    sums.into_iter()
        .map(|(sum, count)| sum / count as f32)
        .collect()
}
