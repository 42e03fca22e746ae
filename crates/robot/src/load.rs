use std::collections::BTreeMap;
use std::path::Path;

use files::{FileError, KEPT_BYTES};

use crate::error::RobotError;
use crate::loaded::Loaded;
use crate::meshes::folders::MeshFolders;
use crate::meshes::packages::Packages;
use crate::robot_toml::file::DescriptionFile;
use crate::structure::control::{ControlSettings, PdGain};
use crate::structure::lumping::Lumping;

use crate::structure::part::{JointSelection, positions};
use crate::structure::robot::Robot;
use crate::warning::RobotWarning;
use crate::whole_robot::WholeRobot;
use crate::{mjcf, urdf};

/// Most joints of a robot: the cost grows with the cube of their number, and humanoids have fewer.
const MOST_JOINTS: usize = 100;

/// Options for loading a robot from its files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoadOptions {
    /// Names of the joints that move; the others are locked at zero. `None` for every joint that
    /// moves in the files.
    pub joints: Option<Vec<String>>,
    /// Positions of joints that are locked (rad or m), beside those of the files.
    pub locked: BTreeMap<String, f64>,
    /// Where meshes are looked for.
    pub packages: Packages,
    /// Which folders meshes may lie in beside packages.
    pub meshes: MeshFolders,
}

impl Robot {
    /// The robot described by `path`, a `robot.urdf`, an MJCF or a `robot.toml`.
    ///
    /// An MJCF also gives rotor inertias, friction and servo gains; whatever else in it may matter is
    /// named in warnings. The extension decides whether the file is XML or a `robot.toml`. With any
    /// other extension, a first character `<` means XML. XML with the root `<mujoco>` is an MJCF. A
    /// `robot.toml` beside a URDF is read only when it is named.
    ///
    /// # Errors
    ///
    /// [`RobotError::Unreadable`], [`RobotError::InFile`] around what is wrong with the URDF, and
    /// [`RobotError::InToml`] for what is wrong with the `robot.toml`.
    pub fn load(path: &Path) -> Result<Loaded, RobotError> {
        Self::load_with(path, &LoadOptions::default())
    }

    /// The robot described by `path`, as [`Robot::load`] reads it, or a part of it.
    ///
    /// A `robot.toml` with `joints` describes the reduced robot: its bodies and its joints. The joints
    /// of `options` then reduce that robot further.
    ///
    /// # Errors
    ///
    /// Those of [`Robot::load`], and [`RobotError::UnknownName`] for a joint of `options` that
    /// does not move.
    pub fn load_with(path: &Path, options: &LoadOptions) -> Result<Loaded, RobotError> {
        let text = read(path)?;
        let is_toml = match path.extension().and_then(|e| e.to_str()) {
            Some("toml") => true,
            Some("urdf" | "xml") => false,
            _ => !text.trim_start().starts_with('<'),
        };
        let (file, urdf_path, text) = if is_toml {
            let file = DescriptionFile::parse(&text, path)?;
            let urdf_path = file.urdf_path();
            let text = read(&urdf_path).map_err(|e| file.of_urdf(&e))?;
            (Some(file), urdf_path, text)
        } else {
            (None, path.to_owned(), text)
        };
        let model =
            read_model(&text, &urdf_path, options.meshes).map_err(|e| e.in_file(&urdf_path))?;
        let part = file.as_ref().map(|file| file.part(&model)).transpose()?.unwrap_or_default();
        let mut loaded =
            Loaded::from_urdf(&model, part, &urdf_path).map_err(|e| e.in_file(path))?;
        if let Some(file) = &file {
            file.apply(&mut loaded)?;
        }
        if options.joints.is_some() || !options.locked.is_empty() {
            loaded = loaded.keep_joints(&model, options)?;
        }
        loaded.warnings.extend(loaded.looks.find_meshes(
            &urdf_path,
            &options.packages,
            options.meshes,
        ));
        loaded.check(&model).map_err(|e| e.in_file(&urdf_path))?;
        Ok(loaded)
    }

    /// The robot that the text of a URDF describes.
    ///
    /// # Errors
    ///
    /// What is wrong with the URDF, without the name of a file.
    pub fn from_urdf(text: &str) -> Result<Self, RobotError> {
        let model = urdf::parse::parse(text)?;
        let mut loaded = Loaded::from_urdf(&model, JointSelection::default(), Path::new(""))?;
        loaded.check(&model)?;
        Ok(loaded.robot)
    }
}

impl Loaded {
    fn from_urdf(
        model: &WholeRobot,
        part: JointSelection,
        path: &Path,
    ) -> Result<Self, RobotError> {
        let whole = &model.robot;
        let locked = part.locks(whole, &model.mimics)?;
        let lumping = Lumping::new(whole, &positions(&locked));
        let robot = lumping.robot(whole)?.locked_in(whole, &locked);
        let fixed = model.fixed_to_base.iter().cloned();
        Ok(Self {
            robot_in_urdf: robot.clone(),
            looks: lumping.looks(model.looks.clone()),
            urdf_path: path.to_owned(),
            expanded: model.expanded.clone(),
            base_link: model.base_link.clone(),
            fixed_to_base: fixed.chain(lumping.fixed_to_base(whole)).collect(),
            part,
            locked,
            control: lumping
                .control(&ControlSettings { gains: whole_gains(model), ..Default::default() }),
            warnings: model.warnings.clone(),
            robot,
        })
    }

    /// The robot with only the joints of `options` moving, and its other joints locked where `options` or the files say, or
    /// at zero.
    ///
    /// A body that still moves by itself keeps its description; any other is merged into its carrier.
    fn keep_joints(self, model: &WholeRobot, options: &LoadOptions) -> Result<Self, RobotError> {
        let locked = &options.locked;
        for (name, position) in locked {
            if model.robot.joint_index(name).is_none() {
                let known: Vec<&str> = model.robot.joint_names().collect();
                return Err(RobotError::unknown_name("locked joints", "joint", name, &known));
            }
            if options.joints.iter().flatten().any(|joint| joint == name) {
                let place = "joints to keep".to_owned();
                let hint = "it is among those that are locked".to_owned();
                let name = name.clone();
                return Err(RobotError::UnknownName { place, what: "moving joint", name, hint });
            }
            if !position.is_finite() {
                let (thing, quantity) = (format!("joint {name}"), "locked position");
                return Err(RobotError::NotFinite { thing, quantity, value: *position });
            }
        }
        let others = || self.robot.joint_names().filter(|name| !locked.contains_key(*name));
        let joints =
            options.joints.clone().unwrap_or_else(|| others().map(str::to_owned).collect());
        if let Some(name) = joints.iter().find(|name| self.robot.joint_index(name).is_none()) {
            return Err(self.no_joint_to_keep(name));
        }
        let kept = |name: &&str| joints.iter().any(|joint| joint == name);
        let names = || self.robot.joint_names();
        let part = JointSelection {
            joints: Some(names().filter(kept).map(str::to_owned).collect()),
            locked: self.part.locked.clone().into_iter().chain(locked.clone()).collect(),
        };
        let at = |name: &str| (name.to_owned(), locked.get(name).copied().unwrap_or(0.0));
        let gone = names().filter(|name| !kept(name)).map(at).collect();
        let lumping = Lumping::new(&self.robot, &gone);
        let [new, old] = [lumping.robot(&self.robot)?, lumping.robot(&self.robot_in_urdf)?];
        let mut smaller = Self::from_urdf(model, part, &self.urdf_path)?;
        smaller.control = lumping.control(&self.control);
        smaller.warnings = self.warnings;
        smaller.robot = smaller.robot.with_gravity(new.gravity_in_base());
        for (index, (new, old)) in new.links().iter().zip(old.links()).enumerate() {
            let Some(link) = smaller.robot.link_mut(index) else { continue };
            link.actuator = new.actuator.clone();
            link.joint.limits = new.joint.limits;
            if new.inertia != old.inertia {
                link.inertia = new.inertia.clone();
            }
        }
        Ok(smaller)
    }

    /// Refuses a moving body without mass and too many joints, and adds warnings about locked joints.
    fn check(&mut self, model: &WholeRobot) -> Result<(), RobotError> {
        let found = self.robot.joint_count();
        if found > MOST_JOINTS {
            let robot = self.robot.name().to_owned();
            return Err(RobotError::TooManyJoints { robot, found, most: MOST_JOINTS });
        }
        for (index, body) in self.robot.links().iter().enumerate() {
            let (link, mass) = (body.name.clone(), body.inertia.mass);
            if mass > 0.0 {
                let defects = self.robot.inertia_defects(index).into_iter();
                let told = |defect| RobotWarning::Inertia { link: link.clone(), defect };
                self.warnings.extend(defects.map(told));
            } else if model.without_mass.contains(&link) {
                return Err(RobotError::MassNotPositive { link, mass });
            } else if !self.robot.is_frame_between_axes(index) {
                self.warnings.push(RobotWarning::Massless { link });
            }
        }
        let is_told = |link: &str| self.warnings.iter().any(|w| w.link() == Some(link));
        let wide = self.robot.wide_inertias().into_iter().filter(|wide| !is_told(&wide.link));
        let wide: Vec<RobotWarning> = wide.map(RobotWarning::WideInertia).collect();
        self.warnings.extend(wide);
        for lock in &self.locked {
            let (joint, position) = (lock.joint.clone(), lock.position);
            let limits = whole_limits(&model.robot, &joint);
            let master = lock.mimics.as_ref().and_then(|_| {
                self.part.moving_master(&joint, &model.robot, &model.mimics).map(str::to_owned)
            });
            if let Some(of) = master {
                self.warnings.push(RobotWarning::MimicLocked { joint, of, position });
            } else if let Some(limits) =
                limits.filter(|&(low, high)| position < low || position > high)
            {
                self.warnings.push(RobotWarning::LockedOutside { joint, position, limits });
            }
        }
        let limbs = self.robot.links().iter().filter(|link| link.parent.is_none()).count();
        if limbs > 1 && model.base_has_mass {
            self.warnings.push(RobotWarning::LimbsOnBase { link: self.base_link.clone(), limbs });
        }
        Ok(())
    }

    /// Error for `--joints` that names no movable joint.
    fn no_joint_to_keep(&self, name: &str) -> RobotError {
        const PLACE: &str = "joints to keep";
        let Some(lock) = self.lock(name) else {
            let known: Vec<&str> = self.robot.joint_names().collect();
            return RobotError::unknown_name(PLACE, "joint", name, &known);
        };
        RobotError::UnknownName {
            place: PLACE.to_owned(),
            what: "moving joint",
            name: name.to_owned(),
            hint: format!("it is locked at {}", lock.position),
        }
    }
}

/// Reads the text of a URDF or an MJCF.
///
/// What an MJCF includes lies below its folder, unless `folders` says otherwise.
fn read_model(text: &str, path: &Path, folders: MeshFolders) -> Result<WholeRobot, RobotError> {
    if mjcf::element::is_mjcf(text) {
        let folder = path.parent().unwrap_or(Path::new(""));
        let read_below = |path: &Path| match folders {
            MeshFolders::Below if path.exists() && !files::is_below(path, folder) => {
                let reason =
                    format!("it lies outside of {}, --allow-outside reads it", folder_name(folder));
                Err(RobotError::Unreadable { path: path.to_owned(), reason })
            }
            _ => read(path),
        };
        mjcf::parse::parse(text, folder, &read_below)
    } else {
        urdf::parse::parse(text)
    }
}

/// The gains that a file gives, one entry a joint.
fn whole_gains(model: &WholeRobot) -> Vec<Option<PdGain>> {
    let mut gains = model.gains.clone();
    gains.resize(model.robot.joint_count(), None);
    gains
}

/// Lowest and highest position of a joint (rad or m).
fn whole_limits(whole: &Robot, joint: &str) -> Option<(f64, f64)> {
    whole.joint_index(joint).and_then(|i| whole.links()[i].joint.limits.position)
}

/// A folder as it is named in messages.
fn folder_name(folder: &Path) -> String {
    match folder.as_os_str().is_empty() {
        true => "the working folder".to_owned(),
        false => folder.display().to_string(),
    }
}

/// The text of a file, without a byte-order mark.
fn read(path: &Path) -> Result<String, RobotError> {
    let text = files::text(path, KEPT_BYTES).map_err(|error| unusable(path, error))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    if text.trim().is_empty() {
        return Err(RobotError::Empty.in_file(path));
    }
    Ok(text.to_owned())
}

/// What is said of a file that is no description.
fn unusable(path: &Path, error: FileError) -> RobotError {
    let inside = path.join("robot.toml");
    let reason = match error {
        FileError::Missing => "there is no such file, a URDF or a robot.toml was expected".into(),
        FileError::Folder if inside.is_file() => {
            format!("it is a directory, give {}", inside.display())
        }
        FileError::Folder => "it is a directory, a URDF or a robot.toml was expected".into(),
        FileError::NotRegular => "it is no regular file, a URDF was expected".into(),
        FileError::TooLarge { most, .. } => {
            return RobotError::TooLarge { limit: most }.in_file(path);
        }
        FileError::NotText { byte, .. } => {
            format!("byte {byte} is not UTF-8, a text file was expected")
        }
        other => other.to_string(),
    };
    RobotError::Unreadable { path: path.to_owned(), reason }
}
