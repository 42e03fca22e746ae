use effects::{EffectColumn, Encoders, Frame, RunMotion};
use logs::{GoalEffort, LogError, LowPass, PreparedJoint, PreparedRun, decimate};
use nalgebra::Complex;
use rayon::prelude::*;
use robot::Robot;

use crate::signals::first_samples::FirstSamples;
use crate::signals::limit::Limit;
use crate::signals::tone::{Beat, Tone};
use crate::thresholds::signals::SignalThresholds;

/// Rate at which effects are evaluated, in cut-off frequencies. A sign or a product makes harmonics of a signal below
/// the cut-off; at this rate they do not alias into the band.
const EVALUATION_RATE: f64 = 16.0;

/// Rate of the regression, in cut-off frequencies: just above twice the band.
pub(crate) const REGRESSION_RATE: f64 = 2.5;

/// Order of the low-pass filter, before it runs forward and backward.
const ORDER: usize = 4;

/// Cut-off of the filter before the signals of a log are decimated, in cut-offs of the regression.
const THINNING: f64 = 4.0;

/// Least RMS value, after the low-pass, of a sine of amplitude one that counts as in the band.
const IN_BAND: f64 = 1e-4;

/// A sine of amplitude one along a run, after the low-pass, at the rate of the regression.
#[derive(Debug, Clone)]
pub(crate) struct Wave {
    /// `L exp(i rate (beat - origin))`
    pub values: Vec<Complex<f64>>,
    /// `L (beat - origin) exp(i rate (beat - origin))`
    pub slopes: Vec<Complex<f64>>,
}

/// One run at the rate at which effects are evaluated, and the decimation of its signals to the rate of the
/// regression.
pub(crate) struct Along<'a> {
    /// The motion about a robot.
    pub motion: RunMotion,
    run: &'a PreparedRun,
    /// `[joint][sample]`: one where the signals of a joint count, else zero. Empty where they count everywhere.
    counts: Vec<Vec<f64>>,
    /// `[joint][_][sample]`: an orthonormal basis of the tones that the effort may contain.
    tone_basis: Vec<Vec<Vec<f64>>>,
    limits: &'a [Limit],
    thresholds: &'a SignalThresholds,
    cutoff_hz: f64,
    low_pass: LowPass,
    /// The low-pass before the signals of a log are decimated to the rate of the motion, where they are.
    thinning: Option<LowPass>,
    /// Scales of the first samples, where all samples are to have one noise.
    first_samples: Option<FirstSamples>,
    /// Number of samples of the run per sample of the motion, and of the motion per sample of the regression.
    strides: [usize; 2],
    /// Rate of the regression (Hz).
    pub rate_hz: f64,
}

impl<'a> Along<'a> {
    /// Evaluates `robot` along a run whose efforts may exceed `limits`.
    pub fn new(
        robot: &Robot,
        frame: &Frame,
        run: &'a PreparedRun,
        cutoff_hz: f64,
        limits: &'a [Limit],
        thresholds: &'a SignalThresholds,
    ) -> Result<Self, LogError> {
        let first = stride(run.rate_hz, EVALUATION_RATE * cutoff_hz);
        let rate = run.rate_hz / first as f64;
        let second = stride(rate, REGRESSION_RATE * cutoff_hz);
        let signals = |pick: fn(&PreparedJoint) -> &Vec<f64>| -> Vec<Vec<f64>> {
            run.joints.iter().map(|j| decimate(pick(j), first)).collect()
        };
        let link = |j: &PreparedJoint| {
            let link = j.link.as_ref()?;
            Some([&link.q, &link.qd, &link.qdd].map(|x| decimate(x, first)))
        };
        let goal_effort = |j: &PreparedJoint| {
            let goal = j.goal_effort.as_ref()?;
            let values = decimate(&goal.values[goal.lead % first..], first);
            Some(GoalEffort { values, lead: goal.lead / first, ..*goal })
        };
        let encoders = Encoders {
            reported: [signals(|j| &j.wide.q), signals(|j| &j.wide.qd), signals(|j| &j.wide.qdd)],
            links: run.joints.iter().map(link).collect(),
            goal_efforts: run.joints.iter().map(goal_effort).collect(),
            since_cold_s: run.time.first().map_or(0.0, |first| first - run.session_start_s),
        };
        let motion = RunMotion::from_encoders(robot, frame, encoders, rate.recip());
        let low_pass = LowPass::new(ORDER, cutoff_hz, rate)?;
        let thinning = (first > 1)
            .then(|| LowPass::new(ORDER, THINNING * cutoff_hz, run.rate_hz))
            .transpose()?;
        let (strides, rate_hz) = ([first, second], rate / second as f64);
        let (counts, tone_basis) = (Vec::new(), vec![Vec::new(); run.joints.len()]);
        Ok(Self {
            motion,
            run,
            counts,
            tone_basis,
            limits,
            thresholds,
            cutoff_hz,
            low_pass,
            thinning,
            first_samples: None,
            strides,
            rate_hz,
        })
    }

    /// Sets efforts and columns to zero while a joint stands, where dry friction holds it with any part of its level.
    ///
    /// The mask precedes the low-pass, so that a standstill does not affect the samples beside it, and the model
    /// stays valid:
    ///
    /// ```text
    /// L(m effort) = L(m columns) weights + L(m noise),   m = 1 while the joint moves, else 0
    /// ```
    pub fn while_moving(mut self) -> Self {
        self.counts = (0..self.run.joints.len()).map(|j| self.moving_mask(j)).collect();
        self
    }

    /// Scales the first samples of efforts and columns alike, so that all samples have one noise.
    pub fn with_even_noise(mut self) -> Self {
        let (thinning, low_pass) = (self.thinning.as_ref(), &self.low_pass);
        self.first_samples = Some(FirstSamples::new(thinning, low_pass, self.strides));
        self
    }

    /// Removes tones from efforts and columns alike.
    pub fn with_tones(mut self, tones: &[Tone]) -> Self {
        tones.iter().for_each(|tone| self.project_out(tone));
        self
    }

    /// Removes how links swing on their springs from where the run begins, from efforts and columns alike.
    pub fn without_swings(mut self) -> Self {
        for part in self.motion.swings().into_iter().flatten() {
            let swing = self.finish(part.joint, part.values);
            self.add_to_basis(part.joint, swing);
        }
        self
    }

    /// One where joint `j` moves, else zero. Also zero are the samples within reach of the decimation filter from a
    /// standstill, and the end of the run, which a late torque needs.
    fn moving_mask(&self, j: usize) -> Vec<f64> {
        let thins = self.strides[0] > 1;
        let margin = if thins { self.reach(THINNING * self.cutoff_hz) } else { 0 };
        let away = self.is_away(&self.motion.stands(j), margin);
        away.into_iter().map(|away| f64::from(u8::from(away))).collect()
    }

    /// Adds a tone to the basis of the tones at its joint, if any of it lies in the band.
    fn project_out(&mut self, tone: &Tone) {
        let beat = match tone.beat {
            Beat::Position(_) => &self.run.joints[tone.joint].wide.q,
            Beat::Clock(_) => &self.run.time,
        };
        let phase = || beat.iter().map(|b| tone.beat.rate() * b);
        for sine in [phase().map(f64::cos).collect(), phase().map(f64::sin).collect()] {
            let sine = self.thin_signal(tone.joint, sine);
            self.add_to_basis(tone.joint, sine);
        }
    }

    /// Adds a signal, at the rate of the regression, to the basis of what is removed at joint `j`.
    fn add_to_basis(&mut self, j: usize, x: Vec<f64>) {
        // The second projection takes what the first leaves by rounding.
        let mut x = self.without_tones(j, self.without_tones(j, x));
        let norm = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm > IN_BAND * (x.len() as f64).sqrt() {
            x.iter_mut().for_each(|x| *x /= norm);
            self.tone_basis[j].push(x);
        }
    }

    /// An effort signal at joint `j`, at the rate of the regression, orthogonal to the tones there.
    fn without_tones(&self, j: usize, mut x: Vec<f64>) -> Vec<f64> {
        for sine in &self.tone_basis[j] {
            let size: f64 = x.iter().zip(sine).map(|(x, s)| x * s).sum();
            x.iter_mut().zip(sine).for_each(|(x, s)| *x -= size * s);
        }
        x
    }

    /// A signal of joint `j`, masked, low-passed, decimated to the rate of the regression, and scaled in its first samples
    /// where [these are](Along::with_even_noise).
    pub fn finish(&self, j: usize, mut x: Vec<f64>) -> Vec<f64> {
        self.finish_all([(j, &mut x)]);
        x
    }

    /// [`Along::finish`] for many signals, each given with its joint.
    fn finish_all<'x>(&self, signals: impl IntoIterator<Item = (usize, &'x mut Vec<f64>)>) {
        let signals = self.smooth_all(signals);
        if let Some(first_samples) = &self.first_samples {
            signals.into_iter().for_each(|x| first_samples.scale(x));
        }
    }

    /// Masks, low-passes and decimates signals, each given with its joint.
    fn smooth_all<'x>(
        &self,
        signals: impl IntoIterator<Item = (usize, &'x mut Vec<f64>)>,
    ) -> Vec<&'x mut Vec<f64>> {
        let mut signals: Vec<&mut Vec<f64>> = signals
            .into_iter()
            .map(|(j, x)| {
                if let Some(counts) = self.counts.get(j) {
                    x.iter_mut().zip(counts).for_each(|(x, counts)| *x *= counts);
                }
                x
            })
            .collect();
        self.low_pass.apply_all(&mut signals);
        signals.iter_mut().for_each(|x| **x = decimate(x, self.strides[1]));
        signals
    }

    /// How far a low-pass spreads a signal (samples of the motion).
    fn reach(&self, cutoff_hz: f64) -> usize {
        (self.thresholds.filter_reach / (cutoff_hz * self.motion.period_s)).round() as usize
    }

    /// Whether a sample of the motion is more than `margin` away from samples at which a joint `rests`. It must also be
    /// out of reach of the low-pass from the end of the run, which a late torque needs.
    fn is_away(&self, rests: &[bool], margin: usize) -> Vec<bool> {
        let end = self.reach(self.cutoff_hz).min(rests.len());
        let mut away = vec![true; rests.len()];
        away[rests.len() - end..].fill(false);
        for (t, _) in rests.iter().enumerate().filter(|(_, rests)| **rests) {
            let end = (t + margin + 1).min(away.len());
            away[t.saturating_sub(margin)..end].fill(false);
        }
        away
    }

    /// Whether a sample at the rate of the regression is out of reach of the low-pass from samples at which a joint
    /// `rests`.
    fn is_clear(&self, rests: &[bool]) -> Vec<bool> {
        let away = self.is_away(rests, self.reach(self.cutoff_hz));
        away.into_iter().step_by(self.strides[1]).collect()
    }

    /// Name of the run.
    pub fn name(&self) -> &str {
        &self.run.name
    }

    /// Time at the rate of the regression (s).
    pub fn time(&self) -> Vec<f64> {
        decimate(&decimate(&self.run.time, self.strides[0]), self.strides[1])
    }

    /// Signals of the motion, `[joint][sample]`, decimated to the rate of the regression without a filter.
    pub fn thin(&self, signals: &[Vec<f64>]) -> Vec<Vec<f64>> {
        signals.iter().map(|x| decimate(x, self.strides[1])).collect()
    }

    /// Whether dry friction holds joint `j` at a sample at the rate of the regression, or at a moment that the
    /// low-pass mixes into the sample.
    pub fn stands(&self, j: usize) -> Vec<bool> {
        self.is_clear(&self.motion.stands(j)).iter().map(|is_clear| !is_clear).collect()
    }

    /// Whether a sample at the rate of the regression is informative about the effort of joint `j`.
    pub fn is_informative(&self, j: usize) -> Vec<bool> {
        let mut moving_mask = vec![1.0; self.motion.samples()];
        self.smooth_all([(j, &mut moving_mask)]);
        moving_mask.into_iter().map(|share| share > self.thresholds.informative_share).collect()
    }

    /// Whether joint `j` slides at a sample at the rate of the regression, out of reach of the low-pass from rest.
    pub fn slides(&self, j: usize) -> Vec<bool> {
        self.is_clear(&self.motion.rests(j))
    }

    /// The columns of one effect, low-passed, at the rate of the regression and orthogonal to the tones. The sizes of
    /// tones are thereby fitted together with those of all effects.
    pub fn finish_columns(&self, mut columns: Vec<EffectColumn>) -> Vec<EffectColumn> {
        let parts = columns.iter_mut().flatten();
        self.finish_all(parts.map(|part| (part.joint, &mut part.values)));
        for part in columns.iter_mut().flatten() {
            part.values = self.without_tones(part.joint, std::mem::take(&mut part.values));
        }
        columns
    }

    /// The efforts of the log.
    pub fn measured_effort(&self) -> Vec<Vec<f64>> {
        self.thin_signals(self.run.joints.iter().map(|j| j.effort.clone()).collect())
    }

    /// The position that the first encoder of every joint reports minus that of its link (rad or m); zero where no second
    /// encoder shows the link.
    pub fn twists(&self) -> Vec<Vec<f64>> {
        let samples = self.run.time.len();
        let of = |j: &PreparedJoint| {
            j.link.as_ref().map_or_else(|| vec![0.0; samples], |link| link.twist.clone())
        };
        self.thin_signals(self.run.joints.iter().map(of).collect())
    }

    /// The effort of joint `j` in the log (N·m or N).
    pub fn effort(&self, j: usize) -> impl Iterator<Item = f64> + '_ {
        self.run.joints[j].effort.iter().copied()
    }

    /// The part of the effort at the joint of `limit` that did not become torque.
    pub fn beyond(&self, limit: &Limit) -> Vec<f64> {
        let beyond = self.effort(limit.joint).map(|effort| limit.beyond(effort)).collect();
        self.thin_signal(limit.joint, beyond)
    }

    /// The clipped part of each effort (N·m or N); empty without saturation.
    pub fn beyond_limits(&self) -> Vec<Vec<f64>> {
        let mut all = vec![Vec::new(); self.run.joints.len()];
        for limit in self.limits {
            all[limit.joint] = self.beyond(limit);
        }
        all
    }

    /// The clipped part of each effort, and the tones in the residual `left` of the rest.
    pub fn known_effort(&self, left: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut known = self.beyond_limits();
        for (j, known) in
            known.iter_mut().enumerate().filter(|(j, _)| !self.tone_basis[*j].is_empty())
        {
            known.resize(left[j].len(), 0.0);
            let became_torque: Vec<f64> = left[j].iter().zip(&*known).map(|(x, k)| x - k).collect();
            let rest = self.without_tones(j, became_torque);
            *known = left[j].iter().zip(rest).map(|(x, rest)| x - rest).collect();
        }
        known
    }

    /// The sine of a beat at joint `j`, of phase zero at `origin`.
    pub fn wave(&self, j: usize, beat: Beat, origin: f64) -> Wave {
        let along: Vec<f64> = match beat {
            Beat::Position(_) => self.motion.q[j].clone(),
            Beat::Clock(_) => decimate(&self.run.time, self.strides[0]),
        };
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for b in along {
            let value = Complex::cis(beat.rate() * (b - origin));
            values.push(value);
            slopes.push(value * (b - origin));
        }
        let finish = |z: Vec<Complex<f64>>| -> Vec<Complex<f64>> {
            let part =
                |part: fn(&Complex<f64>) -> f64| self.finish(j, z.iter().map(part).collect());
            let parts = part(|z| z.re).into_iter().zip(part(|z| z.im));
            parts.map(|(re, im)| Complex::new(re, im)).collect()
        };
        Wave { values: finish(values), slopes: finish(slopes) }
    }

    /// `measured` minus the efforts of the robot.
    pub fn remaining_effort(&self, measured: &[Vec<f64>]) -> Vec<Vec<f64>> {
        minus(measured, &self.expected_effort())
    }

    /// The efforts of the robot.
    pub fn expected_effort(&self) -> Vec<Vec<f64>> {
        let mut efforts = self.motion.effort.clone();
        self.finish_all(efforts.iter_mut().enumerate());
        efforts
    }

    /// Signals at the rate of the log, low-passed, at the rate of the regression. Where effects are evaluated at a
    /// lower rate than that of the log, a filter first keeps noise from aliasing into the band. It leaves the band
    /// itself unchanged (1e-5 at the cut-off).
    fn thin_signals(&self, efforts: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let thin_signal = |(j, effort)| self.thin_signal(j, effort);
        efforts.into_par_iter().enumerate().map(thin_signal).collect()
    }

    fn thin_signal(&self, j: usize, mut x: Vec<f64>) -> Vec<f64> {
        if let Some(thinning) = &self.thinning {
            thinning.apply(&mut x);
            x = decimate(&x, self.strides[0]);
        }
        self.finish(j, x)
    }
}

/// The signals `others` subtracted from the signals of all joints.
pub(crate) fn minus(from: &[Vec<f64>], others: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let of_joint = |(x, y): (&Vec<f64>, &Vec<f64>)| x.iter().zip(y).map(|(x, y)| x - y).collect();
    from.iter().zip(others).map(of_joint).collect()
}

fn stride(rate: f64, wanted: f64) -> usize {
    ((rate / wanted) as usize).max(1)
}
