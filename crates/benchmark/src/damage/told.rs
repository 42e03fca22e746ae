use population::{LogKind, LogSpoiling};

use crate::damage::answer::DamageAnswer;

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
        words(damage.kind).iter().any(|word| text.contains(word)) && (!has_place || place(text))
    })
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

/// Words that name a kind of damage in a sentence of the program; a column and row at fault name what is in single
/// rows.
fn words(kind: LogKind) -> &'static [&'static str] {
    match kind {
        LogKind::EffortSign | LogKind::PositionSign => &["other sign"],
        LogKind::EffortsExchanged => &["exchanged"],
        LogKind::EffortUnit | LogKind::EffortInAmperes => &["another unit", ".effort, row"],
        LogKind::EffortWithoutGravity => &["torque of gravity", "without gravity"],
        LogKind::TimeUnit | LogKind::TimeStretched | LogKind::OtherClock => {
            &["what a second is", "clock"]
        }
        LogKind::StuckEncoder => &["stands still"],
        LogKind::HeldByLogger => &["stand still"],
        LogKind::Spikes => &["single samples", ".position, row"],
        LogKind::TurnJump => &["full turns"],
        LogKind::EffortZeros => &["zero", ".effort, row"],
        LogKind::EffortSpikes => &["single samples", "spike", ".effort, row"],
        LogKind::EffortWithoutSign => &["without a sign", "no sign", "never negative"],
        LogKind::BeyondStatedLimit => &["beyond the limit", "beyond its limit", "limit is wrong"],
        LogKind::NormalisedUnits => &["normalised"],
        LogKind::HeldValues => &["repeat", "held"],
        LogKind::LowRate => &["rate"],
        LogKind::NoNoise => &["noise"],
    }
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
