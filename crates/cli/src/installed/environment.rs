use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Variables that tell where Python and its packages keep their files.
const VARIABLES: [&str; 12] = [
    "PYTHONPATH",
    "VIRTUAL_ENV",
    "CONDA_PREFIX",
    "PATH",
    "HOME",
    "USERPROFILE",
    "LOCALAPPDATA",
    "XDG_CACHE_HOME",
    "MENAGERIE_ROOT",
    "MENAGERIE_CACHE_DIR",
    "ROBOT_DESCRIPTIONS_CACHE",
    "ROBOT_DESCRIPTION_COMMIT",
];

/// What the environment says of Python's packages.
pub(super) struct Environment {
    variables: BTreeMap<&'static str, OsString>,
}

impl Environment {
    /// That of this process.
    pub(super) fn of_process() -> Self {
        let given = |name| Some((name, std::env::var_os(name).filter(|value| !value.is_empty())?));
        Self { variables: VARIABLES.into_iter().filter_map(given).collect() }
    }

    #[cfg(test)]
    pub(super) fn of(variables: &[(&'static str, &Path)]) -> Self {
        let given = variables.iter().map(|(name, value)| (*name, value.as_os_str().to_owned()));
        Self { variables: given.collect() }
    }

    /// A folder that a variable names; `~` at its beginning is the home folder.
    pub(super) fn folder(&self, variable: &str) -> Option<PathBuf> {
        let path = PathBuf::from(self.variables.get(variable)?);
        match path.strip_prefix("~") {
            Ok(below) => Some(self.home()?.join(below)),
            Err(_) => Some(path),
        }
    }

    /// A variable as text.
    pub(super) fn text(&self, variable: &str) -> Option<&str> {
        self.variables.get(variable)?.to_str()
    }

    /// The home folder.
    pub(super) fn home(&self) -> Option<PathBuf> {
        let of = |name: &str| self.variables.get(name).map(PathBuf::from);
        of("HOME").or_else(|| of("USERPROFILE"))
    }

    /// The folder of an installed package: of `PYTHONPATH`, of the active environment of venv or conda, of the Pythons on
    /// `PATH`, or of the user's own packages, whichever has it first.
    pub(super) fn package(&self, name: &str) -> Option<PathBuf> {
        let split = |variable: &str| self.variables.get(variable).map(std::env::split_paths);
        let of_path = split("PYTHONPATH").into_iter().flatten();
        let active = ["VIRTUAL_ENV", "CONDA_PREFIX"].iter().filter_map(|name| self.folder(name));
        let has_python = |folder: &PathBuf| {
            ["python3", "python", "python.exe"].iter().any(|name| folder.join(name).is_file())
        };
        let on_path = split("PATH").into_iter().flatten().filter(has_python);
        let on_path = on_path.filter_map(|folder| folder.parent().map(Path::to_owned));
        let own = self.home().map(|home| home.join(".local"));
        let prefixes = active.chain(on_path).chain(own);
        let folders = of_path.chain(prefixes.flat_map(|prefix| site_packages(&prefix)));
        folders.map(|folder| folder.join(name)).find(|folder| folder.is_dir())
    }
}

/// The folders of packages below a prefix, those of the newest Python first.
fn site_packages(prefix: &Path) -> Vec<PathBuf> {
    let pythons = std::fs::read_dir(prefix.join("lib")).into_iter().flatten().flatten();
    let mut versions: Vec<(Vec<u32>, PathBuf)> = pythons
        .filter_map(|entry| {
            let name = entry.file_name();
            let version = name.to_str()?.strip_prefix("python")?;
            let numbers = version.split('.').map(str::parse).collect::<Result<_, _>>().ok()?;
            Some((numbers, entry.path()))
        })
        .collect();
    versions.sort_by(|a, b| b.cmp(a));
    let folders = versions
        .into_iter()
        .flat_map(|(_, python)| ["site-packages", "dist-packages"].map(|name| python.join(name)));
    folders.chain([prefix.join("Lib").join("site-packages")]).collect()
}

/// Whether a name is that of a file or a module alone, without a way to another folder.
pub(super) fn is_plain(name: &str) -> bool {
    let is_usual = |c: char| c.is_alphanumeric() || "_-+.".contains(c);
    !name.is_empty() && !name.starts_with('.') && name.chars().all(is_usual)
}

/// The reason for a package that is absent.
pub(super) fn not_installed(package: &str, pip: &str) -> String {
    format!(
        "the Python package {package} is not there, neither in PYTHONPATH, in an active environment (VIRTUAL_ENV, \
         CONDA_PREFIX), nor beside a python3 of PATH: pip install {pip}"
    )
}
