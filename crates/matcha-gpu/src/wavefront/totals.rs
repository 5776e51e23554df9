//! What a wavefront did.

use super::state::Counts;
use matcha_render::backend::CacheStatistics;
use std::collections::BTreeMap;
use std::time::Duration;

/// What a wavefront did so far.
#[derive(Clone, Debug, Default)]
pub struct WavefrontStatistics {
    /// Rays traced: camera, scattered and shadow rays.
    pub rays: u64,
    /// Shading points at which a network ran.
    pub shaded: u64,
    /// Nodes found in the cache.
    pub nodes_found: u64,
    /// The cache; all zero where it is off.
    pub cache: CacheStatistics,
    /// Device time of each stage, seconds; empty where the device has no timestamps.
    pub stage_seconds: BTreeMap<&'static str, f64>,
    /// Device time spent in evaluating node networks, seconds.
    pub network_seconds: f64,
}

/// Stages that evaluate networks or look their nodes up, or put hits in order for it.
const NETWORKS: [&str; 4] = ["sort", "lookup", "misses", "evaluate"];

/// Sums of counts.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Totals {
    rays: u64,
    shaded: u64,
    look_ups: u64,
    found: u64,
}

impl Totals {
    pub(super) fn add(&mut self, counts: &Counts) {
        self.rays += counts.rays;
        self.shaded += counts.shaded;
        self.look_ups += counts.look_ups;
        self.found += counts.found;
    }

    pub(super) fn statistics(
        &self,
        table: Option<CacheStatistics>,
        stages: &BTreeMap<&'static str, f64>,
        time: Duration,
    ) -> WavefrontStatistics {
        let cache = table.map_or_else(CacheStatistics::default, |table| CacheStatistics {
            lookups: self.look_ups,
            hits: self.found,
            ..table
        });
        let seconds = |name: &&str| stages.get(name).copied().unwrap_or(0.0);
        // Where timestamps overlap or wrap, a share of more than everything means nothing.
        let network_seconds: f64 = NETWORKS.iter().map(seconds).sum();
        WavefrontStatistics {
            rays: self.rays,
            shaded: self.shaded,
            nodes_found: self.found,
            cache,
            stage_seconds: stages.clone(),
            network_seconds: network_seconds.min(time.as_secs_f64()),
        }
    }
}
