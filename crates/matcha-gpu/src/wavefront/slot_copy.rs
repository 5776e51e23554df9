//! Paths in flight on the host, section by section as they lie in the device's memory.

use super::layout::{Column, QUEUES, Word};
use crate::error::GpuError;
use crate::memory::Memory;
use std::collections::BTreeMap;

/// All that the stages of a wave write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlotCopy {
    sections: BTreeMap<String, Vec<u32>>,
    capacity: u32,
}

impl SlotCopy {
    /// The sections of a memory that kernels write, for so many slots.
    pub(super) fn read(memory: &Memory, capacity: u32) -> Result<SlotCopy, GpuError> {
        let read = |name: &str| {
            let words = memory.read(name, 0, memory.length(name)?)?;
            Ok((name.to_owned(), words))
        };
        Ok(SlotCopy {
            sections: memory
                .written()
                .map(read)
                .collect::<Result<_, GpuError>>()?,
            capacity,
        })
    }

    /// Writes all sections.
    pub(super) fn write_to(&self, memory: &mut Memory) -> Result<(), GpuError> {
        let mut sections = self.sections.iter();
        sections.try_for_each(|(name, words)| memory.write(name, 0, words))
    }

    /// Slots that there are.
    pub fn capacity(&self) -> u32 {
        self.capacity
    }

    /// Sections and their words.
    pub fn sections(&self) -> impl Iterator<Item = (&str, &[u32])> {
        let sections = self.sections.iter();
        sections.map(|(name, words)| (name.as_str(), words.as_slice()))
    }

    /// The words of a section.
    ///
    /// # Panics
    /// If there is no such section.
    pub fn words(&self, section: &str) -> &[u32] {
        &self.sections[section]
    }

    /// The words of a section, to change.
    ///
    /// # Panics
    /// If there is no such section.
    pub fn words_mut(&mut self, section: &str) -> &mut [u32] {
        let words = self.sections.get_mut(section);
        words.unwrap_or_else(|| panic!("there is no section {section}"))
    }

    /// Row `row` of a section that has a word a slot in each.
    pub fn row_word(&self, section: &str, row: u32, slot: u32) -> u32 {
        self.words(section)[(row * self.capacity + slot) as usize]
    }

    /// Sets what [`SlotCopy::row_word`] gives.
    pub fn set_row_word(&mut self, section: &str, row: u32, slot: u32, word: u32) {
        let at = (row * self.capacity + slot) as usize;
        self.words_mut(section)[at] = word;
    }

    /// A slot's value of a section in columns.
    pub fn load<T: Column>(&self, section: &str, slot: u32) -> T {
        let words = self.words(section);
        let mut at = slot as usize;
        T::load(&mut || {
            let word = words[at];
            at += self.capacity as usize;
            word
        })
    }

    /// Sets a slot's value of a section in columns.
    pub fn store<T: Column>(&mut self, section: &str, slot: u32, value: &T) {
        let (mut at, step) = (slot as usize, self.capacity as usize);
        let words = self.words_mut(section);
        value.store(&mut |word| {
            words[at] = word;
            at += step;
        });
    }

    /// The slots of a queue.
    pub fn queue(&self, queue: u32) -> &[u32] {
        let first = (queue * self.capacity) as usize;
        let count = self.words("wave_counts")[queue as usize] as usize;
        &self.words("wave_queues")[first..first + count]
    }

    /// Adds a slot to a queue.
    pub fn push(&mut self, queue: u32, slot: u32) {
        let count = &mut self.words_mut("wave_counts")[queue as usize];
        let k = *count;
        *count += 1;
        self.set_row_word("wave_queues", queue, k, slot);
    }

    /// Numbers of all queues.
    pub fn queues() -> std::ops::Range<u32> {
        0..QUEUES
    }

    /// Words of a section in columns: what they are.
    pub fn columns(section: &str) -> Option<&'static [Word]> {
        let named = |(name, _): &&(&str, _)| *name == section;
        let found = super::layout::COLUMNS.iter().find(named);
        found.map(|(_, words)| *words)
    }
}
