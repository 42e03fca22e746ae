//! Generated serial arms.

use std::fmt::Write;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use robot::{Robot, SensingSide, TorqueSource};

use crate::arms::arm::{Base, RotorsKnown, SampledArm, dummy_dynamics, error_level};
use crate::arms::bodies::BodyError;
use crate::arms::chain::Chain;
use crate::arms::drives::{SampledDrive, accelerations, counterbalance, fit, put};
use crate::arms::electronics::Electronics;
use crate::arms::make::Make;
use crate::arms::urdf_text::urdf;
use crate::corner::ArmClass;
use crate::dice::{between, happens};
use crate::error::PopulationError;
use crate::instruments::Instrument;
use crate::robot_files::RobotFiles;

/// An arm of a class that is generated, with so many joints.
pub(crate) fn draw(
    class: ArmClass,
    count: usize,
    instrument: Instrument,
    random: &mut ChaCha8Rng,
) -> Result<SampledArm, PopulationError> {
    let make = Make::of(class);
    let chain = Chain::draw(class, count, random);
    let electronics = Electronics::draw(class, instrument, random);
    let base = Base::draw(random);
    let gravity = base.gravity(random);

    let unlimited = vec![1e9; chain.joints.len()];
    let bare = Robot::from_urdf(&urdf(&chain, &unlimited, None))?;
    let mut robot = bare.with_gravity(Vector3::from(gravity));
    let mut drives = fit(&mut robot, &make, &electronics, random);
    if class == ArmClass::Industrial && base != Base::Hanging && happens(random, 0.35) {
        balance(&mut robot, &mut drives, random);
    }

    let limits: Vec<f64> = drives.iter().map(|d| d.limit).collect();
    let rotors: Vec<f64> = drives.iter().map(|d| d.rotor).collect();
    let level = error_level(random);
    let errors: Vec<BodyError> =
        chain.joints.iter().map(|_| BodyError::draw(&make, level, random)).collect();
    let known = match RotorsKnown::draw(&electronics, random) {
        RotorsKnown::All => rotors.clone(),
        RotorsKnown::None => vec![0.0; rotors.len()],
    };
    let dummy = dummy_dynamics(class, random);
    let written = Written { chain: &chain, drives: &drives, gravity, base, electronics };
    Ok(SampledArm {
        truth: RobotFiles { urdf: urdf(&chain, &limits, None), toml: written.toml(&rotors) },
        nominal: RobotFiles {
            urdf: urdf(&chain.with_errors(&errors), &limits, dummy),
            toml: written.toml(&known),
        },
        accelerations: accelerations(&robot, &make, random),
        robot,
        electronics,
        kp: drives.iter().map(|d| d.kp).collect(),
        limits,
    })
}

/// Gives the first joint that has something to balance a spring that both sides know.
fn balance(robot: &mut Robot, drives: &mut [SampledDrive], random: &mut ChaCha8Rng) {
    let share = between(random, [0.3, 0.8]);
    for i in 0..drives.len().min(2) {
        let spring = counterbalance(robot, i, share, random);
        if spring[0] > 0.0 {
            drives[i].spring = spring;
            put(robot, drives);
            return;
        }
    }
}

/// What `robot.toml` is written from.
struct Written<'a> {
    chain: &'a Chain,
    drives: &'a [SampledDrive],
    gravity: [f64; 3],
    base: Base,
    electronics: Electronics,
}

impl Written<'_> {
    fn toml(&self, rotors: &[f64]) -> String {
        let sensing = match self.electronics.sensing() {
            SensingSide::Link => "link",
            SensingSide::Motor | SensingSide::Unknown => "motor",
        };
        let source = match self.electronics.torque_source() {
            TorqueSource::Measured => "measured",
            TorqueSource::Current => "current",
            TorqueSource::Commanded | TorqueSource::Unknown => "commanded",
        };
        let mut text = format!(
            "urdf = \"robot.urdf\"\ncontrol_rate_hz = {:?}\nsensing = \"{sensing}\"\ntorque_source = \"{source}\"\n",
            self.electronics.control_rate_hz
        );
        if self.base != Base::Upright {
            text += &format!("gravity_m_per_s2 = {:?}\n", self.gravity);
        }
        for ((joint, drive), rotor) in self.chain.joints.iter().zip(self.drives).zip(rotors) {
            // Writing to a string cannot fail.
            let _ = write!(text, "\n# Gear 1 : {:.0}.\n[joint.{}]\n", drive.gear, joint.name);
            if *rotor > 0.0 {
                let _ = writeln!(text, "rotor_inertia_kg_m2 = {rotor:?}");
            }
            let [stiffness, rest] = drive.spring;
            if stiffness > 0.0 {
                let _ = writeln!(text, "spring_stiffness_nm_per_rad = {stiffness:?}");
                let _ = writeln!(text, "spring_rest_rad = {rest:?}");
            }
            let _ = writeln!(text, "torque_limit_nm = {:?}", drive.limit);
            let _ = writeln!(text, "kp_nm_per_rad = {:?}", drive.kp);
            let _ = writeln!(text, "kd_nm_s_per_rad = {:?}", drive.kd);
        }
        text
    }
}
