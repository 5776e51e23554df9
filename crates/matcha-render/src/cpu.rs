//! The CPU as a rendering device.

use crate::backend::{
    Backend, CacheMode, CacheStatistics, Control, RenderError, RenderOptions, Statistics,
};
use crate::film::{Film, PixelSums, Tile, filter::FilterTable};
use crate::integrator::worker::Worker;
use crate::integrator::{Frame, FrameCache};
use crate::node_cache::CacheLayout;
use crate::prepare::Prepared;
use matcha_cache::{CacheCounts, Table, TableSize, available_memory, fitting_size};
use matcha_shade::compile::CostModel;
use matcha_shade::program::Program;
use matcha_shade::vm::Isa;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The material cache of a scene.
struct CpuCache {
    table: Table,
    /// For each material.
    layouts: Vec<CacheLayout>,
    level_offset: f32,
}

/// A prepared scene, its programs and cache, and a film.
pub struct CpuBackend {
    prepared: Arc<Prepared>,
    programs: Arc<Vec<Program>>,
    cache: Option<CpuCache>,
    pool: rayon::ThreadPool,
    workers: Vec<Mutex<Worker>>,
    tiles: Vec<Tile>,
    filter: FilterTable,
    film: Film,
    seed: u32,
    time: Duration,
}

impl CpuBackend {
    /// Makes programs and cache for a prepared scene.
    ///
    /// # Errors
    /// If the cache does not fit into memory or threads cannot be started.
    pub fn new(prepared: Arc<Prepared>, options: &RenderOptions) -> Result<Self, RenderError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(options.threads.unwrap_or(0))
            .build()
            .map_err(|error| RenderError::Threads(error.to_string()))?;
        let programs = programs(&prepared, options)?;
        let [width, height] = prepared.resolution();
        let settings = &prepared.scene().settings;
        let cache = make_cache(&options.cache, &programs)?;
        if let Some(cache) = &cache
            && programs.iter().any(|program| !program.regions().is_empty())
        {
            cache.table.populate();
        }
        Ok(Self {
            programs,
            cache,
            workers: (0..pool.current_num_threads())
                .map(|_| Mutex::new(Worker::new(&options.schedule)))
                .collect(),
            pool,
            tiles: Tile::cover(width, height),
            filter: FilterTable::new(settings.filter),
            film: Film::new(width, height, settings.exposure),
            seed: options.seed.unwrap_or(settings.seed),
            time: Duration::ZERO,
            prepared,
        })
    }

    /// The prepared scene.
    pub fn prepared(&self) -> &Prepared {
        &self.prepared
    }

    fn cache_statistics(&self, counts: &CacheCounts) -> CacheStatistics {
        let Some(CpuCache { table, .. }) = &self.cache else {
            return CacheStatistics::default();
        };
        CacheStatistics {
            lookups: counts.lookups,
            hits: counts.hits,
            inserts: counts.inserts,
            refused: counts.refused,
            races_lost: counts.lost,
            unencodable: counts.unencodable,
            occupied: counts.inserts,
            capacity: table.size().capacity(),
            bytes: table.size().bytes(),
        }
    }
}

/// The programs of the materials, for the instructions that they will run in.
fn programs(
    prepared: &Prepared,
    options: &RenderOptions,
) -> Result<Arc<Vec<Program>>, RenderError> {
    let cached = options.cache != CacheMode::Off;
    let isa = options.schedule.isa;
    if cached && isa != Isa::best() {
        return prepared.cached_programs_for(CostModel::of(isa));
    }
    prepared.programs(cached)
}

/// The table that a mode asks for. A size that nobody asked for shrinks until it fits.
fn make_cache(mode: &CacheMode, programs: &[Program]) -> Result<Option<CpuCache>, RenderError> {
    let CacheMode::Paper {
        cells,
        entries,
        level_offset,
    } = *mode
    else {
        return Ok(None);
    };
    let asked = TableSize {
        cells: cells.unwrap_or(TableSize::PAPER.cells),
        entries: entries.unwrap_or(TableSize::PAPER.entries),
    };
    let size = match available_memory() {
        Some(available) if cells.is_none() => fitting_size(asked, available),
        _ => asked,
    };
    if size != asked {
        tracing::warn!(
            "the material cache of {} × {} entries does not fit into memory: {} cells are used",
            asked.cells,
            asked.entries,
            size.cells
        );
    }
    let layouts = programs.iter().zip(0..);
    Ok(Some(CpuCache {
        table: Table::new(size)?,
        layouts: layouts
            .map(|(program, material)| CacheLayout::new(material, program))
            .collect(),
        level_offset,
    }))
}

impl Backend for CpuBackend {
    fn device(&self) -> String {
        format!("CPU, {} threads", self.workers.len())
    }

    fn render(&mut self, range: Range<u32>, control: &Control) -> Result<Duration, RenderError> {
        let start = Instant::now();
        let frame = Frame {
            prepared: &self.prepared,
            programs: &self.programs,
            filter: &self.filter,
            cache: self.cache.as_ref().map(|cache| FrameCache {
                table: &cache.table,
                layouts: &cache.layouts,
                level_offset: cache.level_offset,
            }),
            seed: self.seed,
        };
        let film = Mutex::new(&mut self.film);
        let workers = &self.workers;
        let tiles = &self.tiles;
        self.pool.install(|| {
            tiles.par_iter().with_max_len(1).for_each(|tile| {
                if control.stopped() {
                    return;
                }
                let index = rayon::current_thread_index().unwrap_or(0);
                let mut worker = workers[index]
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner);
                let mut sums = vec![PixelSums::default(); tile.pixels() as usize];
                worker.render_tile(&frame, tile, range.clone(), &mut sums);
                film.lock()
                    .unwrap_or_else(PoisonError::into_inner)
                    .add_tile(tile, &sums);
                control.add_samples(u64::from(tile.pixels()) * range.len() as u64);
            });
        });
        let time = start.elapsed();
        self.time += time;
        Ok(time)
    }

    fn film(&self) -> &Film {
        &self.film
    }

    fn statistics(&self) -> Statistics {
        let mut statistics = Statistics {
            seconds: self.time.as_secs_f64(),
            thread_seconds: self.time.as_secs_f64() * self.workers.len() as f64,
            samples: self.film.total_samples(),
            ..Statistics::default()
        };
        let mut counts = CacheCounts::default();
        for worker in &self.workers {
            let worker = worker.lock().unwrap_or_else(PoisonError::into_inner);
            statistics.network_seconds += worker.network_time().as_secs_f64();
            statistics.rays += worker.counts().rays;
            statistics.shaded += worker.counts().shaded;
            counts += worker.cache_counts();
        }
        statistics.cache = self.cache_statistics(&counts);
        statistics.nodes_found = self.film.total_nodes_found();
        statistics
    }

    fn bytes(&self) -> usize {
        self.film.bytes() + self.programs.iter().map(Program::bytes).sum::<usize>()
    }
}
