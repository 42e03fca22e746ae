use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use simulator::effects::EffectSpec;
use simulator::strangers::StrangerKind;

use crate::corner::ArmClass;
use crate::hidden::{HiddenKind, HiddenThings, SizedCause};
use crate::trial::pilot::Pilot;

/// Draws of one effect before it is skipped.
const TRIES: usize = 6;

/// Least and largest strength relative to the threshold of visibility; a fifth of draws is below it.
const STRENGTHS: [f64; 2] = [0.4, 25.0];

/// Kinds that can be hidden in an arm: all of the catalogue with these exceptions. Everyday friction is in
/// every arm, rotors may be missing in the nominal model anyway, and a saturated drive makes the controller
/// lose the arm. The friction of a differential and a counterbalance need an arm that has one, and late goals are those of
/// servos.
fn kinds(class: ArmClass) -> Vec<EffectKind> {
    use EffectKind as K;
    let left_out = |kind: &EffectKind| {
        matches!(
            kind,
            K::ViscousFriction
                | K::CoulombFriction
                | K::RotorInertia
                | K::TorqueSaturation
                | K::Counterbalance
                | K::GoalDelay
        ) || (*kind == K::DifferentialCoupling && class != ArmClass::Wam)
    };
    EffectKind::ALL.into_iter().filter(|kind| !left_out(kind)).collect()
}

impl HiddenThings {
    /// Draws causes and strangers, with strengths log-uniform around the threshold of visibility.
    pub fn draw(
        pilot: &Pilot<'_>,
        class: ArmClass,
        causes: usize,
        strangers: usize,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let kinds = kinds(class);
        let mut all = Self::default();
        for _ in 0..causes {
            all.add(pilot, random, |random| {
                HiddenKind::Cause(kinds[random.random_range(0..kinds.len())])
            });
        }
        for _ in 0..strangers {
            all.add(pilot, random, |random| {
                let number = random.random_range(0..StrangerKind::ALL.len());
                HiddenKind::Stranger(StrangerKind::ALL[number])
            });
        }
        all
    }

    fn add(
        &mut self,
        pilot: &Pilot<'_>,
        random: &mut ChaCha8Rng,
        kind: impl Fn(&mut ChaCha8Rng) -> HiddenKind,
    ) {
        let [least, largest] = STRENGTHS;
        for _ in 0..TRIES {
            let hidden = kind(random);
            let wanted = least * (largest / least).powf(random.random::<f64>());
            match pilot.spec_of_strength(hidden, wanted, random) {
                Some(SizedCause::Cause(effect)) if !self.holds(&effect) => {
                    self.causes.push(effect);
                    return;
                }
                Some(SizedCause::Stranger(stranger)) => {
                    self.strangers.push(stranger);
                    return;
                }
                _ => {}
            }
        }
    }

    /// Whether the same effect is hidden at the same place.
    fn holds(&self, effect: &EffectSpec) -> bool {
        let place = |effect: &EffectSpec| {
            let truth = effect.truth();
            (truth.effect, truth.joint, truth.link)
        };
        self.causes.iter().any(|other| place(other) == place(effect))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::path::Path;

    use motion::State;
    use rand_chacha::rand_core::SeedableRng;
    use robot::{JointKind, Robot};
    use simulator::effects::{JointLevel, Surroundings};
    use simulator::strangers::StrangerSpec;

    use super::*;
    use crate::bench::{BenchWishes, LabBench, draw_bench};
    use crate::corner::MotionClass;
    use crate::dice::between;
    use crate::rigid::{mass_matrix, torque};
    use crate::robot_shares::RobotShares;
    use crate::trial::background::{draw_friction, effects};
    use crate::trial::field::faults::FieldFaults;
    use crate::trial::pilot::SHARES;

    const SEEDS: u64 = 40;
    const SAMPLED_S: f64 = 0.05;

    fn bench(class: ArmClass, seed: u64) -> LabBench {
        let wishes = BenchWishes {
            classes: vec![class],
            motions: MotionClass::ALL.to_vec(),
            logs: [1, 1],
            log_s: [5.0, 5.0],
            instruments: None,
        };
        draw_bench(&wishes, &mut ChaCha8Rng::seed_from_u64(seed)).unwrap()
    }

    /// Root mean square of each joint over the rows of a motion.
    fn rms(rows: &[Vec<f64>]) -> Vec<f64> {
        let square = |j: usize| rows.iter().map(|row| row[j] * row[j]).sum::<f64>();
        (0..rows[0].len()).map(|j| (square(j) / rows.len() as f64).sqrt()).collect()
    }

    fn differences(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let slopes = |w: &[Vec<f64>]| -> Vec<f64> {
            w[1].iter().zip(&w[0]).map(|(after, before)| (after - before) / SAMPLED_S).collect()
        };
        rows.windows(2).map(slopes).collect()
    }

    /// What surrounds every joint in the first motion of a bench, along its plan.
    fn with_surroundings(
        robot: &Robot,
        bench: &LabBench,
        visit: &mut dyn FnMut(&Surroundings<'_>),
    ) {
        let motion = bench.runs[0].motion.build(robot, Path::new("")).unwrap();
        let [mut q, mut qd, mut qdd, mut tau] = [const { Vec::new() }; 4];
        for k in 0..(motion.duration_s() / SAMPLED_S) as usize {
            let mut state = State::default();
            motion.sample(SAMPLED_S * k as f64, &mut state);
            tau.push(torque(robot, &state.q, &state.qd, &state.qdd));
            q.push(state.q);
            qd.push(state.qd);
            qdd.push(state.qdd);
        }
        let inertia = mass_matrix(robot, &q[0]);
        let [speed, acceleration, load] = [rms(&qd), rms(&qdd), rms(&tau)];
        let load_rate = rms(&differences(&tau));
        let level = |(torque_rms, speed_rms)| JointLevel { torque_rms, speed_rms };
        let joints: Vec<JointLevel> =
            load.iter().copied().zip(speed.iter().copied()).map(level).collect();
        for joint in 0..robot.joint_count() {
            let positions = q.iter().map(|row| row[joint]);
            visit(&Surroundings {
                robot,
                joint,
                torque_rms: load[joint],
                speed_rms: speed[joint],
                acceleration_rms: acceleration[joint],
                range: (
                    positions.clone().fold(f64::INFINITY, f64::min),
                    positions.fold(f64::NEG_INFINITY, f64::max),
                ),
                torque_rate_rms: load_rate[joint],
                inertia: inertia[(joint, joint)],
                joints: &joints,
            });
        }
    }

    /// Everyday friction, strong friction, causes and strangers at every joint of every kind of arm, from the
    /// least share of the torque to the largest.
    #[test]
    fn a_scenario_takes_whatever_is_drawn() {
        let (mut drawn, mut sliding) = (0, 0);
        let mut refused: BTreeMap<String, usize> = BTreeMap::new();
        for &class in ArmClass::ALL {
            for seed in 0..SEEDS {
                let mut bench = bench(class, seed);
                let mut random = ChaCha8Rng::seed_from_u64(seed);
                let shares = RobotShares { strong_friction: 0.5, ..RobotShares::default() };
                let faults = FieldFaults::draw(&shares, &mut bench, &random).unwrap();
                let robot = bench.truth.load().unwrap().robot;
                let usual = draw_friction(&robot, &bench.friction, &mut random);
                let mut check = |what: String, refusal: Option<simulator::effects::Mistake>| {
                    drawn += 1;
                    if let Some(m) = refusal {
                        *refused.entry(format!("{what} {}: {}", m.key, m.found)).or_default() += 1;
                    }
                };
                for effect in effects(&robot, &faults.friction(usual)) {
                    check(format!("friction of a {class}"), effect.inject(&robot).err());
                }
                with_surroundings(&robot, &bench, &mut |at| {
                    let slides = robot.links()[at.joint].joint.kind == JointKind::Prismatic;
                    sliding += usize::from(slides);
                    let mut share = || {
                        SHARES[0] * (SHARES[1] / SHARES[0]).powf(between(&mut random, [0.0, 1.0]))
                    };
                    let sizes = [share(), SHARES[1]];
                    for share in sizes {
                        for kind in kinds(class) {
                            let effect = EffectSpec::draw(kind, at, share, &mut random);
                            let sized = SizedCause::Cause(effect).within_workshops();
                            let SizedCause::Cause(effect) = sized else { continue };
                            check(format!("{kind} of a {class}"), effect.inject(&robot).err());
                        }
                        for &kind in StrangerKind::ALL {
                            if kind.fits(&robot, at.joint) {
                                let stranger = StrangerSpec::draw(kind, at, share, &mut random);
                                check(
                                    format!("{kind} of a {class}"),
                                    stranger.inject(&robot).err(),
                                );
                            }
                        }
                    }
                });
            }
        }
        assert!(drawn > 5000 && sliding > 10, "{drawn} drawn, {sliding} sliding axes");
        assert!(refused.is_empty(), "of {drawn} drawn: {refused:#?}");
    }
}
