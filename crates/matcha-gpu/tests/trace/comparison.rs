//! Both devices' answers to the same rays.

use super::adapter::{Device, Section};
use matcha_gpu::trace::{HIT_ROWS, RAY_ROWS, WideTree, hits_of_rows, ray_rows};
use matcha_render::accel::{Accel, Hit, Ray};
use matcha_wgsl::{Module, translate};

/// The walk's WGSL with the device code that it needs.
fn wgsl(stack: u32) -> String {
    let read =
        |path: &str| Module::read(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).expect(path);
    let modules = [
        "../matcha-shade/src/device/math.rs",
        "../matcha-render/src/device/ray_box.rs",
        "../matcha-render/src/device/ray_triangle.rs",
    ];
    let device = translate(&modules.map(read)).unwrap_or_else(|e| panic!("{e}"));
    let needed = [
        "ray_is_sound",
        "box_inverse",
        "BOX_FAR_SLACK",
        "triangle_sides",
        "triangle_inside",
        "triangle_distance",
        "triangle_weights",
    ];
    let text = |path: &str| read(path).source;
    format!(
        "const TRACE_STACK = {stack}u;\nfn word_trace_count(k: u32) -> u32 {{ return count_trace_rays(); }}\n{}{}{}",
        device.needed(needed).text(),
        text("src/wgsl/traverse.wgsl"),
        text("src/wgsl/trace_batch.wgsl")
    )
}

/// What the device finds: nearest hits, or instances alone for `trace_occluded_rays`.
pub fn trace(device: &Device, tree: &WideTree, rays: &[Ray], entry: &str) -> Vec<Option<Hit>> {
    let rows = ray_rows(rays);
    let hits = vec![u32::MAX; HIT_ROWS * rays.len()];
    let padded;
    let triangles: &[u32] = if tree.triangles.is_empty() {
        padded = [0; 12];
        &padded
    } else {
        bytemuck::cast_slice(&tree.triangles)
    };
    let section = |name, class, stride, words| Section {
        name,
        class,
        stride,
        words,
    };
    let sections = [
        section("bvh_nodes", "read4", 5, bytemuck::cast_slice(&tree.nodes)),
        section("bvh_triangles", "read4", 3, triangles),
        section("trace_rays", "read", RAY_ROWS, &rows),
        section("trace_hits", "write", HIT_ROWS, &hits),
    ];
    assert_eq!(rows.len(), RAY_ROWS * rays.len());
    let kernel = device.kernel(&wgsl(tree.stack()), &sections, entry);
    hits_of_rows(&device.run(&kernel, &sections, rays.len()))
}

/// How two devices' answers differ.
#[derive(Debug, Default)]
pub struct Difference {
    /// Rays that meet another triangle, or one where the other device meets none.
    pub other: usize,
    /// Of those, such that are no ties: not at the same distance up to rounding.
    pub wrong: usize,
    /// Rays whose shadow differs.
    pub shadows: usize,
    /// Largest difference of distances (relative) and weights on the same triangle.
    pub largest: f32,
    /// Rays that meet anything.
    pub hits: usize,
}

pub fn compare(device: &Device, accel: &Accel, tree: &WideTree, rays: &[Ray]) -> Difference {
    let found = trace(device, tree, rays, "trace_closest_rays");
    let shadows = trace(device, tree, rays, "trace_occluded_rays");
    let mut difference = Difference::default();
    for ((ray, found), shadow) in rays.iter().zip(found).zip(shadows) {
        let expected = accel.closest(ray);
        difference.hits += usize::from(expected.is_some());
        difference.shadows += usize::from(shadow.is_some() != accel.occluded(ray));
        match (expected, found) {
            (None, None) => {}
            (Some(a), Some(b)) if (a.instance, a.primitive) == (b.instance, b.primitive) => {
                let off = ((a.t - b.t) / a.t)
                    .abs()
                    .max((a.u - b.u).abs())
                    .max((a.v - b.v).abs());
                difference.largest = difference.largest.max(off);
            }
            (Some(a), Some(b)) => {
                difference.other += 1;
                difference.wrong += usize::from(((a.t - b.t) / a.t).abs() > 1e-5);
            }
            _ => {
                difference.other += 1;
                difference.wrong += 1;
            }
        }
    }
    difference
}
