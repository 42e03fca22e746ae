use robot::Robot;

use crate::columns::design::Design;
use crate::error::DiagnosisError;
use crate::outcome::findings::Findings;
use crate::progress::Silent;
use crate::result::{Finding, RuledOut};
use crate::search::inputs::Inputs;
use crate::settings::Settings;
use crate::signals::log::Log;

/// Findings between motors and links, as second encoders at the links show them.
#[derive(Debug)]
pub(crate) struct SecondEncoder {
    pub found: Vec<Finding>,
    pub ruled_out: Vec<RuledOut>,
    /// Number of hypotheses that were looked for.
    pub hypotheses: usize,
    /// The robot with the findings.
    pub robot: Robot,
}

impl SecondEncoder {
    /// Number of findings at a joint.
    pub fn at(&self, joint: &str) -> usize {
        self.found.iter().filter(|f| f.at.joint.as_deref() == Some(joint)).count()
    }
}

/// Looks for effects between the two encoders of a joint, in the position that the first reports minus that of the
/// second. `None` where no joint has two encoders.
///
/// ```text
/// reported - q = (q + load / elasticity + x) / transmission_ratio + encoder_offset - q + noise
/// ```
///
/// with `|x| <= backlash / 2` on the side of the load. The load is what the links of the robot `about` carry along
/// the motion of the second encoders. Search, tests, sizes and intervals are those for the efforts. These four
/// effects count from the `nominal` robot, whatever `about` states of them.
pub(crate) fn compare_encoders(
    about: &Robot,
    nominal: &Robot,
    settings: &Settings,
    log: &Log,
    inadequate: &[Option<String>],
) -> Result<Option<SecondEncoder>, DiagnosisError> {
    let compare = |inputs: &Inputs| {
        inputs.with_dataset(|dataset| {
            let causes = inputs.find_causes(dataset, &Silent)?;
            let Findings { found, ruled_out, .. } = inputs.findings(dataset, &causes)?;
            Ok(SecondEncoder {
                found: found.into_iter().map(|f| f.finding).collect(),
                ruled_out,
                hypotheses: causes.problem.design.groups.len(),
                robot: causes.fitted.robot,
            })
        })?
    };
    with_encoder_inputs(about, nominal, settings, log, inadequate, compare)
}

/// Calls `work` with the inputs of a search between two encoders. `None` where no joint has two encoders.
pub(crate) fn with_encoder_inputs<T>(
    about: &Robot,
    nominal: &Robot,
    settings: &Settings,
    log: &Log,
    inadequate: &[Option<String>],
    work: impl FnOnce(&Inputs) -> Result<T, DiagnosisError>,
) -> Result<Option<T>, DiagnosisError> {
    let log = log.of_twist();
    let rows = log.rows();
    if !rows.contains(&true) {
        return Ok(None);
    }
    let robot = &with_nominal_transmissions(about, nominal, &rows);
    let design = &Design::new(robot, &log)?;
    work(&Inputs { nominal, robot, settings, log, design, inadequate }).map(Some)
}

/// The robot `about` with the nominal transmissions of the joints of `rows`.
fn with_nominal_transmissions(about: &Robot, nominal: &Robot, rows: &[bool]) -> Robot {
    let mut robot = about.clone();
    for (j, link) in nominal.links().iter().enumerate().filter(|(j, _)| rows[*j]) {
        let Some(changed) = robot.link_mut(j) else { continue };
        let (drive, before) = (&mut changed.actuator, &link.actuator);
        drive.elasticity = before.elasticity;
        drive.backlash = before.backlash;
        drive.encoder_offset = before.encoder_offset;
        drive.transmission_ratio = before.transmission_ratio;
    }
    robot
}
