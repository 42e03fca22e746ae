use crate::baselines::candidate::Candidate;
use crate::baselines::dataset::{Dataset, Joint};
use crate::baselines::fit::{fit, square_left};
use crate::baselines::memory::memory;

/// Least error of a log as a share of the torque, for logs that are nearly without noise.
const FLOOR: f64 = 1e-4;

/// Least fall of the held-out error that counts, as shares of the torque and of the error before.
const PRACTICAL: f64 = 0.005;
const LEAST_OF_ERROR: f64 = 0.02;

/// Residual of a fit of the chosen columns at one joint.
#[derive(Debug, Clone)]
pub(super) struct Standing {
    /// The columns, each once.
    pub columns: Vec<usize>,
    rank: usize,
    /// Mean square of the residual, with the floor.
    mean: f64,
    /// Number of samples that count as one independent sample.
    memory: f64,
    /// RMS of the held-out residual.
    held_out: f64,
}

/// Effect of a candidate at one joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change {
    /// Evidence for the candidate (nats).
    pub evidence: f64,
    /// Whether its weight is physically possible.
    pub possible: bool,
    /// Gain in log-likelihood on held-out samples, where it is large enough to matter (nats).
    pub gain: f64,
    /// Whether it predicts noticeably worse.
    pub is_worse: bool,
}

/// The joints of some logs, and the two questions about a candidate.
pub(super) struct Competition<'a> {
    dataset: &'a Dataset,
}

impl<'a> Competition<'a> {
    /// A competition over the columns of a dataset.
    pub fn new(dataset: &'a Dataset) -> Self {
        Self { dataset }
    }

    fn joint(&self, j: usize) -> &'a Joint {
        &self.dataset.joints[j]
    }

    /// Indices of the columns of a part.
    pub fn places(&self, (j, shapes): &(usize, Vec<super::shape::Shape>)) -> Vec<usize> {
        let all = &self.joint(*j).shapes;
        shapes.iter().filter_map(|shape| all.iter().position(|other| other == shape)).collect()
    }

    /// `columns`, and the columns of `places` that are not among them.
    pub fn union(columns: &[usize], places: &[usize]) -> Vec<usize> {
        let new = places.iter().filter(|place| !columns.contains(place));
        columns.iter().chain(new).copied().collect()
    }

    /// The residual after some columns at joint `j`.
    pub fn standing(&self, j: usize, columns: Vec<usize>) -> Standing {
        let joint = self.joint(j);
        let fitted = fit(&joint.total, &columns, joint.target());
        let left = joint.residual_of(&columns, &fitted.weights);
        Standing {
            rank: fitted.rank,
            mean: self.mean(j, fitted.square),
            memory: memory(&left, &self.dataset.runs),
            held_out: self.held_out_rms(j, &columns),
            columns,
        }
    }

    fn floor(&self, j: usize) -> f64 {
        (FLOOR * self.joint(j).torque_rms).powi(2) + f64::MIN_POSITIVE
    }

    fn mean(&self, j: usize, square: f64) -> f64 {
        square / self.joint(j).samples.max(1) as f64 + self.floor(j)
    }

    /// RMS of the residual of some columns, on samples outside the fit of their weights.
    fn held_out_rms(&self, j: usize, columns: &[usize]) -> f64 {
        let joint = self.joint(j);
        let residual_square = |[learned, held]: &[faer::Mat<f64>; 2]| {
            let weights = fit(learned, columns, joint.target()).weights;
            square_left(held, columns, &weights, joint.target())
        };
        (joint.folds.iter().map(residual_square).sum::<f64>() / joint.samples.max(1) as f64).sqrt()
    }

    /// Evidence for the columns of `with` over those of `without`, where `memory` samples count as one:
    ///
    /// ```text
    /// g = n / 2 log(mean without / mean with) - (rank with - rank without) / 2 log(n)
    /// n = samples / memory
    /// ```
    fn evidence(&self, j: usize, memory: f64, means: [f64; 2], more: f64) -> f64 {
        let count = (self.joint(j).samples as f64 / memory).max(1.0);
        0.5 * count * (means[0] / means[1]).ln() - 0.5 * more * count.ln()
    }

    /// The first question: does the log prefer the effort with the candidate's columns?
    pub fn ask(&self, candidate: &Candidate, part: usize, standing: &Standing) -> Change {
        let of = &candidate.parts[part];
        let (j, places) = (of.0, self.places(of));
        let joint = self.joint(j);
        let columns = Self::union(&standing.columns, &places);
        let fitted = fit(&joint.total, &columns, joint.target());
        let more = fitted.rank as f64 - standing.rank as f64;
        let nothing = Change { evidence: 0.0, possible: true, gain: 0.0, is_worse: false };
        if columns.len() == standing.columns.len() || more <= 0.0 {
            return nothing;
        }
        let first = columns.iter().position(|column| places.first() == Some(column));
        let weight = first.map_or(0.0, |at| fitted.weights[at] / joint.scales[columns[at]]);
        let possible = candidate.least.is_none_or(|(at, least)| at != j || weight >= least);
        let means = [standing.mean, self.mean(j, fitted.square)];
        // With every sample for itself it is at its largest: most candidates end here.
        let at_most = self.evidence(j, 1.0, means, 0.0);
        let memory = match possible && at_most > 1.0 {
            true => memory(&joint.residual_of(&columns, &fitted.weights), &self.dataset.runs),
            false => 1.0,
        };
        Change { evidence: self.evidence(j, memory, means, more), possible, ..nothing }
    }

    /// The second question: do the names predict held-out samples better with the candidate?
    pub fn predict(&self, candidate: &Candidate, part: usize, standing: &Standing) -> Change {
        let of = &candidate.parts[part];
        let (j, joint) = (of.0, self.joint(of.0));
        let columns = Self::union(&standing.columns, &self.places(of));
        let (before, after) = (standing.held_out, self.held_out_rms(j, &columns));
        let least = (PRACTICAL * joint.torque_rms).max(LEAST_OF_ERROR * before);
        let gain = match before - after > least {
            true => {
                let [before, after] = [before, after].map(|e| e * e + self.floor(j));
                0.5 * joint.samples as f64 * (before / after).ln()
            }
            false => 0.0,
        };
        let is_worse = after - before > PRACTICAL * joint.torque_rms;
        Change { evidence: 0.0, possible: true, gain, is_worse }
    }

    /// Evidence that is lost when joint `j` keeps only the columns of `rest` (nats).
    pub fn loss(&self, j: usize, standing: &Standing, rest: &[usize]) -> f64 {
        let joint = self.joint(j);
        let fitted = fit(&joint.total, rest, joint.target());
        let means = [self.mean(j, fitted.square), standing.mean];
        self.evidence(j, standing.memory, means, standing.rank as f64 - fitted.rank as f64)
    }
}
