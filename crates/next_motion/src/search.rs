use std::path::Path;

use effects::{Frame, RunMotion as Along};
use logs::LogError;
use motion::{Motion, MotionSpec};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use robot::Robot;

use crate::aim::Aim;
use crate::error::NextMotionError;
use crate::information::{ColumnInformation, ColumnLayout};
use crate::limits::Usable;
use crate::motion_record::{EVALUATION_RATE, MotionRecord};
use crate::steps::Steps;

/// Motions drawn at random.
const DRAWS: u64 = 64;
/// The best of them, which are improved.
const STARTS: usize = 8;
/// Changes tried on each.
const CHANGES: usize = 120;

/// Share of its worth that a motion must keep when a joint is put to rest.
const CALM: f64 = 0.95;

/// Stretches that a motion is divided into; the most informative one is not counted.
const STRETCHES: usize = 5;

/// Rate at which motions are compared, in cut-off frequencies.
const SEARCH_RATE: f64 = 8.0;

/// Share of a cause below which a model counts as imitating it: what rounding leaves.
const UNLIKE: f64 = 1e-6;

/// The robot, the limits and the settings of a search.
#[derive(Debug)]
pub(crate) struct Search<'a> {
    pub robot: &'a Robot,
    pub layout: &'a ColumnLayout,
    pub frame: &'a Frame,
    pub usable: &'a [Usable],
    pub duration_s: f64,
    pub seed: u64,
}

/// A motion and its information.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    steps: Steps,
    pub spec: MotionSpec,
    pub motion: Motion,
    feasibility: Feasibility,
}

/// Whether a motion can be run, and the information that it then gives.
#[derive(Debug, Clone)]
enum Feasibility {
    /// Largest effort over what is usable.
    TooHeavy(f64),
    /// Information of the whole motion and of its stretches.
    Feasible { whole: Box<ColumnInformation>, stretches: Vec<ColumnInformation> },
}

impl Candidate {
    /// The smallest number of nats over all aims. A motion that cannot be run has minus its largest
    /// effort over the usable one.
    fn worth(&self, aims: &[&Aim]) -> f64 {
        match &self.feasibility {
            Feasibility::TooHeavy(share) => -share,
            Feasibility::Feasible { whole, stretches } => {
                let nats = aims.iter().map(|aim| aim.nats_without_best_stretch(whole, stretches));
                nats.fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// Largest effort over what is usable, 0 where it is not above.
    fn heaviest(&self) -> f64 {
        match self.feasibility {
            Feasibility::TooHeavy(share) => share,
            Feasibility::Feasible { .. } => 0.0,
        }
    }

    /// Its information, if it can be run.
    fn information(&self) -> Option<&ColumnInformation> {
        match &self.feasibility {
            Feasibility::TooHeavy(_) => None,
            Feasibility::Feasible { whole, .. } => Some(whole),
        }
    }
}

impl Search<'_> {
    /// Random motions, of which one at least can be run.
    pub fn draw(&self) -> Result<Vec<Candidate>, NextMotionError> {
        let one = |k: u64| {
            let steps = Steps::draw(self.usable.len(), self.duration_s, &mut self.rng(k));
            self.candidate(steps)
        };
        let drawn: Result<Vec<Candidate>, _> = (0..DRAWS).into_par_iter().map(one).collect();
        let drawn = drawn?;
        let share = drawn.iter().map(Candidate::heaviest).fold(f64::INFINITY, f64::min);
        if share > 1.0 { Err(NextMotionError::TooHeavy { share }) } else { Ok(drawn) }
    }

    /// The aims that some of the motions reach.
    pub fn within_reach<'b>(&self, aims: &'b [Aim<'b>], drawn: &[Candidate]) -> Vec<&'b Aim<'b>> {
        let reaches = |aim: &&Aim| {
            drawn
                .iter()
                .filter_map(Candidate::information)
                .any(|i| aim.unimitated_share(i) > UNLIKE)
        };
        aims.iter().filter(reaches).collect()
    }

    /// The information of a motion at the rate of the diagnosis.
    pub fn information_of(&self, motion: &Motion) -> Result<Option<ColumnInformation>, LogError> {
        let along = self.along(motion, EVALUATION_RATE);
        Ok(ColumnInformation::sum(&self.layout.information_along(&along, None, 1)?))
    }

    fn along(&self, motion: &Motion, rate: f64) -> Along {
        let rate_hz = rate * self.layout.cutoff_hz;
        MotionRecord::of_motion(motion, rate_hz).evaluate(self.robot, self.frame)
    }

    /// Improves the best of the drawn motions, and returns the best result.
    pub fn improve(
        &self,
        aims: &[&Aim],
        drawn: Vec<Candidate>,
    ) -> Result<Option<Candidate>, NextMotionError> {
        let mut starts: Vec<(f64, Candidate)> =
            drawn.into_iter().map(|c| (c.worth(aims), c)).collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0));
        starts.truncate(STARTS);
        let climbed: Result<Vec<(f64, Candidate)>, NextMotionError> = starts
            .into_par_iter()
            .enumerate()
            .map(|(k, (worth, start))| self.climb(aims, worth, start, DRAWS + k as u64))
            .collect();
        // The first of equals, so that the order of the threads is no part of the answer.
        let best = climbed?.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
        best.map(|(worth, best)| self.rest_needless_joints(aims, worth, best)).transpose()
    }

    /// The same motion, with every joint at rest whose movement is not needed.
    fn rest_needless_joints(
        &self,
        aims: &[&Aim],
        worth: f64,
        mut best: Candidate,
    ) -> Result<Candidate, NextMotionError> {
        for joint in 0..self.usable.len() {
            let calmer = self.candidate(best.steps.with_joint_at_rest(joint))?;
            if calmer.worth(aims) > CALM * worth {
                best = calmer;
            }
        }
        Ok(best)
    }

    fn climb(
        &self,
        aims: &[&Aim],
        mut worth: f64,
        mut best: Candidate,
        stream: u64,
    ) -> Result<(f64, Candidate), NextMotionError> {
        let mut rng = self.rng(stream);
        for _ in 0..CHANGES {
            let next = self.candidate(best.steps.vary_one_move(&mut rng))?;
            let found = next.worth(aims);
            if found > worth {
                (worth, best) = (found, next);
            }
        }
        Ok((worth, best))
    }

    fn rng(&self, stream: u64) -> ChaCha8Rng {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        rng.set_stream(stream);
        rng
    }

    fn candidate(&self, steps: Steps) -> Result<Candidate, NextMotionError> {
        let spec = steps.spec(self.robot, self.usable, self.duration_s);
        let motion = spec.build(self.robot, Path::new("."))?;
        let feasibility = self.feasibility(&motion)?;
        Ok(Candidate { steps, spec, motion, feasibility })
    }

    fn feasibility(&self, motion: &Motion) -> Result<Feasibility, LogError> {
        let along = self.along(motion, SEARCH_RATE);
        let share = |(torque, usable): (&Vec<f64>, &Usable)| {
            torque.iter().fold(0.0, |m: f64, t| m.max(t.abs())) / usable.effort
        };
        let heaviest = along.torque.iter().zip(self.usable).map(share).fold(0.0, f64::max);
        if heaviest > 1.0 {
            return Ok(Feasibility::TooHeavy(heaviest));
        }
        let stretches = self.layout.information_along(&along, None, STRETCHES)?;
        let whole = ColumnInformation::sum(&stretches).map(Box::new);
        Ok(whole.map_or(Feasibility::TooHeavy(f64::INFINITY), |whole| Feasibility::Feasible {
            whole,
            stretches,
        }))
    }
}
