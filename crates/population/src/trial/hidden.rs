use catalogue::EffectKind;
use simulator::effects::EffectSpec;
use simulator::strangers::{StrangerKind, StrangerSpec};

/// A kind of what is hidden.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HiddenKind {
    /// An effect of the catalogue.
    Cause(EffectKind),
    /// An effect of no catalogue.
    Stranger(StrangerKind),
}

/// What is hidden in an arm beyond everyday friction.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct HiddenThings {
    /// Effects of the catalogue.
    pub causes: Vec<EffectSpec>,
    /// Effects of no catalogue.
    pub strangers: Vec<StrangerSpec>,
}

/// An effect or a stranger with a size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SizedCause {
    /// Of the catalogue.
    Cause(EffectSpec),
    /// Of no catalogue.
    Stranger(StrangerSpec),
}
