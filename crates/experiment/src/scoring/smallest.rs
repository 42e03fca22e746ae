use catalogue::EffectKind;
use diagnosis::{EffectAt, RuledOut};
use simulator::Truth;

use crate::scoring::size::{Size, injected_amount};

/// Smallest detectable size over half a 95 per cent interval: 3.65 standard errors, at which a
/// two-sided test at level 0.005 finds four of five, over 1.96.
const SMALLEST_OVER_HALF: f64 = 3.65 / 1.96;

/// Size of an effect over the smallest size that its logs would have shown:
///
/// ```text
/// size / (1.86 half)                where it is named, half its 95 per cent interval of noise,
/// size / smallest detectable size   where the diagnosis says what it would have found
/// ```
///
/// for the parameter with the largest ratio. It is zero where the diagnosis states that the logs could show no size.
/// For a spring the ratio is inverted: a softer one shows more. `None` where the diagnosis states neither, and for
/// the body of a link, whose size is a change of a whole that only the robot states.
pub(super) fn of_smallest(
    truth: &Truth,
    (at, sizes): (&EffectAt, &[Size]),
    ruled_out: &[RuledOut],
) -> Option<f64> {
    if truth.effect == EffectKind::InertialParameters {
        return None;
    }
    let named = sizes.iter().filter_map(|size| {
        let estimate = size.estimate.as_ref().filter(|estimate| estimate.determined)?;
        let [low, high] = estimate.noise95.unwrap_or(estimate.ci95);
        let half = 0.5 * (high - low);
        Some(injected_amount(truth, &size.name)? / (SMALLEST_OVER_HALF * half))
    });
    let missed = ruled_out.iter().filter(|r| r.at == *at).filter_map(|ruled_out| {
        let size = injected_amount(truth, ruled_out.parameter)?;
        Some(match ruled_out.smallest_detectable {
            Some(largest) if truth.effect == EffectKind::JointElasticity => largest / size,
            Some(smallest) => size / smallest,
            None => 0.0,
        })
    });
    named.chain(missed).filter(|ratio| ratio.is_finite()).max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scoring::size::Estimated;

    fn at(effect: EffectKind) -> EffectAt {
        EffectAt { effect, joint: Some("elbow".to_owned()), link: None }
    }

    fn rule_out(effect: EffectKind, smallest: Option<f64>) -> RuledOut {
        RuledOut {
            at: at(effect),
            parameter: effect.entry().parameters[0].name,
            smallest_detectable: smallest,
            unit: "",
            because: String::new(),
        }
    }

    #[test]
    fn a_missed_effect_is_measured_by_what_would_have_been_found() {
        let kind = EffectKind::CoulombFriction;
        let truth = Truth::at_joint(kind, "elbow", &[("level", 0.5)]);
        let of = |ruled_out: &[RuledOut]| of_smallest(&truth, (&at(kind), &[]), ruled_out);
        assert_eq!(of(&[rule_out(kind, Some(0.25))]), Some(2.0));
        assert_eq!(of(&[rule_out(kind, None)]), Some(0.0));
        assert_eq!(of(&[rule_out(EffectKind::Backlash, Some(0.25))]), None);

        let kind = EffectKind::JointElasticity;
        let truth = Truth::at_joint(kind, "elbow", &[("stiffness", 50.0)]);
        let of = |size| of_smallest(&truth, (&at(kind), &[]), &[rule_out(kind, Some(size))]);
        assert_eq!((of(100.0), of(25.0)), (Some(2.0), Some(0.5)));

        let kind = EffectKind::TorqueConstant;
        let truth = Truth::at_joint(kind, "elbow", &[("gain", 0.9)]);
        let ratio = of_smallest(&truth, (&at(kind), &[]), &[rule_out(kind, Some(0.05))]);
        assert!((ratio.unwrap() - 2.0).abs() < 1e-9, "a tenth from 1");
    }

    #[test]
    fn a_named_effect_is_measured_by_its_interval() {
        let truth = Truth::at_joint(EffectKind::CoulombFriction, "elbow", &[("level", 0.73)]);
        let estimate = |determined| Estimated {
            value: 0.7,
            ci95: [0.3, 1.1],
            noise95: Some([0.504, 0.896]),
            determined,
            covers: true,
            relative_error: None,
        };
        let size = |determined| Size {
            name: "level".to_owned(),
            truth: 0.73,
            estimate: Some(estimate(determined)),
        };
        let of = |size: Size| of_smallest(&truth, (&at(truth.effect), &[size]), &[]);
        assert!((of(size(true)).unwrap() - 2.0).abs() < 1e-9);
        assert_eq!(of(size(false)), None);
    }

    #[test]
    fn the_body_of_a_link_has_no_size_of_its_own() {
        let kind = EffectKind::InertialParameters;
        let truth = Truth::at_joint(kind, "elbow", &[("mass", 0.5)]);
        assert_eq!(of_smallest(&truth, (&at(kind), &[]), &[rule_out(kind, Some(0.1))]), None);
    }
}
