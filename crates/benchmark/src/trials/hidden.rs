use std::fmt;
use std::str::FromStr;

use catalogue::{EffectKind, UnknownEffect};

/// Hidden effects in the arm of a trial. Joint or link, size and shape follow from the seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Hidden {
    /// None: every finding is false.
    Nothing,
    /// One effect of a kind.
    One(EffectKind),
    /// One effect of a kind that the diagnosis does not look for, and so cannot name.
    Unknown(EffectKind),
    /// The same, where the diagnosis also does not look for effects that the catalogue lists as confused with it.
    WithoutRelatives(EffectKind),
    /// Two effects, each drawn from the two kinds; both may be of one kind at two places.
    Two(EffectKind, EffectKind),
    /// Two effects of any kinds that the scenario draws from.
    AnyTwo,
}

const CLEAN: &str = "clean";
const UNKNOWN: &str = "without_";
const STRANGE: &str = "strange_";
const ANY_TWO: &str = "any+any";

impl Hidden {
    /// The corresponding settings of a scenario, as `--set` takes them; other keys of its `hidden` stay.
    pub fn settings(self) -> Vec<String> {
        let drawn = match self {
            Self::Nothing => return vec!["hidden.count=[0, 0]".to_owned()],
            Self::AnyTwo => return vec!["hidden.count=[2, 2]".to_owned()],
            Self::One(kind) | Self::Unknown(kind) | Self::WithoutRelatives(kind) => vec![kind],
            Self::Two(a, b) => vec![a, b],
        };
        let (count, names) = (drawn.len(), drawn.iter().map(|kind| format!("'{kind}'")));
        let names: Vec<String> = names.collect();
        vec![
            format!("hidden.count=[{count}, {count}]"),
            format!("hidden.from=[{}]", names.join(", ")),
        ]
    }

    /// The effects that the diagnosis does not look for.
    pub(super) fn without(self) -> Vec<EffectKind> {
        match self {
            Self::Unknown(kind) => vec![kind],
            Self::WithoutRelatives(kind) => {
                std::iter::once(kind).chain(kind.entry().confused_with.iter().copied()).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The same in a fixed order of two effects.
    pub(super) fn in_order(self) -> Self {
        match self {
            Self::Two(a, b) if b < a => Self::Two(b, a),
            other => other,
        }
    }
}

/// Name of the folder of its trials, such as `clean`, `backlash`, `without_backlash`, `strange_backlash`,
/// `backlash+payload` and `any+any`.
impl fmt::Display for Hidden {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => f.write_str(CLEAN),
            Self::AnyTwo => f.write_str(ANY_TWO),
            Self::Unknown(kind) => write!(f, "{UNKNOWN}{kind}"),
            Self::WithoutRelatives(kind) => write!(f, "{STRANGE}{kind}"),
            Self::One(kind) => write!(f, "{kind}"),
            Self::Two(a, b) => write!(f, "{a}+{b}"),
        }
    }
}

impl FromStr for Hidden {
    type Err = UnknownEffect;

    /// Reads what [`fmt::Display`] writes; codes are accepted instead of names.
    fn from_str(text: &str) -> Result<Self, UnknownEffect> {
        match text.split_once('+') {
            None if text == CLEAN => Ok(Self::Nothing),
            None => match (text.strip_prefix(UNKNOWN), text.strip_prefix(STRANGE)) {
                (Some(kind), _) => Ok(Self::Unknown(kind.parse()?)),
                (_, Some(kind)) => Ok(Self::WithoutRelatives(kind.parse()?)),
                (None, None) => Ok(Self::One(text.parse()?)),
            },
            Some(_) if text == ANY_TWO => Ok(Self::AnyTwo),
            Some((a, b)) => Ok(Self::Two(a.parse()?, b.parse()?)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hidden_is_read_back_from_its_name() {
        use EffectKind::{Backlash, Payload};
        let two = [Hidden::Two(Backlash, Payload), Hidden::AnyTwo];
        let one = [Hidden::Nothing, Hidden::One(Backlash)];
        let unknown = [Hidden::Unknown(Backlash), Hidden::WithoutRelatives(Backlash)];
        for hidden in one.into_iter().chain(unknown).chain(two) {
            assert_eq!(hidden.to_string().parse(), Ok(hidden));
        }
        assert_eq!("TR01".parse(), Ok(Hidden::One(Backlash)));
        assert_eq!("strange_TR01".parse(), Ok(Hidden::WithoutRelatives(Backlash)));
        assert_eq!("backlash+no".parse::<Hidden>(), Err(UnknownEffect("no".to_owned())));
    }

    #[test]
    fn of_what_is_strange_nothing_like_it_is_looked_for() {
        use EffectKind::{ActuatorDelay, ActuatorLag, Payload};
        let without = Hidden::WithoutRelatives(ActuatorDelay).without();
        assert!(without.contains(&ActuatorDelay) && without.contains(&ActuatorLag));
        assert!(!without.contains(&Payload));
        assert_eq!(Hidden::Unknown(ActuatorDelay).without(), [ActuatorDelay]);
    }
}
