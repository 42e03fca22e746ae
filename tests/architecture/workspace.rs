//! The packages of a workspace and what they depend on.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use serde::Deserialize;

use crate::tree::root;

/// A package as `cargo metadata` tells it.
#[derive(Debug, Deserialize)]
pub struct Package {
    pub name: String,
    pub dependencies: Vec<Dependency>,
    #[serde(default)]
    metadata: Option<Metadata>,
    manifest_path: String,
}

/// What a package depends on, `kind` being none for a normal dependency.
#[derive(Debug, Deserialize)]
pub struct Dependency {
    pub name: String,
    pub kind: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Metadata {
    floor: Option<Floor>,
}

#[derive(Debug, Deserialize)]
struct Floor {
    level: u32,
}

impl Package {
    /// `level` of `[package.metadata.floor]`.
    pub fn floor(&self) -> Option<u32> {
        self.metadata.as_ref()?.floor.as_ref().map(|floor| floor.level)
    }

    /// What it needs outside its tests.
    pub fn needs(&self) -> impl Iterator<Item = &str> {
        let built = |d: &&Dependency| d.kind.as_deref() != Some("dev");
        self.dependencies.iter().filter(built).map(|d| d.name.as_str())
    }

    /// Its folder, named from the root.
    pub fn folder(&self) -> String {
        let folder = Path::new(&self.manifest_path).parent().unwrap();
        folder.strip_prefix(root()).unwrap_or(folder).to_str().unwrap().to_owned()
    }

    /// One of the crates, in contrast to the tests, which stand above all floors.
    pub fn is_crate(&self) -> bool {
        self.folder().starts_with("crates/")
    }

    /// A package in `crates/` that is not there, for rules to be broken by.
    pub fn made_up(name: &str, level: u32, needs: &[&str]) -> Self {
        let need = |n: &&str| Dependency { name: (*n).to_owned(), kind: None };
        Self {
            name: name.to_owned(),
            dependencies: needs.iter().map(need).collect(),
            metadata: Some(Metadata { floor: Some(Floor { level }) }),
            manifest_path: root()
                .join("crates")
                .join(name)
                .join("Cargo.toml")
                .display()
                .to_string(),
        }
    }
}

/// The packages of this workspace.
pub fn packages() -> Vec<Package> {
    #[derive(Deserialize)]
    struct Workspace {
        packages: Vec<Package>,
    }
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice::<Workspace>(&output.stdout).unwrap().packages
}

/// The crates of this workspace.
pub fn crates() -> Vec<Package> {
    packages().into_iter().filter(Package::is_crate).collect()
}

/// Every package of the workspace that `name` reaches through dependencies, tests' included.
pub fn reach<'a>(packages: &'a [Package], name: &str) -> BTreeSet<&'a str> {
    let find = |name: &str| packages.iter().find(|p| p.name == name);
    let mut reached = BTreeSet::new();
    let mut open: Vec<&Package> = find(name).into_iter().collect();
    while let Some(package) = open.pop() {
        let next = package.dependencies.iter().filter_map(|d| find(&d.name));
        open.extend(next.filter(|p| reached.insert(p.name.as_str())));
    }
    reached
}
