//! Gradient noise in one to four dimensions: K. Perlin, "Improving Noise" (2002), with
//! the hashes, gradients, scales and period of Cycles, node Noise Texture.

use super::hash::*;
use super::math::*;

/// Perlin's quintic.
#[inline(always)]
pub fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Coordinates repeat every 100,000, where floats get coarse; beyond 1,000,000 they are
/// moved off the lattice, where every value would be zero.
#[inline(always)]
pub fn noise_period(x: f32) -> f32 {
    let wrapped = x - 100_000.0 * trunc(x * 1.0e-5);
    wrapped + select(0.0, 0.5, abs(x) >= 1_000_000.0)
}

/// The bit `bit` of `hash` as a sign on `x`.
#[inline(always)]
pub fn signed_by(x: f32, hash: u32, bit: u32) -> f32 {
    float_of(bits_of(x) ^ ((hash << (31 - bit)) & 0x8000_0000))
}

/// Slope in one dimension.
#[inline(always)]
pub fn gradient1(hash: u32, x: f32) -> f32 {
    let slope = 1.0 + (hash & 7) as i32 as f32;
    signed_by(slope, hash, 3) * x
}

/// Gradient in two dimensions, times the offset.
#[inline(always)]
pub fn gradient2(hash: u32, x: f32, y: f32) -> f32 {
    let first = (hash & 4) == 0;
    let u = select(y, x, first);
    let v = 2.0 * select(x, y, first);
    signed_by(u, hash, 0) + signed_by(v, hash, 1)
}

/// Gradient in three dimensions, times the offset.
#[inline(always)]
pub fn gradient3(hash: u32, x: f32, y: f32, z: f32) -> f32 {
    let u = select(y, x, (hash & 8) == 0);
    let third = select(z, x, (hash & 13) == 12);
    let v = select(third, y, (hash & 12) == 0);
    signed_by(u, hash, 0) + signed_by(v, hash, 1)
}

/// Gradient in four dimensions, times the offset.
#[inline(always)]
pub fn gradient4(hash: u32, x: f32, y: f32, z: f32, w: f32) -> f32 {
    let u = select(x, y, (hash & 24) == 24);
    let v = select(z, y, (hash & 16) == 0);
    let s = select(w, z, (hash & 24) == 0);
    signed_by(u, hash, 0) + signed_by(v, hash, 1) + signed_by(s, hash, 2)
}

/// Signed noise in one dimension, about [−1, 1].
#[inline(always)]
pub fn noise_1d(p: f32) -> f32 {
    let px = noise_period(p);
    let cx = floor(px);
    let fx = px - cx;
    let ix = to_int(cx) as u32;
    let g0 = gradient1(hash1(ix), fx);
    let g1 = gradient1(hash1(wrapping_add(ix, 1)), fx - 1.0);
    0.25 * mix(g0, g1, fade(fx))
}

/// Signed noise in two dimensions.
#[inline(always)]
pub fn noise_2d(p: Vec2) -> f32 {
    let px = noise_period(p.x);
    let py = noise_period(p.y);
    let cx = floor(px);
    let cy = floor(py);
    let fx = px - cx;
    let fy = py - cy;
    let ix = to_int(cx) as u32;
    let iy = to_int(cy) as u32;
    let u = fade(fx);
    let row0 = noise_row_2d(ix, iy, fx, fy, u);
    let row1 = noise_row_2d(ix, wrapping_add(iy, 1), fx, fy - 1.0, u);
    0.6616 * mix(row0, row1, fade(fy))
}

/// Two corners that differ in x.
#[inline(always)]
pub fn noise_row_2d(ix: u32, iy: u32, fx: f32, fy: f32, u: f32) -> f32 {
    let g0 = gradient2(hash2(ix, iy), fx, fy);
    let g1 = gradient2(hash2(wrapping_add(ix, 1), iy), fx - 1.0, fy);
    mix(g0, g1, u)
}

/// Signed noise in three dimensions.
#[inline(always)]
pub fn noise_3d(p: Vec3) -> f32 {
    let px = noise_period(p.x);
    let py = noise_period(p.y);
    let pz = noise_period(p.z);
    let cx = floor(px);
    let cy = floor(py);
    let cz = floor(pz);
    let f = vec3(px - cx, py - cy, pz - cz);
    let ix = to_int(cx) as u32;
    let iy = to_int(cy) as u32;
    let iz = to_int(cz) as u32;
    let iy1 = wrapping_add(iy, 1);
    let iz1 = wrapping_add(iz, 1);
    let u = fade(f.x);
    let v = fade(f.y);
    let r00 = noise_row_3d(ix, iy, iz, f, u);
    let r10 = noise_row_3d(ix, iy1, iz, vec3(f.x, f.y - 1.0, f.z), u);
    let r01 = noise_row_3d(ix, iy, iz1, vec3(f.x, f.y, f.z - 1.0), u);
    let r11 = noise_row_3d(ix, iy1, iz1, vec3(f.x, f.y - 1.0, f.z - 1.0), u);
    0.9820 * mix(mix(r00, r10, v), mix(r01, r11, v), fade(f.z))
}

/// Two corners that differ in x.
#[inline(always)]
pub fn noise_row_3d(ix: u32, iy: u32, iz: u32, f: Vec3, u: f32) -> f32 {
    let g0 = gradient3(hash3(ix, iy, iz), f.x, f.y, f.z);
    let g1 = gradient3(hash3(wrapping_add(ix, 1), iy, iz), f.x - 1.0, f.y, f.z);
    mix(g0, g1, u)
}

/// Signed noise in four dimensions.
#[inline(always)]
pub fn noise_4d(p: Vec3, q: f32) -> f32 {
    let px = noise_period(p.x);
    let py = noise_period(p.y);
    let pz = noise_period(p.z);
    let pw = noise_period(q);
    let cx = floor(px);
    let cy = floor(py);
    let cz = floor(pz);
    let cw = floor(pw);
    let f = vec3(px - cx, py - cy, pz - cz);
    let fw = pw - cw;
    let ix = to_int(cx) as u32;
    let iy = to_int(cy) as u32;
    let iz = to_int(cz) as u32;
    let iw = to_int(cw) as u32;
    let iy1 = wrapping_add(iy, 1);
    let iz1 = wrapping_add(iz, 1);
    let u = fade(f.x);
    let v = fade(f.y);
    let s = fade(fw);
    let r00 = noise_face_4d(ix, iy, iz, iw, f, fw, u, s);
    let r10 = noise_face_4d(ix, iy1, iz, iw, vec3(f.x, f.y - 1.0, f.z), fw, u, s);
    let r01 = noise_face_4d(ix, iy, iz1, iw, vec3(f.x, f.y, f.z - 1.0), fw, u, s);
    let r11 = noise_face_4d(ix, iy1, iz1, iw, vec3(f.x, f.y - 1.0, f.z - 1.0), fw, u, s);
    0.8344 * mix(mix(r00, r10, v), mix(r01, r11, v), fade(f.z))
}

/// Four corners that differ in x and w. The hash's first half does not know w.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn noise_face_4d(ix: u32, iy: u32, iz: u32, iw: u32, f: Vec3, fw: f32, u: f32, s: f32) -> f32 {
    let near = hash_mix3(ix, iy, iz);
    let far = hash_mix3(wrapping_add(ix, 1), iy, iz);
    let iw1 = wrapping_add(iw, 1);
    let h00 = hash_final(wrapping_add(near.a, iw), near.b, near.c);
    let h01 = hash_final(wrapping_add(near.a, iw1), near.b, near.c);
    let h10 = hash_final(wrapping_add(far.a, iw), far.b, far.c);
    let h11 = hash_final(wrapping_add(far.a, iw1), far.b, far.c);
    let gx = f.x - 1.0;
    let gw = fw - 1.0;
    let row0 = mix(
        gradient4(h00, f.x, f.y, f.z, fw),
        gradient4(h10, gx, f.y, f.z, fw),
        u,
    );
    let row1 = mix(
        gradient4(h01, f.x, f.y, f.z, gw),
        gradient4(h11, gx, f.y, f.z, gw),
        u,
    );
    mix(row0, row1, s)
}
