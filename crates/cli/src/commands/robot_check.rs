use std::path::PathBuf;

use dynamics::{ColumnSet, base_parameter_count};
use robot::{Actuator, JointKind, Loaded, LockedJoint, Robot, WideInertia};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::PartArguments;
use crate::output::{display_path, print, print_json, table};

/// Columns of the text.
const WIDTH: usize = 100;

/// Name and version of the schema of what `--json` prints.
const SCHEMA: &str = "plumbline.robot_check/1";

/// Arguments of `robot check`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A robot.urdf, an MJCF, or a robot.toml that names one; of installed Python packages also menagerie:ur5e
    /// (mujoco-menagerie) and description:panda_description (robot_descriptions)
    file: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Prints what a robot description says and whether its inertias are possible.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let loaded = arguments.part.load(&arguments.file)?;
    let check = Check::new(&loaded, display_path(&arguments.file));
    if arguments.json {
        print_json(&check)?;
    } else {
        print(&text(&check))?;
    }
    let has_defect = check.joints.iter().any(|joint| !joint.link_defects.is_empty());
    Ok(if has_defect { ExitStatus::Gap } else { ExitStatus::Good })
}

/// The JSON schema of what `--json` prints.
pub fn schema() -> Schema {
    report::written_schema::<Check>(SCHEMA, "Plumbline robot check")
}

/// What is printed.
#[derive(Serialize, JsonSchema)]
struct Check {
    schema: &'static str,
    robot: String,
    file: String,
    urdf: String,
    base_link: String,
    gravity_m_per_s2: [f64; 3],
    joints: Vec<JointCheck>,
    locked: Vec<LockCheck>,
    base_parameters: BaseCounts,
    warnings: Vec<String>,
}

/// One joint with its link.
#[derive(Serialize, JsonSchema)]
struct JointCheck {
    name: String,
    kind: &'static str,
    position_limits: Option<(f64, f64)>,
    velocity_limit: Option<f64>,
    effort_limit: Option<f64>,
    rotor_inertia: f64,
    viscous: f64,
    coulomb_forward: f64,
    coulomb_backward: f64,
    link: String,
    mass_kg: f64,
    merged: Vec<String>,
    link_defects: Vec<String>,
}

/// A joint that is held where it is.
#[derive(Serialize, JsonSchema)]
struct LockCheck {
    name: String,
    position: f64,
    mimics: Option<String>,
}

/// How many combinations of parameters any motion can reveal.
#[derive(Serialize, JsonSchema)]
struct BaseCounts {
    inertial: usize,
    with_rotors: usize,
    with_friction: usize,
    with_rotors_friction_and_offsets: usize,
}

impl Check {
    fn new(loaded: &Loaded, file: String) -> Self {
        let robot = &loaded.robot;
        let count = |set| base_parameter_count(robot, set);
        let rotors = ColumnSet { rotor: true, ..ColumnSet::INERTIAL };
        let wide = robot.wide_inertias();
        let friction = ColumnSet { viscous: true, coulomb: true, ..ColumnSet::INERTIAL };
        Self {
            schema: SCHEMA,
            robot: robot.name().to_owned(),
            file,
            urdf: display_path(&loaded.urdf_path),
            base_link: loaded.base_link.clone(),
            gravity_m_per_s2: robot.gravity_in_base().into(),
            joints: (0..robot.joint_count())
                .filter_map(|at| JointCheck::new(robot, at, &wide))
                .collect(),
            locked: loaded.locked.iter().map(LockCheck::new).collect(),
            base_parameters: BaseCounts {
                inertial: count(ColumnSet::INERTIAL),
                with_rotors: count(rotors),
                with_friction: count(friction),
                with_rotors_friction_and_offsets: count(ColumnSet::ALL),
            },
            warnings: loaded.warnings.iter().map(ToString::to_string).collect(),
        }
    }
}

impl LockCheck {
    fn new(lock: &LockedJoint) -> Self {
        Self { name: lock.joint.clone(), position: lock.position, mimics: lock.mimics.clone() }
    }

    fn words(&self) -> String {
        let mimics = self.mimics.as_ref().map(|of| format!(" (mimics {of})")).unwrap_or_default();
        format!("{} at {}{mimics}", self.name, short(self.position))
    }
}

impl JointCheck {
    fn new(robot: &Robot, index: usize, wide: &[WideInertia]) -> Option<Self> {
        let link = robot.links().get(index)?;
        let defects = robot.inertia_defects(index);
        let wide = wide.iter().filter(|wide| wide.link == link.name);
        let wide = wide.map(|wide| format!("radius of gyration {} m", short(wide.radius_m)));
        let (joint, inertia) = (&link.joint, &link.inertia);
        let Actuator { rotor_inertia, viscous, coulomb_forward, coulomb_backward, .. } =
            link.actuator;
        Some(Self {
            name: joint.name.clone(),
            kind: match joint.kind {
                JointKind::Revolute => "revolute",
                JointKind::Continuous => "continuous",
                JointKind::Prismatic => "prismatic",
            },
            position_limits: joint.limits.position,
            velocity_limit: joint.limits.velocity,
            effort_limit: joint.limits.effort,
            rotor_inertia,
            viscous,
            coulomb_forward,
            coulomb_backward,
            link: link.name.clone(),
            mass_kg: inertia.mass,
            merged: link.merged.clone(),
            link_defects: defects.iter().map(ToString::to_string).chain(wide).collect(),
        })
    }
}

/// The first names of a list, and how many more there are.
fn some_of(names: &[String]) -> String {
    const LISTED: usize = 4;
    let listed = names[..names.len().min(LISTED)].join(", ");
    match names.len().saturating_sub(LISTED) {
        0 => listed,
        more => format!("{listed} and {more} more"),
    }
}

fn text(check: &Check) -> String {
    let [x, y, z] = check.gravity_m_per_s2;
    let mut text = format!(
        "{}: {} joints on {}, gravity ({x}, {y}, {z}) m/s²\n\n",
        check.robot,
        check.joints.len(),
        check.base_link
    );
    let joints = check.joints.iter().map(|j| {
        let range = j.position_limits.map(|(a, b)| format!("{} to {}", short(a), short(b)));
        let limit = |l: Option<f64>| l.map_or_else(|| "-".to_owned(), short);
        vec![
            j.name.clone(),
            j.kind.to_owned(),
            range.unwrap_or_else(|| "-".to_owned()),
            limit(j.velocity_limit),
            limit(j.effort_limit),
            short(j.rotor_inertia),
            short(j.viscous),
            coulomb(j),
        ]
    });
    let header = ["joint", "type", "range", ">speed", ">effort", ">rotor", ">viscous", ">Coulomb"];
    text.push_str(&table(&header, joints));
    text.push_str(" rad or m, /s, N·m or N; rotor in kg·m² or kg; - where there is no limit\n\n");
    let links = check.joints.iter().map(|j| {
        let verdict = match j.link_defects.as_slice() {
            [] => "consistent".to_owned(),
            defects => defects.join("; "),
        };
        vec![j.link.clone(), format!("{} kg", short(j.mass_kg)), some_of(&j.merged), verdict]
    });
    text.push_str(&table(&["link", ">mass", "fixed to it", "inertia"], links));
    if !check.locked.is_empty() {
        let locked: Vec<String> = check.locked.iter().map(LockCheck::words).collect();
        let lines = report::pack(locked.iter().map(String::as_str), ", ", WIDTH);
        text.push_str(&format!("\nlocked: {}\n", lines.join("\n  ")));
    }
    let base = &check.base_parameters;
    text.push_str(&format!(
        "\nbase parameters: {} inertial, {} with rotors, {} with friction, {} with both and offsets\n",
        base.inertial,
        base.with_rotors,
        base.with_friction,
        base.with_rotors_friction_and_offsets
    ));
    for warning in &check.warnings {
        text.push_str(&format!("warning: {warning}\n"));
    }
    text
}

fn coulomb(joint: &JointCheck) -> String {
    let (forward, backward) = (short(joint.coulomb_forward), short(joint.coulomb_backward));
    if forward == backward { forward } else { format!("{forward}/{backward}") }
}

fn short(value: f64) -> String {
    report::significant(value, 3)
}
