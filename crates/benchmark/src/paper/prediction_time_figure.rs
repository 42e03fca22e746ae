use std::path::{Path, PathBuf};

use document::{Document, KeyPath};
use robot::{Loaded, Robot};

use crate::error::BenchmarkError;
use crate::paper::figure_spec::{FigureScenario, FigureSpec, PredictionTimeFigureSpec};

/// Figure 1 of Nguyen-Tuong & Peters 2010: the time of one prediction against the number of
/// training points.
#[derive(Debug, Clone)]
pub struct PredictionTimeFigure {
    spec: PredictionTimeFigureSpec,
    file: PathBuf,
    loaded: Loaded,
}

/// Most training points: the kernel of equation 10 keeps 4 kB a point of an arm of seven joints.
const MOST_POINTS: usize = 100_000;

impl PredictionTimeFigure {
    /// Reads the figure from its scenario; `seed` replaces the seed there.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`](experiment::ExperimentError::Document), at the value at fault.
    pub fn from_document(document: &Document, seed: Option<u64>) -> Result<Self, BenchmarkError> {
        let FigureScenario { figure: FigureSpec::PredictionTime(spec) } = document.parse()? else {
            let message = "another figure, figure.prediction_time was expected";
            return Err(document.mistake(&KeyPath::root().key("figure"), message, None).into());
        };
        let key = |name: &str| KeyPath::root().key("figure").key("prediction_time").key(name);
        let points = &spec.points;
        let is_known = points.iter().all(|n| (1..=MOST_POINTS).contains(n));
        if points.is_empty() || !is_known || !points.is_sorted_by(|a, b| a < b) {
            let message = format!(
                "{points:?}, one or more rising numbers from 1 to {MOST_POINTS} were expected"
            );
            return Err(document.mistake(&key("points"), message, None).into());
        }
        let file = document.directory_of(&key("robot")).join(&spec.robot);
        let loaded = Robot::load(&file).map_err(|error| {
            let message = format!("the robot cannot be used: {error}");
            document.mistake(&key("robot"), message, None)
        })?;
        let seed = seed.unwrap_or(spec.seed);
        Ok(Self { spec: PredictionTimeFigureSpec { seed, ..spec }, file, loaded })
    }

    /// The scenario as one text that extends nothing and can be read from any folder.
    pub fn self_contained_text(&self) -> String {
        let robot = self.file.canonicalize().unwrap_or_else(|_| self.file.clone());
        let spec = PredictionTimeFigureSpec { robot, ..self.spec.clone() };
        let scenario = FigureScenario { figure: FigureSpec::PredictionTime(spec) };
        toml::to_string(&scenario).unwrap_or_default()
    }

    /// Numbers of training points, rising.
    pub fn points(&self) -> &[usize] {
        &self.spec.points
    }

    /// Seed of the points.
    pub fn seed(&self) -> u64 {
        self.spec.seed
    }

    /// The robot as described.
    pub fn loaded_robot(&self) -> &Loaded {
        &self.loaded
    }

    /// The file of the robot.
    pub fn robot_file(&self) -> &Path {
        &self.file
    }
}
