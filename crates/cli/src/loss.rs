use std::path::{Path, PathBuf};

use exchange::Export;
use logs::Run;
use robot::{Loaded, Robot};
use schemars::JsonSchema;
use serde::Serialize;

use crate::columns::LogArguments;
use crate::diagnosed_input::DiagnosedInput;
use crate::error::CliError;
use crate::input::PartArguments;
use crate::input_warnings::correct_runs;
use crate::messages::warn;
use crate::output::{display_path, table};

/// Logs that exports are tested on.
#[derive(Debug, clap::Args)]
pub struct LossArguments {
    /// Logs that the diagnosis has not seen: the torque error of what each file holds is printed beside those
    /// of the nominal and of the extended robot
    #[arg(long = "log", value_name = "FILE", num_args = 1..)]
    logs: Vec<PathBuf>,
    /// The robot before the findings [default: the one that diagnosis.json names, or the URDF alone]
    #[arg(long, value_name = "FILE", requires = "logs")]
    nominal: Option<PathBuf>,
    #[command(flatten)]
    reading: LogArguments,
}

/// Torque errors of descriptions of a robot on held-out logs.
#[derive(Serialize, JsonSchema)]
pub struct Loss {
    logs: Vec<String>,
    joints: Vec<String>,
    models: Vec<ModelError>,
}

/// The torque error of a description.
#[derive(Serialize, JsonSchema)]
struct ModelError {
    /// `nominal`, `extended`, or the name of a format.
    model: &'static str,
    described_by: String,
    /// RMS while the joint moves (N·m or N); none where it does not.
    rms_nm: Vec<Option<f64>>,
    /// Root of the sum of the squares.
    all_nm: f64,
}

impl LossArguments {
    /// The torque errors of the nominal robot, of the one that `path` describes and of its exports, each with the
    /// name of its format and its file, on the logs; none without logs.
    ///
    /// # Errors
    ///
    /// [`CliError`] of a log, or of a nominal robot, that cannot be used.
    pub fn measure<'a>(
        &self,
        path: &Path,
        loaded: &Loaded,
        part: &PartArguments,
        exports: impl Iterator<Item = (&'static str, String, &'a Export)>,
    ) -> Result<Option<Loss>, CliError> {
        if self.logs.is_empty() {
            return Ok(None);
        }
        let diagnosed = DiagnosedInput::read(&path.with_file_name("diagnosis.json")).ok();
        let (nominal, name) = self.nominal(path, loaded, part, diagnosed.as_ref())?;
        let named = diagnosed.as_ref().map(|input| input.columns(&self.reading)).transpose()?;
        let reading = named.as_ref().unwrap_or(&self.reading);
        let runs = reading.read_runs(&self.logs, &loaded.robot)?;
        let runs = correct_runs(loaded, &runs).unwrap_or(runs);
        let error = |model, described_by, robot: &Robot| {
            ModelError::measure(model, described_by, robot, loaded.control.rate_hz, &runs)
        };
        let mut models = vec![
            error("nominal", name, &nominal)?,
            error("extended", display_path(path), &loaded.robot)?,
        ];
        for (format, file, export) in exports {
            models.push(error(format, file, &export.robot)?);
        }
        Ok(Some(Loss {
            logs: self.logs.iter().map(|log| display_path(log)).collect(),
            joints: loaded.robot.joint_names().map(str::to_owned).collect(),
            models,
        }))
    }

    /// The robot before the findings, with the joints of the extended one, and where it is described.
    fn nominal(
        &self,
        path: &Path,
        loaded: &Loaded,
        part: &PartArguments,
        diagnosed: Option<&DiagnosedInput>,
    ) -> Result<(Robot, String), CliError> {
        let found = self.nominal.clone().or_else(|| diagnosed?.unchanged_robot());
        let Some(file) = found else {
            let name = display_path(&loaded.urdf_path);
            warn(&format!("nominal is what {name} says alone; --nominal names another robot"));
            return Ok((loaded.robot_in_urdf.clone(), name));
        };
        let mut part = diagnosed.map_or_else(|| part.clone(), |input| input.part(part));
        if part.joints.is_empty() && !loaded.part.is_whole() {
            part.joints = loaded.robot.joint_names().map(str::to_owned).collect();
            part.locked = loaded.part.locked.clone().into_iter().collect();
        }
        let nominal = part.load(&file)?.robot;
        if !nominal.joint_names().eq(loaded.robot.joint_names()) {
            return Err(CliError::OtherJoints { path: file, expected: path.to_owned() });
        }
        Ok((nominal, display_path(&file)))
    }
}

impl ModelError {
    fn measure(
        model: &'static str,
        described_by: String,
        robot: &Robot,
        rate_hz: Option<f64>,
        runs: &[Run],
    ) -> Result<Self, CliError> {
        let rms_nm = experiment::robot_error(robot, rate_hz, runs)?;
        let all_nm = rms_nm.iter().flatten().map(|rms| rms * rms).sum::<f64>().sqrt();
        Ok(Self { model, described_by, rms_nm, all_nm })
    }
}

impl Loss {
    /// A table with a row a joint and a column a description.
    pub fn text(&self) -> String {
        let number = |rms: Option<f64>| rms.map_or("-".to_owned(), |x| report::significant(x, 3));
        let header: Vec<String> = std::iter::once("joint".to_owned())
            .chain(self.models.iter().map(|model| format!(">{}", model.model)))
            .collect();
        let row = |name: &str, of: &dyn Fn(&ModelError) -> Option<f64>| {
            let cells = self.models.iter().map(|model| number(of(model)));
            std::iter::once(name.to_owned()).chain(cells).collect::<Vec<_>>()
        };
        let joints = self.joints.iter().enumerate();
        let mut rows: Vec<_> =
            joints.map(|(j, joint)| row(joint, &|model| model.rms_nm.get(j).copied()?)).collect();
        rows.push(row("all", &|model| Some(model.all_nm)));
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let nominal = self.models.first().map_or("", |model| &model.described_by);
        format!(
            "torque error on {}, RMS while a joint moves (N·m or N), of what each file holds;\n\
             nominal is {nominal}\n{}",
            self.logs.join(", "),
            table(&header, rows)
        )
    }
}
