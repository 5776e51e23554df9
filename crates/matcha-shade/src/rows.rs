//! A matrix of f32 with a row a component and a column a point.

use bytemuck::{Pod, Zeroable};

/// Points a 64-byte line holds.
const LINE: usize = 16;

#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Line([f32; LINE]);

/// Rows × points, structure of arrays. Each row starts on a cache line and has room for
/// the points rounded up to 16; what lies in that padding has no meaning.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    lines: Vec<Line>,
    rows: usize,
    points: usize,
    lines_per_row: usize,
}

impl Rows {
    /// A matrix of zeros.
    pub fn new(rows: usize, points: usize) -> Self {
        let mut matrix = Rows::default();
        matrix.resize(rows, points);
        matrix
    }

    /// Changes the shape; memory is kept and grows only. The contents afterwards have
    /// no meaning.
    pub fn resize(&mut self, rows: usize, points: usize) {
        // An odd number of lines, so that equal columns of neighbouring rows do not
        // fall into the same set of the first-level cache.
        self.lines_per_row = points.div_ceil(LINE) | 1;
        self.rows = rows;
        self.points = points;
        let lines = rows * self.lines_per_row;
        if self.lines.len() < lines {
            self.lines.resize(lines, Line([0.0; LINE]));
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Numbers from one row's start to the next one's: a multiple of 16, at least
    /// [`Rows::points`].
    pub fn stride(&self) -> usize {
        self.lines_per_row * LINE
    }

    /// A row with its padding, [`Rows::stride`] long.
    pub fn row(&self, row: usize) -> &[f32] {
        assert!(row < self.rows, "row {row} of {}", self.rows);
        bytemuck::cast_slice(&self.lines[row * self.lines_per_row..][..self.lines_per_row])
    }

    /// A row with its padding, to write.
    pub fn row_mut(&mut self, row: usize) -> &mut [f32] {
        assert!(row < self.rows, "row {row} of {}", self.rows);
        bytemuck::cast_slice_mut(&mut self.lines[row * self.lines_per_row..][..self.lines_per_row])
    }

    /// `count` rows from `first` on, to write at once.
    pub fn rows_mut(&mut self, first: usize, count: usize) -> impl Iterator<Item = &mut [f32]> {
        assert!(
            first + count <= self.rows,
            "rows {first}+{count} of {}",
            self.rows
        );
        self.lines[first * self.lines_per_row..][..count * self.lines_per_row]
            .chunks_exact_mut(self.lines_per_row)
            .map(bytemuck::cast_slice_mut)
    }

    /// One number.
    pub fn get(&self, row: usize, point: usize) -> f32 {
        self.row(row)[point]
    }

    /// Sets one number.
    pub fn set(&mut self, row: usize, point: usize, value: f32) {
        self.row_mut(row)[point] = value;
    }
}
