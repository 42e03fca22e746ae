//! Robots of `robot_descriptions`: a module a robot, which names the files of a repository that is cloned into a cache.

use std::path::{Component, Path, PathBuf};

use super::assignments::{literal, paths};
use super::environment::{Environment, is_plain, not_installed};

/// The URDF or MJCF of a description, by the name of its module (`panda_description`) or without its ending (`panda`).
///
/// # Errors
///
/// A sentence for a package that is absent, a name of no description, and files that are not in the cache.
pub(super) fn file(name: &str, environment: &Environment) -> Result<PathBuf, String> {
    let package = environment.package("robot_descriptions");
    let package =
        package.ok_or_else(|| not_installed("robot_descriptions", "robot_descriptions"))?;
    let names = [name.to_owned(), format!("{name}_description")];
    let modules = names.iter().filter(|name| is_plain(name) && name.ends_with("_description"));
    let module = modules.map(|name| (name, package.join(format!("{name}.py"))));
    let Some((name, module)) = module.into_iter().find(|(_, module)| module.is_file()) else {
        return Err(format!(
            "robot_descriptions has no description called {name}: python3 -m robot_descriptions list names them"
        ));
    };
    let read = |path: &Path| {
        files::text(path, files::KEPT_BYTES).map_err(|error| format!("{}: {error}", path.display()))
    };
    let (module, repositories) = (read(&module)?, read(&package.join("_repositories.py"))?);
    let cache = environment.folder("ROBOT_DESCRIPTIONS_CACHE");
    let usual = || Some(environment.home()?.join(".cache").join("robot_descriptions"));
    let cache = cache.or_else(usual);
    let cache =
        cache.ok_or("the home folder is not known, ROBOT_DESCRIPTIONS_CACHE was expected")?;
    let clone = |repository: &str| {
        let folder = cache_path(&repositories, repository)?;
        Some(match environment.text("ROBOT_DESCRIPTION_COMMIT") {
            Some(commit) => cache.join(format!("{folder}-{commit}")).join(folder),
            None => cache.join(folder),
        })
    };
    let paths = paths(&module, &clone);
    if let Some(file) = paths.get("URDF_PATH").or_else(|| paths.get("MJCF_PATH")) {
        let is_plain = |part| matches!(part, Component::Normal(_));
        let is_within = file.strip_prefix(&cache).is_ok_and(|own| own.components().all(is_plain));
        if is_within && file.is_file() {
            return Ok(file.clone());
        }
        return Err(format!(
            "{} is not there: python3 -m robot_descriptions pull {name} downloads it",
            file.display()
        ));
    }
    match paths.get("XACRO_PATH") {
        Some(_) => find_expansion(&cache.join("xacrodoc").join(name), name),
        None => Err(format!(
            "the module {name} of robot_descriptions names no URDF and no MJCF that could be read"
        )),
    }
}

/// The URDF that `robot_descriptions` has made of a xacro.
fn find_expansion(folder: &Path, name: &str) -> Result<PathBuf, String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let files = entries.map(|entry| entry.path());
    let mut urdfs: Vec<PathBuf> =
        files.filter(|f| f.extension().is_some_and(|e| e == "urdf")).collect();
    urdfs.sort();
    match urdfs.as_slice() {
        [urdf] => Ok(urdf.clone()),
        [] => Err(format!(
            "it is a xacro, of which {} has no URDF yet: pip install xacrodoc, then python3 -m robot_descriptions pull \
             {name} makes it",
            folder.display()
        )),
        several => Err(format!(
            "{} has {} URDFs of it, made by several versions: give the file of one, or remove the others",
            folder.display(),
            several.len()
        )),
    }
}

/// The folder of a repository in the cache, as `_repositories.py` says.
fn cache_path(repositories: &str, name: &str) -> Option<String> {
    let (_, entry) = repositories.split_once(&format!("\"{name}\": Repository("))?;
    let (_, value) = entry.split(')').next()?.split_once("cache_path=")?;
    let (folder, _) = literal(value.trim_start())?;
    is_plain(&folder).then_some(folder)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const REPOSITORIES: &str = "REPOSITORIES: Dict[str, Repository] = {\n    \"arms\": Repository(\n        url=\"x\",\n        \
                                commit=\"y\",  # v1\n        cache_path=\"arm_data\",\n    ),\n}\n";
    const PLAIN: &str = "\"\"\"Arm.\"\"\"\nfrom os import path as _path\n\nREPOSITORY_PATH: str = _clone_to_cache(\n    \"arms\",\n    \
                         commit=None,\n)\n\nPACKAGE_PATH: str = _path.join(\n    REPOSITORY_PATH, \"robots\", \"arm\"\n)\n\nURDF_PATH: str = \
                         _path.join(PACKAGE_PATH, \"arm.urdf\")\n";
    const XACRO: &str = "REPOSITORY_PATH: str = _clone_to_cache(\"arms\")\nPACKAGE_PATH: str = REPOSITORY_PATH\nXACRO_PATH: str = \
                         _path.join(PACKAGE_PATH, \"arm.xacro\")\nXACRO_ARGS = {\"name\": \"arm\"}\n";

    fn installed(folder: &Path) -> Environment {
        let package = folder.join("site/robot_descriptions");
        fs::create_dir_all(&package).unwrap();
        fs::write(package.join("_repositories.py"), REPOSITORIES).unwrap();
        fs::write(package.join("arm_description.py"), PLAIN).unwrap();
        fs::write(package.join("other_description.py"), XACRO).unwrap();
        let cache = folder.join("cache");
        Environment::of(&[
            ("PYTHONPATH", &folder.join("site")),
            ("ROBOT_DESCRIPTIONS_CACHE", &cache),
        ])
    }

    #[test]
    fn a_description_is_found_in_the_cache() {
        let folder = tempfile::tempdir().unwrap();
        let environment = installed(folder.path());
        let missing = file("arm_description", &environment).unwrap_err();
        assert!(
            missing.contains("python3 -m robot_descriptions pull arm_description"),
            "{missing}"
        );
        let robots = folder.path().join("cache/arm_data/robots/arm");
        fs::create_dir_all(&robots).unwrap();
        fs::write(robots.join("arm.urdf"), "<robot/>").unwrap();
        for name in ["arm_description", "arm"] {
            assert_eq!(file(name, &environment).unwrap(), robots.join("arm.urdf"));
        }
    }

    #[test]
    fn a_xacro_is_taken_as_it_was_expanded() {
        let folder = tempfile::tempdir().unwrap();
        let environment = installed(folder.path());
        let missing = file("other_description", &environment).unwrap_err();
        assert!(missing.contains("pip install xacrodoc"), "{missing}");
        let made = folder.path().join("cache/xacrodoc/other_description");
        fs::create_dir_all(&made).unwrap();
        fs::write(made.join("other_description-0f.urdf"), "<robot/>").unwrap();
        assert_eq!(file("other", &environment).unwrap(), made.join("other_description-0f.urdf"));
        fs::write(made.join("other_description-1f.urdf"), "<robot/>").unwrap();
        assert!(file("other", &environment).unwrap_err().contains("2 URDFs"));
    }

    #[test]
    fn what_is_no_description_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let environment = installed(folder.path());
        for name in ["_repositories", "../arm", "nobody"] {
            let told = file(name, &environment).unwrap_err();
            assert!(told.contains(&format!("no description called {name}")), "{told}");
        }
        let absent = file("arm", &Environment::of(&[])).unwrap_err();
        assert!(absent.ends_with("pip install robot_descriptions"), "{absent}");
    }
}
