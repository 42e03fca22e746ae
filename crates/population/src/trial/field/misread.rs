use logs::Run;
use nalgebra::{DMatrix, Unit};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{JointKind, Robot};

use crate::corner::FieldFeature;
use crate::dice::happens;
use crate::moving::body_torque;
use crate::oracle::motion::SeenRun;
use crate::robot_files::RobotFiles;
use crate::sheet::{Strength, TrueStranger};

/// Joints that a description and the logs do not mean alike: of no name in the catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Misreading {
    /// The nominal model calls two joints by each other's name.
    NamesExchanged([usize; 2]),
    /// Two joints have each other's columns in the logs.
    ColumnsExchanged([usize; 2]),
    /// An axis of the nominal model is turned round.
    AxisTurned(usize),
}

impl Misreading {
    /// Two turning joints exchanged, in the model or in the logs; `None` where there are no two.
    pub fn draw_exchange(robot: &Robot, random: &mut ChaCha8Rng) -> Option<Self> {
        let turns = |i: &usize| robot.links()[*i].joint.kind != JointKind::Prismatic;
        let mut joints: Vec<usize> = (0..robot.joint_count()).filter(turns).collect();
        let in_model = happens(random, 0.5);
        if joints.len() < 2 {
            return None;
        }
        let one = joints.swap_remove(random.random_range(0..joints.len()));
        let other = joints[random.random_range(0..joints.len())];
        let pair = [one.min(other), one.max(other)];
        Some(if in_model { Self::NamesExchanged(pair) } else { Self::ColumnsExchanged(pair) })
    }

    /// The axis of a joint turned round.
    pub fn draw_turn(robot: &Robot, random: &mut ChaCha8Rng) -> Self {
        Self::AxisTurned(random.random_range(0..robot.joint_count()))
    }

    /// What it is called in the corner of a trial.
    pub fn feature(self) -> FieldFeature {
        match self {
            Self::NamesExchanged(_) => FieldFeature::JointsExchanged,
            Self::ColumnsExchanged(_) => FieldFeature::ColumnsExchanged,
            Self::AxisTurned(_) => FieldFeature::AxisTurned,
        }
    }

    /// The nominal model with it.
    pub fn model(self, files: &RobotFiles, robot: &Robot) -> RobotFiles {
        let name = |i: usize| robot.links()[i].joint.name.as_str();
        match self {
            Self::NamesExchanged([one, other]) => RobotFiles {
                urdf: exchange(&files.urdf, name(one), name(other)),
                toml: exchange(&files.toml, name(one), name(other)),
            },
            Self::ColumnsExchanged(_) => files.clone(),
            Self::AxisTurned(joint) => {
                RobotFiles { urdf: turn_axis(&files.urdf, name(joint)), ..files.clone() }
            }
        }
    }

    /// Applies it to logs.
    pub fn spoil(self, runs: &mut [Run]) {
        let Self::ColumnsExchanged([one, other]) = self else { return };
        for run in runs {
            let name = |i: usize| run.joints[i].name.clone();
            let names = [name(one), name(other)];
            run.joints.swap(one, other);
            let [first, second] = names;
            run.joints[one].name = first;
            run.joints[other].name = second;
        }
    }

    /// Its entry in the sheet, with the torques of the true arm misread so:
    ///
    /// ```text
    /// share = root of the mean of the sum over j of (tau_misread - tau)^2 / scale^2
    /// exchanged   tau_misread = P bodies(P q, P qd, P qdd),   P exchanges the two joints
    /// turned      tau_misread = bodies of the arm with that axis turned (q, qd, qdd)
    /// ```
    ///
    /// `sigmas` assumes a noise of a hundredth of the torque in every sample.
    pub fn true_stranger(self, robot: &Robot, runs: &[SeenRun], scales: &[f64]) -> TrueStranger {
        let turned = self.turned_arm(robot);
        let order = self.order(robot.joint_count());
        let (mut sum, mut count) = (0.0_f64, 0_u32);
        let mut tau = vec![0.0; robot.joint_count()];
        let mut misread = tau.clone();
        for run in runs {
            for i in 0..run.rows() {
                let of = |m: &DMatrix<f64>, order: &[usize]| {
                    order.iter().map(|j| m[(i, *j)]).collect::<Vec<f64>>()
                };
                let plain: Vec<usize> = (0..tau.len()).collect();
                let at = |order| [&run.q, &run.qd, &run.qdd].map(|m| of(m, order));
                let ([q, qd, qdd], [pq, pqd, pqdd]) = (at(&plain), at(&order));
                body_torque(robot, &q, &qd, &qdd, &mut tau);
                body_torque(&turned, &pq, &pqd, &pqdd, &mut misread);
                let off = |j: usize| (misread[order[j]] - tau[j]) / scales[j];
                sum += (0..tau.len()).map(|j| off(j).powi(2)).sum::<f64>();
                count += 1;
            }
        }
        let share = (sum / f64::from(count.max(1))).sqrt();
        let sigmas = 100.0 * share * f64::from(count).sqrt();
        let joint = match self {
            Self::AxisTurned(joint) => robot.joint_names().nth(joint).map(str::to_owned),
            Self::NamesExchanged(_) | Self::ColumnsExchanged(_) => None,
        };
        let name = match self {
            Self::NamesExchanged(_) => "model: joints exchanged",
            Self::ColumnsExchanged(_) => "log: columns exchanged",
            Self::AxisTurned(_) => "model: axis turned",
        };
        let strength = Strength { sigmas, share, torque: share };
        TrueStranger { name: name.to_owned(), joint, strength, spoiling: None }
    }

    /// The true arm with the axis that the model has turned.
    fn turned_arm(self, robot: &Robot) -> Robot {
        let mut turned = robot.clone();
        if let Self::AxisTurned(joint) = self
            && let Some(link) = turned.link_mut(joint)
        {
            let axis = -link.joint.axis_in_joint.into_inner();
            link.joint.axis_in_joint = Unit::new_unchecked(axis);
        }
        turned
    }

    /// The joint that is read for each.
    fn order(self, joints: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..joints).collect();
        if let Self::NamesExchanged([one, other]) | Self::ColumnsExchanged([one, other]) = self {
            order.swap(one, other);
        }
        order
    }
}

/// A description in which two joints have each other's name.
fn exchange(text: &str, one: &str, other: &str) -> String {
    let quoted = |name: &str| [format!("\"{name}\""), format!("[joint.{name}]")];
    let mut text = text.to_owned();
    // No name of a joint has a line feed.
    for (from, to) in [(one, "\n"), (other, one), ("\n", other)] {
        for (from, to) in quoted(from).into_iter().zip(quoted(to)) {
            text = text.replace(&from, &to);
        }
    }
    text
}

/// A URDF with the axis of a joint turned round.
fn turn_axis(urdf: &str, joint: &str) -> String {
    const START: &str = "<axis xyz=\"";
    let place = || {
        let from = urdf.find(&format!("<joint name=\"{joint}\""))?;
        let start = from + urdf[from..].find(START)? + START.len();
        Some(start..start + urdf[start..].find('"')?)
    };
    let Some(place) = place() else { return urdf.to_owned() };
    let turn = |number: &str| match number.parse::<f64>() {
        Ok(number) if number.abs() > 0.0 => (-number).to_string(),
        _ => number.to_owned(),
    };
    let turned: Vec<String> = urdf[place.clone()].split_whitespace().map(turn).collect();
    [&urdf[..place.start], &turned.join(" "), &urdf[place.end..]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    const URDF: &str = r#"<robot name="arm"><link name="base"/>
        <link name="l1"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
        <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
        <link name="l2"><inertial><origin xyz="0.1 0 0"/><mass value="1"/>
        <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
        <joint name="one" type="continuous"><parent link="base"/><child link="l1"/><axis xyz="0 -1 0"/></joint>
        <joint name="two" type="continuous"><parent link="l1"/><child link="l2"/><origin xyz="1 0 0"/><axis xyz="0 -1 0"/></joint>
        </robot>"#;

    fn arm() -> Robot {
        Robot::from_urdf(URDF).unwrap()
    }

    fn files() -> RobotFiles {
        let toml = "[joint.one]\nkp_nm_per_rad = 1.0\n[joint.two]\nkp_nm_per_rad = 2.0\n";
        RobotFiles { urdf: URDF.to_owned(), toml: toml.to_owned() }
    }

    /// At rest at `q = (0, 0)`: `tau = 9.81 (2 * .5 + 1.1, .1)` N m.
    fn still() -> SeenRun {
        let zero = DMatrix::zeros(4, 2);
        SeenRun {
            step_s: 0.02,
            thinned: 1,
            q: zero.clone(),
            qd: zero.clone(),
            qdd: zero.clone(),
            effort: zero.clone(),
            beyond: zero,
        }
    }

    #[test]
    fn exchanged_names_are_exchanged_in_both_files_and_twice_is_none() {
        let model = Misreading::NamesExchanged([0, 1]).model(&files(), &arm());
        let robot = Robot::from_urdf(&model.urdf).unwrap();
        assert_eq!(robot.joint_names().collect::<Vec<_>>(), ["two", "one"]);
        assert!(model.toml.starts_with("[joint.two]\nkp_nm_per_rad = 1.0"));
        assert_eq!(Misreading::NamesExchanged([0, 1]).model(&model, &arm()), files());
    }

    #[test]
    fn a_turned_axis_is_turned_in_the_model_alone_and_weighs_twice_the_torque() {
        let model = Misreading::AxisTurned(1).model(&files(), &arm());
        let turned = Robot::from_urdf(&model.urdf).unwrap();
        let of = |robot: &Robot, i: usize| robot.links()[i].joint.axis_in_joint.into_inner();
        assert_eq!(of(&turned, 1), -of(&arm(), 1));
        assert_eq!(of(&turned, 0), of(&arm(), 0));
        let told = Misreading::AxisTurned(1).true_stranger(&arm(), &[still()], &[1.0, 0.981]);
        assert!((told.strength.share - 2.0).abs() < 1e-9, "{}", told.strength.share);
        assert_eq!(told.joint.as_deref(), Some("two"));
    }

    /// Exchanged, each joint seems to carry what the other does: off by `9.81 (2.1 - .1)` N m at both.
    #[test]
    fn exchanged_columns_are_off_by_the_difference_of_the_torques() {
        let fault = Misreading::ColumnsExchanged([0, 1]);
        let told = fault.true_stranger(&arm(), &[still()], &[1.0, 1.0]);
        let expected = 2.0_f64.sqrt() * 9.81 * 2.0;
        assert!((told.strength.share - expected).abs() < 1e-9, "{}", told.strength.share);
        assert_eq!(told.joint, None);
    }
}
