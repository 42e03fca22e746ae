use catalogue::EffectKind;
use nalgebra::DMatrix;
use robot::Robot;
use simulator::Truth;
use simulator::scenario::RunSpec;

use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::sheet::CauseRole;
use crate::trial::differences::Difference;
use crate::trial::field::tool::SampledTool;

/// A payload that the later logs have and the earlier ones lack.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChangedPayload {
    /// The payload.
    pub load: SampledTool,
    /// First log that has it.
    pub from: usize,
}

impl ChangedPayload {
    /// The payload in the second half of the runs; `None` for fewer than two.
    pub fn new(load: SampledTool, runs: &mut [RunSpec]) -> Option<Self> {
        let from = runs.len().div_ceil(2);
        let late = runs.get_mut(from..).filter(|late| !late.is_empty())?;
        late.iter_mut().for_each(|run| run.effect.push(load.payload()));
        Some(Self { load, from })
    }

    /// The payload as a cause: the torque of its body along the motion of the logs that have it.
    pub fn difference(&self, robot: &Robot, runs: &[SeenRun]) -> Option<Difference> {
        let link = robot.links().iter().position(|link| link.name == self.load.link)?;
        let (body, joints) = (self.load.body.parameters(), robot.joint_count());
        let torque = |(number, run): (usize, &SeenRun)| {
            let mut torque = DMatrix::zeros(run.rows(), joints);
            if number < self.from {
                return torque;
            }
            for i in 0..run.rows() {
                let mut tau = vec![0.0; joints];
                run.moving(robot, i).add_body(link, &body, &mut tau);
                tau.iter().enumerate().for_each(|(j, tau)| torque[(i, j)] = *tau);
            }
            torque
        };
        let c = self.load.body.com_in_link;
        let parameters =
            [("mass", self.load.body.mass), ("com_x", c.x), ("com_y", c.y), ("com_z", c.z)];
        Some(Difference {
            role: CauseRole::Hidden,
            truth: Truth::at_link(EffectKind::Payload, &self.load.link, &parameters),
            column: TorqueColumn {
                stands_for: StandIn::Itself,
                torque: runs.iter().enumerate().map(torque).collect(),
                prior: 0.0,
            },
        })
    }
}
