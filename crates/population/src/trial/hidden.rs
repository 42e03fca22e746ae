use catalogue::EffectKind;
use simulator::effects::EffectSpec;
use simulator::strangers::{StrangerKind, StrangerSpec};

/// Kind of a hidden cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HiddenKind {
    /// An effect of the catalogue.
    Cause(EffectKind),
    /// An effect outside the catalogue.
    Stranger(StrangerKind),
}

/// Everything hidden in an arm beyond everyday friction.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct HiddenThings {
    /// Effects of the catalogue.
    pub causes: Vec<EffectSpec>,
    /// Effects outside the catalogue.
    pub strangers: Vec<StrangerSpec>,
}

/// An effect or a stranger with a size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SizedCause {
    /// Of the catalogue.
    Cause(EffectSpec),
    /// Outside the catalogue.
    Stranger(StrangerSpec),
}
