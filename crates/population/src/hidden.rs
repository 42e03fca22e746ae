use catalogue::EffectKind;
use simulator::effects::EffectSpec;
use simulator::strangers::{StrangerKind, StrangerSpec};

/// Which of several hidden things.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Which {
    /// A cause, by number.
    Cause(usize),
    /// A stranger, by number.
    Stranger(usize),
}

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

impl HiddenThings {
    /// One thing alone.
    pub fn of(sized: SizedCause) -> Self {
        match sized {
            SizedCause::Cause(effect) => Self { causes: vec![effect], ..Self::default() },
            SizedCause::Stranger(stranger) => Self { strangers: vec![stranger], ..Self::default() },
        }
    }

    /// All but one.
    pub fn without(&self, which: Which) -> Self {
        let mut rest = self.clone();
        match which {
            Which::Cause(k) => drop(rest.causes.remove(k)),
            Which::Stranger(k) => drop(rest.strangers.remove(k)),
        }
        rest
    }
}

/// An effect or a stranger with a size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SizedCause {
    /// Of the catalogue.
    Cause(EffectSpec),
    /// Outside the catalogue.
    Stranger(StrangerSpec),
}
