use effects::{Column, Frame, Hypothesis, Motion};
use logs::{LogError, LowPass, PreparedJoint, PreparedRun, decimate};
use nalgebra::DMatrix;
use rayon::prelude::*;
use robot::Robot;

use crate::design::{JointDesign, RunDesign};

/// Rate at which effects are evaluated, in cut-off frequencies: the harmonics that a sign
/// or a product makes of a signal limited to the cut-off stay far from folding into the band.
const EVALUATION_RATE: f64 = 16.0;

/// Rate of the regression, in cut-off frequencies: just above twice the band.
const REGRESSION_RATE: f64 = 2.5;

/// Order of the low-pass filter, before it runs forward and backward.
const ORDER: usize = 4;

/// All columns of one run and the effort, low-passed alike and at the rate of the regression.
pub(crate) struct Evaluated {
    /// `[hypothesis][weight]`.
    pub columns: Vec<Vec<Column>>,
    /// Rate of the samples (Hz).
    pub rate_hz: f64,
    name: String,
    time: Vec<f64>,
    measured: Vec<Vec<f64>>,
    nominal: Vec<Vec<f64>>,
    state: [Vec<Vec<f64>>; 3],
}

impl Evaluated {
    /// Evaluates `hypotheses` about `robot` along `run`.
    ///
    /// Every signal passes the same filter: effort, nominal effort and columns.
    pub fn new(
        robot: &Robot,
        frame: &Frame,
        run: &PreparedRun,
        cutoff_hz: f64,
        hypotheses: &[Hypothesis],
    ) -> Result<Self, LogError> {
        let first = stride(run.rate_hz, EVALUATION_RATE * cutoff_hz);
        let rate = run.rate_hz / first as f64;
        let second = stride(rate, REGRESSION_RATE * cutoff_hz);
        let parallel = LowPass::new(ORDER, cutoff_hz, rate)?;
        let finish = |mut x: Vec<f64>| {
            parallel.apply(&mut x);
            decimate(&x, second)
        };
        let signals = |pick: fn(&PreparedJoint) -> &Vec<f64>| -> Vec<Vec<f64>> {
            run.joints.iter().map(|j| decimate(pick(j), first)).collect()
        };
        let state = [signals(|j| &j.q), signals(|j| &j.qd), signals(|j| &j.qdd)];
        let motion = Motion::new(robot, frame, state, &signals(|j| &j.qd_wide), rate.recip());
        let filtered = |mut column: Column| {
            column.iter_mut().for_each(|p| p.values = finish(std::mem::take(&mut p.values)));
            column
        };
        let columns = |h: &Hypothesis| h.columns(&motion).into_iter().map(filtered).collect();
        let measured = efforts(run, cutoff_hz, first)?.into_iter().map(finish).collect();
        Ok(Self {
            columns: hypotheses.par_iter().map(columns).collect(),
            rate_hz: rate / second as f64,
            name: run.name.clone(),
            time: decimate(&decimate(&run.time, first), second),
            measured,
            nominal: motion.effort.iter().map(|e| finish(e.clone())).collect(),
            state: [&motion.q, &motion.qd, &motion.qdd]
                .map(|s| s.iter().map(|x| decimate(x, second)).collect()),
        })
    }

    /// The columns sorted into one matrix a joint: `local[j]` are the columns that reach
    /// joint j, `origins` the hypothesis and weight of every column.
    pub fn to_run(&self, local: &[Vec<usize>], origins: &[(usize, usize)]) -> RunDesign {
        let joint = |j: usize| {
            let mut x = DMatrix::zeros(self.time.len(), local[j].len());
            for (k, &index) in local[j].iter().enumerate() {
                let (h, weight) = origins[index];
                let parts = self.columns[h][weight].iter().filter(|p| p.joint == j);
                parts.for_each(|p| x.column_mut(k).copy_from_slice(&p.values));
            }
            JointDesign {
                x,
                measured: self.measured[j].clone(),
                nominal: self.nominal[j].clone(),
                state: [0, 1, 2].map(|s| self.state[s][j].clone()),
            }
        };
        let joints = (0..local.len()).map(joint).collect();
        RunDesign { name: self.name.clone(), time: self.time.clone(), joints }
    }
}

/// The efforts at the evaluation rate. Where that is below the log's, noise is kept from
/// folding into the band by a filter that leaves the band itself alone (1e-5 at the cut-off).
fn efforts(run: &PreparedRun, cutoff_hz: f64, stride: usize) -> Result<Vec<Vec<f64>>, LogError> {
    let mut efforts: Vec<_> = run.joints.iter().map(|j| j.effort.clone()).collect();
    if stride > 1 {
        let filter = LowPass::new(ORDER, 4.0 * cutoff_hz, run.rate_hz)?;
        efforts.par_iter_mut().for_each(|e| {
            filter.apply(e);
            *e = decimate(e, stride);
        });
    }
    Ok(efforts)
}

fn stride(rate: f64, wanted: f64) -> usize {
    ((rate / wanted) as usize).max(1)
}
