use serde::Serialize;

/// Where a result comes from: enough to repeat it, and no date.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// The command line, one entry an argument.
    pub command: Vec<String>,
    /// The files that were read.
    pub files: Vec<FileHash>,
    /// Seed of every random draw; none where nothing is drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FileHash {
    /// What it is: `robot`, `urdf`, `log` or `map`.
    pub role: &'static str,
    /// Its path as it was given.
    pub path: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

impl Provenance {
    /// The command line as one would type it, with quotes where a shell needs them.
    pub fn command_line(&self) -> String {
        let quoted: Vec<String> = self.command.iter().map(|argument| quoted(argument)).collect();
        quoted.join(" ")
    }
}

/// An argument as a shell reads it back, in quotes where it needs them.
pub fn quoted(argument: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+@%".contains(c);
    if !argument.is_empty() && argument.chars().all(plain) {
        return argument.to_owned();
    }
    format!("'{}'", argument.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn an_argument_with_a_space_or_a_quote_is_quoted() {
        assert_eq!(quoted("data/log_1.csv"), "data/log_1.csv");
        assert_eq!(quoted("my log"), "'my log'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted(""), "''");
    }
}
