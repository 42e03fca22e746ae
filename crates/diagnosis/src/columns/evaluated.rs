use effects::{Column, Hypothesis};
use logs::LogError;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::columns::run_design::{JointDesign, RunDesign};
use crate::signals::along::{Along, less};
use crate::signals::look::Look;

/// All columns of one run and the effort, low-passed alike and at the rate of the regression.
pub(crate) struct Evaluated {
    /// `[hypothesis][weight]`.
    pub columns: Vec<Vec<Column>>,
    /// Rate of the samples (Hz).
    pub rate_hz: f64,
    name: String,
    time: Vec<f64>,
    measured: Vec<Vec<f64>>,
    known: Vec<Vec<f64>>,
    nominal: Vec<Vec<f64>>,
    state: [Vec<Vec<f64>>; 3],
    tells: Vec<Vec<bool>>,
    slides: Vec<Vec<bool>>,
}

impl Evaluated {
    /// Evaluates `hypotheses` along a run.
    ///
    /// Every signal passes the same filter: what is measured, the same of the nominal robot, and
    /// columns.
    pub fn new(along: &Along, hypotheses: &[Hypothesis], look: Look) -> Result<Self, LogError> {
        let motion = &along.motion;
        let joints = motion.effort.len();
        let columns = |h: &Hypothesis| match look {
            Look::Effort => along.finished(h.columns(motion)),
            Look::Twist => along.finished(h.twist(motion)),
        };
        let nominal: Vec<Vec<f64>> = match look {
            Look::Effort => along.expected(),
            Look::Twist => (0..joints).map(|j| along.finish(j, motion.twist(j))).collect(),
        };
        let (measured, known) = match look {
            Look::Effort => {
                let measured = along.measured()?;
                let known = along.known(&less(&measured, &nominal))?;
                (measured, known)
            }
            Look::Twist => (along.twists()?, vec![Vec::new(); joints]),
        };
        let time = along.time();
        let tells = |j: usize| match look {
            Look::Effort => along.tells(j),
            Look::Twist => vec![true; time.len()],
        };
        Ok(Self {
            columns: hypotheses.par_iter().map(columns).collect(),
            rate_hz: along.rate_hz,
            name: along.name().to_owned(),
            measured,
            known,
            nominal,
            state: [&motion.q, &motion.qd, &motion.qdd].map(|s| along.thin(s)),
            tells: (0..joints).map(tells).collect(),
            slides: (0..joints).map(|j| along.slides(j)).collect(),
            time,
        })
    }

    /// Counts the efforts from those of the robot as it was `described`: by how much the robot
    /// itself differs is known.
    pub fn measure_from(&mut self, described: &Along) {
        for (j, effort) in described.motion.effort.iter().enumerate() {
            let effort = described.finish(j, effort.clone());
            self.known[j].resize(effort.len(), 0.0);
            let own = self.known[j].iter_mut().zip(&self.nominal[j]);
            own.zip(&effort).for_each(|((known, own), effort)| *known += own - effort);
            self.nominal[j] = effort;
        }
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
                known: self.known[j].clone(),
                nominal: self.nominal[j].clone(),
                state: [0, 1, 2].map(|s| self.state[s][j].clone()),
                tells: self.tells[j].clone(),
                slides: self.slides[j].clone(),
            }
        };
        let joints = (0..local.len()).map(joint).collect();
        RunDesign { name: self.name.clone(), time: self.time.clone(), joints }
    }
}
