use std::fmt;
use std::str::FromStr;

/// An option as `sbatch` takes it, such as `--partition=short`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SbatchOption(String);

/// A text that is no option.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("an option of sbatch in one piece, such as --partition=short, was expected")]
pub struct NoOption;

impl FromStr for SbatchOption {
    type Err = NoOption;

    fn from_str(text: &str) -> Result<Self, NoOption> {
        let name = text.split_once('=').map_or(text, |(name, _)| name);
        let named = name.starts_with('-') && name.chars().any(char::is_alphanumeric);
        let bare = name.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c));
        let lasting = !text.contains(char::is_control);
        if named && bare && lasting { Ok(Self(text.to_owned())) } else { Err(NoOption) }
    }
}

impl fmt::Display for SbatchOption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_is_one_piece_and_one_line() {
        for text in ["--partition=short", "--exclusive", "-pshort", "--comment=two words"] {
            assert_eq!(text.parse(), Ok(SbatchOption(text.to_owned())));
        }
        for text in ["partition=short", "-p short", "--time=1\nrm -r x", "", "-", "--", "-=a"] {
            assert_eq!(text.parse::<SbatchOption>(), Err(NoOption), "{text:?}");
        }
    }
}
