use effects::{EffectColumn, Hypothesis};
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::columns::readings::Readings;
use crate::columns::run_design::{JointDesign, RunDesign};
use crate::signals::along::{Along, minus};
use crate::signals::response::Response;

/// All columns of one run and the effort, low-passed alike, at the rate of the regression.
pub(crate) struct Evaluated {
    /// `[hypothesis][weight]`.
    pub columns: Vec<Vec<EffectColumn>>,
    /// Rate of the samples (Hz).
    pub rate_hz: f64,
    name: String,
    time: Vec<f64>,
    readings: Readings,
    known: Vec<Vec<f64>>,
    nominal: Vec<Vec<f64>>,
    state: [Vec<Vec<f64>>; 3],
}

impl Evaluated {
    /// Evaluates `hypotheses` along a run.
    /// Measured effort, effort of the nominal robot and columns pass the same filter.
    /// columns.
    pub fn new(
        along: &Along,
        readings: Readings,
        hypotheses: &[Hypothesis],
        response: Response,
    ) -> Self {
        let motion = &along.motion;
        let joints = motion.effort.len();
        let columns = |h: &Hypothesis| match response {
            Response::Effort => along.finish_columns(h.columns(motion)),
            Response::Twist => along.finish_columns(h.twist(motion)),
        };
        let nominal: Vec<Vec<f64>> = match response {
            Response::Effort => along.expected_effort(),
            Response::Twist => (0..joints).map(|j| along.finish(j, motion.twist(j))).collect(),
        };
        let known = match response {
            Response::Effort => along.known_effort(&minus(&readings.measured, &nominal)),
            Response::Twist => vec![Vec::new(); joints],
        };
        Self {
            columns: hypotheses.par_iter().map(columns).collect(),
            rate_hz: along.rate_hz,
            name: along.name().to_owned(),
            time: along.time(),
            readings,
            known,
            nominal,
            state: [&motion.q, &motion.qd, &motion.qdd].map(|s| along.thin(s)),
        }
    }

    /// Compares the efforts with those of the robot as it was `described`. The difference between the two robots
    /// counts as explained already.
    pub fn measure_from(&mut self, described: &Along) {
        for (j, effort) in described.motion.effort.iter().enumerate() {
            let effort = described.finish(j, effort.clone());
            self.known[j].resize(effort.len(), 0.0);
            let own = self.known[j].iter_mut().zip(&self.nominal[j]);
            own.zip(&effort).for_each(|((known, own), effort)| *known += own - effort);
            self.nominal[j] = effort;
        }
    }

    /// The columns sorted into one matrix a joint. `local[j]` are the columns that reach joint j, `origins` the
    /// hypothesis and weight of every column.
    pub fn into_run(self, local: &[Vec<usize>], origins: &[(usize, usize)]) -> RunDesign {
        let Self { columns, name, time, readings, known, nominal, state, .. } = self;
        let matrix = |j: usize| {
            let mut x = DMatrix::zeros(time.len(), local[j].len());
            for (k, &index) in local[j].iter().enumerate() {
                let (h, weight) = origins[index];
                let parts = columns[h][weight].iter().filter(|p| p.joint == j);
                parts.for_each(|p| x.column_mut(k).copy_from_slice(&p.values));
            }
            x
        };
        let Readings { measured, is_informative, slides } = readings;
        let [q, qd, qdd] = state;
        let states = q.into_iter().zip(qd).zip(qdd);
        let marks = is_informative.into_iter().zip(slides);
        let efforts = measured.into_iter().zip(known).zip(nominal);
        let joint =
            |(j, ((((measured, known), nominal), ((q, qd), qdd)), (is_informative, slides)))| {
                let state = [q, qd, qdd];
                JointDesign {
                    x: matrix(j),
                    measured,
                    known,
                    nominal,
                    state,
                    is_informative,
                    slides,
                }
            };
        let joints = efforts.zip(states).zip(marks).enumerate().map(joint).collect();
        RunDesign { name, time, joints }
    }
}
