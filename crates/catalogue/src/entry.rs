use crate::family::Family;
use crate::kind::EffectKind;

/// One parameter of an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Name, as in `diagnosis.json`.
    pub name: &'static str,
    /// Unit for a revolute joint.
    pub unit: &'static str,
    /// Unit for a prismatic joint.
    pub unit_prismatic: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Lowest and highest plausible value on an arm of the size of a Barrett WAM, in `unit`:
    /// shoulder and elbow, where it is a parameter of a joint. Published values where there
    /// are any, otherwise round judgement.
    pub typical: (f64, f64),
}

/// The description of an effect, in words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectEntry {
    /// The effect.
    pub kind: EffectKind,
    /// The family.
    pub family: Family,
    /// The name in words, for sentences.
    pub words: &'static str,
    /// What it is, in a few words.
    pub summary: &'static str,
    /// What it adds to the torque.
    pub equation: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Its signature in a log.
    pub signature: &'static str,
    /// What a log must contain to reveal it.
    pub needs: &'static str,
    /// Effects with which it is confused because they can produce the same torque.
    pub confused_with: &'static [EffectKind],
    /// The motion that distinguishes it from those.
    pub told_apart_by: &'static str,
    /// Where the model comes from.
    pub source: &'static str,
}

/// Units of a torque and of a position, at a revolute and at a prismatic joint.
pub(crate) const TORQUE: [&str; 2] = ["N m", "N"];
pub(crate) const POSITION: [&str; 2] = ["rad", "m"];

/// A unit that is the same at every joint.
pub(crate) const fn always(unit: &'static str) -> [&'static str; 2] {
    [unit, unit]
}

/// A parameter with its units at a revolute and at a prismatic joint.
pub(crate) const fn parameter(
    name: &'static str,
    [unit, unit_prismatic]: [&'static str; 2],
    meaning: &'static str,
    typical: (f64, f64),
) -> Parameter {
    Parameter { name, unit, unit_prismatic, meaning, typical }
}

/// The phase of something periodic at position or time zero.
pub(crate) const fn phase(meaning: &'static str) -> Parameter {
    parameter("phase", always("rad"), meaning, (-std::f64::consts::PI, std::f64::consts::PI))
}
