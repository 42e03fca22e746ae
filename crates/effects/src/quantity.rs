use catalogue::EffectKind;
use robot::{Actuator, Robot};

/// A parameter of an effect as the user reads it.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectQuantity {
    /// Name, as in the catalogue.
    pub name: &'static str,
    /// Value.
    pub value: f64,
    /// Value in the nominal robot.
    pub nominal: f64,
    /// Unit.
    pub unit: &'static str,
}

/// Name and unit of parameter `index` of `kind` at joint `joint`.
pub(crate) fn name_and_unit(
    kind: EffectKind,
    index: usize,
    robot: &Robot,
    joint: usize,
) -> (&'static str, &'static str) {
    let parameter = kind.entry().parameters[index];
    let rotation = robot.links().get(joint).is_none_or(|l| l.joint.kind.is_rotation());
    (parameter.name, if rotation { parameter.unit } else { parameter.unit_prismatic })
}

/// A parameter with its values by `read` from the actuator of `joint` in both robots.
pub(crate) fn actuator_quantity(
    kind: EffectKind,
    index: usize,
    joint: usize,
    [nominal, extended]: [&Robot; 2],
    read: impl Fn(&Actuator) -> f64,
) -> EffectQuantity {
    let (name, unit) = name_and_unit(kind, index, nominal, joint);
    let value = |r: &Robot| r.links().get(joint).map_or(f64::NAN, |l| read(&l.actuator));
    EffectQuantity { name, value: value(extended), nominal: value(nominal), unit }
}
