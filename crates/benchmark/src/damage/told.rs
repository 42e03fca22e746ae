use catalogue::EffectKind;
use population::{LogKind, LogSpoiling};

use crate::damage::answer::DamageAnswer;
use crate::panel::spoiling_phrases::spoiling_phrases;

/// Name of the run with another clock.
const OTHER_CLOCK: &str = "log_2";

/// Whether an answer says more of spoilt logs than of the same logs before, names the damage, and has its place: one
/// of its joints, or the run with another clock.
pub(crate) fn is_told(before: &DamageAnswer, after: &DamageAnswer, damage: &LogSpoiling) -> bool {
    let new = after.said.iter().filter(|text| !before.said.contains(text));
    let place = |text: &str| match damage.kind {
        LogKind::OtherClock => text.contains(OTHER_CLOCK),
        _ => text.contains("all joints") || damage.joints.iter().any(|joint| text.contains(joint)),
    };
    let has_place = !is_of_all(damage.kind);
    new.into_iter().any(|text| {
        spoiling_phrases(damage.kind).iter().any(|phrase| text.contains(phrase))
            && (!has_place || place(text))
    })
}

/// Whether an effect is the damage by another name: efforts that are off by a share of their own at every joint are what
/// a torque constant does.
pub(crate) fn is_effect(damage: LogKind, effect: EffectKind) -> bool {
    damage == LogKind::EffortInAmperes && effect == EffectKind::TorqueConstant
}

/// Whether it is of no joint and no run.
fn is_of_all(kind: LogKind) -> bool {
    matches!(
        kind,
        LogKind::EffortUnit
            | LogKind::EffortWithoutGravity
            | LogKind::TimeUnit
            | LogKind::TimeStretched
            | LogKind::HeldByLogger
            | LogKind::EffortWithoutSign
            | LogKind::EffortInAmperes
            | LogKind::HeldValues
            | LogKind::NormalisedUnits
            | LogKind::LowRate
            | LogKind::NoNoise
    )
}

#[cfg(test)]
mod tests {
    use diagnosis::Verdict;

    use super::*;

    fn answer(said: &[&str]) -> DamageAnswer {
        let said = said.iter().map(|&text| text.to_owned()).collect();
        DamageAnswer { verdict: Verdict::DataInadequate, names: Vec::new(), said }
    }

    #[test]
    fn what_is_told_has_the_word_and_the_place_and_is_new() {
        let sign = LogSpoiling {
            kind: LogKind::EffortSign,
            joints: vec!["elbow".to_owned()],
            size: None,
            readable: true,
        };
        let says = |text: &str| is_told(&answer(&[]), &answer(&[text]), &sign);
        let sentence = "The effort of joint elbow seems to have the other sign.";
        assert!(says(sentence));
        assert!(!says("The effort of joint wrist seems to have the other sign."));
        assert!(!says("The effort of joint elbow is at its limit."));
        assert!(!is_told(&answer(&[sentence]), &answer(&[sentence]), &sign));
        let clock = LogSpoiling { kind: LogKind::OtherClock, ..sign };
        let said = |text: &str| is_told(&answer(&[]), &answer(&[text]), &clock);
        assert!(said("run log_2 disagrees on what a second is"));
        assert!(!said("run log_1 disagrees on what a second is"));
    }
}
