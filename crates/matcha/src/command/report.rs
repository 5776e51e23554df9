//! What a comparison measured.

use crate::measure::{self, Error};
use crate::session::Loaded;
use image::RgbImage;
use matcha_render::backend::{Backend, Statistics};
use serde::Serialize;

/// `report.json`: its fields are the file's keys.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    scene: String,
    device: String,
    resolution: [u32; 2],
    samples: u32,
    seconds: Seconds,
    /// Without over with.
    speedup: f64,
    /// Share of the uncached time that networks took.
    material_share: f64,
    /// Time saved over the time that networks took.
    recovered: f64,
    error: Error,
    cache: CacheReport,
    /// Traced without the cache.
    rays: u64,
    nodes_found_per_sample: f64,
}

/// Seconds of rendering, preparation excluded.
#[derive(Debug, Serialize)]
struct Seconds {
    without: f64,
    with: f64,
}

#[derive(Debug, Serialize)]
struct CacheReport {
    lookups: u64,
    hits: u64,
    inserts: u64,
    refused: u64,
    occupied: u64,
    capacity: u64,
    bytes: u64,
}

impl CacheReport {
    fn of(statistics: &Statistics) -> Self {
        let cache = statistics.cache;
        Self {
            lookups: cache.lookups,
            hits: cache.hits,
            inserts: cache.inserts,
            refused: cache.refused,
            occupied: cache.occupied,
            capacity: cache.capacity,
            bytes: cache.bytes,
        }
    }
}

impl Report {
    /// From both renderings and what they look like, without the cache first.
    pub fn new(
        loaded: &Loaded,
        without: &dyn Backend,
        with: &dyn Backend,
        [shown_without, shown_with]: [&RgbImage; 2],
    ) -> Self {
        let (before, after) = (without.statistics(), with.statistics());
        let (reference, test) = (without.film().combined(), with.film().combined());
        let [width, height] = loaded.resolution();
        let share = before.material_share();
        Self {
            scene: loaded.name().to_owned(),
            device: without.device(),
            resolution: [width, height],
            samples: without.film().samples().min(with.film().samples()),
            speedup: ratio(before.seconds, after.seconds),
            material_share: share,
            recovered: ratio(before.seconds - after.seconds, before.seconds * share),
            seconds: Seconds {
                without: before.seconds,
                with: after.seconds,
            },
            error: Error {
                flip_mean: measure::flip_mean(width, height, shown_with, shown_without),
                rel_mse: measure::rel_mse(&test, &reference),
                max_abs: measure::max_abs(&test, &reference),
            },
            cache: CacheReport::of(&after),
            rays: before.rays,
            nodes_found_per_sample: ratio(after.nodes_found as f64, after.samples as f64),
        }
    }

    /// One line for the terminal.
    pub fn summary(&self) -> String {
        format!(
            "without the cache {:.2} s, with it {:.2} s: {:.1} % saved; FLIP {:.4}",
            self.seconds.without,
            self.seconds.with,
            self.saved_percent(),
            self.error.flip_mean
        )
    }

    /// The lines under the figure's four pictures.
    pub fn captions(&self) -> [Vec<String>; 4] {
        let Seconds { without, with } = self.seconds;
        let [width, height] = self.resolution;
        [
            vec![
                "(a) Without the cache".into(),
                format!(
                    "{without:.2} s, {} samples, {width} × {height}",
                    self.samples
                ),
                format!(
                    "material networks: {:.0} % of the time",
                    self.material_share * 100.0
                ),
            ],
            vec![
                "(b) With the cache".into(),
                format!("{with:.2} s: {:.1} % saved", self.saved_percent()),
                format!("hits: {:.1} % of look-ups", self.hit_percent()),
            ],
            vec![
                "(c) Difference × 5".into(),
                format!(
                    "FLIP {:.4}, relative MSE {:.2e}",
                    self.error.flip_mean, self.error.rel_mse
                ),
                format!("largest difference {:.3}", self.error.max_abs),
            ],
            vec![
                "(d) Nodes found in the cache".into(),
                format!("{:.2} per sample in the mean", self.nodes_found_per_sample),
                format!("{:.1} % of the table in use", self.use_percent()),
            ],
        ]
    }

    fn saved_percent(&self) -> f64 {
        100.0
            * ratio(
                self.seconds.without - self.seconds.with,
                self.seconds.without,
            )
    }

    fn hit_percent(&self) -> f64 {
        100.0 * ratio(self.cache.hits as f64, self.cache.lookups as f64)
    }

    fn use_percent(&self) -> f64 {
        100.0 * ratio(self.cache.occupied as f64, self.cache.capacity as f64)
    }
}

/// Zero where nothing can be said.
fn ratio(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { 0.0 }
}
