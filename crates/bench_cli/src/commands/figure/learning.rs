use std::path::{Path, PathBuf};

use benchmark::LearningFigureReport;
use benchmark::{
    LearningErrors, LearningFigure, ModelErrors, PaperData, PaperPlant, learning_claims,
};
use cli::{
    EXTENDED, Line, RunFolder, Watch, create_folder, diagnosis_files, display_path, hash, log_file,
    provenance,
};
use document::Document;
use experiment::{PAPER_MODELS, Product};
use report::Provenance;
use robot::Robot;
use serde::{Deserialize, Serialize};

use crate::commands::figure::arguments::Arguments;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// The errors on the data of one arm.
#[derive(Serialize, Deserialize)]
struct Errors {
    test: Vec<ModelErrors>,
    /// Of the real data alone.
    outside: Vec<ModelErrors>,
}

/// Draws figure 2 of the paper into `out`: simulates both arms, learns from their logs, and judges
/// what is claimed of the errors.
pub fn run(
    arguments: &Arguments,
    document: &Document,
    out: &Path,
) -> Result<BenchExitStatus, BenchError> {
    let figure = LearningFigure::from_document(document, arguments.seed)?;
    create_folder(out)?;
    let watch = Watch::of_all((!arguments.output.quiet).then(Line::new));
    let errors = Stages { figure: &figure, run: RunFolder { out, watch: &watch } }.all();
    watch.finish();
    let errors = errors?;
    let report = LearningFigureReport {
        errors: &errors,
        claims: &learning_claims(&errors),
        outside: &outside_words(&figure),
        provenance: &origin(&figure, &arguments.scenario)?,
    };
    let (json, page) = (report.json()?, report.page()?);
    let figures = report.figures()?;
    let mut files = vec![
        ("scenario.toml", figure.self_contained_text().as_bytes()),
        ("metrics.json", json.as_bytes()),
        ("report.html", page.as_bytes()),
    ];
    files.extend(figures.iter().map(|(name, svg)| (*name, svg.as_bytes())));
    report::write_folder(out, &files)?;
    let figure_files: Vec<String> =
        figures.iter().map(|(name, _)| display_path(&out.join(name))).collect();
    let closing = format!(
        "report         {}\nfigures        {}\n",
        display_path(&out.join("report.html")),
        figure_files.join("\n               ")
    );
    arguments.output.say(&json, &report.text(), &closing)?;
    Ok(BenchExitStatus::Good)
}

/// What the motion outside is.
fn outside_words(figure: &LearningFigure) -> String {
    let shares = figure.outside_share();
    let percent = |share: Option<f64>| report::percent(share.unwrap_or(f64::NAN));
    let [least, most] = [f64::min, f64::max].map(|of| shares.iter().copied().reduce(of));
    format!(
        "the models of the real data along a motion in which a joint is {} to {} of the time where \
         the training never took it, tested on {} points",
        percent(least),
        percent(most),
        figure.spec().test_points
    )
}

/// This program and the files that the figure was made from.
fn origin(figure: &LearningFigure, scenario: &Path) -> Result<Provenance, BenchError> {
    let [simulated, real] = figure.plants();
    let mut origin = provenance(real.plant().robot_file(), real.loaded_robot(), None)?;
    origin.files.push(hash("scenario", scenario)?);
    origin.files.push(hash("simulated", simulated.file())?);
    origin.files.push(hash("real", real.file())?);
    origin.seed = Some(real.plant().seed());
    Ok(origin)
}

/// The stages of the figure, each of which is made from what those before it have written.
struct Stages<'a> {
    figure: &'a LearningFigure,
    run: RunFolder<'a>,
}

impl Stages<'_> {
    /// Makes every stage that is not there yet.
    fn all(&self) -> Result<LearningErrors, BenchError> {
        let [simulated, real] = self.figure.plants();
        let simulated = self.errors(simulated)?;
        let real = self.errors(real)?;
        let (spec, robot) = (self.figure.spec(), self.figure.robot());
        Ok(LearningErrors {
            robot: robot.name().to_owned(),
            joints: robot.joint_names().map(str::to_owned).collect(),
            points: spec.learn.points,
            test_points: spec.test_points,
            simulated: simulated.test,
            real: real.test,
            outside: real.outside,
        })
    }

    /// From the simulation of an arm to the errors of its models.
    #[allow(clippy::result_large_err, reason = "the errors of plumbline are as large")]
    fn errors(&self, arm: &PaperPlant) -> Result<Errors, BenchError> {
        let name = arm.data().name();
        let [logs, diagnosis, models] =
            ["logs", "diagnosis", "models"].map(|f| Path::new(f).join(name));
        let plant = arm.plant();
        let stage = format!("{name}_logs");
        self.run.logs(&stage, &logs, plant, arm.loaded_robot(), || Ok(plant))?;
        self.diagnosis(arm, [&logs, &diagnosis])?;
        self.models(arm, [&logs, &diagnosis, &models])?;
        self.test(arm, [&logs, &models])
    }

    /// Names the causes from the logs that models are learned from.
    fn diagnosis(&self, arm: &PaperPlant, [logs, folder]: [&Path; 2]) -> Result<(), BenchError> {
        let names = self.figure.learning_runs();
        let file = arm.plant().robot_file();
        let mut inputs = RunFolder::inputs(file, arm.loaded_robot(), "")?;
        for name in &names {
            inputs = inputs.and_file(&self.run.out.join(log_file(logs, name)))?;
        }
        let stage = format!("{}_diagnosis", arm.data().name());
        let words = format!("from {} of the logs alone", names.len());
        self.run.stage::<_, BenchError>(&stage, &words, inputs, || {
            let runs = self.run.runs(logs, &names, &arm.loaded_robot().robot)?;
            self.run.diagnose(folder, file, arm.loaded_robot(), &runs)?;
            Ok(Product { value: (), files: diagnosis_files(folder) })
        })?;
        Ok(())
    }

    /// Learns the models of the paper.
    fn models(
        &self,
        arm: &PaperPlant,
        [logs, diagnosis, folder]: [&Path; 3],
    ) -> Result<(), BenchError> {
        let learn = &self.figure.spec().learn;
        let extended = self.run.out.join(diagnosis).join(EXTENDED);
        let said = format!("{learn:?} {PAPER_MODELS:?}");
        let mut inputs = RunFolder::inputs(arm.plant().robot_file(), arm.loaded_robot(), &said)?;
        inputs = inputs.and_file(&extended)?;
        let names = self.figure.learning_runs();
        for name in &names {
            inputs = inputs.and_file(&self.run.out.join(log_file(logs, name)))?;
        }
        let stage = format!("{}_models", arm.data().name());
        let words = format!("{} models of {} points", PAPER_MODELS.len(), learn.points);
        self.run.stage::<_, BenchError>(&stage, &words, inputs, || {
            let runs = self.run.runs(logs, &names, &arm.loaded_robot().robot)?;
            let named = Robot::load(&extended)?.robot;
            let models = self.figure.learn(arm, &runs, &named, self.run.watch)?;
            create_folder(&self.run.out.join(folder))?;
            models.save(&self.run.out.join(folder))?;
            Ok(Product { value: (), files: model_files(folder) })
        })?;
        Ok(())
    }

    /// Tests the models on the runs that took no part.
    fn test(&self, arm: &PaperPlant, [logs, folder]: [&Path; 2]) -> Result<Errors, BenchError> {
        let (learned, test) = (self.figure.learning_runs(), self.figure.test());
        let outside: &[&str] = match arm.data() {
            PaperData::Simulated => &[],
            PaperData::Real => &[LearningFigure::OUTSIDE],
        };
        let points = self.figure.spec().test_points.to_string();
        let mut inputs = RunFolder::inputs(arm.plant().robot_file(), arm.loaded_robot(), &points)?;
        for name in learned.iter().chain(&test).chain(outside) {
            inputs = inputs.and_file(&self.run.out.join(log_file(logs, name)))?;
        }
        for file in model_files(folder) {
            inputs = inputs.and_file(&self.run.out.join(file))?;
        }
        let stage = format!("{}_errors", arm.data().name());
        let words = format!("{points} points of {}", [&test, outside].concat().join(" and of "));
        let made = self.run.stage::<_, BenchError>(&stage, &words, inputs, || {
            experiment::Progress::begin(self.run.watch, "test");
            let robot = &arm.loaded_robot().robot;
            let models = self.figure.load(arm, &self.run.out.join(folder))?;
            let learned = self.run.runs(logs, &learned, robot)?;
            let errors = |names: &[&str]| -> Result<Vec<ModelErrors>, BenchError> {
                match self.run.runs(logs, names, robot)? {
                    runs if runs.is_empty() => Ok(Vec::new()),
                    runs => Ok(self.figure.errors(arm, &models, [&learned, &runs])?),
                }
            };
            let value = Errors { test: errors(&test)?, outside: errors(outside)? };
            Ok(Product { value, files: Vec::new() })
        })?;
        Ok(made.value)
    }
}

/// The files of the models in a folder.
fn model_files(folder: &Path) -> Vec<PathBuf> {
    PAPER_MODELS.iter().map(|kind| folder.join(format!("{kind}.parquet"))).collect()
}
