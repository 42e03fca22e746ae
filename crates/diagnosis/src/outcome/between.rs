use robot::Robot;

use crate::columns::design::Design;
use crate::error::DiagnosisError;
use crate::outcome::told::Told;
use crate::progress::Silent;
use crate::result::{Finding, RuledOut};
use crate::search::study::Study;
use crate::settings::Settings;
use crate::signals::log::Log;
use crate::signals::look::Look;

/// What second encoders at the links show of what lies between motors and links.
#[derive(Debug)]
pub(crate) struct Between {
    pub found: Vec<Finding>,
    pub ruled_out: Vec<RuledOut>,
    /// Number of hypotheses that were looked for.
    pub hypotheses: usize,
    /// The robot with what was found.
    pub robot: Robot,
}

impl Between {
    /// Number of findings at a joint.
    pub fn at(&self, joint: &str) -> usize {
        self.found.iter().filter(|f| f.at.joint.as_deref() == Some(joint)).count()
    }
}

/// Looks for what lies between the two encoders of a joint, in what the first one reports beyond
/// the second; none where no joint has two.
///
/// ```text
/// reported - q = (q + load / elasticity + x) / transmission_ratio + encoder_offset - q + noise
/// ```
///
/// with `|x| <= backlash / 2` on the side of the load, and the load that the links of the robot
/// `about` carry along the motion that the second encoders saw. Search, tests, sizes and intervals
/// are those of the efforts. What `about` has been given of these four effects counts for nothing.
pub(crate) fn between(
    about: &Robot,
    nominal: &Robot,
    settings: &Settings,
    (log, inadequate): (&Log, &[Option<String>]),
) -> Result<Option<Between>, DiagnosisError> {
    let log = Log { tones: &[], limits: &[], look: Look::Twist, described: None, ..*log };
    let rows = log.rows();
    if !rows.contains(&true) {
        return Ok(None);
    }
    let mut robot = about.clone();
    for (j, link) in nominal.links().iter().enumerate().filter(|(j, _)| rows[*j]) {
        let Some(changed) = robot.link_mut(j) else { continue };
        let (drive, before) = (&mut changed.actuator, &link.actuator);
        drive.elasticity = before.elasticity;
        drive.backlash = before.backlash;
        drive.encoder_offset = before.encoder_offset;
        drive.transmission_ratio = before.transmission_ratio;
    }
    let design = Design::new(&robot, &log)?;
    let (robot, design) = (&robot, &design);
    let study = Study { nominal, robot, settings, log, design, inadequate };
    study.with_record(|record| {
        let conclusion = study.conclusion(record, &Silent)?;
        let Told { found, ruled_out, .. } = study.told(record, &conclusion);
        Ok(Some(Between {
            found: found.into_iter().map(|f| f.finding).collect(),
            ruled_out,
            hypotheses: conclusion.problem.design.groups.len(),
            robot: conclusion.solution.robot,
        }))
    })?
}
