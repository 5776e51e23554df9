//! The CPU as a rendering device.

use crate::backend::{
    Backend, CacheMode, CacheStatistics, Control, RenderError, RenderOptions, Statistics,
};
use crate::film::{Film, PixelSums, Tile, filter::FilterTable};
use crate::integrator::worker::Worker;
use crate::integrator::{Frame, FrameCache};
use crate::node_cache::CacheLayout;
use crate::prepare::Prepared;
use crate::table_use::TableUse;
use matcha_cache::{CacheCounts, Table, TableSize, available_memory, fitting_size};
use matcha_shade::compile::CostModel;
use matcha_shade::program::Program;
use matcha_shade::vm::Isa;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The material cache of a scene.
struct CpuCache {
    table: Table,
    cells: TableUse,
    /// Time in which the table's memory was cleared.
    clearing: Duration,
    /// For each material.
    layouts: Vec<CacheLayout>,
    level_offset: f32,
}

/// One tile in so many tells what the cache will have to hold.
const TELLING_TILES: usize = 16;

/// A prepared scene, its programs and cache, and a film.
pub struct CpuBackend {
    prepared: Arc<Prepared>,
    programs: Arc<Vec<Program>>,
    cache: Option<CpuCache>,
    pool: rayon::ThreadPool,
    workers: Vec<Mutex<Worker>>,
    /// Those that tell of all come first.
    tiles: Vec<Tile>,
    telling_tiles: usize,
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
        let (tiles, telling_tiles) = telling_first(width, height, pool.current_num_threads());
        Ok(Self {
            cache: make_cache(&options.cache, &programs)?,
            programs,
            workers: (0..pool.current_num_threads())
                .map(|_| Mutex::new(Worker::new(&options.schedule)))
                .collect(),
            pool,
            tiles,
            telling_tiles,
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

    fn cache_counts(&self) -> CacheCounts {
        let mut counts = CacheCounts::default();
        for worker in &self.workers {
            counts += lock(worker).cache_counts();
        }
        counts
    }

    fn cache_statistics(&self) -> CacheStatistics {
        let Some(CpuCache { table, cells, .. }) = &self.cache else {
            return CacheStatistics::default();
        };
        let counts = self.cache_counts();
        CacheStatistics {
            lookups: counts.lookups,
            hits: counts.hits,
            inserts: counts.inserts,
            refused: counts.refused,
            races_lost: counts.lost,
            unencodable: counts.unencodable,
            occupied: cells.entries(counts.inserts),
            capacity: table.size().capacity(),
            bytes: table.size().bytes(),
        }
    }

    /// Decides how many cells of the table are in use, by `decision`, which gets the number of
    /// values stored so far.
    fn fit_table(&mut self, decision: impl FnOnce(&mut TableUse, &mut Table, u64)) {
        let inserts = self.cache_counts().inserts;
        if let Some(cache) = &mut self.cache {
            let start = Instant::now();
            decision(&mut cache.cells, &mut cache.table, inserts);
            cache.clearing += start.elapsed();
        }
    }

    /// How many tiles are to be rendered before the cache's table is fitted to what they tell.
    fn tiles_to_see(&self) -> usize {
        match &self.cache {
            Some(cache) if cache.cells.wants_to_see() => self.telling_tiles,
            _ => 0,
        }
    }

    /// Renders some tiles, and takes the time.
    fn render_tiles(&mut self, tiles: Range<usize>, samples: &Range<u32>, control: &Control) {
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
        let tiles = &self.tiles[tiles];
        self.pool.install(|| {
            tiles.par_iter().with_max_len(1).for_each(|tile| {
                if control.stopped() {
                    return;
                }
                let mut worker = lock(&workers[rayon::current_thread_index().unwrap_or(0)]);
                let mut sums = vec![PixelSums::default(); tile.pixels() as usize];
                worker.render_tile(&frame, tile, samples.clone(), &mut sums);
                lock(&film).add_tile(tile, &sums);
                control.add_samples(u64::from(tile.pixels()) * samples.len() as u64);
            });
        });
        self.time += start.elapsed();
    }
}

/// What a panicking thread left is still what was counted.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// All tiles; first some from all over the picture, at least one a thread, and their number.
fn telling_first(width: u32, height: u32, threads: usize) -> (Vec<Tile>, usize) {
    let all = Tile::cover(width, height);
    let every = (all.len() / threads.max(1)).clamp(1, TELLING_TILES);
    let tells = |&(k, _): &(usize, &Tile)| k % every == 0;
    let telling = all.iter().enumerate().filter(tells);
    let others = all.iter().enumerate().filter(|tile| !tells(tile));
    let tiles = telling.chain(others).map(|(_, &tile)| tile).collect();
    (tiles, all.len().div_ceil(every))
}

fn pixels(tiles: &[Tile]) -> f64 {
    tiles.iter().map(|tile| f64::from(tile.pixels())).sum()
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
    let start = Instant::now();
    let (table, cells) = TableUse::begin(size)?;
    Ok(Some(CpuCache {
        table,
        cells,
        clearing: start.elapsed(),
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
        let before = self.time;
        self.fit_table(TableUse::keep_room);
        let seen = self.tiles_to_see();
        if seen > 0 {
            self.render_tiles(0..seen, &range, control);
            let share = pixels(&self.tiles[..seen]) / pixels(&self.tiles);
            self.fit_table(|cells, table, inserts| cells.foresee(table, inserts, share));
        }
        self.render_tiles(seen..self.tiles.len(), &range, control);
        Ok(self.time - before)
    }

    fn film(&self) -> &Film {
        &self.film
    }

    fn statistics(&self) -> Statistics {
        let mut statistics = Statistics {
            seconds: self.time.as_secs_f64(),
            table_seconds: self
                .cache
                .as_ref()
                .map_or(0.0, |c| c.clearing.as_secs_f64()),
            thread_seconds: self.time.as_secs_f64() * self.workers.len() as f64,
            samples: self.film.total_samples(),
            ..Statistics::default()
        };
        for worker in &self.workers {
            let worker = lock(worker);
            statistics.network_seconds += worker.network_time().as_secs_f64();
            statistics.rays += worker.counts().rays;
            statistics.shaded += worker.counts().shaded;
        }
        statistics.cache = self.cache_statistics();
        statistics.nodes_found = self.film.total_nodes_found();
        statistics
    }

    fn bytes(&self) -> usize {
        self.film.bytes() + self.programs.iter().map(Program::bytes).sum::<usize>()
    }
}
