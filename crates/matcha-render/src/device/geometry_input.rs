//! Quantities of a point by their packed codes, from the arrays of [`GeometryView`].
// Device code has no methods.
#![allow(clippy::manual_range_contains)]

use crate::device::geometry_view::{
    GEOMETRY_NONE, GeometryView, geometry_corners, geometry_material, geometry_triangle,
};
use crate::device::surface_background::background_quantity;
use crate::device::surface_input::*;
use crate::device::surface_path::PathInfo;
use crate::device::surface_point::SurfacePoint;
use glam::{Vec2, Vec3};
use matcha_shade::device::input_code::*;
use matcha_shade::device::math::{vec2, vec3};

/// First entry of a mesh's layer for a UV name, or none; `kind` is 0 for the coordinates, 1 for
/// the tangents.
#[inline]
pub fn geometry_uv_layer(view: GeometryView, mesh: u32, name: u32, kind: u32) -> u32 {
    let mut first = GEOMETRY_NONE;
    if name < view.uv_names {
        let layers = view.meshes[mesh as usize].first_layer;
        first = view.layers[(layers + 2 * name + kind) as usize];
    }
    first
}

/// UVs of a point's triangle; zero where the mesh lacks the layer.
#[inline]
pub fn geometry_uvs(view: GeometryView, point: &SurfacePoint, name: u32) -> [Vec2; 3] {
    let mesh = view.instances[point.instance as usize].mesh;
    let first = geometry_uv_layer(view, mesh, name, 0);
    let zero = vec2(0.0, 0.0);
    let mut corners = [zero, zero, zero];
    if first != GEOMETRY_NONE {
        corners = view.uvs[(first + point.primitive) as usize];
    }
    corners
}

/// Change of a point's position with the UVs of a name.
#[inline]
pub fn geometry_gradients(view: GeometryView, point: &SurfacePoint, name: u32) -> SurfaceGradients {
    let triangle = geometry_triangle(view, point.instance, point.primitive);
    let corners = geometry_corners(view, triangle);
    let placement = view.instances[point.instance as usize].placement;
    surface_gradients(&placement, corners, geometry_uvs(view, point, name))
}

/// Tangent of a UV name: MikkTSpace's where the mesh has it, otherwise along dP/du.
#[inline]
pub fn geometry_tangent(view: GeometryView, point: &SurfacePoint, name: u32) -> SurfaceTangent {
    let mesh = view.instances[point.instance as usize].mesh;
    let first = geometry_uv_layer(view, mesh, name, 1);
    if first == GEOMETRY_NONE {
        return surface_tangent_of_gradients(point, geometry_gradients(view, point, name));
    }
    let tangents = view.tangents[(first + point.primitive) as usize];
    let placement = view.instances[point.instance as usize].placement;
    surface_tangent_of_corners(point, &placement, tangents.corners, tangents.sign)
}

/// A part of an attribute; zero where the mesh lacks it.
#[inline]
pub fn geometry_attribute(
    view: GeometryView,
    point: &SurfacePoint,
    name: u32,
    part: u32,
) -> [f32; 4] {
    let mut first = GEOMETRY_NONE;
    if name < view.attribute_names {
        let mesh = view.instances[point.instance as usize].mesh;
        let layers = view.meshes[mesh as usize].first_layer + 2 * view.uv_names;
        first = view.layers[(layers + name) as usize];
    }
    let mut value = [0.0, 0.0, 0.0, 0.0];
    if first != GEOMETRY_NONE {
        let corners = view.attributes[(first + point.primitive) as usize];
        let a = corners[0];
        let b = corners[1];
        let c = corners[2];
        let blend = surface_blend(point, part);
        value = [
            surface_linear(blend, a[0], b[0], c[0]),
            surface_linear(blend, a[1], b[1], c[1]),
            surface_linear(blend, a[2], b[2], c[2]),
            surface_linear(blend, a[3], b[3], c[3]),
        ];
    }
    value
}

/// A part of the generated coordinates.
#[inline]
pub fn geometry_generated(view: GeometryView, point: &SurfacePoint, part: u32) -> Vec3 {
    let index = view.instances[point.instance as usize].mesh;
    let mesh = view.meshes[index as usize];
    let blend = surface_blend(point, part);
    if mesh.first_generated != GEOMETRY_NONE {
        let corners = view.generated[(mesh.first_generated + point.primitive) as usize];
        return surface_linear3(blend, corners);
    }
    let corners = geometry_corners(view, mesh.first_triangle + point.primitive);
    let object = surface_linear3(blend, corners);
    surface_generated(object, part, mesh.generated_origin, mesh.generated_size)
}

/// A part of the object coordinates.
#[inline]
pub fn geometry_object(view: GeometryView, point: &SurfacePoint, part: u32) -> Vec3 {
    let triangle = geometry_triangle(view, point.instance, point.primitive);
    surface_linear3(surface_blend(point, part), geometry_corners(view, triangle))
}

/// Change of the shading normal along an axis; zero on flat meshes.
#[inline]
pub fn geometry_normal_along(view: GeometryView, point: &SurfacePoint, part: u32) -> Vec3 {
    let mesh = view.instances[point.instance as usize].mesh;
    let first = view.meshes[mesh as usize].first_normals;
    if first == GEOMETRY_NONE {
        return vec3(0.0, 0.0, 0.0);
    }
    let normals = view.normals[(first + point.primitive) as usize];
    let placement = view.instances[point.instance as usize].placement;
    surface_normal_along(point, &placement, normals, part)
}

/// Pointiness of a point; 0.5, flat, where it was not asked for.
#[inline]
pub fn geometry_pointiness(view: GeometryView, point: &SurfacePoint) -> f32 {
    let mut value = 0.5;
    if view.has_pointiness != 0 {
        let triangle = geometry_triangle(view, point.instance, point.primitive);
        let vertices = view.indices[triangle as usize];
        value = surface_linear(
            surface_blend(point, INPUT_PART_VALUE),
            view.pointiness[vertices[0] as usize],
            view.pointiness[vertices[1] as usize],
            view.pointiness[vertices[2] as usize],
        );
    }
    value
}

/// Random number of a point's island; 0 where it was not asked for.
#[inline]
pub fn geometry_island(view: GeometryView, point: &SurfacePoint) -> f32 {
    let mut value = 0.0;
    if view.has_islands != 0 {
        let triangle = geometry_triangle(view, point.instance, point.primitive);
        value = view.islands[triangle as usize];
    }
    value
}

/// Numbers of a point's object and material; unused components are 0.
#[inline]
pub fn geometry_object_quantity(view: GeometryView, point: &SurfacePoint, code: u32) -> Vec3 {
    if code == INPUT_OBJECT_LOCATION {
        return view.instances[point.instance as usize].placement.origin;
    }
    if code == INPUT_OBJECT_COLOR {
        let color = view.instances[point.instance as usize].color;
        return vec3(color[0], color[1], color[2]);
    }
    let value = if code == INPUT_OBJECT_ALPHA {
        view.instances[point.instance as usize].color[3]
    } else if code == INPUT_OBJECT_INDEX {
        view.instances[point.instance as usize].pass_index
    } else if code == INPUT_OBJECT_RANDOM {
        view.instances[point.instance as usize].random
    } else if code == INPUT_MATERIAL_INDEX {
        let material = geometry_material(view, point.instance, point.primitive);
        view.pass_indices[material as usize]
    } else if code == INPUT_POINTINESS {
        geometry_pointiness(view, point)
    } else {
        geometry_island(view, point)
    };
    vec3(value, 0.0, 0.0)
}

/// A quantity of at most three numbers at a point; unused ones are 0.
#[inline]
pub fn geometry_quantity(view: GeometryView, point: &SurfacePoint, packed: u32) -> Vec3 {
    let code = input_code(packed);
    let part = input_part(packed);
    let name = input_name(packed);
    if part != INPUT_PART_VALUE && !input_is_differentiable(code) {
        return vec3(0.0, 0.0, 0.0);
    }
    if code == INPUT_UV {
        let uv = surface_linear2(surface_blend(point, part), geometry_uvs(view, point, name));
        vec3(uv.x, uv.y, 0.0)
    } else if code == INPUT_NORMAL && part != INPUT_PART_VALUE {
        geometry_normal_along(view, point, part)
    } else if code == INPUT_TANGENT {
        geometry_tangent(view, point, name).direction
    } else if code == INPUT_TANGENT_SIGN {
        vec3(geometry_tangent(view, point, name).sign, 0.0, 0.0)
    } else if code == INPUT_DP_DU {
        geometry_gradients(view, point, name).u
    } else if code == INPUT_DP_DV {
        geometry_gradients(view, point, name).v
    } else if code == INPUT_GENERATED {
        geometry_generated(view, point, part)
    } else if code == INPUT_OBJECT {
        geometry_object(view, point, part)
    } else if code >= INPUT_POINTINESS && code <= INPUT_OBJECT_RANDOM {
        geometry_object_quantity(view, point, code)
    } else {
        surface_own_quantity(view.camera, point, code, part)
    }
}

/// A quantity at a point by its packed code; unused numbers are 0.
#[inline]
pub fn geometry_input(view: GeometryView, point: &SurfacePoint, packed: u32) -> [f32; 4] {
    if input_code(packed) == INPUT_ATTRIBUTE {
        return geometry_attribute(view, point, input_name(packed), input_part(packed));
    }
    let value = geometry_quantity(view, point, packed);
    [value.x, value.y, value.z, 0.0]
}

/// A quantity of a ray that leaves the scene, by its packed code; unused numbers are 0.
#[inline]
pub fn geometry_background(view: GeometryView, ray: PathInfo, packed: u32) -> [f32; 4] {
    let value = background_quantity(view.camera, ray, input_code(packed), input_part(packed));
    [value.x, value.y, value.z, 0.0]
}
