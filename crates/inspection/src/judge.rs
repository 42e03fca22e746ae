use std::borrow::Cow;

use robot::Robot;

use crate::fit::{Drive, Fitted, ProductSums};
use crate::log_reading::LogReading;
use crate::motion_samples::MotionSamples;
use crate::nominal_torque::NominalTorque;
use crate::pooled::{fit_pooled, own_factor};
use crate::thresholds::InspectionThresholds;

/// Compares readings of samples with the nominal torque.
pub(crate) struct Judge<'a> {
    pub robot: Cow<'a, Robot>,
    pub thresholds: &'a InspectionThresholds,
    torque: NominalTorque,
    pub samples: MotionSamples,
    /// Nominal torque as the samples stand: rigid bodies without gravity, gravity per unit, and all.
    pub inertial: Vec<f64>,
    pub gravity: [Vec<f64>; 3],
    pub whole: Vec<f64>,
    /// Share of the effort of each joint that counts as nothing.
    pub floors: Vec<f64>,
}

/// A reading, and the residual that it leaves.
#[derive(Debug, Clone)]
pub(crate) struct ReadingFit {
    pub reading: LogReading,
    /// Share of the effort left at each joint as the log stands, and when it is read so.
    pub before: Vec<f64>,
    pub shares: Vec<f64>,
    /// Logarithm of the factor by which the residual is smaller than that of the log as it stands.
    pub gain: f64,
}

impl<'a> Judge<'a> {
    pub fn new(
        robot: &'a Robot,
        thresholds: &'a InspectionThresholds,
        samples: MotionSamples,
    ) -> Self {
        let mut torque = NominalTorque::new(robot);
        let inertial = torque.inertial(&samples);
        let gravity = torque.gravity(&samples);
        let whole = torque.whole(samples.joints, &samples.motion);
        let floors = floors(&samples, thresholds);
        Self {
            robot: Cow::Borrowed(robot),
            thresholds,
            torque,
            samples,
            inertial,
            gravity,
            whole,
            floors,
        }
    }

    /// The bounds of a drive of nearly the right torque constant.
    pub fn exact_drive(&self) -> Drive {
        Drive { gain: self.thresholds.exact_gain }
    }

    /// The usual bounds of a drive.
    fn drive(&self) -> Drive {
        Drive { gain: self.thresholds.drive_gain }
    }

    /// The residual of each joint with the samples as they stand.
    pub fn as_is(&self) -> ReadingFit {
        let fits = self.fits(&self.samples, &self.whole, self.drive());
        let shares: Vec<f64> = fits.iter().map(|fit| fit.share).collect();
        ReadingFit { reading: LogReading::AsIs, before: shares.clone(), shares, gain: 0.0 }
    }

    /// The fit of every joint for samples and their nominal torque.
    pub fn fits(&self, samples: &MotionSamples, tau: &[f64], drive: Drive) -> Vec<Fitted> {
        let fit = |j| {
            let sums = self.sums(samples, tau, j);
            if samples.has_goals(j) { sums.fit_of_loop(drive) } else { sums.fit(drive) }
        };
        (0..samples.joints).map(fit).collect()
    }

    /// The least squares fits of a joint without and with viscous friction of either sign.
    pub fn fits_of_loop(&self, j: usize) -> [Fitted; 2] {
        let sums = self.sums(&self.samples, &self.whole, j);
        [sums.fit(self.drive()), sums.fit_of_loop(self.drive())]
    }

    /// Sums of a joint for samples and their nominal torque.
    pub fn sums(&self, samples: &MotionSamples, tau: &[f64], j: usize) -> ProductSums {
        let column = |x: &[f64]| samples.column(x, j);
        let turned = samples.direction(j);
        let columns = [column(tau), turned, column(&samples.motion[1]), column(&samples.motion[2])];
        ProductSums::of(columns.each_ref().map(Vec::as_slice), &column(&samples.effort))
    }

    /// The residual with a reading.
    pub fn judge_reading(&mut self, reading: LogReading, as_is: &ReadingFit) -> ReadingFit {
        let read = reading.apply(&self.samples);
        let tau = match &reading {
            _ if reading.is_of_efforts() => self.whole.clone(),
            LogReading::WithoutGravity => self.inertial.clone(),
            LogReading::Gravity(g) => self.torque_under([g.x, g.y, g.z]),
            LogReading::LockedAt(locks) => match self.robot.locked_at(locks) {
                Some(robot) => NominalTorque::new(&robot).whole(read.joints, &read.motion),
                None => self.whole.clone(),
            },
            _ => self.torque.whole(read.joints, &read.motion),
        };
        let narrow = Drive { gain: self.thresholds.unit_gain };
        let drive = match reading {
            LogReading::Unit(_) => narrow,
            LogReading::LockedAt(_) => self.exact_drive(),
            _ => self.drive(),
        };
        let shares: Vec<f64> = self.fits(&read, &tau, drive).iter().map(|f| f.share).collect();
        let gain = self.gain(&as_is.shares, &shares);
        ReadingFit { reading, before: as_is.shares.clone(), shares, gain }
    }

    /// Efforts without the torque of gravity. `None` where the efforts contain some of the described one.
    ///
    /// Drives have nearly the right constant here, since another one could take gravity away as well.
    pub fn without_gravity(&self) -> Option<ReadingFit> {
        let part = *self.fit_pooled(&self.inertial, &[&self.held_torque()])?.first()?;
        if part.abs() > self.thresholds.held_gravity {
            return None;
        }
        let shares = |tau: &[f64]| -> Vec<f64> {
            self.fits(&self.samples, tau, self.exact_drive()).iter().map(|fit| fit.share).collect()
        };
        let (before, shares) = (shares(&self.whole), shares(&self.inertial));
        let gain = self.gain(&before, &shares);
        Some(ReadingFit { reading: LogReading::WithoutGravity, before, shares, gain })
    }

    /// Whether the joints tell one by one that gravity is in no effort: two deny it or more, none confirms it, and there is
    /// none of another direction either.
    ///
    /// ```text
    /// effort - (M qdd + C qd) = p g(q) + drive,   denied: |p| + 2 error < 1/2,   confirmed: p - 2 error > 1/2
    /// ```
    ///
    /// An offset takes most of the torque of gravity where an arm moves little, so that its part says more than what it
    /// leaves. A counterbalance takes it from one joint.
    pub fn lacks_gravity_at_joints(&self) -> bool {
        let t = self.thresholds;
        let columns = self.gravity.each_ref().map(Vec::as_slice);
        let of_any_direction = self.fit_pooled(&self.inertial, &columns);
        let nominal = self.robot.gravity_in_base().norm();
        let is_turned = of_any_direction.is_some_and(|g| {
            g.iter().map(|g| g * g).sum::<f64>().sqrt() > t.held_gravity * nominal
        });
        let held = self.held_torque();
        let part = |j| own_factor(&self.samples, &self.inertial, &held, j, t.rows_of_independent);
        let parts: Vec<[f64; 2]> = (0..self.samples.joints).filter_map(part).collect();
        let denies = |[part, error]: &&[f64; 2]| {
            part.abs() < t.held_gravity && part.abs() + 2.0 * error < 0.5
        };
        let confirms = |[part, error]: &[f64; 2]| part - 2.0 * error > 0.5;
        let denying = parts.iter().filter(denies).count();
        !is_turned && denying >= t.joints_without_gravity && !parts.iter().any(confirms)
    }

    /// Torque of the described gravity.
    fn held_torque(&self) -> Vec<f64> {
        let pull = self.robot.gravity_in_base();
        let mut held = vec![0.0; self.inertial.len()];
        for (unit, g) in self.gravity.iter().zip(pull.iter()) {
            held.iter_mut().zip(unit).for_each(|(held, unit)| *held += g * unit);
        }
        held
    }

    /// Nominal torque with another acceleration of free fall.
    pub fn torque_under(&self, g: [f64; 3]) -> Vec<f64> {
        let mut tau = self.inertial.clone();
        for (unit, g) in self.gravity.iter().zip(g) {
            tau.iter_mut().zip(unit).for_each(|(tau, unit)| *tau += g * unit);
        }
        tau
    }

    /// Sum over joints of `ln((before + floor) / (after + floor))`.
    pub fn gain(&self, before: &[f64], after: &[f64]) -> f64 {
        let gains = before.iter().zip(after).zip(&self.floors);
        gains.map(|((b, a), floor)| ((b + floor) / (a + floor)).ln()).sum()
    }

    /// Squares of the error of a joint's nominal torque over those of the effort about its mean.
    pub fn model_floor(&self, j: usize) -> f64 {
        let tau = self.samples.column(&self.whole, j);
        let all = tau.iter().map(|t| t * t).sum::<f64>();
        let about = self.sums(&self.samples, &self.whole, j).total();
        self.thresholds.model_error.powi(2) * all / about.max(f64::MIN_POSITIVE)
    }

    /// Common factors of columns that all joints share, beside a torque of factor one.
    pub fn fit_pooled(&self, granted: &[f64], columns: &[&[f64]]) -> Option<Vec<f64>> {
        fit_pooled(&self.samples, granted, columns, self.thresholds.pooled_share)
    }

    /// Reads the samples so from now on.
    pub fn adopt(&mut self, reading: &LogReading) {
        self.samples = reading.apply(&self.samples);
        if let LogReading::LockedAt(locks) = reading
            && let Some(robot) = self.robot.locked_at(locks)
        {
            self.torque = NominalTorque::new(&robot);
            self.robot = Cow::Owned(robot);
        }
        match reading {
            LogReading::WithoutGravity => {
                self.gravity.iter_mut().flatten().for_each(|unit| *unit = 0.0);
                self.whole = self.inertial.clone();
            }
            LogReading::Gravity(g) => self.whole = self.torque_under([g.x, g.y, g.z]),
            _ => {
                self.inertial = self.torque.inertial(&self.samples);
                self.gravity = self.torque.gravity(&self.samples);
                self.whole = self.torque.whole(self.samples.joints, &self.samples.motion);
            }
        }
        self.floors = floors(&self.samples, self.thresholds);
    }
}

/// Squares of the error of models over those of the effort about its mean. The error is a share of the whole effort, also of
/// the mean, which an offset takes off.
fn floors(samples: &MotionSamples, t: &InspectionThresholds) -> Vec<f64> {
    let floor = |j: usize| {
        let effort = samples.column(&samples.effort, j);
        let mean = effort.iter().sum::<f64>() / effort.len().max(1) as f64;
        let about = effort.iter().map(|e| (e - mean).powi(2)).sum::<f64>();
        let all = effort.iter().map(|e| e * e).sum::<f64>();
        if about > 0.0 { (t.model_error.powi(2) * all / about).max(t.floor) } else { f64::INFINITY }
    };
    let all: Vec<f64> = (0..samples.joints).map(floor).collect();
    all.into_iter().map(|f| if f.is_finite() { f } else { NO_EFFORT }).collect()
}

/// Floor of a joint that has no effort: nothing counts there.
const NO_EFFORT: f64 = 1e12;
