use catalogue::EffectKind;

/// How the columns of an effect depend on the robot about which they are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Linearity {
    /// They are the same however large the effect.
    Exact,
    /// They are those of a small change: about a robot that has it, or other effects, they are others.
    Tangent,
}

/// Whether something else may pass for an effect: its columns are made of the model's own torque, which is wrong
/// wherever something else is, or have a shape that was chosen among many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Imitable {
    Yes,
    No,
}

/// How far the law of an effect holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// One size holds everywhere.
    Firm,
    /// Sizes differ with speed, position or load.
    Rough,
}

/// Where an effect lies, seen from the first encoder of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seat {
    /// Between that encoder and the link: a second one at the link shows it.
    BeforeTheLink,
    /// Anywhere else.
    Elsewhere,
}

/// How a weight tells its parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weights {
    /// It is the change of the parameter of the same index.
    Direct,
    /// It is the change of the reciprocal of that parameter.
    Reciprocal,
    /// How large the effect would have to be to be seen is told of this parameter.
    SeenBy(usize),
    /// The first two are one size in two phases.
    Phases,
}

/// Where a form of dry friction differs from Coulomb friction of one level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shows {
    /// Near rest.
    NearRest,
    /// At other positions than those of a log that does not show it.
    AtOtherPositions,
}

/// What an effect is to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// It makes the size of that effect of the same joint vary, which shows there.
    FormOf(EffectKind, Shows),
    /// It is these effects of the same place together.
    Together(&'static [EffectKind]),
    /// It is another name for changes of the same numbers.
    OtherNameOf(EffectKind),
    /// It has the same columns about a robot without either.
    TwinOf(EffectKind),
    /// That effect at the same place has the name where it does the work.
    PlainerHere(EffectKind),
    /// The same of that effect at the joint that carries the link.
    PlainerAtTheJoint(EffectKind),
    /// The same of these at every joint that it reaches: what it explains is what it adds to them.
    PlainerAtEveryJoint(&'static [EffectKind]),
}

/// What is known of an effect before any log.
///
/// Every effect states all of it in its own file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Nature {
    /// How its columns depend on the robot.
    pub linearity: Linearity,
    /// Whether an error elsewhere, or one of many trial shapes, may pass for it.
    pub imitable: bool,
    /// How far its law holds.
    pub law: Law,
    /// Where it lies.
    pub seat: Seat,
    /// How its weights tell its parameters.
    pub weights: Weights,
    /// What it is to other effects.
    pub relations: &'static [Relation],
}

impl Nature {
    /// All that is known of an effect.
    pub(crate) const fn new(
        linearity: Linearity,
        imitable: Imitable,
        law: Law,
        seat: Seat,
        weights: Weights,
        relations: &'static [Relation],
    ) -> Self {
        let imitable = matches!(imitable, Imitable::Yes);
        Self { linearity, imitable, law, seat, weights, relations }
    }

    /// Whether what it explains is what it adds to its plainer rivals at every joint.
    pub fn adds_to_the_plain(self) -> bool {
        self.relations.iter().any(|r| matches!(r, Relation::PlainerAtEveryJoint(_)))
    }

    /// Effects that together are this one.
    pub fn together(self) -> &'static [EffectKind] {
        let parts = |r: &Relation| match r {
            Relation::Together(kinds) => Some(*kinds),
            _ => None,
        };
        self.relations.iter().find_map(parts).unwrap_or_default()
    }

    /// The effect whose size it makes vary, and where that shows.
    pub fn form_of(self) -> Option<(EffectKind, Shows)> {
        let form = |r: &Relation| match r {
            Relation::FormOf(kind, shows) => Some((*kind, *shows)),
            _ => None,
        };
        self.relations.iter().find_map(form)
    }
}
