//! Where functions are tried.

use crate::adapter::Point;

/// Random numbers that are the same every time (Steele, Lea and Flood 2014, SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// A number in the range.
    pub fn number(&mut self, [low, high]: [f32; 2]) -> f32 {
        low + (high - low) * ((self.word() >> 8) as f32 / 16_777_216.0)
    }
}

/// `count` points with numbers of the range, and an immediate below `immediates`.
pub fn numbers(count: usize, range: [f32; 2], immediates: u32, seed: u64) -> Vec<Point> {
    let mut random = Random(seed);
    let point = |_| {
        let mut words: Point = std::array::from_fn(|_| random.number(range).to_bits());
        words[12] = random.word() % immediates;
        words
    };
    (0..count).map(point).collect()
}

/// Points of all kinds of bits.
pub fn words(count: usize, seed: u64) -> Vec<Point> {
    let mut random = Random(seed);
    (0..count)
        .map(|_| std::array::from_fn(|_| random.word()))
        .collect()
}

/// Points whose numbers are special: zero, whole numbers, halves and small ones. The sign
/// of a zero, infinities and not-a-number are not among them: WGSL lets a device take any
/// zero for another and assume that there are no others.
pub fn special(count: usize, immediates: u32, seed: u64) -> Vec<Point> {
    let values: [f32; 8] = [0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -3.0, 1e-6];
    let mut random = Random(seed);
    let point = |_| {
        let mut words: Point =
            std::array::from_fn(|_| values[random.word() as usize % values.len()].to_bits());
        words[12] = random.word() % immediates;
        words
    };
    (0..count).map(point).collect()
}
