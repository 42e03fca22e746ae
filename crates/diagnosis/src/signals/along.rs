use effects::{Column, Encoders, Frame, Motion};
use logs::{LogError, LowPass, PreparedJoint, PreparedRun, decimate};
use nalgebra::Complex;
use rayon::prelude::*;
use robot::Robot;

use crate::signals::limit::Limit;
use crate::signals::tone::{Beat, Tone};

/// Rate at which effects are evaluated, in cut-off frequencies: the harmonics that a sign
/// or a product makes of a signal limited to the cut-off stay far from folding into the band.
const EVALUATION_RATE: f64 = 16.0;

/// Rate of the regression, in cut-off frequencies: just above twice the band.
pub(crate) const REGRESSION_RATE: f64 = 2.5;

/// Order of the low-pass filter, before it runs forward and backward.
const ORDER: usize = 4;

/// How far beyond a stand a low-pass carries what holds the joint there, in periods of its cut-off.
const CARRIED: f64 = 0.35;

/// Cut-off of the filter before the signals of a log are thinned, in cut-offs of the regression.
const THINNING: f64 = 4.0;

/// Least share of what the low-pass takes into a sample that comes from where the joint moves, for the
/// sample to tell of the effort: of a smaller one less is left than of its noise, whose power falls
/// with the share and not with its square.
const TELLS: f64 = 2.0 / 3.0;

/// Noise of readings of the efforts, as a share of them, above which the start of a run takes no part:
/// the low-pass begins in the first reading, with all of its noise.
const NOISY: f64 = 0.1;

/// Least RMS value of a sine of size one behind the low-pass that is one in its band.
const IN_BAND: f64 = 1e-4;

/// A sine of size one along a run, behind the low-pass, at the rate of the regression.
#[derive(Debug, Clone)]
pub(crate) struct Wave {
    /// `L exp(i rate (beat - origin))`
    pub values: Vec<Complex<f64>>,
    /// `L (beat - origin) exp(i rate (beat - origin))`
    pub slopes: Vec<Complex<f64>>,
}

/// One run at the rate at which effects are evaluated, and how its signals are brought to that
/// of the regression.
pub(crate) struct Along<'a> {
    /// The motion about a robot.
    pub motion: Motion,
    run: &'a PreparedRun,
    /// `[joint][sample]`: one where the signals of a joint count and zero elsewhere; empty where they
    /// count everywhere.
    counts: Vec<Vec<f64>>,
    /// `[joint][_][sample]`: an orthonormal basis of the tones there may be in the effort.
    heard: Vec<Vec<Vec<f64>>>,
    limits: &'a [Limit],
    /// Whether readings of the efforts are noisy.
    noisy: bool,
    cutoff_hz: f64,
    low_pass: LowPass,
    /// Samples of the run to one of the motion, and of the motion to one of the regression.
    strides: [usize; 2],
    /// Rate of the regression (Hz).
    pub rate_hz: f64,
}

impl<'a> Along<'a> {
    /// Evaluates `robot` along a run, whose efforts go beyond limits.
    pub fn new(
        robot: &Robot,
        frame: &Frame,
        run: &'a PreparedRun,
        cutoff_hz: f64,
        limits: &'a [Limit],
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
        let encoders = Encoders {
            reported: [signals(|j| &j.wide.q), signals(|j| &j.wide.qd), signals(|j| &j.wide.qdd)],
            links: run.joints.iter().map(link).collect(),
            since_cold_s: run.time.first().map_or(0.0, |first| first - run.session_start_s),
        };
        let motion = Motion::seen(robot, frame, encoders, rate.recip());
        let low_pass = LowPass::new(ORDER, cutoff_hz, rate)?;
        let (strides, rate_hz) = ([first, second], rate / second as f64);
        let (counts, heard) = (Vec::new(), vec![Vec::new(); run.joints.len()]);
        let noisy = is_noisy(run);
        Ok(Self {
            motion,
            run,
            counts,
            heard,
            limits,
            noisy,
            cutoff_hz,
            low_pass,
            strides,
            rate_hz,
        })
    }

    /// The same of the joints while they move: what holds one that stands is any part of its dry
    /// friction. Efforts and columns are set to zero there before the low-pass, which carries
    /// nothing of it elsewhere then, and leaves `effort = columns weights + noise` as true as it was:
    ///
    /// ```text
    /// L(m effort) = L(m columns) weights + L(m noise),   m = 1 while the joint moves, else 0
    /// ```
    pub fn while_moving(mut self) -> Self {
        self.counts = (0..self.run.joints.len()).map(|j| self.moving(j)).collect();
        self
    }

    /// The same with tones in its efforts.
    pub fn hearing(mut self, tones: &[Tone]) -> Result<Self, LogError> {
        for tone in tones {
            self.hear(tone)?;
        }
        Ok(self)
    }

    /// One where joint `j` moves, and as far from where it stands as thinning carries what holds it
    /// there; zero elsewhere, at the end of the run, beyond which a late torque looks, and at the
    /// start of a noisy one.
    fn moving(&self, j: usize) -> Vec<f64> {
        let thins = self.strides[0] > 1;
        let margin = if thins { self.carried(THINNING * self.cutoff_hz) } else { 0 };
        let away = self.away(&self.motion.stands(j), margin);
        away.into_iter().map(|away| f64::from(u8::from(away))).collect()
    }

    /// Takes a tone into the basis of what is heard at its joint, if the band has any of it.
    fn hear(&mut self, tone: &Tone) -> Result<(), LogError> {
        let beat = match tone.beat {
            Beat::Position(_) => &self.run.joints[tone.joint].wide.q,
            Beat::Clock(_) => &self.run.time,
        };
        let phase = || beat.iter().map(|b| tone.beat.rate() * b);
        for sine in [phase().map(f64::cos).collect(), phase().map(f64::sin).collect()] {
            // The second time what the first leaves by rounding.
            let sine = self.without_heard(tone.joint, self.thinned(tone.joint, sine)?);
            let mut sine = self.without_heard(tone.joint, sine);
            let norm = sine.iter().map(|x| x * x).sum::<f64>().sqrt();
            if norm > IN_BAND * (sine.len() as f64).sqrt() {
                sine.iter_mut().for_each(|x| *x /= norm);
                self.heard[tone.joint].push(sine);
            }
        }
        Ok(())
    }

    /// A signal of the efforts at joint `j`, at the rate of the regression, without what tones may have
    /// in it.
    fn without_heard(&self, j: usize, mut x: Vec<f64>) -> Vec<f64> {
        for sine in &self.heard[j] {
            let size: f64 = x.iter().zip(sine).map(|(x, s)| x * s).sum();
            x.iter_mut().zip(sine).for_each(|(x, s)| *x -= size * s);
        }
        x
    }

    /// A signal of joint `j` where it counts, low-passed, at the rate of the regression.
    pub fn finish(&self, j: usize, mut x: Vec<f64>) -> Vec<f64> {
        self.finish_all([(j, &mut x)]);
        x
    }

    /// The same of many signals, each with its joint.
    fn finish_all<'x>(&self, signals: impl IntoIterator<Item = (usize, &'x mut Vec<f64>)>) {
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
        signals.into_iter().for_each(|x| *x = decimate(x, self.strides[1]));
    }

    /// How far a low-pass carries what is somewhere (samples of the motion).
    fn carried(&self, cutoff_hz: f64) -> usize {
        (CARRIED / (cutoff_hz * self.motion.period_s)).round() as usize
    }

    /// Whether a sample of the motion is more than `margin` from where a joint `rests`, and as far from
    /// the end of the run, beyond which a late torque looks, and from the start of a noisy one, as the
    /// low-pass carries what is there.
    fn away(&self, rests: &[bool], margin: usize) -> Vec<bool> {
        let end = self.carried(self.cutoff_hz).min(rests.len());
        let mut away = vec![true; rests.len()];
        away[rests.len() - end..].fill(false);
        away[..if self.noisy { end } else { 0 }].fill(false);
        for (t, _) in rests.iter().enumerate().filter(|(_, rests)| **rests) {
            let end = (t + margin + 1).min(away.len());
            away[t.saturating_sub(margin)..end].fill(false);
        }
        away
    }

    /// Whether a sample at the rate of the regression is as far from where a joint `rests` as the
    /// low-pass carries what is there.
    fn clear(&self, rests: &[bool]) -> Vec<bool> {
        let away = self.away(rests, self.carried(self.cutoff_hz));
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

    /// Signals of the motion, `[joint][sample]`, at the rate of the regression, as they are.
    pub fn thin(&self, signals: &[Vec<f64>]) -> Vec<Vec<f64>> {
        signals.iter().map(|x| decimate(x, self.strides[1])).collect()
    }

    /// Whether joint `j` is held by any part of its dry friction at a sample at the rate of the
    /// regression, or the low-pass mixes that in.
    pub fn stands(&self, j: usize) -> Vec<bool> {
        self.clear(&self.motion.stands(j)).iter().map(|clear| !clear).collect()
    }

    /// Whether a sample at the rate of the regression tells of the effort of joint `j`.
    pub fn tells(&self, j: usize) -> Vec<bool> {
        let moving = self.finish(j, vec![1.0; self.motion.samples()]);
        moving.into_iter().map(|share| share > TELLS).collect()
    }

    /// Whether joint `j` slides at a sample at the rate of the regression: does not turn there.
    pub fn slides(&self, j: usize) -> Vec<bool> {
        let (rests, stands) = (self.motion.rests(j), self.motion.stands(j));
        let turns: Vec<bool> = rests.iter().zip(stands).map(|(rests, s)| *rests && !s).collect();
        self.clear(&turns)
    }

    /// The columns of one effect, low-passed, at the rate of the regression, without what tones may
    /// have in them: sizes of tones are fitted with those of all effects.
    pub fn finished(&self, mut columns: Vec<Column>) -> Vec<Column> {
        let parts = columns.iter_mut().flatten();
        self.finish_all(parts.map(|part| (part.joint, &mut part.values)));
        for part in columns.iter_mut().flatten() {
            part.values = self.without_heard(part.joint, std::mem::take(&mut part.values));
        }
        columns
    }

    /// The efforts of the log.
    pub fn measured(&self) -> Result<Vec<Vec<f64>>, LogError> {
        self.all_thinned(self.run.joints.iter().map(|j| j.effort.clone()).collect())
    }

    /// What the first encoder of every joint reports beyond the position of its link; zero where
    /// no second one shows it.
    pub fn twists(&self) -> Result<Vec<Vec<f64>>, LogError> {
        let samples = self.run.time.len();
        let of = |j: &PreparedJoint| {
            j.link.as_ref().map_or_else(|| vec![0.0; samples], |link| link.twist.clone())
        };
        self.all_thinned(self.run.joints.iter().map(of).collect())
    }

    /// The effort of joint `j` in the log (N·m or N).
    pub fn effort(&self, j: usize) -> impl Iterator<Item = f64> + '_ {
        self.run.joints[j].effort.iter().copied()
    }

    /// The part of the effort at the joint of `limit` that became no torque.
    pub fn beyond(&self, limit: &Limit) -> Result<Vec<f64>, LogError> {
        let beyond = self.effort(limit.joint).map(|effort| limit.beyond(effort)).collect();
        self.thinned(limit.joint, beyond)
    }

    /// What of them became no torque; nothing where all did.
    pub fn beyond_limits(&self) -> Result<Vec<Vec<f64>>, LogError> {
        let mut all = vec![Vec::new(); self.run.joints.len()];
        for limit in self.limits {
            all[limit.joint] = self.beyond(limit)?;
        }
        Ok(all)
    }

    /// The same with the tones there may be in what a robot leaves of the efforts.
    pub fn known(&self, left: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, LogError> {
        let mut known = self.beyond_limits()?;
        for (j, known) in known.iter_mut().enumerate().filter(|(j, _)| !self.heard[*j].is_empty()) {
            known.resize(left[j].len(), 0.0);
            let became_torque: Vec<f64> = left[j].iter().zip(&*known).map(|(x, k)| x - k).collect();
            let rest = self.without_heard(j, became_torque);
            *known = left[j].iter().zip(rest).map(|(x, rest)| x - rest).collect();
        }
        Ok(known)
    }

    /// The sine of a beat at joint `j`, its phase none at `origin`.
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

    /// `measured` less the efforts of the robot.
    pub fn left(&self, measured: &[Vec<f64>]) -> Vec<Vec<f64>> {
        less(measured, &self.expected())
    }

    /// The efforts of the robot.
    pub fn expected(&self) -> Vec<Vec<f64>> {
        let mut efforts = self.motion.effort.clone();
        self.finish_all(efforts.iter_mut().enumerate());
        efforts
    }

    /// Signals at the rate of the log, low-passed, at the rate of the regression. Where effects
    /// are evaluated at a lower rate than the log's, noise is kept from folding into the band by
    /// a filter that leaves the band itself alone (1e-5 at the cut-off).
    fn all_thinned(&self, efforts: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, LogError> {
        let thinned = |(j, effort)| self.thinned(j, effort);
        efforts.into_par_iter().enumerate().map(thinned).collect()
    }

    fn thinned(&self, j: usize, mut x: Vec<f64>) -> Result<Vec<f64>, LogError> {
        if self.strides[0] > 1 {
            LowPass::new(ORDER, THINNING * self.cutoff_hz, self.run.rate_hz)?.apply(&mut x);
            x = decimate(&x, self.strides[0]);
        }
        Ok(self.finish(j, x))
    }
}

/// Whether readings of the efforts are noisy, by the RMS difference of two in turn, over `sqrt 2`, and
/// over all joints.
fn is_noisy(run: &PreparedRun) -> bool {
    let efforts = || run.joints.iter().map(|joint| &joint.effort);
    let steps: f64 =
        efforts().flat_map(|x| x.windows(2)).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let whole: f64 = efforts().flatten().map(|x| x * x).sum();
    0.5 * steps > NOISY * NOISY * whole
}

/// The signals of all joints less others.
pub(crate) fn less(from: &[Vec<f64>], others: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let less = |(x, y): (&Vec<f64>, &Vec<f64>)| x.iter().zip(y).map(|(x, y)| x - y).collect();
    from.iter().zip(others).map(less).collect()
}

fn stride(rate: f64, wanted: f64) -> usize {
    ((rate / wanted) as usize).max(1)
}
