//! Where sections lie: as few buffers as the limits allow. The build script reads this
//! file, too.

use super::section::{Class, Declaration, STORED};

/// Elements to which the start of a section is rounded: a cache line or more.
const ALIGNMENT: u64 = 32;

/// What a device allows.
#[derive(Clone, Copy, Debug)]
pub struct PlacementLimits {
    /// Largest binding, bytes.
    pub binding_bytes: u64,
    /// Most storage buffers that one kernel may be bound to, in all its groups.
    pub storage_buffers: u32,
    /// Largest uniform binding, bytes.
    pub uniform_bytes: u64,
}

/// A buffer that is bound as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arena {
    /// What is in it.
    pub class: Class,
    /// Its number among those of its class.
    pub number: u32,
    /// Elements.
    pub length: u64,
}

/// A section's place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Name, class and stride.
    pub declaration: Declaration,
    /// Elements (of the class).
    pub length: u64,
    /// The arena that it begins in (a number among all arenas); unused for plain sections.
    pub arena: usize,
    /// Arenas that it reaches over; more than one only if it does not fit into one.
    pub arenas: usize,
    /// First element in its first arena; for plain sections, first word in the header.
    pub offset: u64,
    /// Words of the header with the offset, and behind it the count.
    pub slot: u32,
}

/// All places.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Placement {
    /// The arenas, those of one class together.
    pub arenas: Vec<Arena>,
    /// The sections in the order in which they were asked for.
    pub sections: Vec<Placed>,
    /// Words of the header, a multiple of four.
    pub header_words: u32,
    /// Most elements that an arena of a class of one word may have.
    binding_words: u64,
}

/// Why sections have no place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlacementError {
    /// There are not enough bindings.
    #[error(
        "the scene needs {needed} storage buffers of at most {binding_mib} MiB, but the device binds {allowed}: \
         choose another with --device, a smaller cache with --cells, or smaller pictures"
    )]
    Buffers {
        /// How many it takes.
        needed: usize,
        /// How many there can be.
        allowed: u32,
        /// Their largest size, MiB.
        binding_mib: u64,
    },
    /// Plain sections do not fit.
    #[error("{words} words do not fit into a uniform buffer of {limit} bytes")]
    Header {
        /// How many words they are.
        words: u32,
        /// The device's limit.
        limit: u64,
    },
    /// Offsets are words.
    #[error(
        "section {0} has more than 4294967295 elements: render with a smaller cache (--cells), smaller pictures, or \
         --device cpu"
    )]
    TooLong(String),
}

impl Placement {
    /// Places sections of the given numbers of elements.
    pub fn new(
        sections: &[(Declaration, u64)],
        limits: &PlacementLimits,
    ) -> Result<Placement, PlacementError> {
        let mut placement = Placement {
            binding_words: limits.binding_bytes / 4,
            ..Placement::default()
        };
        for (index, (declaration, length)) in sections.iter().enumerate() {
            if u32::try_from(*length).is_err() {
                return Err(PlacementError::TooLong(declaration.name.clone()));
            }
            placement.sections.push(Placed {
                declaration: declaration.clone(),
                length: *length,
                arena: 0,
                arenas: 0,
                offset: 0,
                slot: 2 * index as u32,
            });
        }
        for class in STORED {
            placement.place_class(class);
        }
        placement.place_plain();
        placement.fits(limits)
    }

    /// Most elements of a class that a binding holds.
    pub fn binding_length(&self, class: Class) -> u64 {
        self.binding_words / class.words() / ALIGNMENT * ALIGNMENT
    }

    fn place_class(&mut self, class: Class) {
        let capacity = self.binding_length(class);
        let first = self.arenas.len();
        let add = |arenas: &mut Vec<Arena>, length| {
            let number = (arenas.len() - first) as u32;
            arenas.push(Arena {
                class,
                number,
                length,
            });
        };
        for section in &mut self.sections {
            if section.declaration.class != class {
                continue;
            }
            // Nothing is bound in vain, but a buffer is never empty.
            let length = section.length.max(1);
            section.arenas = length.div_ceil(capacity) as usize;
            if section.arenas > 1 {
                section.arena = self.arenas.len();
                let mut rest = length;
                while rest > 0 {
                    add(&mut self.arenas, rest.min(capacity));
                    rest = rest.saturating_sub(capacity);
                }
                continue;
            }
            let start = |arena: &Arena| arena.length.next_multiple_of(ALIGNMENT);
            let room = |arena: &Arena| start(arena) + length <= capacity;
            let found = self.arenas[first..].iter().position(room);
            section.arena = first + found.unwrap_or(self.arenas.len() - first);
            if found.is_none() {
                add(&mut self.arenas, 0);
            }
            let arena = &mut self.arenas[section.arena];
            section.offset = start(arena);
            arena.length = section.offset + length;
        }
    }

    fn place_plain(&mut self) {
        let mut words = 2 * self.sections.len() as u32;
        for section in &mut self.sections {
            if section.declaration.class == Class::Plain {
                section.length = u64::from(section.declaration.stride);
                section.offset = u64::from(words);
                words += section.declaration.stride;
            }
        }
        self.header_words = words.next_multiple_of(4).max(4);
    }

    fn fits(self, limits: &PlacementLimits) -> Result<Placement, PlacementError> {
        if self.arenas.len() > limits.storage_buffers as usize {
            return Err(PlacementError::Buffers {
                needed: self.arenas.len(),
                allowed: limits.storage_buffers,
                binding_mib: limits.binding_bytes >> 20,
            });
        }
        if u64::from(self.header_words) * 4 > limits.uniform_bytes {
            return Err(PlacementError::Header {
                words: self.header_words,
                limit: limits.uniform_bytes,
            });
        }
        Ok(self)
    }

    /// The header's words, plain sections zero.
    pub fn header(&self) -> Vec<u32> {
        let mut words = vec![0; self.header_words as usize];
        for section in &self.sections {
            let counted = section.length / u64::from(section.declaration.stride);
            words[section.slot as usize] = section.offset as u32;
            words[section.slot as usize + 1] = counted as u32;
        }
        words
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: PlacementLimits = PlacementLimits {
        binding_bytes: 4096,
        storage_buffers: 8,
        uniform_bytes: 1024,
    };

    fn section(name: &str, class: Class, length: u64) -> (Declaration, u64) {
        let declaration = Declaration {
            name: name.to_owned(),
            class,
            stride: 1,
        };
        (declaration, length)
    }

    #[test]
    fn small_sections_share_a_buffer_and_a_large_one_has_several() {
        let sections = [
            section("a", Class::Read, 10),
            section("large", Class::Read, 2500),
            section("b", Class::Read, 20),
            section("c", Class::Write4, 0),
            section("p", Class::Plain, 1),
        ];
        let placement = Placement::new(&sections, &LIMITS).expect("it fits");
        let lengths: Vec<_> = placement
            .arenas
            .iter()
            .map(|a| (a.class, a.length))
            .collect();
        let expected = [
            (Class::Read, 52),
            (Class::Read, 1024),
            (Class::Read, 1024),
            (Class::Read, 452),
            (Class::Write4, 1),
        ];
        assert_eq!(lengths, expected);
        let places: Vec<_> = placement
            .sections
            .iter()
            .map(|s| (s.arena, s.offset))
            .collect();
        assert_eq!(places, [(0, 0), (1, 0), (0, 32), (4, 0), (0, 10)]);
        assert_eq!(placement.header_words, 12);
        assert_eq!(
            placement.header()[..10],
            [0, 10, 0, 2500, 32, 20, 0, 0, 10, 1]
        );
    }

    #[test]
    fn what_cannot_be_bound_is_refused() {
        let sections = [section("huge", Class::Read, 9 * 1024)];
        let error = Placement::new(&sections, &LIMITS).expect_err("nine are too many");
        let PlacementError::Buffers {
            needed, allowed, ..
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!((needed, allowed), (9, 8));
        let long = [section("long", Class::Read, 1 << 32)];
        let error = Placement::new(&long, &LIMITS).expect_err("too long");
        assert_eq!(error, PlacementError::TooLong("long".to_owned()));
    }
}
