//! Bounces step by step: some stages on the processor and the others on the device, to find out
//! which one differs; or each on both, to be compared.

use super::Wavefront;
use super::layout::QUEUE_ACTIVE;
use super::slot_copy::SlotCopy;
use super::stages::{Form, LAYER_QUEUES, Stage, Step};
use super::state::Part;
use crate::error::GpuError;
use crate::twin::Twin;
use std::ops::Range;

/// The first stage that the device takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GpuFrom {
    /// This one: those before it are left to their twins on the processor.
    Stage(Stage),
    /// The device takes none.
    Nothing,
}

impl GpuFrom {
    fn leaves_to_twin(self, stage: Stage) -> bool {
        match self {
            GpuFrom::Stage(first) => stage < first,
            GpuFrom::Nothing => true,
        }
    }
}

/// Who runs which stage.
pub(super) struct Bisection {
    pub from: GpuFrom,
    pub twin: Twin,
}

/// What some steps did on the device, and what their twins do.
#[doc(hidden)]
pub struct StepRecord<'a> {
    /// The steps: one, or those that look networks' values up and evaluate what is missing.
    pub steps: &'a [Step],
    /// Paths in flight before.
    pub before: &'a SlotCopy,
    /// After, on the device.
    pub device: &'a SlotCopy,
    /// After, on the processor.
    pub twin: &'a SlotCopy,
}

/// Who takes the steps of a bounce.
trait Stepper {
    /// Takes some steps.
    fn take(&mut self, steps: &[Step]) -> Result<(), GpuError>;

    /// Slots in a queue.
    fn count(&self, queue: u32) -> Result<u32, GpuError>;

    /// One bounce of all paths; then finished ones are replaced.
    fn bounce(&mut self, form: &Form) -> Result<(), GpuError> {
        self.take(&form.until_shadows())?;
        let mut queues = LAYER_QUEUES;
        for _ in 0..form.layers {
            if self.count(queues[0])? == 0 {
                break;
            }
            let mut steps = Vec::new();
            queues = form.add_layers(queues, 1, &mut steps);
            self.take(&steps)?;
        }
        self.take(&[Step::Collect])?;
        self.take(&form.regenerate())
    }
}

/// Each step where its stage belongs.
struct Divided<'a> {
    wavefront: &'a mut Wavefront,
    bisection: &'a mut Bisection,
    part: &'a Part,
    /// Paths in flight while they are on the processor.
    here: Option<SlotCopy>,
}

impl Divided<'_> {
    fn bring_here(&mut self) -> Result<(), GpuError> {
        if self.here.is_none() {
            self.here = Some(self.wavefront.slots.copy()?);
        }
        Ok(())
    }

    fn send_back(&mut self) -> Result<(), GpuError> {
        let Some(here) = self.here.take() else {
            return Ok(());
        };
        let Wavefront { slots, runner, .. } = &mut *self.wavefront;
        slots.restore(runner, &here)
    }
}

impl Stepper for Divided<'_> {
    fn take(&mut self, steps: &[Step]) -> Result<(), GpuError> {
        for step in steps {
            // What belongs to no stage happens where the paths are.
            match step
                .stage()
                .map(|stage| self.bisection.from.leaves_to_twin(stage))
            {
                Some(true) => self.bring_here()?,
                Some(false) => self.send_back()?,
                None => {}
            }
            match &mut self.here {
                Some(here) => self.bisection.twin.run(*step, self.part, here),
                None => drop(self.wavefront.wave().run_steps(&[*step], self.part)?),
            }
        }
        Ok(())
    }

    fn count(&self, queue: u32) -> Result<u32, GpuError> {
        match &self.here {
            Some(here) => Ok(here.queue(queue).len() as u32),
            None => self.wavefront.slots.count(queue),
        }
    }
}

/// Each step on both, from the same paths.
struct Compared<'a> {
    wavefront: &'a mut Wavefront,
    twin: &'a mut Twin,
    part: &'a Part,
    now: SlotCopy,
    look: &'a mut dyn FnMut(&StepRecord),
}

impl Stepper for Compared<'_> {
    fn take(&mut self, steps: &[Step]) -> Result<(), GpuError> {
        let mut rest = steps;
        while !rest.is_empty() {
            let (now, later) = rest.split_at(together(rest));
            rest = later;
            self.wavefront.wave().run_steps(now, self.part)?;
            let device = self.wavefront.slots.copy()?;
            let mut twin = self.now.clone();
            for step in now {
                self.twin.run(*step, self.part, &mut twin);
            }
            (self.look)(&StepRecord {
                steps: now,
                before: &self.now,
                device: &device,
                twin: &twin,
            });
            self.now = device;
        }
        Ok(())
    }

    fn count(&self, queue: u32) -> Result<u32, GpuError> {
        Ok(self.now.queue(queue).len() as u32)
    }
}

/// How many of the first steps are compared together: what a twin does not find in the cache, the
/// device may, so that only what both have in the end is the same.
fn together(steps: &[Step]) -> usize {
    let evaluates = |step: &Step| matches!(step, Step::Evaluate(_));
    match steps[0] {
        Step::LookUp(_) => steps.iter().position(evaluates).map_or(1, |last| last + 1),
        _ => 1,
    }
}

impl Wavefront {
    /// One bounce, each step where its stage belongs; then finished paths are replaced.
    pub(super) fn run_bisected(
        &mut self,
        bisection: &mut Bisection,
        part: &Part,
    ) -> Result<(), GpuError> {
        let form = self.form.clone();
        let mut divided = Divided {
            wavefront: self,
            bisection,
            part,
            here: None,
        };
        divided.bounce(&form)?;
        divided.send_back()
    }

    /// For tests: renders some bounces of the first part of a picture, which is not put on a film,
    /// and shows `look` what every step does here and there.
    ///
    /// # Errors
    /// If the device fails, or the wavefront has no twins: see
    /// [`crate::backend::GpuOptions::gpu_from`].
    #[doc(hidden)]
    pub fn compare_steps(
        &mut self,
        pixels: u32,
        samples: Range<u32>,
        bounces: u32,
        look: &mut dyn FnMut(&StepRecord),
    ) -> Result<(), GpuError> {
        let Some(mut bisection) = self.bisection.take() else {
            return Err(GpuError::Invalid {
                what: "to compare steps".to_owned(),
                message: "there are no twins".to_owned(),
            });
        };
        let part = Part::new(0, pixels, self.in_use, self.width, &samples);
        let done = self.compare_bounces(&mut bisection.twin, &part, bounces, look);
        self.bisection = Some(bisection);
        done
    }

    fn compare_bounces(
        &mut self,
        twin: &mut Twin,
        part: &Part,
        bounces: u32,
        look: &mut dyn FnMut(&StepRecord),
    ) -> Result<(), GpuError> {
        let form = self.form.clone();
        self.slots.reset(&mut self.runner, part)?;
        let mut compared = Compared {
            now: self.slots.copy()?,
            wavefront: self,
            twin,
            part,
            look,
        };
        for _ in 0..bounces {
            compared.bounce(&form)?;
            if compared.count(QUEUE_ACTIVE)? == 0 {
                break;
            }
        }
        Ok(())
    }
}
