use catalogue::EffectKind;
use effects::{Hypothesis, Place, hypotheses};
use robot::Robot;

use crate::design_error::DesignError;
use crate::effect_name::find_effect;
use crate::error::CliError;

/// A cause as it is typed: `FR01@elbow`, `payload@hand`, `gravity_direction`.
pub fn parse(text: &str, robot: &Robot) -> Result<Hypothesis, CliError> {
    let (effect, place) = text.split_once('@').map_or((text, None), |(e, p)| (e, Some(p)));
    Ok(at(find_effect(effect)?, place, robot)?)
}

/// An effect at a joint or a link of this name, or at the base.
pub fn at(kind: EffectKind, place: Option<&str>, robot: &Robot) -> Result<Hypothesis, DesignError> {
    if let Err(reason) = effects::model(kind) {
        return Err(DesignError::NoModel { effect: kind.label(), reason });
    }
    let own: Vec<Hypothesis> = hypotheses(robot).into_iter().filter(|h| h.kind == kind).collect();
    let found = own.iter().copied().find(|&h| place_name(h, robot) == place);
    found.ok_or_else(|| {
        let places: Vec<&str> = own.iter().filter_map(|&h| place_name(h, robot)).collect();
        DesignError::Place {
            effect: kind.label(),
            found: place.unwrap_or("no place").to_owned(),
            expected: if own.is_empty() {
                "an effect that this robot can have and that a motion of two minutes shows"
                    .to_owned()
            } else if places.is_empty() {
                "no place".to_owned()
            } else {
                format!("one of {}", places.join(", "))
            },
        }
    })
}

/// The name of the joint or link where a cause acts, none at the base.
pub fn place_name(cause: Hypothesis, robot: &Robot) -> Option<&str> {
    match cause.place {
        Place::Joint(joint) => robot.links().get(joint).map(|l| l.joint.name.as_str()),
        Place::Link(link) => robot.links().get(link).map(|l| l.name.as_str()),
        Place::Base => None,
    }
}

/// A cause in words, such as `FR01 viscous friction at elbow`.
pub fn words(cause: Hypothesis, robot: &Robot) -> String {
    match place_name(cause, robot) {
        Some(place) => format!("{} at {place}", cause.kind.label()),
        None => cause.kind.label(),
    }
}
