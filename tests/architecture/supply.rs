//! What dependencies may be licensed as, which are kept out and where they come from: `deny.toml`, held against every
//! dependency whether `cargo deny` is there or not.

use std::process::Command;

use serde::Deserialize;

use crate::assert_kept;
use crate::tree::{root, text};

/// A dependency, on this platform or another.
#[derive(Debug, Deserialize)]
struct Dependency {
    name: String,
    version: String,
    license: Option<String>,
    /// None for a crate of this workspace.
    source: Option<String>,
}

/// What `deny.toml` allows and keeps out.
#[derive(Debug, Deserialize)]
struct Rules {
    licenses: Licenses,
    bans: Bans,
    sources: Sources,
}

#[derive(Debug, Deserialize)]
struct Licenses {
    allow: Vec<String>,
}

#[derive(Debug, Deserialize)]
struct Bans {
    deny: Vec<Banned>,
}

#[derive(Debug, Deserialize)]
struct Banned {
    name: String,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Sources {
    allow_registry: Vec<String>,
}

impl Rules {
    /// Every rule that a dependency breaks.
    fn broken(&self, dependency: &Dependency) -> Vec<String> {
        let Dependency { name, version, license, source } = dependency;
        let mut broken = self.misplaced(dependency);
        let license = license.as_deref().unwrap_or("no licence that is named");
        if source.is_some() && !self.is_allowed(license) {
            broken.push(format!("{name} {version} is under {license}"));
        }
        broken
    }

    /// The rules that a dependency breaks by its name or by where it comes from.
    fn misplaced(&self, Dependency { name, version, source, .. }: &Dependency) -> Vec<String> {
        let Some(source) = source else { return Vec::new() };
        let mut broken = Vec::new();
        if self.bans.deny.iter().any(|banned| banned.name == *name) {
            broken.push(format!("{name} {version} is kept out"));
        }
        let registries = &self.sources.allow_registry;
        if !registries.iter().any(|known| source.strip_prefix("registry+") == Some(known)) {
            broken.push(format!("{name} {version} comes from {source}"));
        }
        broken
    }

    /// Whether an SPDX expression, or an older one with slashes, leaves a choice that is allowed.
    fn is_allowed(&self, license: &str) -> bool {
        let spaced = license.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
        let mut words: Vec<&str> = spaced.split_whitespace().rev().collect();
        self.any(&mut words) && words.is_empty()
    }

    fn any(&self, words: &mut Vec<&str>) -> bool {
        let mut is_allowed = self.all(words);
        while words.pop_if(|word| word.eq_ignore_ascii_case("or")).is_some() {
            is_allowed |= self.all(words);
        }
        is_allowed
    }

    fn all(&self, words: &mut Vec<&str>) -> bool {
        let mut is_allowed = self.one(words);
        while words.pop_if(|word| word.eq_ignore_ascii_case("and")).is_some() {
            is_allowed &= self.one(words);
        }
        is_allowed
    }

    fn one(&self, words: &mut Vec<&str>) -> bool {
        if words.pop_if(|word| *word == "(").is_some() {
            let is_allowed = self.any(words);
            return words.pop() == Some(")") && is_allowed;
        }
        let mut license = words.pop().unwrap_or_default().to_owned();
        if words.pop_if(|word| *word == "WITH").is_some() {
            license = format!("{license} WITH {}", words.pop().unwrap_or_default());
        }
        self.licenses.allow.contains(&license)
    }
}

fn rules() -> Rules {
    toml::from_str(&text("deny.toml")).unwrap()
}

/// All that the workspace depends on on any platform, without its licences: `Cargo.lock`.
fn locked() -> Vec<Dependency> {
    #[derive(Deserialize)]
    struct Lock {
        package: Vec<Dependency>,
    }
    toml::from_str::<Lock>(&text("Cargo.lock")).unwrap().package
}

/// All that the workspace depends on, with its licences. A build downloads the crates of its own platform only: where
/// those of the others are absent, those of this one are held, and that is said.
fn dependencies() -> Vec<Dependency> {
    metadata(&[]).unwrap_or_else(|absent| {
        eprintln!("of this platform alone: {absent}");
        metadata(&["--filter-platform", &host()]).unwrap()
    })
}

/// The packages that `cargo metadata` finds on this machine, or what it says where it cannot.
fn metadata(arguments: &[&str]) -> Result<Vec<Dependency>, String> {
    #[derive(Deserialize)]
    struct Graph {
        packages: Vec<Dependency>,
    }
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--offline", "--locked", "--format-version", "1"])
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap();
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(serde_json::from_slice::<Graph>(&output.stdout).unwrap().packages)
}

/// The platform that cargo builds for, as its triple.
fn host() -> String {
    let output = Command::new(env!("CARGO")).arg("-vV").output().unwrap();
    let version = String::from_utf8(output.stdout).unwrap();
    version.lines().find_map(|line| line.strip_prefix("host: ")).unwrap().to_owned()
}

#[test]
fn dependencies_are_what_deny_toml_allows() {
    let (rules, dependencies) = (rules(), dependencies());
    assert!(dependencies.len() > 100, "{}", dependencies.len());
    assert_kept(&dependencies.iter().flat_map(|d| rules.broken(d)).collect::<Vec<_>>());
    assert_kept(&locked().iter().flat_map(|d| rules.misplaced(d)).collect::<Vec<_>>());
}

#[test]
fn a_dependency_that_is_not_allowed_is_reported() {
    let registry = "registry+https://github.com/rust-lang/crates.io-index";
    let of = |name: &str, license: Option<&str>, source: &str| Dependency {
        name: name.to_owned(),
        version: "1.0.0".to_owned(),
        license: license.map(str::to_owned),
        source: Some(source.to_owned()),
    };
    let made_up = [
        (of("good", Some("(MIT OR GPL-3.0) AND Unicode-3.0"), registry), vec![]),
        (of("good", Some("Unlicense/MIT"), registry), vec![]),
        (of("good", Some("Apache-2.0 WITH LLVM-exception or GPL-2.0"), registry), vec![]),
        (of("free", Some("GPL-3.0"), registry), vec!["free 1.0.0 is under GPL-3.0"]),
        (
            of("both", Some("MIT AND GPL-3.0"), registry),
            vec!["both 1.0.0 is under MIT AND GPL-3.0"],
        ),
        (of("torn", Some("(MIT"), registry), vec!["torn 1.0.0 is under (MIT"]),
        (of("bare", None, registry), vec!["bare 1.0.0 is under no licence that is named"]),
        (of("openssl-sys", Some("MIT"), registry), vec!["openssl-sys 1.0.0 is kept out"]),
        (of("git", Some("MIT"), "git+https://a.b"), vec!["git 1.0.0 comes from git+https://a.b"]),
    ];
    for (dependency, expected) in made_up {
        assert_eq!(rules().broken(&dependency), expected, "{}", dependency.name);
    }
}
