use effects::{Frame, Hypothesis, Scale, ShapedRobot};
use logs::{LowPass, Prepared, PreparedJoint};
use nalgebra::DVector;
use robot::Robot;

use crate::error::NextMotionError;
use crate::information::{ColumnInformation, ColumnLayout, ORDER};
use crate::limits::{Usable, efforts, usable};
use crate::motion_record::{EVALUATION_RATE, MotionRecord};

/// Size of a cause that no log shows, as a share of its prior standard deviation.
const SUPPOSED: f64 = 0.1;

/// Share of its largest speed below which a joint counts as at rest in a motion that has not been
/// run.
const REST_SHARE: f64 = 1e-3;

/// What is known before the motion.
#[derive(Debug, Clone)]
pub(crate) struct Known {
    pub frame: Frame,
    /// Typical sizes of efforts, speeds and inertias.
    pub scale: Scale,
    /// Information from the logs; zero without logs.
    pub information: ColumnInformation,
    source: Source,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    Logs,
    Limits,
}

impl Known {
    /// From logs.
    pub fn of_logs(
        shaped: &ShapedRobot,
        layout: &ColumnLayout,
        logs: &Prepared,
    ) -> Result<Self, NextMotionError> {
        let (robot, trial_gaps) = (&shaped.robot, shaped.trial_gaps.clone());
        let trial_springs = shaped.trial_springs.clone();
        let scale = Scale::of_logs(robot, logs);
        let rest_speed = scale.speed.iter().map(|speed| REST_SHARE * speed).collect();
        let trial_lateness_s = shaped.trial_lateness_s;
        let frame = Frame {
            rest_speed,
            trial_gaps,
            trial_springs,
            trial_lateness_s,
            ..Frame::of_logs(logs)
        };
        let information = along_logs(robot, layout, &frame, logs)?;
        Ok(Self { frame, scale, information, source: Source::Logs })
    }

    /// From the limits of the joints, before there is any log.
    pub fn of_limits(shaped: &ShapedRobot, layout: &ColumnLayout) -> Self {
        let usable = usable(&shaped.robot);
        let each = |of: fn(&Usable) -> f64| usable.iter().map(of).collect::<Vec<f64>>();
        Self {
            frame: Frame {
                rest_speed: each(|u| REST_SHARE * u.speed),
                centre: each(|u| u.middle),
                reach: each(|u| u.half),
                resolution: vec![0.0; usable.len()],
                trial_gaps: shaped.trial_gaps.clone(),
                trial_springs: shaped.trial_springs.clone(),
                trial_lateness_s: shaped.trial_lateness_s,
            },
            scale: scale_of_limits(&shaped.robot),
            information: layout.no_information(),
            source: Source::Limits,
        }
    }

    /// The weights of the columns of some causes: those that explain the logs best or, without
    /// logs, a tenth of their prior standard deviations.
    pub fn weights(
        &self,
        layout: &ColumnLayout,
        robot: &Robot,
        causes: &[Hypothesis],
    ) -> DVector<f64> {
        let prior: Vec<f64> = causes
            .iter()
            .flat_map(|h| h.prior(robot, &self.scale, &effects::Priors::default()))
            .collect();
        match self.source {
            Source::Logs => self.information.weights(&layout.columns(causes), &prior),
            Source::Limits => SUPPOSED * DVector::from_vec(prior),
        }
    }
}

/// Sizes that the limits of the joints allow, for use without logs.
pub(crate) fn scale_of_limits(robot: &Robot) -> Scale {
    let usable = usable(robot);
    let each = |of: fn(&Usable) -> f64| usable.iter().map(of).collect::<Vec<f64>>();
    let [link_mass, link_length] = Scale::of_links(robot);
    Scale {
        effort: efforts(robot),
        speed: each(|u| u.speed),
        acceleration: each(|u| u.acceleration),
        range: each(|u| 2.0 * u.half),
        // A motion is over before a drive is warm.
        session_s: 0.0,
        link_mass,
        link_length,
    }
}

/// The normal equations of the columns and the measured effort over all runs.
fn along_logs(
    robot: &Robot,
    layout: &ColumnLayout,
    frame: &Frame,
    logs: &Prepared,
) -> Result<ColumnInformation, NextMotionError> {
    let mut all = Vec::new();
    for run in &logs.runs {
        let stride = (run.rate_hz / (EVALUATION_RATE * layout.cutoff_hz)).max(1.0) as usize;
        let motion = MotionRecord::of_run(run, stride).evaluate(robot, frame);
        let filter = LowPass::new(ORDER, layout.cutoff_hz, run.rate_hz)?;
        let effort = |joint: &PreparedJoint| {
            let mut effort = joint.effort.clone();
            filter.apply(&mut effort);
            effort.into_iter().step_by(stride).collect::<Vec<f64>>()
        };
        let measured: Vec<Vec<f64>> = run.joints.iter().map(effort).collect();
        all.extend(layout.information_along(&motion, Some(&measured), 1)?);
    }
    ColumnInformation::sum(&all).ok_or(NextMotionError::NoRuns)
}

#[cfg(test)]
mod tests {
    use catalogue::EffectKind;
    use effects::Place;

    use super::*;
    use crate::testing::{log, turntable};

    #[test]
    fn a_cause_has_the_size_at_which_it_explains_the_logs() {
        let mut robot = turntable();
        robot.link_mut(0).unwrap().actuator.viscous = 0.5;
        let cause = Hypothesis { kind: EffectKind::ViscousFriction, place: Place::Joint(0) };
        let layout = ColumnLayout {
            hypotheses: vec![cause],
            widths: vec![1],
            noise: vec![Some(1e-6)],
            cutoff_hz: 4.0,
        };
        let shaped = ShapedRobot::new(robot);
        let robot = &shaped.robot;
        let of_logs = Known::of_logs(&shaped, &layout, &log(robot, |v| 0.2 * v)).unwrap();
        let found = of_logs.weights(&layout, robot, &[cause]);
        assert!((found[0] - 0.2).abs() < 1e-4, "{found}");
        // Without logs, a tenth of the effort limit at the largest usable speed.
        let of_limits = Known::of_limits(&shaped, &layout);
        let found = of_limits.weights(&layout, robot, &[cause]);
        assert!((found[0] - 0.1 * 50.0 / 2.4).abs() < 1e-12, "{found}");
        assert!(of_limits.information.xx.iter().all(|x| x.abs() <= 0.0));
    }
}
