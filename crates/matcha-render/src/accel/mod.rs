//! Where rays meet the scene: a hierarchy of boxes over triangles and instances, and the walk.
//!
//! `obvhs` builds binary hierarchies; ours are collapsed from them into nodes of eight children
//! (`collapse`), tested at once (`kernel`), with leaves of up to four packs of four triangles.
//! Triangles are tested by the signs of Plücker products about the ray (as Embree's robust mode
//! does), which are exactly opposite for the two triangles of an edge: no ray slips between.

mod build;
mod collapse;
mod kernel;
#[cfg(target_arch = "x86_64")]
mod kernel_avx2;
mod memory;
mod node;
mod ray;
#[cfg(test)]
mod tests;
mod traverse;
mod validate;

pub use build::{BuildOptions, is_hittable, is_near};
pub use node::{Bounds, LEAF_PACKS, Link, Node, PACK, Pack, WIDTH};
pub use ray::{Hit, NOTHING, Ray, offset_origin, ray_kind, visibility_mask};
pub use traverse::{Placement, Tree};

use crate::scene::Scene;
use traverse::Isa;

/// Why there is no structure for a scene.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum AccelError {
    /// A triangle names a vertex that is not there.
    #[error(
        "mesh {mesh:?}: triangle {triangle} refers to vertex {vertex}, but there are {vertices}"
    )]
    VertexIndex {
        /// Mesh.
        mesh: String,
        /// Triangle.
        triangle: usize,
        /// Vertex it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// An instance names a mesh that is not there.
    #[error("object {instance:?} refers to mesh {mesh}, but there are {meshes}")]
    MeshIndex {
        /// Instance.
        instance: String,
        /// Mesh it names.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// More than the structure's links can address.
    #[error("the scene has too many triangles: at most {limit} nodes can be addressed")]
    TooLarge {
        /// Number of nodes.
        limit: usize,
    },
}

/// The structure that answers rays.
#[derive(Clone, Debug)]
pub struct Accel {
    nodes: Vec<Node>,
    packs: Vec<Pack>,
    placements: Vec<Placement>,
    masks: Vec<u8>,
    root: Link,
    depth: usize,
    dropped: usize,
    isa: Isa,
}

impl Accel {
    /// Builds the structure of a scene.
    pub fn build(scene: &Scene) -> Result<Self, AccelError> {
        Self::build_with(scene, &BuildOptions::default())
    }

    /// Builds the structure of a scene with options.
    pub fn build_with(scene: &Scene, options: &BuildOptions) -> Result<Self, AccelError> {
        build::build(scene, options)
    }

    /// What a walk reads, for devices that walk it in a form of their own.
    pub fn tree(&self) -> Tree<'_> {
        Tree {
            nodes: &self.nodes,
            packs: &self.packs,
            placements: &self.placements,
            masks: &self.masks,
            root: self.root,
        }
    }

    /// Takes instances that let light through out of the sight of shadow rays and shows them
    /// to [`ray_kind::TRANSPARENT_SHADOW`] rays instead. `transparent` has an entry an instance.
    pub fn part_shadows(&mut self, transparent: &[bool]) {
        for (mask, _) in self
            .masks
            .iter_mut()
            .zip(transparent)
            .filter(|(_, is)| **is)
        {
            if *mask & ray_kind::SHADOW != 0 {
                *mask = *mask & !ray_kind::SHADOW | ray_kind::TRANSPARENT_SHADOW;
            }
        }
    }

    /// The nearest hit along a ray.
    #[inline]
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        traverse::trace::<false>(&self.tree(), ray, self.isa, self.depth)
    }

    /// True if anything is hit.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        traverse::trace::<true>(&self.tree(), ray, self.isa, self.depth).is_some()
    }

    /// The nearest hits of many rays; as many as the shorter slice has.
    pub fn closest_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.closest(ray);
        }
    }

    /// Which of many rays hit anything; as many as the shorter slice has.
    pub fn occluded_batch(&self, rays: &[Ray], blocked: &mut [bool]) {
        for (ray, blocked) in rays.iter().zip(blocked) {
            *blocked = self.occluded(ray);
        }
    }

    /// Memory of the structure, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
            + size_of_val(&self.packs[..])
            + size_of_val(&self.placements[..])
            + self.masks.len()
    }

    /// Triangles that were left out because nothing can hit them: no area, or no finite coordinates.
    pub fn dropped_triangles(&self) -> usize {
        self.dropped
    }

    /// Turns to the code that needs no special instructions, for comparison.
    #[doc(hidden)]
    pub fn use_portable_kernel(&mut self) {
        self.isa = Isa::Portable;
    }
}
