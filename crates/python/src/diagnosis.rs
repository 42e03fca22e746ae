use std::path::PathBuf;
use std::sync::Arc;

use ::diagnosis::{DiagnosisRun, JointTraces, RunTraces, Settings};
use cli::{SearchArguments, hashes_of, provenance_of};
use experiment::{DiagnosedLogs, ForwardGap};
use logs::Run;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::{InputOptions, Provenance, Report};

use crate::arguments::{effects, positive};
use crate::arrays::{rows_of, table};
use crate::error::exception;
use crate::log::PyLog;
use crate::robot::PyRobot;
use crate::work::{Work, run};

/// What a model gets wrong in logs.
#[pyclass(frozen, name = "Diagnosis", module = "plumbline")]
pub struct PyDiagnosis {
    robot: Arc<::robot::Loaded>,
    extended: Py<PyRobot>,
    runs: Vec<Run>,
    outcome: DiagnosisRun,
    forward: Option<ForwardGap>,
    provenance: Provenance,
    input: InputOptions,
    doubts: Vec<String>,
}

/// The arguments of a diagnosis that Python asks for.
pub struct DiagnosisRequest<'a> {
    /// Name of the function of Python.
    pub function: &'static str,
    /// The robot.
    pub robot: &'a PyRobot,
    /// The logs.
    pub logs: Vec<PyRef<'a, PyLog>>,
    /// Cut-off of the low-pass (Hz).
    pub cutoff_hz: Option<f64>,
    /// Effects that are not looked for.
    pub without: &'a [String],
    /// Whether nothing is fitted beside the findings.
    pub only_findings: bool,
}

impl DiagnosisRequest<'_> {
    /// The logs as runs of the robot.
    pub fn runs(&self) -> PyResult<Vec<Run>> {
        self.logs.iter().map(|log| log.run(&self.robot.loaded.robot)).collect()
    }

    /// How the robot and the logs were read; of logs that were read in several ways, how the robot was.
    pub fn input(&self) -> InputOptions {
        let joints = self.robot.asked.clone().unwrap_or_default();
        let locked = self.robot.locked.clone();
        let columns: Vec<_> = self.logs.iter().filter_map(|log| log.columns()).collect();
        let all = columns.iter().map(|columns| cli::options_of_columns(columns));
        let all: Vec<InputOptions> = all.collect();
        let episodes = all.iter().flat_map(|options| options.episodes.clone()).collect();
        let without =
            |options: &InputOptions| InputOptions { episodes: Vec::new(), ..options.clone() };
        match all.first().map(without) {
            Some(first) if all.iter().all(|options| without(options) == first) => {
                InputOptions { joints, locked, episodes, ..first }
            }
            _ => InputOptions { joints, locked, ..InputOptions::default() },
        }
    }

    /// How causes are searched.
    pub fn settings(&self) -> PyResult<Settings> {
        let cutoff_hz = positive("cutoff_hz", self.cutoff_hz)?;
        let search = SearchArguments {
            cutoff_hz,
            without: effects(self.without)?,
            only_findings: self.only_findings,
        };
        Ok(search.settings(&self.robot.loaded))
    }

    /// Where the answer comes from: the command line of the program that gives the same, or the call
    /// where a log was never a file.
    pub fn provenance(&self, runs: &[Run]) -> PyResult<Provenance> {
        let loaded = &self.robot.loaded;
        let mut provenance =
            provenance_of(self.command(runs), &self.robot.path, loaded, None).map_err(exception)?;
        provenance.files.extend(hashes_of(runs));
        Ok(provenance)
    }

    fn command(&self, runs: &[Run]) -> Vec<String> {
        let robot = self.robot.path.display().to_string();
        let files: Option<Vec<_>> = self.logs.iter().map(|log| log.options()).collect();
        let same = files.filter(|files| files.windows(2).all(|pair| pair[0].1 == pair[1].1));
        let Some(files) = same else {
            let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
            return vec![format!("plumbline.{}({robot}, [{}])", self.function, names.join(", "))];
        };
        let mut command = vec!["plumbline".to_owned(), self.function.to_owned()];
        command.extend(["--robot".to_owned(), robot]);
        if let Some(joints) = &self.robot.asked {
            command.extend(["--joints".to_owned(), joints.join(",")]);
        }
        if !self.robot.locked.is_empty() {
            let each = self.robot.locked.iter().map(|(name, at)| format!("{name}={at}"));
            command.extend(["--locked".to_owned(), each.collect::<Vec<_>>().join(",")]);
        }
        command.push("--log".to_owned());
        command.extend(files.iter().map(|(path, _)| path.display().to_string()));
        command.extend(files.first().map(|(_, options)| options.clone()).unwrap_or_default());
        if let Some(cutoff_hz) = self.cutoff_hz {
            command.extend(["--cutoff-hz".to_owned(), cutoff_hz.to_string()]);
        }
        if self.only_findings {
            command.push("--only-findings".to_owned());
        }
        for effect in self.without {
            command.extend(["--without".to_owned(), effect.clone()]);
        }
        command
    }
}

impl PyDiagnosis {
    /// The diagnosis that an outcome is.
    pub fn new(
        py: Python<'_>,
        robot: &PyRobot,
        runs: Vec<Run>,
        outcome: DiagnosisRun,
        forward: Option<ForwardGap>,
        provenance: Provenance,
        input: InputOptions,
    ) -> PyResult<Self> {
        let doubts = cli::input_warnings(&robot.loaded, &runs);
        let extended = Py::new(py, robot.with_robot(outcome.extended.clone()))?;
        let loaded = Arc::clone(&robot.loaded);
        Ok(Self { robot: loaded, extended, runs, outcome, forward, provenance, input, doubts })
    }

    /// The logs, as they were given.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    fn as_report(&self) -> Report<'_> {
        Report {
            forward: self.forward.as_ref(),
            input: Some(&self.input),
            ..Report::new(&self.outcome, &self.robot.robot, &self.provenance)
        }
    }
}

/// Names what the model of `robot` gets wrong in `logs`.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for logs that cannot be used.
#[pyfunction]
#[pyo3(signature = (robot, logs, *, cutoff_hz=None, without=Vec::new(), only_findings=false, progress=None))]
pub fn diagnose(
    py: Python<'_>,
    robot: &PyRobot,
    logs: Vec<PyRef<'_, PyLog>>,
    cutoff_hz: Option<f64>,
    without: Vec<String>,
    only_findings: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyDiagnosis> {
    let request = DiagnosisRequest {
        function: "diagnose",
        robot,
        logs,
        cutoff_hz,
        without: &without,
        only_findings,
    };
    let (runs, settings) = (request.runs()?, request.settings()?);
    let (provenance, input) = (request.provenance(&runs)?, request.input());
    let about = &robot.loaded.robot;
    let found = run(py, progress.as_ref(), |work: &Work| {
        let outcome = ::diagnosis::diagnose(about, &runs, &settings, work)?;
        let read = outcome.read.as_deref().unwrap_or(&runs);
        let robots = [about, &outcome.extended];
        let cutoff_hz = outcome.diagnosis.data.cutoff_hz;
        // A robot that cannot be simulated is diagnosed all the same.
        let forward = experiment::forward_gap_of_logs(robots, read, cutoff_hz, work).ok();
        Ok::<_, ::diagnosis::DiagnosisError>((outcome, forward))
    })?;
    let (outcome, forward) = found.map_err(exception)?;
    PyDiagnosis::new(py, robot, runs, outcome, forward, provenance, input)
}

#[pymethods]
impl PyDiagnosis {
    /// The robot with the findings in it.
    #[getter]
    fn robot(&self, py: Python<'_>) -> Py<PyRobot> {
        self.extended.clone_ref(py)
    }

    /// What the description of the robot leaves out of its motion, in sentences.
    #[getter]
    fn doubts(&self) -> Vec<String> {
        self.doubts.clone()
    }

    /// `diagnosis.json`.
    pub fn json(&self) -> PyResult<String> {
        report::json(&self.as_report()).map_err(exception)
    }

    /// What the program prints.
    fn text(&self) -> String {
        report::text(&self.as_report())
    }

    /// `report.html`.
    fn html(&self) -> PyResult<String> {
        report::html(&self.as_report()).map_err(exception)
    }

    /// The first screen of the report.
    fn notebook(&self) -> PyResult<String> {
        report::notebook(&self.as_report()).map_err(exception)
    }

    /// `figure.svg`.
    fn figure(&self) -> PyResult<String> {
        report::figure(&self.as_report()).map_err(exception)
    }

    /// Writes the files of the program's output folder.
    #[pyo3(signature = (folder, *, recording=true, progress=None))]
    fn report(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        recording: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let report = self.as_report();
        cli::write_diagnosis(&folder, &self.robot, &self.outcome, &report, None)
            .map_err(exception)?;
        if !recording {
            return Ok(());
        }
        let diagnosed = DiagnosedLogs {
            loaded: &self.robot,
            runs: self.outcome.read.as_deref().unwrap_or(&self.runs),
            outcome: &self.outcome,
            verdict: &report::markdown(&report),
        };
        let recorded =
            run(py, progress.as_ref(), |work| cli::record_diagnosis(&folder, &diagnosed, work))?;
        recorded.map(|_| ()).map_err(|error| exception(*error))
    }

    /// The signals behind the diagnosis: of every run its name, its times (s), and by name position, velocity, and the
    /// measured, nominal and extended torque, each of the shape (samples, joints).
    fn traces<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let of = |trace: &RunTraces| {
            let run = PyDict::new(py);
            run.set_item("name", &trace.name)?;
            run.set_item("time", PyArray1::from_slice(py, &trace.time))?;
            for (name, signal) in TRACES {
                let columns: Vec<&[f64]> = trace.joints.iter().map(signal).collect();
                run.set_item(name, table(py, rows_of(&columns), columns.len(), false)?)?;
            }
            Ok(run)
        };
        self.outcome.traces.iter().map(of).collect()
    }
}

/// A signal of a joint.
type TraceSignal = fn(&JointTraces) -> &[f64];

/// Signals behind a diagnosis, by name.
const TRACES: [(&str, TraceSignal); 5] = [
    ("position", |joint| &joint.position),
    ("velocity", |joint| &joint.velocity),
    ("measured", |joint| &joint.measured),
    ("nominal", |joint| &joint.nominal),
    ("extended", |joint| &joint.extended),
];
