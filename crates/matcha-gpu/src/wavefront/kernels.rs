//! The kernels of a wave.

use super::stages::Form;
use crate::error::GpuError;
use crate::memory::Memory;
use crate::pipeline::{Kernel, KernelSource, Pipelines};
use crate::shader::Library;
use crate::sort::CountingSort;
use std::sync::Arc;

/// The kernels that a form needs.
pub(super) struct Kernels {
    pub measure: Arc<Kernel>,
    pub regenerate: Arc<Kernel>,
    pub traverse: Arc<Kernel>,
    pub meet: Arc<Kernel>,
    pub escape: Arc<Kernel>,
    pub evaluate: Arc<Kernel>,
    pub look_up: Option<Arc<Kernel>>,
    pub misses: Option<Arc<Kernel>>,
    pub inline: Option<Arc<Kernel>>,
    pub shade: Arc<Kernel>,
    pub emit: Arc<Kernel>,
    pub block: Arc<Kernel>,
    pub layer: Option<Arc<Kernel>>,
    pub pass: Option<Arc<Kernel>>,
    pub collect: Arc<Kernel>,
    pub sort_slots: Option<CountingSort>,
    pub sort_misses: Option<CountingSort>,
}

impl Kernels {
    /// Compiles them.
    pub fn new(
        pipelines: &Pipelines,
        library: &Library,
        scene: &Memory,
        slots: &Memory,
        table: Option<&Memory>,
        form: &Form,
    ) -> Result<Kernels, GpuError> {
        let kernel = |name: &str, memories: &[&Memory]| {
            pipelines.kernel(&KernelSource {
                name,
                library,
                memories,
                constants: &[],
            })
        };
        let plain = |name: &str| kernel(name, &[scene, slots]);
        let cached = |name, wanted: bool| match table {
            Some(table) if wanted => kernel(name, &[scene, slots, table]).map(Some),
            _ => Ok(None),
        };
        let optional = |name, wanted: bool| wanted.then(|| plain(name)).transpose();
        let sort = |count, place, wanted: bool| {
            let sort = || CountingSort::new(count, place, plain);
            wanted.then(sort).transpose()
        };
        let of_lights = |trees, without| plain(if form.light_programs { trees } else { without });
        Ok(Kernels {
            sort_slots: sort("wave_sort_slots", "wave_place_slots", form.sorts_slots())?,
            sort_misses: sort("wave_sort_misses", "wave_place_misses", form.sorts_misses())?,
            measure: plain("wave_measure")?,
            regenerate: plain("wave_regenerate")?,
            traverse: plain("wave_traverse")?,
            meet: of_lights("wave_meet_trees", "wave_meet")?,
            escape: of_lights("wave_escape_trees", "wave_escape")?,
            evaluate: plain("wave_evaluate")?,
            look_up: cached("wave_look_up", !form.inline)?,
            misses: cached("wave_misses", !form.inline)?,
            inline: cached("wave_inline", form.inline)?,
            shade: plain("wave_shade")?,
            emit: plain("wave_emit")?,
            block: plain("wave_block")?,
            layer: optional("wave_layer", form.transparent)?,
            pass: optional("wave_pass", form.transparent)?,
            collect: plain("wave_collect")?,
        })
    }
}
