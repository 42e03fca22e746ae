use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::columns::common::CommonPart;
use crate::columns::design::Design;
use crate::columns::stratum::Stratum;
use crate::regression::blocks::Block;

/// Sufficient statistics of one joint in one block: with `X` its local columns and `y` its
/// residual,
///
/// ```text
/// xx = X' X,  xy = X' y,  yy = y' y
/// ```
#[derive(Debug, Clone)]
pub(crate) struct JointGram {
    pub xx: DMatrix<f64>,
    pub xy: DVector<f64>,
    pub yy: f64,
    /// Number of samples.
    pub count: usize,
}

impl JointGram {
    fn empty(width: usize) -> Self {
        Self { xx: DMatrix::zeros(width, width), xy: DVector::zeros(width), yy: 0.0, count: 0 }
    }

    fn add(&mut self, other: &Self) {
        self.xx += &other.xx;
        self.xy += &other.xy;
        self.yy += other.yy;
        self.count += other.count;
    }

    /// Sum of squares after the local weights `w`, each with its index: `yy - 2 w' xy + w' xx w`.
    pub fn remaining(&self, w: &[(usize, f64)]) -> f64 {
        let reduction = |&(i, wi): &(usize, f64)| {
            let column = self.xx.column(i);
            wi * (2.0 * self.xy[i] - w.iter().map(|&(k, wk)| column[k] * wk).sum::<f64>())
        };
        (self.yy - w.iter().map(reduction).sum::<f64>()).max(0.0)
    }

    /// `X' (y - X w)`.
    fn score(&self, w: &[(usize, f64)]) -> DVector<f64> {
        let mut score = self.xy.clone();
        w.iter().for_each(|&(k, wk)| score.axpy(-wk, &self.xx.column(k), 1.0));
        score
    }
}

/// Sufficient statistics of every block, `[block][stratum]`.
#[derive(Debug, Clone)]
pub(crate) struct Grams {
    blocks: Vec<Vec<JointGram>>,
    local: Vec<Vec<usize>>,
    width: usize,
    common: Option<CommonPart>,
}

/// The statistics of all joints, weighted and summed: the normal equations.
#[derive(Debug, Clone)]
pub(crate) struct Information {
    /// `sum_j c_j X_j' X_j`.
    pub h: DMatrix<f64>,
    /// `sum_j c_j X_j' y_j`.
    pub g: DVector<f64>,
    /// `sum_j c_j y_j' y_j`.
    pub yy: f64,
}

impl Information {
    /// Weighted sum of squares after the weights `w`: `yy - 2 w' g + w' H w`.
    pub fn deviance(&self, w: &[f64]) -> f64 {
        let w = DVector::from_column_slice(w);
        self.yy - 2.0 * w.dot(&self.g) + w.dot(&(&self.h * &w))
    }
}

impl Grams {
    /// One pass over the design.
    pub fn new(design: &Design, blocks: &[Block]) -> Self {
        let stratum = |block: &Block, s: Stratum| {
            let signals = &design.runs[block.run].joints[s.joint()];
            let is_of = |t: &usize| signals.stratum(s.joint(), *t) == Some(s);
            let own: Vec<usize> = block.samples.clone().filter(is_of).collect();
            let y =
                signals.residual().enumerate().skip(block.samples.start).take(block.samples.len());
            let y = y.filter(|(t, _)| is_of(t)).map(|(_, y)| y);
            let y = DVector::from_iterator(own.len(), y);
            let x = signals.x.select_rows(&own);
            let xt = x.transpose();
            JointGram { xx: &xt * &x, xy: &xt * &y, yy: y.norm_squared(), count: y.len() }
        };
        let all =
            |block: &Block| Stratum::all(design.joints()).map(|s| stratum(block, s)).collect();
        Self {
            blocks: blocks.par_iter().map(all).collect(),
            local: design.local.clone(),
            width: design.width,
            common: design.common.clone(),
        }
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.local.len()
    }

    /// The statistics of a stratum over the blocks `of`.
    pub fn stratum(&self, s: Stratum, of: &[usize]) -> JointGram {
        let mut sum = JointGram::empty(self.local[s.joint()].len());
        of.iter().for_each(|&b| sum.add(&self.blocks[b][s.index()]));
        sum
    }

    /// The statistics of every stratum over the blocks `of`.
    pub fn sums(&self, of: &[usize]) -> Vec<JointGram> {
        Stratum::all(self.joints()).map(|s| self.stratum(s, of)).collect()
    }

    /// The normal equations over the blocks `of`, stratum `s` with weight `weight[s]`, and those of other logs for what
    /// they have in common.
    pub fn information(&self, of: &[usize], weight: &[f64]) -> Information {
        self.weigh(&self.sums(of), weight)
    }

    /// The same from the statistics of every stratum.
    pub fn weigh(&self, sums: &[JointGram], weight: &[f64]) -> Information {
        let mut own = self.weigh_own(sums, weight);
        if let Some(CommonPart { columns, of_others }) = &self.common {
            let (first, count) = (columns.start, columns.len());
            let mut h = own.h.view_mut((first, first), (count, count));
            h += &of_others.h;
            let mut g = own.g.rows_mut(first, count);
            g += &of_others.g;
            own.yy += of_others.yy;
        }
        own
    }

    /// The normal equations over the blocks `of` alone.
    pub fn own_information(&self, of: &[usize], weight: &[f64]) -> Information {
        self.weigh_own(&self.sums(of), weight)
    }

    fn weigh_own(&self, sums: &[JointGram], weight: &[f64]) -> Information {
        let (mut h, mut g) = (DMatrix::zeros(self.width, self.width), DVector::zeros(self.width));
        let mut yy = 0.0;
        for (s, &c) in Stratum::all(self.joints()).zip(weight).filter(|(_, c)| **c > 0.0) {
            let (j, sum) = (s.joint(), &sums[s.index()]);
            yy += c * sum.yy;
            for (a, &row) in self.local[j].iter().enumerate() {
                g[row] += c * sum.xy[a];
                for (b, &column) in self.local[j].iter().enumerate() {
                    h[(row, column)] += c * sum.xx[(a, b)];
                }
            }
        }
        Information { h, g, yy }
    }

    /// `sum_j c_j X_j' (y_j - X_j w)` of one block.
    pub fn score(&self, block: usize, weight: &[f64], w: &[f64]) -> DVector<f64> {
        let mut score = DVector::zeros(self.width);
        for (s, &c) in Stratum::all(self.joints()).zip(weight).filter(|(_, c)| **c > 0.0) {
            let j = s.joint();
            let local = self.local(j, w);
            let part = self.blocks[block][s.index()].score(&local);
            self.local[j].iter().zip(part.iter()).for_each(|(&k, s)| score[k] += c * s);
        }
        score
    }

    /// The non-zero weights at joint `j` with their indices. A model has few of the joint's columns.
    pub fn local(&self, j: usize, w: &[f64]) -> Vec<(usize, f64)> {
        let all = self.local[j].iter().map(|&k| w[k]).enumerate();
        all.filter(|(_, w)| w.abs() > 0.0).collect()
    }

    /// Sum of squares of a block after `w`, stratum `s` with weight `weight[s]`.
    pub fn deviance(&self, block: usize, weight: &[f64], w: &[f64]) -> f64 {
        let of = |(s, weight): (Stratum, &f64)| {
            weight * self.blocks[block][s.index()].remaining(&self.local(s.joint(), w))
        };
        Stratum::all(self.joints()).zip(weight).map(of).sum()
    }
}
