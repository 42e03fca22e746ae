use catalogue::EffectKind;

/// How the columns of an effect depend on the robot about which they are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Linearity {
    /// They are the same however large the effect.
    Exact,
    /// They are those of a small change: about a robot that has it, or other effects, they are others.
    Tangent,
    /// They are besides made of the model's own torque, which is wrong wherever something else is, or
    /// have a shape that was chosen among many.
    Doubtful,
}

/// Where a form of dry friction differs from Coulomb friction of one level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shows {
    /// Near rest.
    NearRest,
    /// At other positions than those of a log that does not show it.
    AtOtherPositions,
}

/// Effects that have the name where they do the work of another, alone or together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plainer {
    /// There are none.
    Nothing,
    /// This one at the same place.
    Here(EffectKind),
    /// This one at the joint that carries the link.
    AtTheJoint(EffectKind),
    /// These at every joint that the other reaches: what it explains is what it adds to them.
    AtEveryJoint(&'static [EffectKind]),
}

/// What is known of an effect before any log.
///
/// Every effect states all of it in its own file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Nature {
    /// How its columns depend on the robot.
    pub linearity: Linearity,
    /// Whether the law holds roughly: its sizes differ with speed, position or load.
    pub is_rough: bool,
    /// Whether it lies between the first encoder of a joint and the link.
    pub is_before_the_link: bool,
    /// Whether its weights are reciprocals of its parameters.
    pub is_reciprocal: bool,
    /// The effect of the same joint whose size it makes vary, and where that shows.
    pub form_of: Option<(EffectKind, Shows)>,
    /// Effects of the same place that together are this one.
    pub together: &'static [EffectKind],
    /// Another name for changes of the same numbers.
    pub other_name: Option<EffectKind>,
    /// The effect of the same columns about a robot without either.
    pub twin: Option<EffectKind>,
    /// Effects that have the name where they do its work.
    pub plainer: Plainer,
    /// The parameter that tells how large it would have to be to be seen; that of the weight where none.
    pub seen_by: Option<usize>,
    /// Number of its first columns that are one size in several phases.
    pub phases: usize,
}
