//! Points, what programs read of them, and images, on the device against the processor: the
//! same device code over the same arrays, which matcha-render's own tests hold to the scene.

// The fixture is matcha-render's, and calls that crate `crate`.
use matcha_render::{accel, scene, surface};

#[path = "../../../matcha-render/src/flat/tests/fixture.rs"]
#[allow(dead_code)]
mod fixture;

use fixture::{Random, all_kinds, hit, images, looks, path, smooth_images};
use glam::{Vec2, vec2};
use matcha_gpu::batch::{Extent, Runner};
use matcha_gpu::device::Device;
use matcha_gpu::memory::{Memory, Sections};
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_gpu::{GpuError, testing};
use matcha_render::accel::Hit;
use matcha_render::camera::prepare;
use matcha_render::device::geometry_input::{geometry_background, geometry_input};
use matcha_render::device::geometry_view::geometry_point;
use matcha_render::device::surface_path::PathInfo;
use matcha_render::device::texture_view::texture_sample;
use matcha_render::flat::{FlatGeometry, FlatTextures, Section};
use matcha_render::scene::{Camera, Image};
use matcha_render::surface::{SurfaceTables, View};
use matcha_render::texture::TextureSet;
use matcha_shade::input::{Input, InputKind};

/// Points and rays of a test.
const COUNT: usize = 4096;
/// Rows of a point before those of its inputs.
const POINT_ROWS: usize = 14;

/// Runs a kernel of `probe.wgsl` over `COUNT` items and gives the words that it writes.
fn probe(
    device: &Device,
    kernel: &str,
    scene: &[(&str, Vec<u32>)],
    output: (&str, usize),
) -> Result<Vec<u32>, GpuError> {
    let mut library = Library::embedded(device.report().atomics_64)?;
    library.add("probe.wgsl", include_str!("probe.wgsl"))?;
    let mut sections = Sections::new();
    for (name, words) in scene {
        sections.filled(&library, name, words.as_slice())?;
    }
    sections.filled(&library, "probe_count", vec![COUNT as u32])?;
    let scene: Memory = sections.place(device, 1, &[])?;
    let mut sections = Sections::new();
    sections.zeroed(&library, output.0, (output.1 * COUNT) as u64)?;
    let state = sections.place(device, 2, &[&scene])?;
    let memories = [&scene, &state];
    let pipelines = Pipelines::new(device, None);
    let kernel = pipelines.kernel(&KernelSource {
        name: kernel,
        library: &library,
        memories: &memories,
        constants: &[],
    })?;
    let mut runner = Runner::new(device)?;
    let mut batch = runner.batch();
    let extent = Extent::Items(COUNT as u32);
    batch.dispatch("probe", &kernel, &memories, &[], extent);
    batch.run()?;
    state.read(output.0, 0, (output.1 * COUNT) as u64)
}

fn words(sections: Vec<Section<'_>>) -> Vec<(&'static str, Vec<u32>)> {
    let own = |section: Section<'_>| (section.name, section.words.to_vec());
    sections.into_iter().map(own).collect()
}

/// Columns of values of one word each, as rows.
fn rows<const N: usize>(items: &[[u32; N]]) -> Vec<u32> {
    (0..N)
        .flat_map(|row| items.iter().map(move |item| item[row]))
        .collect()
}

/// Largest difference of the device's rows from the processor's values, each as a part of the
/// largest number of its group of rows at that point (at least 1), with its row.
struct Difference {
    largest: f32,
    row: usize,
    /// Values that have the same bits.
    same: usize,
    all: usize,
}

fn difference(found: &[u32], expected: &[Vec<f32>], group: impl Fn(usize) -> usize) -> Difference {
    let mut result = Difference {
        largest: 0.0,
        row: 0,
        same: 0,
        all: 0,
    };
    for (i, values) in expected.iter().enumerate() {
        for (row, &value) in values.iter().enumerate() {
            let same_group = |&(other, _): &(usize, &f32)| group(other) == group(row);
            let members = values.iter().enumerate().filter(same_group);
            let scale = members.fold(1.0f32, |scale, (_, v)| scale.max(v.abs()));
            let on_device = f32::from_bits(found[row * COUNT + i]);
            let apart = (on_device - value).abs() / scale;
            if apart > result.largest || apart.is_nan() {
                (result.largest, result.row) = (apart, row);
            }
            result.same += usize::from(on_device.to_bits() == value.to_bits());
            result.all += 1;
        }
    }
    result
}

struct Surfaces {
    flat: FlatGeometry,
    hits: Vec<(Hit, PathInfo)>,
    inputs: Vec<Input>,
}

fn surfaces() -> Surfaces {
    let scene = fixture::scene();
    let view = View::new(prepare(&Camera::default(), [200, 100], 1.0), [200, 100]);
    let read = [InputKind::Pointiness, InputKind::RandomPerIsland];
    let tables = SurfaceTables::new(&scene, view, read);
    let mut random = Random(5);
    Surfaces {
        flat: FlatGeometry::of_scene(&scene, &tables, view),
        hits: (0..COUNT)
            .map(|_| (hit(&mut random, &scene), path(&mut random)))
            .collect(),
        inputs: all_kinds(),
    }
}

impl Surfaces {
    fn sections(&self) -> Vec<(&'static str, Vec<u32>)> {
        let mut all = words(self.flat.sections());
        let hits: Vec<[u32; 17]> = self
            .hits
            .iter()
            .map(|(hit, path)| {
                let mut words = [0; 17];
                let floats = [hit.t, hit.u, hit.v].map(f32::to_bits);
                words[..2].copy_from_slice(&[hit.instance, hit.primitive]);
                words[2..5].copy_from_slice(&floats);
                words[5..].copy_from_slice(bytemuck::cast_slice(std::slice::from_ref(path)));
                words
            })
            .collect();
        all.push(("probe_hits", rows(&hits)));
        let packed = self.inputs.iter().map(|input| input.packed());
        all.push(("probe_inputs", packed.collect()));
        all
    }

    fn expected(&self) -> Vec<Vec<f32>> {
        let view = self.flat.view();
        let values = |(hit, path): &(Hit, PathInfo)| {
            let weights = vec2(hit.u, hit.v);
            let point = geometry_point(view, hit.instance, hit.primitive, hit.t, weights, *path);
            let vectors = [
                point.position,
                point.normal,
                point.true_normal,
                point.shadow_origin,
            ];
            let mut values: Vec<f32> = vectors.iter().flat_map(|v| v.to_array()).collect();
            values.extend([point.cone_width, point.backfacing as f32]);
            let inputs = self.inputs.iter();
            values.extend(inputs.flat_map(|i| geometry_input(view, &point, i.packed())));
            values
        };
        self.hits.iter().map(values).collect()
    }

    /// The vector or the input that a row of a point belongs to.
    fn group(row: usize) -> usize {
        if row < POINT_ROWS {
            row / 3
        } else {
            100 + (row - POINT_ROWS) / 4
        }
    }

    fn name(&self, row: usize) -> String {
        match row.checked_sub(POINT_ROWS) {
            Some(row) => format!("{:?}", self.inputs[row / 4]),
            None => format!("row {row} of the point"),
        }
    }

    fn compare(&self, device: &Device, sections: &[(&str, Vec<u32>)]) -> Difference {
        let rows = POINT_ROWS + 4 * self.inputs.len();
        let found = probe(device, "probe_surfaces", sections, ("probe_points", rows));
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        difference(&found, &self.expected(), Self::group)
    }
}

/// Stated error of points and their quantities; the scene's triangles are at random, so that
/// some are seen edge-on and some UVs all but collapse.
const SURFACE_ERROR: f32 = 1e-5;

#[test]
fn points_and_their_quantities_are_those_of_the_processor() {
    let Some(device) = testing::device() else {
        return;
    };
    let surfaces = surfaces();
    let found = surfaces.compare(&device, &surfaces.sections());
    let name = surfaces.name(found.row);
    println!(
        "{} of {} values have the same bits; largest difference {} ({name})",
        found.same, found.all, found.largest
    );
    assert!(found.largest <= SURFACE_ERROR, "{} {name}", found.largest);
}

#[test]
fn must_fail_a_corrupted_layer_is_noticed() {
    let Some(device) = testing::device() else {
        return;
    };
    let surfaces = surfaces();
    let mut sections = surfaces.sections();
    let uvs = sections
        .iter_mut()
        .find(|(name, _)| *name == "GeometryView_uvs");
    uvs.expect("there are UVs").1[7] ^= 1 << 20;
    let found = surfaces.compare(&device, &sections);
    assert!(found.largest > SURFACE_ERROR, "it is not noticed");
    let name = surfaces.name(found.row);
    assert!(
        ["Uv(", "Tangent", "DpD"]
            .iter()
            .any(|kind| name.contains(kind)),
        "{name}"
    );
}

#[test]
fn rays_that_leave_have_the_quantities_of_the_processor() {
    let Some(device) = testing::device() else {
        return;
    };
    let surfaces = surfaces();
    let output = ("probe_points", 4 * surfaces.inputs.len());
    let found = probe(&device, "probe_background", &surfaces.sections(), output);
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    let view = surfaces.flat.view();
    let values = |(_, path): &(Hit, PathInfo)| {
        let inputs = surfaces.inputs.iter();
        inputs
            .flat_map(|input| geometry_background(view, *path, input.packed()))
            .collect()
    };
    let expected: Vec<Vec<f32>> = surfaces.hits.iter().map(values).collect();
    let found = difference(&found, &expected, |row| row / 4);
    println!(
        "{} of {} values have the same bits; largest difference {}",
        found.same, found.all, found.largest
    );
    let name = surfaces.name(POINT_ROWS + found.row);
    assert!(found.largest <= SURFACE_ERROR, "{} {name}", found.largest);
}

/// Stated error of look-ups, of max(1, |value|).
const TEXTURE_ERROR: f32 = 2e-6;

struct Places {
    flat: FlatTextures,
    places: Vec<(u32, [Vec2; 3])>,
}

fn places(images: &[Image], packs: bool) -> Places {
    let looks = looks();
    let set = TextureSet::build(images, &looks);
    let mut random = Random(6);
    let place = |i: usize| {
        let uv = vec2(random.unit() * 6.0 - 3.0, random.unit() * 6.0 - 3.0);
        let size = (random.unit() * 10.0 - 9.0).exp2();
        let [a, b] = [0, 1].map(|_| vec2(random.unit() * size, random.unit() * size));
        ((i % looks.len()) as u32, [uv, a, b])
    };
    Places {
        places: (0..COUNT).map(place).collect(),
        flat: FlatTextures::of_set(&set, &looks, packs),
    }
}

impl Places {
    fn compare(&self, device: &Device, corrupted: Option<&str>) -> Difference {
        let mut sections = words(self.flat.sections());
        for (name, words) in &mut sections {
            if corrupted == Some(*name) {
                let middle = words.len() / 2;
                words[middle] ^= 0x0080_0000;
            }
        }
        let places: Vec<[u32; 7]> = self
            .places
            .iter()
            .map(|(look, [uv, a, b])| {
                let [u, v, au, av, bu, bv] = [uv.x, uv.y, a.x, a.y, b.x, b.y].map(f32::to_bits);
                [*look, u, v, au, av, bu, bv]
            })
            .collect();
        sections.push(("probe_places", rows(&places)));
        let found = probe(device, "probe_textures", &sections, ("probe_colors", 4));
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        let values = |(look, [uv, a, b]): &(u32, [Vec2; 3])| {
            let color = texture_sample(self.flat.view(), *look, *uv, *a, *b);
            vec![color.rgb.x, color.rgb.y, color.rgb.z, color.alpha]
        };
        let expected: Vec<Vec<f32>> = self.places.iter().map(values).collect();
        difference(&found, &expected, |row| row)
    }
}

#[test]
fn images_are_filtered_as_on_the_processor() {
    let Some(device) = testing::device() else {
        return;
    };
    let (plain, packed) = (places(&images(), false), places(&smooth_images(), true));
    let packs = packed.flat.memory().expect("it is packed");
    assert!(packs.packed_levels >= 4, "{packs:?}");
    for places in [plain, packed] {
        let found = places.compare(&device, None);
        println!(
            "{} of {} values have the same bits; largest difference {}",
            found.same, found.all, found.largest
        );
        assert!(found.largest <= TEXTURE_ERROR, "{}", found.largest);
    }
}

#[test]
fn must_fail_a_corrupted_texel_is_noticed() {
    let Some(device) = testing::device() else {
        return;
    };
    for (images, packs) in [(images(), false), (smooth_images(), true)] {
        let found = places(&images, packs).compare(&device, Some("TextureView_texels"));
        assert!(found.largest > 100.0 * TEXTURE_ERROR, "it is not noticed");
    }
}
