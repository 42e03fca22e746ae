use dynamics::add_gram;
use faer::{MatMut, MatRef};
use nalgebra::{DMatrix, DVector};

/// Most blocks that are kept; beyond it, neighbours are merged.
const MOST_BLOCKS: usize = 64;

/// Samples in a block before the first merger.
const FIRST_LENGTH: usize = 16;

/// Sums over the samples of one joint, for `X` the columns that it sees: the lower triangle of
///
/// ```text
/// [X tau]' [X tau] = [ X'X        .       ]
///                    [ tau'X      tau'tau ]
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JointSums(DMatrix<f64>);

impl JointSums {
    /// The sums over rows `[x tau]` of `width` numbers each, row-major.
    pub fn of(rows: &[f64], width: usize) -> Self {
        let mut sums = DMatrix::zeros(width, width);
        let x = MatRef::from_row_major_slice(rows, rows.len() / width, width);
        add_gram(MatMut::from_column_major_slice_mut(sums.as_mut_slice(), width, width), x);
        Self(sums)
    }

    fn columns(&self) -> usize {
        self.0.nrows() - 1
    }

    /// `X'X`.
    pub fn gram(&self) -> DMatrix<f64> {
        let n = self.columns();
        let mut gram = self.0.view((0, 0), (n, n)).into_owned();
        gram.fill_upper_triangle_with_lower_triangle();
        gram
    }

    /// `X'tau`.
    pub fn rhs(&self) -> DVector<f64> {
        let n = self.columns();
        self.0.view((n, 0), (1, n)).row(0).transpose()
    }

    /// `tau'tau`.
    pub fn square(&self) -> f64 {
        self.0[(self.columns(), self.columns())]
    }

    /// `X' (tau - X w)`.
    pub fn score(&self, w: &DVector<f64>) -> DVector<f64> {
        let mut score = self.rhs();
        score -= self.gram() * w;
        score
    }
}

/// Sums over consecutive samples, one entry a joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sums {
    /// Number of samples.
    pub samples: usize,
    /// The sums of every joint.
    pub joints: Vec<JointSums>,
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.samples += other.samples;
        self.joints.iter_mut().zip(&other.joints).for_each(|(sum, more)| sum.0 += &more.0);
    }
}

/// Sums over blocks of consecutive samples, all of one length but the last: between 32 and 64 of
/// them for a record of any length. The spread from block to block shows the correlation time of
/// the noise.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BlockSums {
    blocks: Vec<Sums>,
    length: usize,
}

impl BlockSums {
    /// No block yet.
    pub fn new() -> Self {
        Self { blocks: Vec::new(), length: FIRST_LENGTH }
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.blocks.iter().map(|block| block.samples).sum()
    }

    /// The next sample after `sample` at which pushed samples must be cut, so that each block gets
    /// its own.
    pub fn cut_after(&self, sample: usize) -> usize {
        (sample / self.length + 1) * self.length
    }

    /// Appends the sums of the next samples, cut where [`BlockSums::cut_after`] says.
    pub fn push(&mut self, next: Sums) {
        match self.blocks.last_mut().filter(|last| last.samples < self.length) {
            Some(last) => last.add(&next),
            None => {
                if self.blocks.len() == MOST_BLOCKS {
                    self.merge_neighbours();
                }
                self.blocks.push(next);
            }
        }
    }

    fn merge_neighbours(&mut self) {
        self.length *= 2;
        let pairs = self.blocks.chunks(2).map(total);
        self.blocks = pairs.collect();
    }

    /// The blocks, in the order of time.
    pub fn blocks(&self) -> &[Sums] {
        &self.blocks
    }

    /// The sums over all samples, `None` when there are none.
    pub fn total(&self) -> Option<Sums> {
        (!self.blocks.is_empty()).then(|| total(&self.blocks))
    }
}

/// The sum of at least one block.
fn total(blocks: &[Sums]) -> Sums {
    let mut sum = blocks[0].clone();
    blocks[1..].iter().for_each(|block| sum.add(block));
    sum
}
