use catalogue::EffectKind;

/// How the columns of an effect depend on the robot for which they are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Linearity {
    /// They are the same for every size of the effect.
    Exact,
    /// They hold for a small change only, and depend on the effects that the robot already has.
    Tangent,
}

/// Whether another error may imitate an effect. Its columns are made of the model's own torque, which any other error
/// changes, or have a shape that was chosen among many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Imitable {
    Yes,
    No,
}

/// How far the law of an effect holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// One size holds everywhere.
    Exact,
    /// Sizes differ with speed, position or load.
    Approximate,
}

/// Where an effect lies relative to the first encoder of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Location {
    /// Between that encoder and the link: a second one at the link shows it.
    BeforeTheLink,
    /// Anywhere else.
    Elsewhere,
}

/// How the weights are related to the parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weights {
    /// A weight is the change of the parameter of the same index.
    Direct,
    /// A weight is the change of the reciprocal of that parameter.
    Reciprocal,
    /// The size that the logs would show is reported as the parameter with this index.
    SeenBy(usize),
    /// The first two weights are one size in two phases.
    Phases,
}

/// Where a form of dry friction differs from Coulomb friction of one level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RevealedBy {
    /// Near rest.
    NearRest,
    /// At other positions than those of a log that does not show it.
    AtOtherPositions,
}

/// How an effect is related to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// It makes the size of that effect at the same joint vary, and shows under this condition.
    FormOf(EffectKind, RevealedBy),
    /// It is the sum of these effects at the same place.
    Together(&'static [EffectKind]),
    /// It is another name for changes of the same numbers.
    OtherNameOf(EffectKind),
    /// It has the same columns about a robot without either.
    TwinOf(EffectKind),
    /// That effect at the same place is simpler, and is named instead where it explains the same.
    PlainerHere(EffectKind),
    /// The same for that effect at the joint that carries the link.
    PlainerAtTheJoint(EffectKind),
    /// The same for these effects at every joint that it reaches: it counts only for what it explains beyond them.
    PlainerAtEveryJoint(&'static [EffectKind]),
}

/// What is known of an effect before any log.
///
/// Every effect states all of it in its own file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Traits {
    /// How its columns depend on the robot.
    pub linearity: Linearity,
    /// Whether an error elsewhere, or one of many trial shapes, may imitate it.
    pub imitable: bool,
    /// How far its law holds.
    pub law: Law,
    /// Where it lies.
    pub location: Location,
    /// How its weights are related to its parameters.
    pub weights: Weights,
    /// How it is related to other effects.
    pub relations: &'static [Relation],
}

impl Traits {
    /// All that is known of an effect.
    pub(crate) const fn new(
        linearity: Linearity,
        imitable: Imitable,
        law: Law,
        location: Location,
        weights: Weights,
        relations: &'static [Relation],
    ) -> Self {
        let imitable = matches!(imitable, Imitable::Yes);
        Self { linearity, imitable, law, location, weights, relations }
    }

    /// Whether it counts only for what it explains beyond simpler effects at every joint.
    pub fn adds_to_the_plain(self) -> bool {
        self.relations.iter().any(|r| matches!(r, Relation::PlainerAtEveryJoint(_)))
    }

    /// Effects whose sum is this one.
    pub fn together(self) -> &'static [EffectKind] {
        let parts = |r: &Relation| match r {
            Relation::Together(kinds) => Some(*kinds),
            _ => None,
        };
        self.relations.iter().find_map(parts).unwrap_or_default()
    }

    /// The effect whose size it makes vary, and where that shows.
    pub fn form_of(self) -> Option<(EffectKind, RevealedBy)> {
        let form = |r: &Relation| match r {
            Relation::FormOf(kind, shows) => Some((*kind, *shows)),
            _ => None,
        };
        self.relations.iter().find_map(form)
    }
}
