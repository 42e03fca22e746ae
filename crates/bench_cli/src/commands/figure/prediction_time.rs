use std::path::Path;

use benchmark::{PredictionTimeFigure, time_claims};
use benchmark::{PredictionTimeFigureReport, PredictionTimes, TimeCurve};
use cli::{Line, RunFolder, Watch, create_folder, display_path, hash, provenance};
use document::Document;
use experiment::Product;

use crate::commands::figure::arguments::Arguments;
use crate::commands::times::curves::{AS_WRITTEN, MadeUp, curves, machine};
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// What is to know of the two curves of the rigid-body kernel.
const KERNELS: &str = "The rigid-body kernel is a product, so that its sum over the training points is one vector: \
     rbd-kernel sums it once, rbd-kernel as in eq. 10 at every prediction as the paper has it.";

/// Draws figure 1 of the paper into `out`, and judges what is claimed of the times.
pub fn run(
    arguments: &Arguments,
    document: &Document,
    out: &Path,
) -> Result<BenchExitStatus, BenchError> {
    let figure = PredictionTimeFigure::from_document(document, arguments.seed)?;
    create_folder(out)?;
    let watch = Watch::of_all((!arguments.output.quiet).then(Line::new));
    let measured = measure(&figure, RunFolder { out, watch: &watch });
    watch.finish();
    let loaded = figure.loaded_robot();
    let mut provenance = provenance(figure.robot_file(), loaded, None)?;
    provenance.files.push(hash("scenario", &arguments.scenario)?);
    provenance.seed = Some(figure.seed());
    let times = PredictionTimes {
        robot: loaded.robot.name().to_owned(),
        joints: loaded.robot.joint_count(),
        machine: machine(),
        curves: measured?,
        remarks: vec![KERNELS.to_owned()],
        provenance,
    };
    let claims = time_claims(&times.each(), AS_WRITTEN);
    let report = PredictionTimeFigureReport { times: &times, claims: &claims };
    let (json, page, svg) = (report.json()?, report.page()?, times.figure()?);
    let files = [
        ("scenario.toml", figure.self_contained_text()),
        ("metrics.json", json.clone()),
        ("report.html", page),
        ("figure1.svg", svg),
    ];
    let files = files.each_ref().map(|(name, text)| (*name, text.as_bytes()));
    report::write_folder(out, &files)?;
    let closing = format!(
        "report         {}\nfigure         {}\n",
        display_path(&out.join("report.html")),
        display_path(&out.join("figure1.svg"))
    );
    arguments.output.say(&json, &report.text(), &closing)?;
    Ok(BenchExitStatus::Good)
}

/// The times on this machine, measured now or before.
fn measure(figure: &PredictionTimeFigure, run: RunFolder) -> Result<Vec<TimeCurve>, BenchError> {
    let (points, seed) = (figure.points(), figure.seed());
    let said = format!("{points:?} {seed} {}", machine());
    let inputs = RunFolder::inputs(figure.robot_file(), figure.loaded_robot(), &said)?;
    let words = format!("one prediction, {} numbers of training points", points.len());
    let made = run.stage::<_, BenchError>("times", &words, inputs, || {
        let curves = curves(&figure.loaded_robot().robot, MadeUp { points, seed }, run.watch)?;
        Ok(Product { value: curves, files: Vec::new() })
    })?;
    Ok(made.value)
}
