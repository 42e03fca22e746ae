use catalogue::{EffectKind, Parameter};
use experiment::{Injected, Score};
use serde::Serialize;

use crate::statistics::share::Share;
use crate::tables::tally::TrialGroup;

/// Number of classes by size.
const CLASSES: usize = 3;

/// How often an effect is named, by its injected size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Power {
    /// The injected effect.
    #[serde(rename = "put_in")]
    pub injected: TrialGroup,
    /// The parameter that stands for its size.
    pub parameter: &'static str,
    /// Its unit at a revolute joint.
    pub unit: &'static str,
    /// Classes of equal number of trials, smaller sizes first.
    pub classes: Vec<SizeClass>,
}

/// Trials of similar size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizeClass {
    /// Least and largest size.
    pub sizes: [f64; 2],
    /// Trials in which the effect was named first, at its place.
    pub exactly: Share,
}

impl Power {
    /// One entry for every kind that was injected alone and has a size, by code.
    pub fn all(scores: &[Score]) -> Vec<Self> {
        let mut kinds = EffectKind::ALL;
        kinds.sort_by_key(|kind| kind.code());
        kinds.into_iter().filter_map(|kind| Self::of(kind, scores)).collect()
    }

    fn of(kind: EffectKind, scores: &[Score]) -> Option<Self> {
        let parameter = size_of(kind)?;
        let sized = scores.iter().filter_map(|score| {
            let [injected] = &score.injected[..] else { return None };
            let own = injected.at.effect == kind && score.looked_for;
            own.then(|| size(injected, parameter).map(|size| (size, score))).flatten()
        });
        let mut sized: Vec<(f64, &Score)> = sized.collect();
        sized.sort_by(|(a, one), (b, other)| a.total_cmp(b).then(one.seed.cmp(&other.seed)));
        let class = |i: usize| {
            let trials = &sized[i * sized.len() / CLASSES..(i + 1) * sized.len() / CLASSES];
            let sizes = [trials.first()?.0, trials.last()?.0];
            Some(SizeClass { sizes, exactly: Share::of(trials, |(_, score)| score.exactly) })
        };
        let classes: Vec<SizeClass> = (0..CLASSES).filter_map(class).collect();
        let (injected, unit) = (TrialGroup::Kind(kind), parameter.unit);
        (!classes.is_empty()).then_some(Self { injected, parameter: parameter.name, unit, classes })
    }
}

/// The parameter that stands for the size of an effect; `None` for a body, which is injected as a whole.
fn size_of(kind: EffectKind) -> Option<&'static Parameter> {
    let parameters = kind.entry().parameters;
    let parameter_named = |name| parameters.iter().find(|parameter| parameter.name == name);
    match kind {
        EffectKind::InertialParameters => None,
        EffectKind::DifferentialCoupling => parameter_named("level_sum"),
        EffectKind::PreslidingFriction => parameter_named("level"),
        EffectKind::FrictionTemperatureDrift => parameter_named("share"),
        _ => parameters.first(),
    }
}

/// Injected size: the length of a vector, the distance of a factor from 1, or the number.
fn size(injected: &Injected, parameter: &Parameter) -> Option<f64> {
    let value = |name: &str| injected.sizes.iter().find(|s| s.name == name).map(|s| s.truth);
    match parameter.name {
        "tilt_1" => Some(value("tilt_1")?.hypot(value("tilt_2")?)),
        "gain" | "ratio" => Some((value(parameter.name)? - 1.0).abs()),
        name => Some(value(name)?.abs()),
    }
}
