use std::f64::consts::TAU;

use motion::State;
use robot::{PdGain, Reading};

use crate::error;
use crate::error::TrackingError;
use crate::feedforward::TorquePrediction;
use crate::torque_limits::TorqueLimits;

/// Gains, limits and the error rate of a controller.
///
/// ```text
/// u = limit(u_FF + kp error + kd error_rate),   error = q_ref + q_lead - q
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Controller {
    /// Gains of every joint.
    pub gains: Vec<PdGain>,
    /// Torque limits of the motors.
    pub limits: TorqueLimits,
    /// Where the rate of the error comes from.
    pub error_rate: ErrorRate,
}

/// Where the rate of the error comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ErrorRate {
    /// The velocity that the machine reports: `qd_ref + qd_lead - qd`.
    Reading,
    /// The change of the error over one period behind a low pass of first order,
    ///
    /// ```text
    /// error_rate_k = error_rate_{k-1} + a ((error_k - error_{k-1}) / T - error_rate_{k-1})
    /// a = 1 - exp(-2 pi cutoff_hz T)
    /// ```
    ///
    /// from rest. The reference goes through the same filter as the position, so a motion
    /// that is followed perfectly shows none of the filter's lag.
    FilteredDifference {
        /// Cut-off of the low pass (Hz).
        cutoff_hz: f64,
    },
}

impl Default for ErrorRate {
    /// The filtered difference at 180 rad/s.
    fn default() -> Self {
        Self::FilteredDifference { cutoff_hz: 180.0 / TAU }
    }
}

impl Controller {
    /// Refuses gains, limits or a cut-off that do not fit a machine of `joints` joints.
    pub(crate) fn check(&self, joints: usize) -> Result<(), TrackingError> {
        error::same_joints("the set of gains", self.gains.len(), joints)?;
        error::same_joints("the set of torque limits", self.limits.limits().len(), joints)?;
        for (joint, gain) in self.gains.iter().enumerate() {
            error::not_negative(|| format!("kp of joint {joint} (N m/rad or N/m)"), gain.kp)?;
            error::not_negative(|| format!("kd of joint {joint} (N m s/rad or N s/m)"), gain.kd)?;
        }
        match self.error_rate {
            ErrorRate::Reading => Ok(()),
            ErrorRate::FilteredDifference { cutoff_hz } => {
                error::positive("the cut-off of the error's rate (Hz)", cutoff_hz)
            }
        }
    }
}

/// The feedback of a run, from one tick to the next.
#[derive(Debug)]
pub(crate) struct Feedback<'a> {
    controller: &'a Controller,
    period_s: f64,
    /// The error of the last tick; empty before the first.
    last_error: Vec<f64>,
    error_rate: Vec<f64>,
}

impl<'a> Feedback<'a> {
    /// The feedback before the first tick.
    pub fn new(controller: &'a Controller, period_s: f64) -> Self {
        let joints = controller.gains.len();
        let last_error = Vec::with_capacity(joints);
        Self { controller, period_s, last_error, error_rate: vec![0.0; joints] }
    }

    /// Fills `tau` with `kp error + kd error_rate` (N m or N).
    pub fn fill(
        &mut self,
        reference: &State,
        lead: &TorquePrediction,
        now: &Reading,
        tau: &mut [f64],
    ) {
        let error = |j: usize| reference.q[j] + lead.q_lead[j] - now.q[j];
        let joints = self.error_rate.len();
        if self.last_error.is_empty() {
            self.last_error.extend((0..joints).map(error));
        }
        for (j, (gain, tau)) in self.controller.gains.iter().zip(tau).enumerate() {
            let error = error(j);
            self.error_rate[j] = match self.controller.error_rate {
                ErrorRate::Reading => reference.qd[j] + lead.qd_lead[j] - now.qd[j],
                ErrorRate::FilteredDifference { cutoff_hz } => {
                    let a = -(-TAU * cutoff_hz * self.period_s).exp_m1();
                    let difference = (error - self.last_error[j]) / self.period_s;
                    self.error_rate[j] + a * (difference - self.error_rate[j])
                }
            };
            self.last_error[j] = error;
            *tau = gain.kp * error + gain.kd * self.error_rate[j];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD_S: f64 = 0.002;

    fn controller(kp: f64, kd: f64, error_rate: ErrorRate) -> Controller {
        Controller { gains: vec![PdGain { kp, kd }], limits: TorqueLimits::none(1), error_rate }
    }

    /// The feedback of every tick when the reference and the position are functions of time.
    fn feedback(controller: &Controller, q_ref: fn(f64) -> f64, q: fn(f64) -> f64) -> Vec<f64> {
        let mut feedback = Feedback::new(controller, PERIOD_S);
        let each = |k: usize| {
            let t = k as f64 * PERIOD_S;
            let reference = State { q: vec![q_ref(t)], qd: vec![0.0], qdd: vec![0.0] };
            let reading = Reading { q: vec![q(t)], ..Reading::zero(1) };
            let mut tau = [0.0];
            feedback.fill(&reference, &TorquePrediction::zero(1), &reading, &mut tau);
            tau[0]
        };
        (0..500).map(each).collect()
    }

    #[test]
    fn a_reference_followed_perfectly_shows_no_lag_of_the_filter() {
        let tau = feedback(&controller(10.0, 1.0, ErrorRate::default()), f64::sin, f64::sin);
        assert!(tau.iter().all(|tau| *tau == 0.0));
    }

    #[test]
    fn the_filtered_rate_of_a_growing_error_is_the_step_response_of_the_low_pass() {
        let rate = ErrorRate::FilteredDifference { cutoff_hz: 180.0 / TAU };
        let tau = feedback(&controller(0.0, 2.0, rate), |t| 3.0 * t, |_| 0.0);
        for (k, tau) in tau.iter().enumerate() {
            // Behind k changes of the error: 1 - (1 - a)^k of the slope.
            let expected = 2.0 * 3.0 * (1.0 - (-180.0 * PERIOD_S * k as f64).exp());
            assert!((tau - expected).abs() < 1e-10, "tick {k}: {tau} instead of {expected}");
        }
    }

    #[test]
    fn the_feedback_follows_the_reference_and_its_lead() {
        let controller = controller(10.0, 2.0, ErrorRate::Reading);
        let lead = TorquePrediction { tau: vec![7.0], q_lead: vec![0.1], qd_lead: vec![0.5] };
        let reference = State { q: vec![1.0], qd: vec![2.0], qdd: vec![0.0] };
        let reading = Reading { q: vec![0.6], qd: vec![1.5], ..Reading::zero(1) };
        let mut tau = [0.0];
        Feedback::new(&controller, PERIOD_S).fill(&reference, &lead, &reading, &mut tau);
        assert!((tau[0] - (10.0 * 0.5 + 2.0 * 1.0)).abs() < 1e-14, "{tau:?}");
    }

    #[test]
    fn gains_that_are_no_gains_are_refused() {
        let of = |kp, kd, rate| controller(kp, kd, rate).check(1).unwrap_err().to_string();
        assert!(of(f64::NAN, 1.0, ErrorRate::Reading).contains("kp of joint 0"));
        assert!(of(1.0, -1.0, ErrorRate::Reading).contains("kd of joint 0"));
        let none = ErrorRate::FilteredDifference { cutoff_hz: 0.0 };
        assert!(of(1.0, 1.0, none).contains("cut-off"));
        let error = controller(1.0, 1.0, ErrorRate::Reading).check(2).unwrap_err();
        let expected = TrackingError::JointCount { what: "the set of gains", got: 1, expected: 2 };
        assert_eq!(error, expected);
    }
}
