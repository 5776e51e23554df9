//! A random number for every island of a mesh: vertices that edges join.

use crate::scene::Mesh;

/// Root of a vertex in a forest, halving the path to it.
fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let above = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = above;
        vertex = above;
    }
    vertex
}

/// A number in [0, 1] per triangle, the same for all triangles of an island: a hash of the
/// island's least vertex where the file does not say (Cycles hashes a vertex of the island too;
/// which one depends on its edges' order, which only an exporter knows).
pub(super) fn random_per_island(mesh: &Mesh) -> Vec<f32> {
    if mesh.islands.len() == mesh.indices.len() {
        return mesh.islands.clone();
    }
    let mut parents: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for triangle in &mesh.indices {
        for vertex in &triangle[1..] {
            let (a, b) = (root(&mut parents, triangle[0]), root(&mut parents, *vertex));
            parents[a.max(b) as usize] = a.min(b);
        }
    }
    let number = |t: &[u32; 3]| hash_to_unit(root(&mut parents, t[0]));
    mesh.indices.iter().map(number).collect()
}

/// A 32-bit mix (Wellons 2018, "Prospecting for hash functions": lowbias32), scaled to [0, 1].
fn hash_to_unit(mut x: u32) -> f32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^= x >> 16;
    x as f32 / u32::MAX as f32
}
