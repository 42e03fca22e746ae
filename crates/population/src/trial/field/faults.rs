use logs::Run;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::Robot;
use simulator::effects::EffectSpec;

use crate::bench::LabBench;
use crate::corner::{EffortClass, FieldFeature};
use crate::dice::happens;
use crate::error::PopulationError;
use crate::hidden::HiddenThings;
use crate::oracle::motion::SeenRun;
use crate::robot_shares::RobotShares;
use crate::sheet::TrueStranger;
use crate::trial::background::Friction;
use crate::trial::differences::{Difference, Drives};
use crate::trial::field::delay::delay_of_all;
use crate::trial::field::friction::{strong, with_levels};
use crate::trial::field::inertial::with_hand;
use crate::trial::field::misread::Misreading;
use crate::trial::field::mount;
use crate::trial::field::payload::ChangedPayload;
use crate::trial::field::tool::SampledTool;
use crate::trial::field::wrong_urdf::WrongUrdf;

/// Streams of random numbers, one a feature: a feature that is added or left out shifts no other draw.
#[derive(Debug, Clone, Copy)]
enum Stream {
    WrongUrdf = 1,
    Friction = 2,
    Delay = 3,
    Exchange = 4,
    Turn = 5,
    Mount = 6,
    Tool = 7,
    Payload = 8,
}

impl Stream {
    /// The generator of a feature in the attempt that `main` draws.
    ///
    /// ```text
    /// stream = 2^32 feature + attempt
    /// ```
    fn open(self, main: &ChaCha8Rng) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::from_seed(main.get_seed());
        random.set_stream(((self as u64) << 32) + main.get_stream());
        random
    }
}

/// What a trial has of robots in use. Nothing is drawn where all shares are zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct FieldFaults {
    /// Their names, in the order of [`FieldFeature::ALL`].
    pub features: Vec<FieldFeature>,
    /// Strong Coulomb friction of each joint that has it (N m or N).
    levels: Vec<Option<f64>>,
    /// Effects in all runs.
    effects: Vec<EffectSpec>,
    /// The payload of the later runs.
    payload: Option<ChangedPayload>,
    /// Joints that model and logs do not mean alike.
    misreadings: Vec<Misreading>,
}

impl FieldFaults {
    /// Draws them and puts those of the nominal model and of single runs into the bench.
    ///
    /// # Errors
    ///
    /// [`PopulationError`] where the bench's robot or a motion cannot be read.
    pub fn draw(
        shares: &RobotShares,
        bench: &mut LabBench,
        main: &ChaCha8Rng,
    ) -> Result<Self, PopulationError> {
        let mut faults = Self::default();
        if shares.is_none() {
            return Ok(faults);
        }
        let robot = bench.truth.load()?.robot;
        faults.draw_models(shares, bench, &robot, main)?;
        faults.draw_drives(shares, bench, &robot, main)?;
        faults.draw_readings(shares, bench, &robot, main);
        faults.features.sort_unstable();
        faults.features.dedup();
        Ok(faults)
    }

    /// Wrong bodies, tools and payloads.
    fn draw_models(
        &mut self,
        shares: &RobotShares,
        bench: &mut LabBench,
        robot: &Robot,
        main: &ChaCha8Rng,
    ) -> Result<(), PopulationError> {
        let mut random = Stream::Tool.open(main);
        let taken_off = happens(&mut random, shares.tools_taken_off);
        let Some(tool) = SampledTool::draw(robot, &mut random) else { return Ok(()) };

        let mut random = Stream::WrongUrdf.open(main);
        if happens(&mut random, shares.wrong_urdfs) {
            let drives = match bench.effort {
                EffortClass::JointTorque => Drives::Unseen,
                EffortClass::Command | EffortClass::Current => Drives::Seen,
            };
            let given = (&bench.nominal, &tool);
            let wrong = WrongUrdf::draw(&bench.truth.urdf, robot, given, drives, &mut random)?;
            bench.nominal = wrong.model;
            self.features.extend(wrong.errors);
        }
        let has_tool = [FieldFeature::ToolTakenOff, FieldFeature::ToolUnknown];
        let has_tool = has_tool.map(|feature| self.features.contains(&feature));
        if has_tool[1] {
            self.effects.push(tool.payload());
        }
        if taken_off && has_tool == [false; 2] {
            bench.nominal.urdf = with_hand(&bench.nominal.urdf, &tool.link, &tool.body);
            self.features.push(FieldFeature::ToolTakenOff);
        }

        let mut random = Stream::Payload.open(main);
        let changes = happens(&mut random, shares.changed_payloads);
        if let Some(load) = SampledTool::draw(robot, &mut random)
            && changes
            && !has_tool[1]
        {
            self.payload = ChangedPayload::new(load, &mut bench.runs);
            self.features.extend(self.payload.iter().map(|_| FieldFeature::PayloadChanged));
        }
        Ok(())
    }

    /// Friction and late drives, where the effort shows them.
    fn draw_drives(
        &mut self,
        shares: &RobotShares,
        bench: &LabBench,
        robot: &Robot,
        main: &ChaCha8Rng,
    ) -> Result<(), PopulationError> {
        let mut random = Stream::Friction.open(main);
        let shows = bench.effort != EffortClass::JointTorque;
        if happens(&mut random, shares.strong_friction) && shows {
            self.levels = strong(robot, &bench.runs, &mut random)?;
            self.features.push(FieldFeature::StrongFriction);
        }
        let mut random = Stream::Delay.open(main);
        let is_command = bench.effort == EffortClass::Command;
        if happens(&mut random, shares.delayed_drives) && is_command {
            let rate = bench.control.rate_hz.or(bench.truth.load()?.control.rate_hz);
            let rate = rate.unwrap_or(500.0);
            self.effects.extend(delay_of_all(robot, &bench.sensors, rate, &mut random));
            self.features.push(FieldFeature::DelayedDrives);
        }
        Ok(())
    }

    /// Mounts, axes and joints that the model does not mean as the logs do.
    fn draw_readings(
        &mut self,
        shares: &RobotShares,
        bench: &mut LabBench,
        robot: &Robot,
        main: &ChaCha8Rng,
    ) {
        if happens(&mut Stream::Mount.open(main), shares.unknown_mounts) && mount::is_tilted(robot)
        {
            bench.nominal = mount::upright(&bench.nominal);
            self.features.push(FieldFeature::MountUnknown);
        }
        let mut random = Stream::Turn.open(main);
        if happens(&mut random, shares.turned_axes) {
            self.misreadings.push(Misreading::draw_turn(robot, &mut random));
        }
        let mut random = Stream::Exchange.open(main);
        if happens(&mut random, shares.exchanged_joints) {
            self.misreadings.extend(Misreading::draw_exchange(robot, &mut random));
        }
        for misreading in &self.misreadings {
            bench.nominal = misreading.model(&bench.nominal, robot);
            self.features.push(misreading.feature());
        }
    }

    /// Whether the nominal model says something of friction that roughly known values would replace.
    pub fn states_friction(&self) -> bool {
        self.features.contains(&FieldFeature::DummyDamping)
    }

    /// Everyday friction as strong as it is.
    pub fn friction(&self, everyday: Vec<Friction>) -> Vec<Friction> {
        with_levels(everyday, &self.levels)
    }

    /// Puts the effects of all runs in place of those of the same name and place.
    pub fn hide(&self, hidden: &mut HiddenThings) {
        let place = |effect: &EffectSpec| {
            let truth = effect.truth();
            (truth.effect, truth.joint, truth.link)
        };
        let load = self.payload.as_ref().map(|payload| payload.load.payload());
        let own: Vec<_> = self.effects.iter().chain(&load).map(place).collect();
        let is_mount = |effect: &EffectSpec| matches!(effect, EffectSpec::GravityDirection(_));
        let knows_mount = !self.features.contains(&FieldFeature::MountUnknown);
        hidden
            .causes
            .retain(|cause| !own.contains(&place(cause)) && (knows_mount || !is_mount(cause)));
        hidden.causes.extend(self.effects.iter().cloned());
    }

    /// Differences from the nominal model beyond bodies, friction and rotors.
    pub fn differences(
        &self,
        truth: &Robot,
        nominal: &Robot,
        runs: &[SeenRun],
    ) -> impl Iterator<Item = Difference> {
        let payload = self.payload.as_ref().and_then(|payload| payload.difference(truth, runs));
        payload.into_iter().chain(mount::difference(truth, nominal, runs))
    }

    /// Applies what is wrong with the logs.
    pub fn spoil(&self, runs: &mut [Run]) {
        self.misreadings.iter().for_each(|misreading| misreading.spoil(runs));
    }

    /// What has no name in the catalogue.
    pub fn strangers(
        &self,
        robot: &Robot,
        runs: &[SeenRun],
        scales: &[f64],
    ) -> impl Iterator<Item = TrueStranger> {
        self.misreadings.iter().map(move |one| one.true_stranger(robot, runs, scales))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{BenchWishes, draw_bench};
    use crate::corner::{ArmClass, MotionClass};

    fn bench(seed: u64) -> LabBench {
        let wishes = BenchWishes {
            classes: ArmClass::ALL.to_vec(),
            motions: MotionClass::ALL.to_vec(),
            logs: [1, 4],
            log_s: [5.0, 6.0],
            instruments: None,
        };
        draw_bench(&wishes, &mut ChaCha8Rng::seed_from_u64(seed)).unwrap()
    }

    fn drawn(shares: &RobotShares, seed: u64) -> (LabBench, FieldFaults) {
        let mut bench = bench(seed);
        let main = ChaCha8Rng::seed_from_u64(seed);
        let faults = FieldFaults::draw(shares, &mut bench, &main).unwrap();
        (bench, faults)
    }

    const ALL: RobotShares = RobotShares {
        wrong_urdfs: 1.0,
        strong_friction: 1.0,
        delayed_drives: 1.0,
        exchanged_joints: 1.0,
        turned_axes: 1.0,
        unknown_mounts: 1.0,
        tools_taken_off: 0.5,
        changed_payloads: 0.5,
    };

    /// A model can be read whatever is wrong with it, and everything comes up.
    #[test]
    fn every_feature_comes_up_and_leaves_a_model_that_can_be_read() {
        let mut all = Vec::new();
        for seed in 0..80 {
            let (bench, faults) = drawn(&ALL, seed);
            let nominal = bench.nominal.load().unwrap();
            let truth = bench.truth.load().unwrap();
            assert_eq!(nominal.robot.joint_count(), truth.robot.joint_count(), "{seed}");
            let rotors = nominal.robot.links().iter().map(|link| link.actuator.rotor_inertia);
            assert!(rotors.sum::<f64>() <= 0.0, "{seed}: a wrong model knows a rotor");
            all.extend(faults.features);
        }
        let missing: Vec<_> = FieldFeature::ALL.iter().filter(|f| !all.contains(f)).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }

    /// One feature more or less changes nothing of another one.
    #[test]
    fn features_do_not_shift_one_another() {
        for seed in 0..20 {
            let (_, all) = drawn(&ALL, seed);
            let (_, alone) =
                drawn(&RobotShares { strong_friction: 1.0, ..RobotShares::default() }, seed);
            assert_eq!(all.levels, alone.levels, "{seed}");
            let turned = RobotShares { turned_axes: 1.0, ..RobotShares::default() };
            assert_eq!(all.misreadings[0], drawn(&turned, seed).1.misreadings[0], "{seed}");
            let (plain, none) = drawn(&RobotShares::default(), seed);
            assert_eq!((plain, none), (bench(seed), FieldFaults::default()));
        }
    }
}
