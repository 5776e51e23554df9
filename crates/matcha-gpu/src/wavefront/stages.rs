//! The stages of a wave, in order, and the steps that they are made of.

use super::layout::*;

/// A stage of a wave, in the order in which a bounce comes to the first of its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Finished paths go onto the film and are replaced.
    Regenerate,
    /// Paths find what they meet.
    Traverse,
    /// Lights on the way of paths, the suns and the world.
    Lights,
    /// Node networks, look-ups in the cache included.
    Evaluate,
    /// Closures, and all that is sampled or taken from them.
    Shade,
    /// Shadow rays among surfaces.
    Shadow,
    /// What shadow rays bring.
    Accumulate,
}

/// Where networks are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Where paths hit surfaces.
    Hits,
    /// Points on emissive surfaces towards which shadow rays go.
    Emitters,
    /// Transparent surfaces on the way of shadow rays.
    Layers,
    /// Directions in which paths left the scene.
    Escaped,
    /// Directions of shadow rays to the world.
    WorldTasks,
    /// Directions of shadow rays to lights with node trees.
    LightTasks,
}

impl Place {
    /// Its number.
    pub fn at(self) -> u32 {
        match self {
            Place::Hits => AT_HITS,
            Place::Emitters => AT_EMITTERS,
            Place::Layers => AT_LAYERS,
            Place::Escaped => AT_ESCAPED,
            Place::WorldTasks => AT_WORLD_TASKS,
            Place::LightTasks => AT_LIGHT_TASKS,
        }
    }

    /// The queue of its slots.
    pub fn queue(self) -> u32 {
        match self {
            Place::Hits => QUEUE_HITS,
            Place::Emitters => QUEUE_EMITTERS,
            Place::Layers => QUEUE_LAYER_HITS,
            Place::Escaped => QUEUE_ESCAPED,
            Place::WorldTasks => QUEUE_WORLD_TASKS,
            Place::LightTasks => QUEUE_LIGHT_TASKS,
        }
    }

    /// On a surface programs have regions, and cached values.
    pub fn on_surface(self) -> bool {
        matches!(self, Place::Hits | Place::Emitters | Place::Layers)
    }
}

/// A part of a stage: a kernel over a queue, and its twin on the processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Makes the sizes of dispatches over the queues whose bits are set in `queues`, and empties those
    /// in `empty`. Belongs to no stage.
    Measure {
        /// Bits of queues.
        queues: u32,
        /// Bits of queues.
        empty: u32,
    },
    /// Puts finished paths on the film, and starts others.
    Regenerate,
    /// Finds what paths meet.
    Traverse,
    /// Adds the lights on the paths' ways.
    Meet,
    /// Adds the suns and the world to paths that left the scene.
    Escape,
    /// Puts slots in the order of their programs.
    Sort(Place),
    /// Looks the cacheable nodes up.
    LookUp(Place),
    /// Puts what was not found in the order of regions.
    SortMisses,
    /// Evaluates what was not found.
    Misses,
    /// Looks up, evaluates what is missing and then the rest, at once.
    Inline(Place),
    /// Evaluates the rest of programs.
    Evaluate(Place),
    /// Everything that happens to paths at their hits.
    Shade,
    /// Multiplies emission into shadow rays that wait for it.
    Emit(Place),
    /// Ends shadow rays that opaque surfaces block.
    Block,
    /// Finds the next transparent surface of shadow rays.
    Layer {
        /// Their queue.
        from: u32,
    },
    /// Weakens shadow rays by what they met, and sends them on.
    Pass {
        /// Into this queue.
        to: u32,
    },
    /// Adds to paths what shadow rays bring.
    Collect,
}

impl Step {
    /// The stage that it belongs to.
    pub fn stage(self) -> Option<Stage> {
        Some(match self {
            Step::Measure { .. } => return None,
            Step::Regenerate => Stage::Regenerate,
            Step::Traverse => Stage::Traverse,
            Step::Meet | Step::Escape => Stage::Lights,
            Step::Sort(_) | Step::LookUp(_) | Step::SortMisses | Step::Misses => Stage::Evaluate,
            Step::Inline(_) | Step::Evaluate(_) => Stage::Evaluate,
            Step::Shade | Step::Emit(_) | Step::Pass { .. } => Stage::Shade,
            Step::Block | Step::Layer { .. } => Stage::Shadow,
            Step::Collect => Stage::Accumulate,
        })
    }

    /// What its time is counted for.
    pub(super) fn timed_as(self) -> &'static str {
        match self {
            Step::Measure { .. } => "queues",
            Step::Regenerate => "regenerate",
            Step::Traverse => "traverse",
            Step::Meet | Step::Escape => "lights",
            Step::Sort(_) | Step::SortMisses => "sort",
            Step::LookUp(_) => "lookup",
            Step::Misses => "misses",
            Step::Inline(_) | Step::Evaluate(_) => "evaluate",
            Step::Shade | Step::Emit(_) | Step::Pass { .. } => "shade",
            Step::Block | Step::Layer { .. } => "shadow",
            Step::Collect => "accumulate",
        }
    }
}

/// What a rendering needs of the stages.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    /// Values of nodes are kept.
    pub cached: bool,
    /// Hits look up and evaluate what is missing in one kernel.
    pub inline: bool,
    /// The world has a program.
    pub world: bool,
    /// Some light has one.
    pub light_programs: bool,
    /// Shadow rays pass transparent surfaces.
    pub transparent: bool,
    /// Most transparent surfaces on the way of a shadow ray.
    pub layers: u32,
    /// Hits and misses are sorted by what is to be evaluated.
    pub sorted: bool,
    /// Number of programs.
    pub programs: u32,
    /// Number of regions of all programs.
    pub regions: u32,
}

/// The queues of shadow rays among transparent surfaces, as a bounce begins with them: those that
/// come next, and those behind the surface after it.
pub(super) const LAYER_QUEUES: [u32; 2] = [QUEUE_LAYERS, QUEUE_LAYERS_NEXT];

fn measure(queues: &[u32], empty: &[u32]) -> Step {
    let bits = |queues: &[u32]| queues.iter().fold(0, |bits, queue| bits | 1 << queue);
    Step::Measure {
        queues: bits(queues),
        empty: bits(empty),
    }
}

impl Form {
    /// Slots are sorted before networks run.
    pub fn sorts_slots(&self) -> bool {
        self.sorted && self.programs > 1
    }

    /// Misses are sorted before they are evaluated.
    pub fn sorts_misses(&self) -> bool {
        self.sorted && self.regions > 1 && self.cached && !self.inline
    }

    /// Replaces finished paths; counts of the last bounce are no longer needed.
    pub fn regenerate(&self) -> [Step; 2] {
        let empty = (1 << QUEUES) - 1;
        [Step::Measure { queues: 0, empty }, Step::Regenerate]
    }

    /// All steps up to shadow rays among opaque surfaces.
    pub fn until_shadows(&self) -> Vec<Step> {
        let mut steps = self.regenerate().to_vec();
        steps.extend([
            measure(&[QUEUE_ACTIVE], &[]),
            Step::Traverse,
            Step::Meet,
            measure(&[QUEUE_HITS, QUEUE_ESCAPED], &[]),
        ]);
        if self.world {
            self.networks(Place::Escaped, &mut steps);
        }
        steps.push(Step::Escape);
        self.networks(Place::Hits, &mut steps);
        steps.push(Step::Shade);
        let waiting = [
            QUEUE_TASKS,
            QUEUE_EMITTERS,
            QUEUE_WORLD_TASKS,
            QUEUE_LIGHT_TASKS,
        ];
        steps.push(measure(&waiting, &[]));
        self.emitters(&mut steps);
        steps.push(Step::Block);
        steps
    }

    /// Evaluates programs at a place.
    fn networks(&self, place: Place, steps: &mut Vec<Step>) {
        if self.sorts_slots() && place.on_surface() {
            steps.push(Step::Sort(place));
        }
        if self.cached && place.on_surface() {
            if self.inline {
                steps.push(Step::Inline(place));
                return;
            }
            steps.extend([Step::LookUp(place), measure(&[QUEUE_MISSES], &[])]);
            if self.sorts_misses() {
                steps.push(Step::SortMisses);
            }
            steps.extend([Step::Misses, measure(&[], &[QUEUE_MISSES])]);
        }
        steps.push(Step::Evaluate(place));
    }

    /// The radiance of sampled lights that is not known.
    fn emitters(&self, steps: &mut Vec<Step>) {
        let mut places = vec![Place::Emitters];
        places.extend(self.world.then_some(Place::WorldTasks));
        places.extend(self.light_programs.then_some(Place::LightTasks));
        for place in places {
            self.networks(place, steps);
            steps.push(Step::Emit(place));
        }
    }

    /// Some transparent surfaces on the way of shadow rays, one layer after the other: of those
    /// in the first queue, into the second and back. Returns the queues in the order for going on.
    pub fn add_layers(&self, mut queues: [u32; 2], count: u32, steps: &mut Vec<Step>) -> [u32; 2] {
        if !self.transparent {
            return queues;
        }
        for _ in 0..count {
            let [from, to] = queues;
            steps.extend([
                measure(&[from], &[to, QUEUE_LAYER_HITS]),
                Step::Layer { from },
                measure(&[QUEUE_LAYER_HITS], &[]),
            ]);
            self.networks(Place::Layers, steps);
            steps.push(Step::Pass { to });
            queues = [to, from];
        }
        queues
    }
}
