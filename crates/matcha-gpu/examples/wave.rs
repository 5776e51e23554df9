//! Renders a scene on the device and on the processor, and compares.
use matcha_gpu::adapter::{self, Wanted};
use matcha_gpu::backend::{GpuOptions, MaterialStage};
use matcha_gpu::device::Device;
use matcha_gpu::pipeline::Pipelines;
use matcha_gpu::wavefront::Wavefront;
use matcha_render::backend::{Backend, CacheMode, Control, RenderOptions};
use matcha_render::cpu::CpuBackend;
use matcha_render::film::Film;
use matcha_render::prepare::Prepared;
use std::sync::Arc;
use std::time::Instant;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let number = |i: usize, d: u32| args.get(i).and_then(|a| a.parse().ok()).unwrap_or(d);
    let (w, h, spp, cached) = (number(2, 64), number(3, 36), number(4, 1), number(5, 0));
    let loaded = matcha_import::load(
        std::path::Path::new(&args[1]),
        &Default::default(),
        &mut |_| {},
    )
    .expect("scene");
    let prepared = Arc::new(Prepared::new(loaded.scene, Some([w, h])).expect("prepared"));
    let options = RenderOptions {
        cache: if cached > 0 {
            CacheMode::Paper {
                cells: Some(1 << 20),
                entries: Some(8),
                level_offset: 0.0,
            }
        } else {
            CacheMode::Off
        },
        seed: Some(0),
        ..Default::default()
    };
    let mut cpu = CpuBackend::new(prepared.clone(), &options).expect("cpu");
    let t = cpu.render(0..spp, &Control::default()).expect("cpu render");
    println!("cpu {t:?}");
    let device =
        Device::open(&adapter::choose(adapter::adapters(), &Wanted::Best).expect("adapter"))
            .expect("device");
    let pipelines = Pipelines::new(&device, None);
    let start = Instant::now();
    let gpu = GpuOptions {
        material_stage: if cached == 2 {
            MaterialStage::Inline
        } else {
            MaterialStage::Split
        },
        ..Default::default()
    };
    let mut wave =
        Wavefront::new(&device, &pipelines, &prepared, &options, &gpu).expect("wavefront");
    println!(
        "set up {:?}, pipelines {:.1} s",
        start.elapsed(),
        pipelines.seconds()
    );
    let mut film = Film::new(w, h, prepared.scene().settings.exposure);
    let start = Instant::now();
    wave.render(0..spp, &Control::default(), &mut film)
        .expect("gpu render");
    println!("gpu {:?} {:?}", start.elapsed(), wave.statistics());
    let (a, b) = (cpu.film().combined(), film.combined());
    let mean = |p: &[[f32; 4]]| -> Vec<f32> {
        (0..4)
            .map(|c| p.iter().map(|p| p[c]).sum::<f32>() / p.len() as f32)
            .collect()
    };
    println!("mean cpu {:?} gpu {:?}", mean(&a), mean(&b));
    let far = a
        .iter()
        .zip(&b)
        .filter(|(a, b)| (0..3).any(|c| (a[c] - b[c]).abs() > 0.02 * a[c].abs().max(0.05)))
        .count();
    println!(
        "{far} of {} pixels differ by more than 2 %; samples {} {}",
        a.len(),
        cpu.film().samples(),
        film.samples()
    );
    for (name, p) in [("cpu", &a), ("gpu", &b)] {
        let bytes: Vec<u8> = p
            .iter()
            .flat_map(|p| {
                [p[0], p[1], p[2]].map(|v| (v.max(0.0).powf(1.0 / 2.2) * 255.0).min(255.0) as u8)
            })
            .collect();
        std::fs::write(
            format!("/tmp/wave_{name}.ppm"),
            [format!("P6 {w} {h} 255\n").into_bytes(), bytes].concat(),
        )
        .unwrap();
    }
}
