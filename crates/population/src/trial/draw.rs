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
