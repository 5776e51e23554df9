//! Device code for tests: functions of the workspace between a point's words and four
//! words of result, and one of every construct of the subset.
#![allow(clippy::all)]

use matcha_cache::device::encoding::{
    color_fits, decode_color, decode_normal, decode_pair, decode_vector, encode_color,
    encode_normal, encode_pair, encode_vector, normal_fits, pair_fits, vector_fits,
};
use matcha_cache::device::key_hash::{cell_of, hash_texel, seed_of_node};
use matcha_render::device::light_triangle::{LightTriangle, light_triangle_sample};
use matcha_render::device::lobe::{
    ClosureFrame, ClosureLobe, LOBE_ASHIKHMIN_SHIRLEY, LOBE_BECKMANN, LOBE_DIFFUSE, LOBE_GGX,
    lobe_eval, lobe_sample,
};
use matcha_render::device::mapping::{mapping_cosine, mapping_disk, mapping_frame, mapping_place};
use matcha_render::device::microfacet::microfacet_beckmann_slope;
use matcha_render::device::sobol::{sobol_2d, sobol_3d, sobol_pixel_seed};
use matcha_shade::device::fractal::{fbm_init, fbm_step_3d};
use matcha_shade::device::hash::{hash1, hash2, hash3, hash4};
use matcha_shade::device::math::*;
use matcha_shade::device::perlin::{noise_1d, noise_2d, noise_3d, noise_4d};
use matcha_shade::device::texel::{texel_centre, texel_index, texel_level};

/// A number of a point.
pub fn probe_number(w: [u32; 13], i: u32) -> f32 {
    float_of(w[i as usize])
}

/// Three numbers of a point.
pub fn probe_triple(w: [u32; 13], i: u32) -> Vec3 {
    vec3(
        probe_number(w, i),
        probe_number(w, i + 1),
        probe_number(w, i + 2),
    )
}

/// Bits of four numbers.
pub fn probe_four(a: f32, b: f32, c: f32, d: f32) -> [u32; 4] {
    [bits_of(a), bits_of(b), bits_of(c), bits_of(d)]
}

pub fn probe_waves(w: [u32; 13]) -> [u32; 4] {
    let x = float_of(w[0]);
    probe_four(sin(x), cos(x), atan2(x, float_of(w[1])), tanh(x))
}

pub fn probe_powers(w: [u32; 13]) -> [u32; 4] {
    let x = float_of(w[0]);
    probe_four(exp(x), log(abs(x)), exp2(x), log2(abs(x)))
}

pub fn probe_power(w: [u32; 13]) -> [u32; 4] {
    let x = float_of(w[0]);
    let y = float_of(w[1]);
    probe_four(
        pow(x, y),
        modulo(x, y),
        floored_modulo(x, y),
        smoothstep(0.0, y, x),
    )
}

pub fn probe_arcs(w: [u32; 13]) -> [u32; 4] {
    let x = float_of(w[0]);
    probe_four(asin(x), acos(x), atan(x), sinh(x))
}

/// A number, 0 instead of not-a-number, whose bits are the device's affair.
pub fn probe_real(w: u32) -> f32 {
    select(0.0, float_of(w), (w & 0x7fff_ffff) <= 0x7f80_0000)
}

pub fn probe_rounding(w: [u32; 13]) -> [u32; 4] {
    let x = probe_real(w[0]);
    let y = probe_real(w[1]);
    [
        bits_of(floor(x)) ^ bits_of(trunc(y)),
        bits_of(ceil(x)) ^ bits_of(negate_if(y, x > 0.0)),
        to_int(x) as u32,
        bits_of(min(x, y)) ^ bits_of(max(abs(x), y)),
    ]
}

pub fn probe_hashes(w: [u32; 13]) -> [u32; 4] {
    [
        hash1(w[0]),
        hash2(w[0], w[1]),
        hash3(w[0], w[1], w[2]),
        hash4(w[0], w[1], w[2], w[3]),
    ]
}

pub fn probe_keys(w: [u32; 13]) -> [u32; 4] {
    let seed = seed_of_node(w[0], w[1], w[2] & 3);
    let key = hash_texel(seed, w[3] as i32, w[4] as i32, w[5] as i32);
    [key.cell, key.fingerprint, cell_of(key.cell, w[6]), seed.a]
}

pub fn probe_texels(w: [u32; 13]) -> [u32; 4] {
    let a = vec2(float_of(w[0]), float_of(w[1]));
    let b = vec2(float_of(w[2]), float_of(w[3]));
    let level = texel_level(a, b, 1.0);
    let i = texel_index(float_of(w[4]), level);
    let centre = texel_centre(i, 3, level);
    [level as u32, i as u32, bits_of(centre.x), bits_of(centre.y)]
}

/// Words of a value's encodings.
pub fn probe_encodings(w: [u32; 13]) -> [u32; 4] {
    let v = probe_triple(w, 0);
    let pair = vec2(v.x, v.y);
    let fits = color_fits(v) as u32
        | (vector_fits(v) as u32) << 1
        | (pair_fits(pair) as u32) << 2
        | (normal_fits(v) as u32) << 3;
    [
        encode_color(abs3(v)),
        encode_vector(v),
        encode_pair(pair) ^ fits,
        encode_normal(normalize(v)),
    ]
}

pub fn probe_decodings(w: [u32; 13]) -> [u32; 4] {
    let color = decode_color(w[0]);
    let vector = decode_vector(w[1]);
    let pair = decode_pair(w[2]);
    let normal = decode_normal(w[3]);
    probe_four(
        color.x + color.y * 0.5 + color.z * 0.25,
        vector.x + vector.y * 0.5 + vector.z * 0.25,
        pair.x + pair.y * 0.5,
        normal.x + normal.y * 0.5 + normal.z * 0.25,
    )
}

pub fn probe_noises(w: [u32; 13]) -> [u32; 4] {
    let p = probe_triple(w, 0);
    let t = float_of(w[3]);
    probe_four(
        noise_1d(p.x),
        noise_2d(vec2(p.x, p.y)),
        noise_3d(p),
        noise_4d(p, t),
    )
}

/// Octaves of fBm by hand, in a loop over an array.
pub fn probe_octaves(w: [u32; 13]) -> [u32; 4] {
    let p = probe_triple(w, 0);
    let mut state = fbm_init(p, 0.0, 4.5, 0.6, 2.1, 1);
    let mut i = 0;
    while i < 5 {
        state = fbm_step_3d(i, p, 0.0, 4.5, 0.6, 2.1, 1, state);
        i += 1;
    }
    probe_four(state[0], state[1], state[2], state[3])
}

pub fn probe_sobol(w: [u32; 13]) -> [u32; 4] {
    let seed = sobol_pixel_seed(w[0] & 4095, w[1] & 4095, w[2]);
    let two = sobol_2d(seed, w[3], w[4] & 63);
    let three = sobol_3d(seed, w[3], w[4] & 63);
    probe_four(two.y, three.x, three.y, three.z)
}

/// A number from −4 to 4 as one from 0 to 1.
pub fn probe_unit(x: f32) -> f32 {
    saturate(x * 0.124_999 + 0.5)
}

pub fn probe_mappings(w: [u32; 13]) -> [u32; 4] {
    let u = vec2(probe_unit(float_of(w[0])), probe_unit(float_of(w[1])));
    let disk = mapping_disk(u);
    let around = mapping_cosine(u);
    let frame = mapping_frame(normalize(probe_triple(w, 2)));
    let placed = mapping_place(frame, around.x, around.y, around.z);
    probe_four(disk.x, disk.y, placed.x, placed.y + placed.z)
}

/// A closure of any kind seen from a direction.
pub fn probe_closure(w: [u32; 13], kind: u32) -> ClosureLobe {
    let normal = vec3(0.0, 0.0, 1.0);
    let wo = normalize(abs3(probe_triple(w, 0)) + vec3(0.0, 0.0, 0.1));
    let alpha_x = 0.05 + 0.9 * probe_unit(float_of(w[3]));
    let alpha_y = 0.05 + 0.9 * probe_unit(float_of(w[4]));
    ClosureLobe {
        kind,
        fresnel: w[12] & 3,
        reflects: 1.0,
        weight: splat3(1.0),
        sample_weight: 1.0,
        normal,
        tangent: vec3(1.0, 0.0, 0.0),
        alpha_x,
        alpha_y,
        ior: 1.45,
        energy: 1.0,
        f0: vec3(0.04, 0.5, 0.9),
        tint: vec3(0.1, 0.2, 0.5),
        cos_wo: wo.z,
        lambda_wo: 0.3,
    }
}

/// Value and density of a closure for a pair of directions, and its sample.
pub fn probe_lobe(w: [u32; 13], kind: u32) -> [u32; 4] {
    let lobe = probe_closure(w, kind);
    let ng = vec3(0.0, 0.0, 1.0);
    let bent = (w[12] & 4) != 0;
    let frame = ClosureFrame {
        n: if bent {
            normalize(vec3(0.2, 0.1, 1.0))
        } else {
            ng
        },
        ng,
        wo: normalize(abs3(probe_triple(w, 0)) + vec3(0.0, 0.0, 0.1)),
        backfacing: false,
        bump_correction: (w[12] & 8) != 0,
    };
    let wi = normalize(probe_triple(w, 5) + vec3(0.0, 0.0, 0.01));
    let eval = lobe_eval(lobe, frame, wi);
    let u = vec3(
        probe_unit(float_of(w[8])),
        probe_unit(float_of(w[9])),
        probe_unit(float_of(w[10])),
    );
    let sample = lobe_sample(lobe, frame, u);
    probe_four(
        eval.value.x + eval.value.y,
        eval.pdf,
        sample.wi.x + 0.5 * sample.wi.y + 0.25 * sample.wi.z,
        sample.value.x,
    )
}

pub fn probe_diffuse(w: [u32; 13]) -> [u32; 4] {
    probe_lobe(w, LOBE_DIFFUSE)
}

pub fn probe_ggx(w: [u32; 13]) -> [u32; 4] {
    probe_lobe(w, LOBE_GGX)
}

pub fn probe_beckmann(w: [u32; 13]) -> [u32; 4] {
    probe_lobe(w, LOBE_BECKMANN)
}

pub fn probe_ashikhmin(w: [u32; 13]) -> [u32; 4] {
    probe_lobe(w, LOBE_ASHIKHMIN_SHIRLEY)
}

pub fn probe_slope(w: [u32; 13]) -> [u32; 4] {
    let cosine = 0.05 + 0.94 * probe_unit(float_of(w[0]));
    let u = 0.001 + 0.998 * probe_unit(float_of(w[1]));
    probe_four(microfacet_beckmann_slope(cosine, u), 0.0, 0.0, 0.0)
}

pub fn probe_triangle(w: [u32; 13]) -> [u32; 4] {
    let triangle = LightTriangle {
        a: probe_triple(w, 0),
        b: probe_triple(w, 3),
        c: probe_triple(w, 6),
    };
    let u = vec2(probe_unit(float_of(w[9])), probe_unit(float_of(w[10])));
    let sampled = light_triangle_sample(triangle, vec3(0.0, 0.0, 9.0), u);
    probe_four(sampled.uv.x, sampled.uv.y, sampled.pdf, 0.0)
}

/// Some state of [`probe_constructs`].
pub struct ProbeState {
    pub sum: u32,
    pub list: [u32; 4],
    pub on: bool,
    pub at: Vec3,
}

const PROBE_TABLE: [u32; 4] = [1, 0xffff_ffff, 3, 0x8000_0000];

/// An early return, in a function with a parameter that changes.
pub fn probe_early(mut x: u32, limit: u32) -> u32 {
    if x > limit {
        return x - limit;
    }
    let mut rounds = 0;
    while x < limit {
        x += if x % 3 == 0 { 7 } else { 5 };
        rounds += 1;
        if rounds > 40 {
            break;
        }
        if x % 2 == 0 {
            continue;
        }
        x ^= 1;
    }
    x + rounds
}

/// One of every construct; exact.
pub fn probe_constructs(w: [u32; 13]) -> [u32; 4] {
    let i = w[0] as i32;
    let signed = (i >> 5) as u32 ^ ((i & 0xffff) / 7) as u32 ^ ((i & 0xffff) % 11) as u32;
    let negative = (-2147483648 + (i & 0xff)) as u32;
    let shifts = (w[1] << (w[2] & 31)) | (w[1] >> 3);
    let both = (w[0] > w[1]) ^ (w[2] > w[3]);
    let first = if both {
        let a = w[0] ^ w[3];
        a & 0xff
    } else if w[4] % 2 == 0 && !(w[5] == 0) {
        1
    } else {
        2
    };
    let mut state = ProbeState {
        list: [w[0], first, 3, !w[1]],
        sum: 0,
        on: both | (first == 2),
        at: vec3(1.0, 2.0, 3.0),
    };
    let mut k = 0;
    while k < 4 && (if state.on { k < 3 } else { true }) {
        let slot = (state.list[k as usize] ^ w[6]) & 3;
        state.list[slot as usize] =
            wrapping_add(state.list[slot as usize], PROBE_TABLE[(slot) as usize]);
        state.sum = wrapping_mul(state.sum, 31) ^ state.list[k as usize];
        state.at.y = state.at.y * 2.0 + (k as i32 as f32);
        k += 1;
    }
    let late;
    if w[7] & 1 == 1 {
        late = 5;
    } else {
        late = 9;
    }
    let zeros = [late; 3];
    let state_sum = state.sum;
    let state = zeros[(w[8] % 3) as usize] + probe_early(w[9] % 100, late * 10);
    let whole = to_int(float_of(w[10] & 0x47ff_ffff)) as u32;
    let deep = 3 + {
        let w = w[11] & 7;
        w * w
    };
    [
        wrapping_add(signed, negative) ^ shifts,
        wrapping_add(state_sum, state),
        whole ^ rotate_left(w[11], 7) ^ deep,
        first ^ bits_of(if late == 5 { -0.0 } else { 0.5 }),
    ]
}
