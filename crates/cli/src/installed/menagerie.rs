//! Models of MuJoCo Menagerie as the package `mujoco-menagerie` keeps them: `registry.json` in the package names every robot
//! with its MJCF files, and the cache has a folder `models/ROBOT-OID` for each that is downloaded, with `.complete` in it.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

use super::environment::{Environment, is_plain, not_installed};

/// Digits of the object id in the name of a folder.
const OID_DIGITS: usize = 16;

#[derive(Deserialize)]
struct Registry {
    robots: BTreeMap<String, Entry>,
}

#[derive(Deserialize)]
struct Entry {
    oid: String,
    default_model: String,
    entry_points: BTreeMap<String, EntryPoint>,
}

#[derive(Deserialize)]
struct EntryPoint {
    file: String,
    kind: String,
}

/// The MJCF of a robot, by its own name (`universal_robots_ur5e`) or that of one of its models (`ur5e`).
///
/// # Errors
///
/// A sentence for a package that is absent, a name of no robot or of several, and a robot that is not downloaded.
pub(super) fn file(name: &str, environment: &Environment) -> Result<PathBuf, String> {
    let package = environment.package("mujoco_menagerie");
    let package = package.ok_or_else(|| not_installed("mujoco_menagerie", "mujoco-menagerie"))?;
    let registry = package.join("registry.json");
    let unreadable = |reason: String| format!("{}: {reason}", registry.display());
    let text = files::text(&registry, files::KEPT_BYTES).map_err(|e| unreadable(e.to_string()))?;
    let registry: Registry = serde_json::from_str(&text).map_err(|e| unreadable(e.to_string()))?;
    let (robot, entry, model) = find(&registry, name)?;
    let point = entry.entry_points.get(model).filter(|point| is_plain(&point.file));
    let (true, Some(point)) = (is_plain(robot), point) else {
        return Err(format!("registry.json of mujoco_menagerie names no file of {robot}"));
    };
    let folder = folder(robot, entry, environment)?;
    let file = folder.join(&point.file);
    if file.is_file() {
        return Ok(file);
    }
    Err(format!("{} is not there: mujoco-menagerie prefetch {robot} downloads it", file.display()))
}

/// The robot with this name, or the only one with a model of this name.
fn find<'a>(
    registry: &'a Registry,
    name: &'a str,
) -> Result<(&'a str, &'a Entry, &'a str), String> {
    if let Some((robot, entry)) = registry.robots.get_key_value(name) {
        return Ok((robot, entry, &entry.default_model));
    }
    let has_model = |entry: &Entry| entry.entry_points.get(name).is_some_and(|p| p.kind == "robot");
    let found: Vec<(&String, &Entry)> =
        registry.robots.iter().filter(|(_, entry)| has_model(entry)).collect();
    match found.as_slice() {
        [(robot, entry)] => Ok((robot, entry, name)),
        [] => Err(format!(
            "mujoco_menagerie has no robot and no model called {name}: mujoco-menagerie names lists its robots"
        )),
        several => {
            let names: Vec<&str> = several.iter().map(|(robot, _)| robot.as_str()).collect();
            Err(format!(
                "{name} is a model of {}, one of these robots was expected",
                names.join(", ")
            ))
        }
    }
}

/// The folder of a robot, where `MENAGERIE_ROOT` or the cache has it.
fn folder(robot: &str, entry: &Entry, environment: &Environment) -> Result<PathBuf, String> {
    if let Some(root) = environment.folder("MENAGERIE_ROOT") {
        return Ok(root.join(robot));
    }
    let home = environment.home();
    let of_system = || {
        let home = home.as_ref();
        if cfg!(windows) {
            let local = environment.folder("LOCALAPPDATA");
            let local = local.or_else(|| Some(home?.join("AppData").join("Local")));
            return Some(local?.join("mujoco_menagerie").join("cache"));
        }
        if cfg!(target_os = "macos") {
            return Some(home?.join("Library").join("Caches").join("mujoco_menagerie"));
        }
        let cache = environment.folder("XDG_CACHE_HOME").or_else(|| Some(home?.join(".cache")));
        Some(cache?.join("mujoco_menagerie"))
    };
    let cache = environment.folder("MENAGERIE_CACHE_DIR").or_else(of_system);
    let cache = cache.ok_or("the home folder is not known, MENAGERIE_CACHE_DIR was expected")?;
    let digits = entry.oid.get(..OID_DIGITS).filter(|digits| is_plain(digits));
    let digits = digits
        .ok_or_else(|| format!("registry.json has the object id {} of {robot}", entry.oid))?;
    let folder = cache.join("models").join(format!("{robot}-{digits}"));
    if folder.join(".complete").is_file() {
        return Ok(folder);
    }
    Err(format!(
        "{} is not downloaded into {}: mujoco-menagerie prefetch {robot} does it",
        robot,
        cache.display()
    ))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    const REGISTRY: &str = r#"{ "schema": 1, "robots": {
        "universal_robots_ur5e": { "oid": "2a3464301404aba7ffff", "default_model": "ur5e", "entry_points": {
            "ur5e": { "file": "ur5e.xml", "kind": "robot" }, "scene": { "file": "scene.xml", "kind": "scene" } } },
        "leap_hand": { "oid": "00000000000000000000", "default_model": "left_hand", "entry_points": {
            "left_hand": { "file": "left_hand.xml", "kind": "robot" } } },
        "shadow_hand": { "oid": "11111111111111111111", "default_model": "left_hand", "entry_points": {
            "left_hand": { "file": "left_hand.xml", "kind": "robot" } } } } }"#;

    fn installed(folder: &Path) -> Environment {
        let package = folder.join("venv/lib/python3.12/site-packages/mujoco_menagerie");
        fs::create_dir_all(&package).unwrap();
        fs::write(package.join("registry.json"), REGISTRY).unwrap();
        let cache = folder.join("cache");
        Environment::of(&[("VIRTUAL_ENV", &folder.join("venv")), ("MENAGERIE_CACHE_DIR", &cache)])
    }

    #[test]
    fn a_robot_is_found_by_its_name_and_by_that_of_its_model() {
        let folder = tempfile::tempdir().unwrap();
        let environment = installed(folder.path());
        let missing = file("ur5e", &environment).unwrap_err();
        assert!(missing.contains("mujoco-menagerie prefetch universal_robots_ur5e"), "{missing}");
        let models = folder.path().join("cache/models/universal_robots_ur5e-2a3464301404aba7");
        fs::create_dir_all(&models).unwrap();
        fs::write(models.join("ur5e.xml"), "<mujoco/>").unwrap();
        assert!(file("ur5e", &environment).is_err(), "a download that did not end");
        fs::write(models.join(".complete"), "").unwrap();
        for name in ["ur5e", "universal_robots_ur5e"] {
            assert_eq!(file(name, &environment).unwrap(), models.join("ur5e.xml"));
        }
    }

    #[test]
    fn what_cannot_be_found_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let environment = installed(folder.path());
        let told = |name: &str| file(name, &environment).unwrap_err();
        assert_eq!(
            told("left_hand"),
            "left_hand is a model of leap_hand, shadow_hand, one of these robots was expected"
        );
        assert!(told("../ur5e").contains("no robot and no model called ../ur5e"));
        assert!(told("scene").contains("no robot and no model"));
        let absent = file("ur5e", &Environment::of(&[])).unwrap_err();
        assert!(absent.ends_with("pip install mujoco-menagerie"), "{absent}");
    }
}
