//! As much of Embree 3's C interface as the comparison needs.

use glam::{Affine3A, Mat4};
use matcha_render::accel::Ray;
use matcha_render::scene::{Mesh, Scene};
use std::ffi::{c_char, c_void};

const TRIANGLE: u32 = 0;
const INSTANCE: u32 = 121;
const INDEX_BUFFER: u32 = 0;
const VERTEX_BUFFER: u32 = 1;
const UINT3: u32 = 0x5003;
const FLOAT3: u32 = 0x9003;
const FLOAT3X4_COLUMN_MAJOR: u32 = 0x9234;
const ROBUST: u32 = 4;
const HIGH_QUALITY: u32 = 2;
const INVALID: u32 = u32::MAX;

/// `RTCRayHit`.
#[repr(C, align(16))]
struct RayHit {
    origin: [f32; 3],
    near: f32,
    direction: [f32; 3],
    time: f32,
    far: f32,
    mask: u32,
    id: u32,
    flags: u32,
    normal: [f32; 3],
    uv: [f32; 2],
    primitive: u32,
    geometry: u32,
    instance: u32,
}

/// `RTCIntersectContext` for incoherent rays.
#[repr(C)]
struct Context {
    flags: u32,
    filter: *const c_void,
    instance: u32,
}

unsafe extern "C" {
    fn rtcNewDevice(config: *const c_char) -> *mut c_void;
    fn rtcNewScene(device: *mut c_void) -> *mut c_void;
    fn rtcSetSceneFlags(scene: *mut c_void, flags: u32);
    fn rtcSetSceneBuildQuality(scene: *mut c_void, quality: u32);
    fn rtcCommitScene(scene: *mut c_void);
    fn rtcNewGeometry(device: *mut c_void, kind: u32) -> *mut c_void;
    fn rtcSetNewGeometryBuffer(
        geometry: *mut c_void,
        kind: u32,
        slot: u32,
        format: u32,
        stride: usize,
        count: usize,
    ) -> *mut c_void;
    fn rtcSetGeometryInstancedScene(geometry: *mut c_void, scene: *mut c_void);
    fn rtcSetGeometryTransform(
        geometry: *mut c_void,
        step: u32,
        format: u32,
        matrix: *const c_void,
    );
    fn rtcCommitGeometry(geometry: *mut c_void);
    fn rtcAttachGeometry(scene: *mut c_void, geometry: *mut c_void) -> u32;
    fn rtcIntersect1(scene: *mut c_void, context: *mut Context, ray: *mut RayHit);
    fn rtcOccluded1(scene: *mut c_void, context: *mut Context, ray: *mut RayHit);
}

/// A committed scene; never freed, the process ends soon.
pub struct Embree(*mut c_void);

// SAFETY: Embree's committed scenes may be traced by any number of threads.
unsafe impl Sync for Embree {}

impl Embree {
    /// High-quality build of a scene: one flat scene, or a scene of instances as Cycles has it.
    pub fn build(scene: &Scene, flat: bool, robust: bool) -> Self {
        // SAFETY: Embree's functions are called as its manual says, with handles that they made.
        unsafe {
            let device = rtcNewDevice(std::ptr::null());
            let new_scene = || {
                let handle = rtcNewScene(device);
                rtcSetSceneFlags(handle, if robust { ROBUST } else { 0 });
                rtcSetSceneBuildQuality(handle, HIGH_QUALITY);
                handle
            };
            let top = new_scene();
            if flat {
                for instance in &scene.instances {
                    let mesh = &scene.meshes[instance.mesh as usize];
                    rtcAttachGeometry(top, triangles(device, mesh, instance.transform));
                }
            } else {
                let scenes: Vec<*mut c_void> = scene
                    .meshes
                    .iter()
                    .map(|mesh| {
                        let own = new_scene();
                        rtcAttachGeometry(own, triangles(device, mesh, Affine3A::IDENTITY));
                        rtcCommitScene(own);
                        own
                    })
                    .collect();
                for instance in &scene.instances {
                    let geometry = rtcNewGeometry(device, INSTANCE);
                    rtcSetGeometryInstancedScene(geometry, scenes[instance.mesh as usize]);
                    let columns = Mat4::from(instance.transform).to_cols_array_2d();
                    let matrix: [[f32; 3]; 4] = columns.map(|c| [c[0], c[1], c[2]]);
                    rtcSetGeometryTransform(
                        geometry,
                        0,
                        FLOAT3X4_COLUMN_MAJOR,
                        matrix.as_ptr().cast(),
                    );
                    rtcCommitGeometry(geometry);
                    rtcAttachGeometry(top, geometry);
                }
            }
            rtcCommitScene(top);
            Self(top)
        }
    }

    /// True if anything is hit; the nearest hit is found on the way.
    pub fn closest(&self, ray: &Ray) -> bool {
        let mut hit = convert(ray);
        let mut context = context();
        // SAFETY: the scene is committed; both structs are laid out as Embree's.
        unsafe { rtcIntersect1(self.0, &mut context, &mut hit) };
        hit.geometry != INVALID
    }

    /// True if anything is hit.
    pub fn occluded(&self, ray: &Ray) -> bool {
        let mut hit = convert(ray);
        let mut context = context();
        // SAFETY: as above.
        unsafe { rtcOccluded1(self.0, &mut context, &mut hit) };
        hit.far < 0.0
    }
}

fn context() -> Context {
    Context {
        flags: 0,
        filter: std::ptr::null(),
        instance: INVALID,
    }
}

fn convert(ray: &Ray) -> RayHit {
    RayHit {
        origin: ray.origin.to_array(),
        near: ray.t_min,
        direction: ray.direction.to_array(),
        time: 0.0,
        far: ray.t_max,
        mask: u32::MAX,
        id: 0,
        flags: 0,
        normal: [0.0; 3],
        uv: [0.0; 2],
        primitive: INVALID,
        geometry: INVALID,
        instance: INVALID,
    }
}

/// # Safety
/// `device` is a device of Embree's.
unsafe fn triangles(device: *mut c_void, mesh: &Mesh, transform: Affine3A) -> *mut c_void {
    // SAFETY: Embree allocates the buffers with room for as many elements as are written.
    unsafe {
        let geometry = rtcNewGeometry(device, TRIANGLE);
        let vertices =
            rtcSetNewGeometryBuffer(geometry, VERTEX_BUFFER, 0, FLOAT3, 12, mesh.positions.len());
        for (i, &p) in mesh.positions.iter().enumerate() {
            vertices
                .cast::<[f32; 3]>()
                .add(i)
                .write(transform.transform_point3(p).to_array());
        }
        let indices =
            rtcSetNewGeometryBuffer(geometry, INDEX_BUFFER, 0, UINT3, 12, mesh.indices.len());
        for (i, &triangle) in mesh.indices.iter().enumerate() {
            indices.cast::<[u32; 3]>().add(i).write(triangle);
        }
        rtcCommitGeometry(geometry);
        geometry
    }
}
