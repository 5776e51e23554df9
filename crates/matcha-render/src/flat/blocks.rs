//! Images packed in blocks (`device::texture_block`): a quarter of the memory.

use crate::device::texture_block::*;
use rayon::prelude::*;

/// Texels of a block.
const TEXELS: usize = (BLOCK_SIDE * BLOCK_SIDE) as usize;

/// A channel of a level may be off by so much in the mean (the root of the mean square), of 255;
/// a level for which blocks would be worse stays as it is.
pub const BLOCK_ERROR: f64 = 4.0;

type Texel = [f32; 4];
type Block = [Texel; TEXELS];

/// A level's words in blocks; none where they are no fewer, or the error would be more than
/// [`BLOCK_ERROR`].
pub(super) fn pack(width: u32, height: u32, texels: &[[u8; 4]]) -> Option<Vec<u32>> {
    let (across, down) = (blocks_along(width), blocks_along(height));
    let words = across as usize * down as usize * BLOCK_WORDS as usize;
    if words >= texels.len() {
        return None;
    }
    let packed: Vec<(Vec<u32>, [f64; 4])> = (0..down)
        .into_par_iter()
        .map(|row| pack_row(width, height, texels, row))
        .collect();
    let mut squares = [0.0; 4];
    for (_, row) in &packed {
        for (sum, square) in squares.iter_mut().zip(row) {
            *sum += square;
        }
    }
    let worst = squares.into_iter().fold(0.0, f64::max);
    let most = BLOCK_ERROR * BLOCK_ERROR * texels.len() as f64;
    (worst <= most).then(|| packed.into_iter().flat_map(|(words, _)| words).collect())
}

/// A row of blocks, and the sums of the channels' squared errors.
fn pack_row(width: u32, height: u32, texels: &[[u8; 4]], row: u32) -> (Vec<u32>, [f64; 4]) {
    let mut words = Vec::with_capacity((blocks_along(width) * BLOCK_WORDS) as usize);
    let mut squares = [0.0; 4];
    for column in 0..blocks_along(width) {
        let place = |k: usize| {
            let k = k as u32;
            [
                column * BLOCK_SIDE + k % BLOCK_SIDE,
                row * BLOCK_SIDE + k / BLOCK_SIDE,
            ]
        };
        // Beyond the border its texels go on.
        let block: Block = std::array::from_fn(|k| {
            let [x, y] = place(k);
            let at = y.min(height - 1) as usize * width as usize + x.min(width - 1) as usize;
            texels[at].map(f32::from)
        });
        let packed = pack_block(&block);
        for (k, texel) in block.iter().enumerate() {
            let [x, y] = place(k);
            if x < width && y < height {
                let off = unpacked(&packed, k as u32);
                for c in 0..4 {
                    squares[c] += f64::from(off[c] - texel[c]).powi(2);
                }
            }
        }
        words.extend(packed);
    }
    (words, squares)
}

/// A texel as device code has it.
fn unpacked(block: &[u32; 4], texel: u32) -> Texel {
    let weights = block_weights(block[0], block[1], block[2 + texel as usize / 8], texel);
    let color = block_color(block[0], block[1], weights.x);
    let alpha = block_between(block_alpha(block[0]), block_alpha(block[1]), weights.y);
    [color.x, color.y, color.z, alpha]
}

/// The better one of both forms.
fn pack_block(block: &Block) -> [u32; 4] {
    let together = pack_together(block);
    if block.iter().all(|texel| texel[3] == block[0][3]) {
        return together;
    }
    let apart = pack_apart(block);
    if squared_error(block, &apart) < squared_error(block, &together) {
        apart
    } else {
        together
    }
}

fn squared_error(block: &Block, packed: &[u32; 4]) -> f32 {
    let off = |(k, texel): (usize, &Texel)| distance(texel, &unpacked(packed, k as u32));
    block.iter().enumerate().map(off).sum()
}

/// Colour and alpha on one line.
fn pack_together(block: &Block) -> [u32; 4] {
    let mut line = Line::fit(block, 15);
    let [first, second] = line.words();
    if first > second {
        line.turn();
    }
    line.packed()
}

/// Colour and alpha on lines of their own.
fn pack_apart(block: &Block) -> [u32; 4] {
    let mut line = Line::fit(&block.map(|[r, g, b, _]| [r, g, b, 0.0]), 3);
    let alpha = Line::fit(&block.map(|[_, _, _, a]| [0.0, 0.0, 0.0, a]), 3);
    for (end, alpha) in line.ends.iter_mut().zip(&alpha.ends) {
        end[3] = alpha[3];
    }
    for (bits, alpha) in line.bits.iter_mut().zip(&alpha.bits) {
        *bits |= alpha << 2;
    }
    let [first, second] = line.words();
    if first < second {
        line.turn();
    }
    line.packed()
}

/// Two colours, and where between them texels are.
struct Line {
    ends: [[u8; 4]; 2],
    bits: [u8; TEXELS],
}

impl Line {
    /// The line through texels that is nearest to them, in `steps` steps.
    fn fit(block: &Block, steps: u8) -> Line {
        let mut ends = spread(block);
        let mut best = Line::between(ends, block, steps);
        for _ in 0..2 {
            ends = least_squares(block, &best.1.bits, steps).unwrap_or(ends);
            let refined = Line::between(ends, block, steps);
            if refined.0 < best.0 {
                best = refined;
            }
        }
        best.1
    }

    /// The line between two places, and how far the texels are from it, squared.
    fn between(ends: [Texel; 2], block: &Block, steps: u8) -> (f32, Line) {
        let ends = ends.map(|end| end.map(|value| value.round().clamp(0.0, 255.0) as u8));
        let [start, end] = ends.map(|end| end.map(f32::from));
        let along: Texel = std::array::from_fn(|c| end[c] - start[c]);
        let length = dot(&along, &along).max(1.0);
        let mut error = 0.0;
        let bits = block.map(|texel| {
            let from: Texel = std::array::from_fn(|c| texel[c] - start[c]);
            let at = (dot(&from, &along) / length * f32::from(steps)).round();
            let at = at.clamp(0.0, f32::from(steps));
            let weight = at / f32::from(steps);
            error += distance(&from, &along.map(|value| value * weight));
            at as u8
        });
        (error, Line { ends, bits })
    }

    fn words(&self) -> [u32; 2] {
        self.ends.map(u32::from_le_bytes)
    }

    /// The same line from its other end: in both forms bits are steps, and turn around.
    fn turn(&mut self) {
        self.ends.swap(0, 1);
        self.bits.iter_mut().for_each(|bits| *bits = 15 - *bits);
    }

    fn packed(&self) -> [u32; 4] {
        let word = |half: &[u8]| {
            let texels = half.iter().enumerate();
            texels.fold(0, |word, (k, &bits)| word | u32::from(bits) << (4 * k))
        };
        let [first, second] = self.words();
        let (low, high) = self.bits.split_at(TEXELS / 2);
        [first, second, word(low), word(high)]
    }
}

fn dot(a: &Texel, b: &Texel) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn distance(a: &Texel, b: &Texel) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// The outermost texels along the direction in which they spread most, as places on that line.
fn spread(block: &Block) -> [Texel; 2] {
    let mean: Texel =
        std::array::from_fn(|c| block.iter().map(|t| t[c]).sum::<f32>() / TEXELS as f32);
    let off = block.map(|texel| -> Texel { std::array::from_fn(|c| texel[c] - mean[c]) });
    let direction = principal(&off);
    let places = off.map(|texel| dot(&texel, &direction));
    let low = places.iter().copied().fold(0.0, f32::min);
    let high = places.iter().copied().fold(0.0, f32::max);
    [low, high].map(|at| std::array::from_fn(|c| mean[c] + direction[c] * at))
}

/// The direction of the largest variance, of length 1; by a power iteration that begins with the
/// texel farthest from the mean.
fn principal(off: &Block) -> Texel {
    let farthest = |a: &&Texel, b: &&Texel| dot(a, a).total_cmp(&dot(b, b));
    let mut direction = off.iter().max_by(farthest).copied().unwrap_or_default();
    for _ in 0..8 {
        let mut next = Texel::default();
        for texel in off {
            let along = dot(texel, &direction);
            for c in 0..4 {
                next[c] += texel[c] * along;
            }
        }
        let length = dot(&next, &next).sqrt();
        if length == 0.0 {
            return Texel::default();
        }
        direction = next.map(|value| value / length);
    }
    direction
}

/// The ends for which the texels at these steps are nearest; none where all are at one.
fn least_squares(block: &Block, bits: &[u8; TEXELS], steps: u8) -> Option<[Texel; 2]> {
    let (mut aa, mut ab, mut bb) = (0.0f32, 0.0f32, 0.0f32);
    let (mut to_a, mut to_b) = (Texel::default(), Texel::default());
    for (texel, &bits) in block.iter().zip(bits) {
        let b = f32::from(bits) / f32::from(steps);
        let a = 1.0 - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        for c in 0..4 {
            to_a[c] += texel[c] * a;
            to_b[c] += texel[c] * b;
        }
    }
    let determinant = aa * bb - ab * ab;
    (determinant > 1e-4).then(|| {
        [
            std::array::from_fn(|c| (to_a[c] * bb - to_b[c] * ab) / determinant),
            std::array::from_fn(|c| (to_b[c] * aa - to_a[c] * ab) / determinant),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(side: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<[u8; 4]> {
        let places = (0..side * side).map(|k| (k % side, k / side));
        places.map(|(x, y)| pixel(x, y)).collect()
    }

    fn texel(words: &[u32], side: u32, x: u32, y: u32) -> Texel {
        let first = block_word(x, y, side) as usize;
        let block: [u32; 4] = words[first..first + 4].try_into().expect("four words");
        unpacked(&block, block_texel(x, y))
    }

    /// Largest error of a channel.
    fn largest(side: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> f32 {
        let texels = image(side, &pixel);
        let words = pack(side, side, &texels).expect("it is packed");
        let off = |k: u32| {
            let (x, y) = (k % side, k / side);
            let (found, exact) = (texel(&words, side, x, y), pixel(x, y).map(f32::from));
            (0..4)
                .map(|c| (found[c] - exact[c]).abs())
                .fold(0.0, f32::max)
        };
        (0..side * side).map(off).fold(0.0, f32::max)
    }

    #[test]
    fn one_colour_and_two_are_exact() {
        assert_eq!(largest(16, |_, _| [13, 200, 77, 255]), 0.0);
        let ends = [[255, 0, 10, 255], [0, 90, 250, 255]];
        assert_eq!(largest(16, |x, y| ends[((x ^ y) & 1) as usize]), 0.0);
        // The larger word first, too, and borders that no block ends at.
        assert_eq!(largest(13, |x, _| ends[((x + 1) & 1) as usize]), 0.0);
    }

    #[test]
    fn gradients_are_off_by_one_step_in_rounding() {
        let ramp = |x: u32, y: u32| {
            let t = x + y;
            [(4 * t) as u8, (255 - 3 * t) as u8, (2 * t) as u8, 255]
        };
        assert!(largest(32, ramp) <= 1.0);
    }

    /// What is cut out has an edge that colour knows nothing of.
    #[test]
    fn alpha_is_free_of_colour() {
        let cut = |x: u32, y: u32| {
            let alpha = if (x * 5 + y * 3) % 7 < 3 { 0 } else { 255 };
            let shade = (x % 4) * 5;
            [60 + shade as u8, 120 - shade as u8, 30, alpha]
        };
        assert!(largest(32, cut) <= 2.0);
        // Alpha that is exactly 0 or 1 stays so: shadows ask for it.
        let words = pack(32, 32, &image(32, cut)).expect("it is packed");
        for k in 0..32 * 32 {
            let (x, y) = (k % 32, k / 32);
            assert_eq!(texel(&words, 32, x, y)[3], f32::from(cut(x, y)[3]));
        }
    }

    #[test]
    fn no_level_is_worse_than_stated() {
        let noise = |strength: u32| {
            move |x: u32, y: u32| {
                let h = (x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663))
                    .wrapping_mul(2_654_435_761);
                h.to_le_bytes()
                    .map(|b| (128 + u32::from(b) * strength / 255) as u8)
            }
        };
        let squares = |words: &[u32], texels: &[[u8; 4]]| {
            let off =
                |k: u32| texel(words, 64, k % 64, k / 64)[0] - f32::from(texels[k as usize][0]);
            (0..64 * 64).map(|k| f64::from(off(k)).powi(2)).sum::<f64>()
        };
        let mild = image(64, noise(12));
        let words = pack(64, 64, &mild).expect("it is mild");
        assert_eq!(words.len() * 4, mild.len());
        assert!((squares(&words, &mild) / 4096.0).sqrt() <= BLOCK_ERROR);
        assert_eq!(pack(64, 64, &image(64, noise(120))), None);
    }

    #[test]
    fn small_levels_stay_as_they_are() {
        let texels = image(2, |_, _| [1; 4]);
        assert_eq!(pack(2, 2, &texels), None);
        assert_eq!(pack(4, 1, &texels), None);
        assert!(pack(5, 5, &image(5, |_, _| [1; 4])).is_some());
    }
}
