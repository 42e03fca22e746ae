use std::f64::consts::TAU;

use catalogue::EffectKind;
use diagnosis::Estimate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simulator::Truth;

use crate::scoring::stored;

/// A parameter of an injected effect, and its estimate in a diagnosis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Size {
    /// Name of the parameter, as in the catalogue.
    pub name: String,
    /// The injected value.
    #[serde(deserialize_with = "stored::number")]
    pub truth: f64,
    /// The estimate, where the effect is named at its place.
    pub estimate: Option<Estimated>,
}

/// An estimate, stated in the way of the injected value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Estimated {
    /// Best value.
    #[serde(deserialize_with = "stored::number")]
    pub value: f64,
    /// 95 per cent interval.
    #[serde(deserialize_with = "stored::interval")]
    pub ci95: [f64; 2],
    /// The same for noise alone; `None` in scores that were stored before the two differed.
    #[serde(default, deserialize_with = "stored::known_interval")]
    pub noise95: Option<[f64; 2]>,
    /// Whether the logs determine the value.
    pub determined: bool,
    /// Whether the interval contains the injected value.
    pub covers: bool,
    /// `|value - truth| / size`. The size is that of the number itself, of the vector for a component, and one turn
    /// for a phase. `None` for a number that is zero.
    pub relative_error: Option<f64>,
}

impl Size {
    /// The parameters of `truth`, each with its estimate in a finding that names the effect.
    pub fn all(truth: &Truth, estimates: &[Estimate]) -> Vec<Self> {
        let size = |(name, &value): (&String, &f64)| {
            let of = estimates.iter().find(|estimate| estimate.name == name);
            let estimate = of.map(|estimate| on_truth_scale(truth, value, estimate));
            Self { name: name.clone(), truth: value, estimate }
        };
        truth.parameters.iter().map(size).collect()
    }
}

fn on_truth_scale(truth: &Truth, value: f64, estimate: &Estimate) -> Estimated {
    let to_injected_scale = |number: f64| match statement_of(truth.effect, estimate.name) {
        Stated::Added => number - estimate.nominal,
        Stated::Factor => number / estimate.nominal,
        Stated::Whole => number,
    };
    // The turn in which a phase lies means nothing.
    let turns = |number: f64| TAU * ((value - number) / TAU).round();
    let shift = if estimate.name == "phase" { turns(estimate.value) } else { 0.0 };
    let on_its_scale = |interval: [f64; 2]| interval.map(|end| to_injected_scale(end) + shift);
    let [low, high] = on_its_scale(estimate.ci95);
    let best = to_injected_scale(estimate.value) + shift;
    let size = magnitude(truth, estimate.name);
    Estimated {
        value: best,
        ci95: [low, high],
        noise95: Some(on_its_scale(estimate.noise95)),
        determined: estimate.determined,
        covers: (low..=high).contains(&value),
        relative_error: (size > 0.0).then(|| (best - value).abs() / size),
    }
}

/// How the simulator states an injected parameter, relative to the value of the resulting robot.
/// with.
enum Stated {
    /// A change, added to the described value.
    Added,
    /// A factor of the described value.
    Factor,
    /// The resulting value itself.
    Whole,
}

fn statement_of(effect: EffectKind, parameter: &str) -> Stated {
    use EffectKind as E;
    match (effect, parameter) {
        (E::TorqueConstant, "gain") | (E::TransmissionRatio, "ratio") => Stated::Factor,
        (E::ViscousFriction, "viscous")
        | (E::CoulombFriction, "level")
        | (E::AsymmetricFriction, "forward" | "backward")
        | (E::StribeckFriction, "coulomb" | "breakaway")
        | (E::PreslidingFriction | E::PositionDependentFriction, "level")
        | (E::RotorInertia, "inertia")
        | (E::TorqueOffset, "offset")
        | (E::CableSpring, "stiffness")
        | (E::Backlash, "gap")
        | (E::ActuatorDelay, "delay") => Stated::Added,
        _ => Stated::Whole,
    }
}

/// The injected amount of a parameter: the length of a vector, the distance of a factor from 1, or else the number.
/// For a breakaway level it is the excess over the Coulomb level. `None` for a parameter without injection.
pub(super) fn injected_amount(truth: &Truth, name: &str) -> Option<f64> {
    let value = *truth.parameters.get(name)?;
    if (truth.effect, name) == (EffectKind::StribeckFriction, "breakaway") {
        return Some(value - truth.parameters.get("coulomb")?);
    }
    Some(match statement_of(truth.effect, name) {
        Stated::Factor => (value - 1.0).abs(),
        Stated::Added | Stated::Whole => magnitude(truth, name),
    })
}

/// The size that an error of a parameter is divided by.
fn magnitude(truth: &Truth, name: &str) -> f64 {
    if name == "phase" {
        return TAU;
    }
    let vector = ["com_", "tilt_", "force_"].into_iter().find(|vector| name.starts_with(vector));
    let own = |other: &str| vector.map_or(other == name, |vector| other.starts_with(vector));
    let parts = truth.parameters.iter().filter(|(other, _)| own(other));
    parts.map(|(_, value)| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(name: &'static str, value: f64, nominal: f64) -> Estimate {
        let ci95 = [value - 0.1, value + 0.1];
        Estimate { name, value, ci95, noise95: ci95, nominal, unit: "", determined: true }
    }

    fn only(truth: &Truth, estimates: &[Estimate]) -> Estimated {
        Size::all(truth, estimates)[0].estimate.clone().unwrap()
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-12, "{a} and {b}");
    }

    #[test]
    fn what_was_added_is_compared_with_what_is_beyond_the_description() {
        let truth = Truth::at_joint(EffectKind::RotorInertia, "elbow", &[("inertia", 0.2)]);
        let found = only(&truth, &[estimate("inertia", 0.55, 0.3)]);
        close(found.value, 0.25);
        close(found.ci95[0], 0.15);
        close(found.ci95[1], 0.35);
        close(found.relative_error.unwrap(), 0.25);
        assert!(found.covers);
    }

    #[test]
    fn a_gain_is_compared_with_the_factor_on_the_one_described() {
        let truth = Truth::at_joint(EffectKind::TorqueConstant, "elbow", &[("gain", 1.1)]);
        let found = only(&truth, &[estimate("gain", 2.64, 2.4)]);
        close(found.value, 1.1);
        close(found.relative_error.unwrap(), 0.0);
    }

    #[test]
    fn what_is_stated_in_whole_is_compared_in_whole() {
        let truth = Truth::at_link(EffectKind::InertialParameters, "arm", &[("mass", 2.0)]);
        let found = only(&truth, &[estimate("mass", 2.2, 1.5)]);
        close(found.value, 2.2);
        assert!(!found.covers, "1.9 is below 2.1");
        close(found.relative_error.unwrap(), 0.1);
    }

    #[test]
    fn a_phase_is_compared_in_the_nearest_turn_and_a_component_by_its_vector() {
        let truth = Truth::at_joint(EffectKind::TorqueRipple, "elbow", &[("phase", 3.1)]);
        let found = only(&truth, &[estimate("phase", -3.1, 0.0)]);
        close(found.value, TAU - 3.1);
        assert!(found.covers);
        close(found.relative_error.unwrap(), (TAU - 6.2) / TAU);

        let com = [("com_x", 0.03), ("com_y", 0.04), ("mass", 1.0)];
        let truth = Truth::at_link(EffectKind::Payload, "palm", &com);
        close(only(&truth, &[estimate("com_x", 0.04, 0.0)]).relative_error.unwrap(), 0.2);
    }

    #[test]
    fn what_is_not_estimated_or_zero_has_no_error() {
        let truth = Truth::at_joint(EffectKind::CableSpring, "elbow", &[("cubic", 0.0)]);
        assert_eq!(only(&truth, &[estimate("cubic", 0.5, 0.0)]).relative_error, None);
        assert_eq!(Size::all(&truth, &[estimate("rest", 0.5, 0.0)])[0].estimate, None);
        let mut broken = estimate("cubic", 0.0, 0.0);
        broken.ci95 = [f64::NAN; 2];
        assert!(!only(&truth, &[broken]).covers);
    }
}
