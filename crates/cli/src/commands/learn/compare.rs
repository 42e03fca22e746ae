use std::path::Path;
use std::time::Instant;

use effects::omissions;
use learner::{
    LearnerError, ModelKind, Regression, RigidBodyFit, Samples, TorqueScore, TrainSettings,
    Training,
};
use report::{ComparedJoint, LearningComparison, ModelRow};
use robot::{Loaded, Robot};

use super::arguments::Arguments;
use super::data::LearningData;
use super::row::row;
use super::timing::median_query_us;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{create_folder, display_path, print_answer};
use crate::quiet::Quiet;
use crate::watch::Watch;

/// A file of the output folder, and what it holds.
type NamedFile = (String, Vec<u8>);

/// Learns the models, compares them, and writes them with the comparison.
pub fn run(arguments: &Arguments, loaded: &Loaded, watch: &Watch) -> Result<ExitStatus, CliError> {
    let robot = &loaded.robot;
    let named =
        arguments.named.as_deref().map(|path| read_extended_robot(path, robot)).transpose()?;
    settings(arguments, Vec::new()).check()?;
    let data = LearningData::read(arguments, loaded)?;
    let out = arguments.out.as_path();
    create_folder(out)?;
    let learned = Learning { arguments, robot, named: named.as_ref(), data: &data, watch }.run(out);
    watch.finish();
    let (models, mut files) = learned?;
    let mut warnings = data.warnings.clone();
    warnings.extend(omissions(named.as_ref().unwrap_or(robot)));
    let comparison = LearningComparison {
        robot: robot.name().to_owned(),
        joints: ComparedJoint::all(robot),
        train: data.train.summary(arguments.points),
        regression: data.regression().summary(usize::MAX),
        test: data.test.summary_of_test(),
        thinning: "sample floor(i n / points) of n, i from 0: evenly spread over all runs".into(),
        cutoff_hz: data.cutoff_hz,
        models,
        warnings,
        provenance: arguments.robot.provenance(loaded, arguments.reading.columns.map.as_deref())?,
    };
    files.push(("learning.json".to_owned(), comparison.json()?.into_bytes()));
    files.push(("figure.svg".to_owned(), comparison.figure()?.into_bytes()));
    files.push(("report.html".to_owned(), comparison.page()?.into_bytes()));
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    report::write_folder(out, &files)?;
    say(arguments, out, &comparison)?;
    Ok(ExitStatus::Good)
}

/// The robot with named effects, which must be the same robot.
fn read_extended_robot(path: &Path, robot: &Robot) -> Result<Robot, CliError> {
    let named = Robot::load(path)?.robot;
    if named.joint_names().eq(robot.joint_names()) {
        return Ok(named);
    }
    Err(CliError::OtherRobot { path: path.to_owned(), expected: robot.name().to_owned() })
}

/// How the models are trained; with directions of motion as inputs where there are speeds.
fn settings(arguments: &Arguments, direction_speeds: Vec<f64>) -> TrainSettings {
    TrainSettings {
        points: arguments.points,
        inducing_points: arguments.inducing_points,
        prior: arguments.prior,
        direction_speeds,
        ..TrainSettings::default()
    }
}

/// What models are learned from.
struct Learning<'a> {
    arguments: &'a Arguments,
    robot: &'a Robot,
    named: Option<&'a Robot>,
    data: &'a LearningData,
    watch: &'a Watch,
}

impl Learning<'_> {
    /// The rows of all models, and their files.
    fn run(&self, out: &Path) -> Result<(Vec<ModelRow>, Vec<NamedFile>), CliError> {
        let begin = Instant::now();
        let fit = self.regression()?;
        let regression_s = begin.elapsed().as_secs_f64();
        let (samples, rest_speeds) = (&self.data.train.samples, &self.data.rest_speeds);
        let directions = self.arguments.directions.then(|| rest_speeds.clone());
        let settings = settings(self.arguments, directions.unwrap_or_default());
        let mut training =
            Training::new(self.robot, samples, rest_speeds.clone(), &settings, self.watch)?
                .with_regression(&fit);
        if let Some(named) = self.named {
            training = training.with_named(named);
        }
        let tested = self.data.test_samples();
        let (mut rows, mut files) = (Vec::new(), Vec::new());
        for kind in without_repeats(&self.arguments.models) {
            let (mut row, file) = self.model(&mut training, kind, &tested, out)?;
            if kind == ModelKind::Rbd {
                row.training_s += regression_s;
                row.remarks.extend(remark_of_fit(&fit));
            }
            row.remarks.extend(shared_kernels(&rows, &row));
            files.push(file);
            rows.push(row);
        }
        Ok((rows, files))
    }

    fn regression(&self) -> Result<RigidBodyFit, LearnerError> {
        self.watch.begin("regression of the rigid bodies");
        let mut regression = Regression::new(self.robot, self.arguments.columns);
        regression.add_samples(&self.data.regression().samples)?;
        regression.fit(None)
    }

    /// Trains one model, tests it, and gives its file of the folder `out`.
    fn model(
        &self,
        training: &mut Training,
        kind: ModelKind,
        tested: &Samples,
        out: &Path,
    ) -> Result<(ModelRow, NamedFile), CliError> {
        self.watch.begin(kind.name());
        let begin = Instant::now();
        let fitted = training.fit(kind)?;
        let training_s = begin.elapsed().as_secs_f64();
        self.watch.begin(&format!("{kind}: test on {} samples", tested.len()));
        let score = TorqueScore::of(&fitted.model, tested);
        let prediction_us = median_query_us(&fitted.model, tested);
        let name = format!("models/{kind}.parquet");
        let bytes = fitted.model.bytes(&out.join(&name))?;
        let mut row = row(&fitted, score, self.robot);
        if self.watch.took_an_end() {
            row.remarks.push("Ctrl-C ended searches of it before they converged".to_owned());
        }
        Ok((ModelRow { training_s, prediction_us, ..row }, (name, bytes)))
    }
}

/// Every kind once, in the order of the first mention.
fn without_repeats(kinds: &[ModelKind]) -> Vec<ModelKind> {
    let mut kept = Vec::new();
    for kind in kinds {
        if !kept.contains(kind) {
            kept.push(*kind);
        }
    }
    kept
}

/// A remark on parameters that the regression could not determine.
fn remark_of_fit(fit: &RigidBodyFit) -> Option<String> {
    (!fit.undetermined.is_empty()).then(|| {
        format!(
            "{} of {} combinations of parameters are not determined by {} samples and stay as \
             described",
            fit.undetermined.len(),
            fit.rank + fit.undetermined.len(),
            fit.samples
        )
    })
}

/// A remark on the time of a model whose kernels were searched for with an earlier one.
fn shared_kernels(earlier: &[ModelRow], row: &ModelRow) -> Option<String> {
    let scales = |row: &ModelRow| -> Option<Vec<_>> {
        Some(row.kernels.as_ref()?.iter().map(|kernel| kernel.length_scales.clone()).collect())
    };
    let own = scales(row)?;
    let first = earlier.iter().find(|earlier| scales(earlier).as_ref() == Some(&own))?;
    Some(format!("its Gaussian kernels are those of {}, whose time holds the search", first.name))
}

/// Table or JSON on the standard output; with JSON, where the files lie on the standard error.
fn say(arguments: &Arguments, out: &Path, comparison: &LearningComparison) -> Result<(), CliError> {
    let closing = format!(
        "comparison     {}\nfigure         {}\nmodels         {}\n",
        display_path(&out.join("learning.json")),
        display_path(&out.join("figure.svg")),
        display_path(&out.join("models"))
    );
    let json = arguments.json.then(|| comparison.json()).transpose()?;
    print_answer(Quiet(arguments.quiet), json.as_deref(), || comparison.text(), &closing)
}
