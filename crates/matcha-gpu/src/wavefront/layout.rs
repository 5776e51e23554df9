//! How paths in flight lie in the device's memory, for the host: numbers of queues and states, and
//! the words of structs in columns. The build script takes all of it from `src/wgsl/wave_*.wgsl` and
//! from the device structs themselves.

use glam::{Vec2, Vec3};

#[allow(dead_code)]
mod generated {
    use super::{Column, Word};
    include!(concat!(env!("OUT_DIR"), "/host_code.rs"));
}
pub use generated::*;

/// A word of a struct in columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// How device code names it: `origin.x`, `leaves[1]`.
    pub path: &'static str,
    /// A number with a fraction; else a whole number, bits, or 0 and 1.
    pub float: bool,
}

/// A value that lies in columns, word by word.
pub trait Column: Sized {
    /// Makes the value of its words, which `next` gives in order.
    fn load(next: &mut dyn FnMut() -> u32) -> Self;

    /// Hands its words to `put` in order.
    fn store(&self, put: &mut dyn FnMut(u32));
}

impl Column for u32 {
    fn load(next: &mut dyn FnMut() -> u32) -> Self {
        next()
    }

    fn store(&self, put: &mut dyn FnMut(u32)) {
        put(*self);
    }
}

impl Column for f32 {
    fn load(next: &mut dyn FnMut() -> u32) -> Self {
        f32::from_bits(next())
    }

    fn store(&self, put: &mut dyn FnMut(u32)) {
        put(self.to_bits());
    }
}

impl Column for bool {
    fn load(next: &mut dyn FnMut() -> u32) -> Self {
        next() != 0
    }

    fn store(&self, put: &mut dyn FnMut(u32)) {
        put((*self).into());
    }
}

impl Column for Vec2 {
    fn load(next: &mut dyn FnMut() -> u32) -> Self {
        <[f32; 2]>::load(next).into()
    }

    fn store(&self, put: &mut dyn FnMut(u32)) {
        self.to_array().store(put);
    }
}

impl Column for Vec3 {
    fn load(next: &mut dyn FnMut() -> u32) -> Self {
        <[f32; 3]>::load(next).into()
    }

    fn store(&self, put: &mut dyn FnMut(u32)) {
        self.to_array().store(put);
    }
}

impl<T: Column, const N: usize> Column for [T; N] {
    fn load(next: &mut dyn FnMut() -> u32) -> Self {
        std::array::from_fn(|_| T::load(next))
    }

    fn store(&self, put: &mut dyn FnMut(u32)) {
        self.iter().for_each(|element| element.store(put));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use matcha_render::device::path_shade::{ShadowTask, path_no_task};

    #[test]
    fn a_struct_comes_back_from_its_words() {
        let task = ShadowTask {
            value: Vec3::new(1.0, 2.0, 3.0),
            leaves: [4, 5],
            casts_shadow: true,
            uv: Vec2::new(0.25, 0.5),
            distance: 9.0,
            ..path_no_task()
        };
        let mut words = Vec::new();
        task.store(&mut |word| words.push(word));
        let (_, listed) = COLUMNS
            .iter()
            .find(|(name, _)| *name == "tasks")
            .expect("tasks");
        assert_eq!(words.len(), listed.len());
        let word = |path: &str| {
            let at = listed.iter().position(|word| word.path == path);
            words[at.expect("the field")]
        };
        assert_eq!(word("value.y"), 2.0f32.to_bits());
        assert_eq!([word("leaves[0]"), word("leaves[1]")], [4, 5]);
        assert_eq!((word("casts_shadow"), word("uv.y")), (1, 0.5f32.to_bits()));
        let mut next = words.iter().copied();
        let again = ShadowTask::load(&mut || next.next().expect("a word"));
        assert_eq!(format!("{again:?}"), format!("{task:?}"));
    }

    #[test]
    fn constants_are_those_of_the_kernels() {
        let all = [QUEUE_ACTIVE, QUEUE_HITS, QUEUE_MISSES, MISS_ROWS, AT_HITS];
        assert_eq!(all, [0, 1, 10, 6, 0]);
        assert_eq!(SCENE_NOTHING, u32::MAX);
    }
}
