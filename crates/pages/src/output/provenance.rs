use schemars::JsonSchema;
use serde::Serialize;

/// Where a result comes from: enough to repeat it, and no date.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
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
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
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
        let quote_argument: Vec<String> =
            self.command.iter().map(|argument| quote_argument(argument)).collect();
        quote_argument.join(" ")
    }

    /// The same without the folders of this machine, for a page that is passed on. Of every path the
    /// shortest ending stays that no other file has, in the command line too.
    pub fn without_folders(&self) -> Self {
        let paths: Vec<Vec<&str>> = self.files.iter().map(|file| parts(&file.path)).collect();
        let short: Vec<String> = paths.iter().map(|path| ending(path, &paths)).collect();
        let command = self.command.iter().map(|argument| {
            let own = parts(argument);
            match paths.iter().position(|path| *path == own) {
                Some(file) => short[file].clone(),
                None if argument.starts_with('/') => ending(&own, &[]),
                None => argument.clone(),
            }
        });
        let files = self.files.iter().zip(&short);
        let files = files.map(|(file, path)| FileHash { path: path.clone(), ..file.clone() });
        Self { command: command.collect(), files: files.collect(), ..self.clone() }
    }
}

/// The folders of a path and its name, with `..` resolved.
fn parts(path: &str) -> Vec<&str> {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/').filter(|part| !part.is_empty() && *part != ".") {
        match (part, parts.last()) {
            ("..", Some(last)) if *last != ".." => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts
}

/// The shortest ending of a path that no other path has.
fn ending(path: &[&str], all: &[Vec<&str>]) -> String {
    let is_own = |length: usize| {
        let others = all.iter().filter(|other| other.as_slice() != path);
        others.filter(|other| other.ends_with(&path[path.len() - length..])).count() == 0
    };
    let length = (1..=path.len()).find(|&length| is_own(length)).unwrap_or(path.len());
    path[path.len() - length..].join("/")
}

/// An argument as a shell reads it back, in quotes where it needs them.
pub fn quote_argument(argument: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+@%".contains(c);
    if !argument.is_empty() && argument.chars().all(plain) {
        return argument.to_owned();
    }
    format!("'{}'", argument.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::{FileHash, Provenance, quote_argument};

    #[test]
    fn an_argument_with_a_space_or_a_quote_is_quoted() {
        assert_eq!(quote_argument("data/log_1.csv"), "data/log_1.csv");
        assert_eq!(quote_argument("my log"), "'my log'");
        assert_eq!(quote_argument("it's"), r"'it'\''s'");
        assert_eq!(quote_argument(""), "''");
    }

    #[test]
    fn a_page_tells_files_apart_and_no_folder_of_the_machine() {
        let file = |path: &str| FileHash { role: "log", path: path.into(), sha256: "00".into() };
        let files =
            ["/home/me/demo/scenarios/../robots/arm.toml", "/data/a/1.csv", "/data/b/1.csv"];
        let command =
            ["plumbline", "--robot", files[0], "--map=x", "/home/me/map.toml", "../b/1.csv"];
        let provenance = Provenance {
            program: "plumbline",
            version: "0",
            command: command.map(str::to_owned).to_vec(),
            files: files.map(file).to_vec(),
            seed: None,
        };
        let shown = provenance.without_folders();
        let paths: Vec<&str> = shown.files.iter().map(|file| file.path.as_str()).collect();
        assert_eq!(paths, ["arm.toml", "a/1.csv", "b/1.csv"]);
        assert_eq!(shown.command_line(), "plumbline --robot arm.toml --map=x map.toml ../b/1.csv");
    }
}
