use askama::Template;

use crate::learning::comparison::{
    ComparedJoint, DataSet, KernelRow, LearningComparison, ModelRow,
};
use pages::{
    Cell, FileHash, HtmlGrid, Medium, Provenance, ReportError, TABLE_DIGITS, escape_json,
    mark_least, percent_range, render_html, render_page, significant,
};

#[derive(Template)]
#[template(path = "learning/learning.html")]
struct Page<'a> {
    comparison: &'a LearningComparison,
    sentence: String,
    errors: String,
    error_table: String,
    rms_table: String,
    costs: String,
    kernels: Vec<(&'a str, String)>,
    data: [(&'static str, &'a DataSet); 3],
    provenance: &'a Provenance,
    json: String,
}

impl LearningComparison {
    /// `report.html`: the errors of every model, what they cost and what they learned, in one file
    /// that opens offline, and without scripts too.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn page(&self) -> Result<String, ReportError> {
        let shared = self.without_folders();
        let kernels = shared.models.iter().filter_map(|model| {
            let kernels = model.kernels.as_ref()?;
            Some(shared.kernel_table(kernels).map(|table| (model.name.as_str(), table)))
        });
        render_page(&Page {
            sentence: shared.sentence(),
            errors: shared.draw(Medium::Page)?,
            error_table: shared.by_joint("Joint (nMSE)", |model| &model.nmse)?,
            rms_table: shared.by_joint("Joint (N·m or N)", |model| &model.rmse_nm)?,
            costs: shared.cost_table()?,
            kernels: kernels.collect::<Result<_, _>>()?,
            data: [
                ("learned from", &shared.train),
                ("rigid bodies from", &shared.regression),
                ("tested on", &shared.test),
            ],
            provenance: &shared.provenance,
            json: escape_json(&shared.json()?),
            comparison: &shared,
        })
    }

    /// The same without the folders of this machine.
    fn without_folders(&self) -> Self {
        let short = |data: &DataSet| {
            let files = Provenance { files: data.logs.clone(), ..self.provenance.clone() };
            let logs: Vec<FileHash> = files.without_folders().files;
            DataSet { logs, ..data.clone() }
        };
        Self {
            train: short(&self.train),
            regression: short(&self.regression),
            test: short(&self.test),
            provenance: self.provenance.without_folders(),
            ..self.clone()
        }
    }

    /// Which model errs least, in a sentence.
    fn sentence(&self) -> String {
        let mean = |model: &ModelRow| {
            let known: Vec<f64> = model.nmse.iter().copied().filter(|e| e.is_finite()).collect();
            let whole = !known.is_empty() && known.len() == self.joints.len();
            whole.then(|| known.iter().sum::<f64>() / known.len() as f64)
        };
        let known = self.models.iter().filter_map(|model| Some((model, mean(model)?)));
        let Some((best, error)) = known.min_by(|a, b| a.1.total_cmp(&b.1)) else {
            return "No model has an error at every joint.".to_owned();
        };
        format!(
            "Of {} models {} errs least on {} held-out samples: its nMSE is {} in the mean of the joints.",
            self.models.len(),
            best.name,
            self.test.points,
            significant(error, TABLE_DIGITS)
        )
    }

    /// One row a joint, the least of a row standing out.
    fn by_joint(
        &self,
        corner: &str,
        numbers: fn(&ModelRow) -> &Vec<f64>,
    ) -> Result<String, ReportError> {
        let row = |(i, joint): (usize, &ComparedJoint)| {
            let errors = self.models.iter().map(|model| numbers(model).get(i).copied());
            let errors: Vec<f64> = errors.map(|error| error.unwrap_or(f64::NAN)).collect();
            (joint.name.clone(), mark_least(&errors))
        };
        render_html(&HtmlGrid {
            corner: corner.to_owned(),
            header: self.models.iter().map(|model| model.name.clone()).collect(),
            rows: self.joints.iter().enumerate().map(row).collect(),
        })
    }

    /// One row a model.
    fn cost_table(&self) -> Result<String, ReportError> {
        let header =
            ["Points", "Training (s)", "Prediction (µs)", "Log likelihood", "In 95 % interval"];
        let row = |model: &ModelRow| {
            let cells = [
                if model.points == 0 { "-".to_owned() } else { model.points.to_string() },
                significant(model.training_s, TABLE_DIGITS),
                significant(model.prediction_us, TABLE_DIGITS),
                model.log_likelihood.map_or("-".to_owned(), |value| significant(value, 6)),
                model.coverage_95.as_ref().map_or("-".to_owned(), |c| percent_range(c)),
            ];
            (model.name.clone(), cells.map(Cell::plain).to_vec())
        };
        render_html(&HtmlGrid {
            corner: "Model".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.models.iter().map(row).collect(),
        })
    }

    /// The hyperparameters of a model, one row a joint.
    fn kernel_table(&self, kernels: &[KernelRow]) -> Result<String, ReportError> {
        let row = |(joint, kernel): (&ComparedJoint, &KernelRow)| {
            let scales = kernel.length_scales.iter();
            let scales = scales.map(|(name, scale)| format!("{name} {}", significant(*scale, 3)));
            let cells = [
                significant(kernel.signal_variance_nm2.sqrt(), TABLE_DIGITS),
                significant(kernel.noise_variance_nm2.sqrt(), TABLE_DIGITS),
                scales.collect::<Vec<_>>().join(", "),
                kernel.search.clone(),
            ];
            (joint.name.clone(), cells.map(Cell::plain).to_vec())
        };
        let header =
            ["Signal (N·m or N)", "Noise (N·m or N)", "Length scales", "How the search ended"];
        render_html(&HtmlGrid {
            corner: "Joint".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.joints.iter().zip(kernels).map(row).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::learning::sample;

    #[test]
    fn the_page_holds_errors_costs_and_kernels_and_no_folder_of_the_machine() {
        let mut comparison = sample::comparison();
        comparison.train.logs[0].path = "/home/me/a.csv".into();
        let page = comparison.page().unwrap();
        for expected in [
            "Of 3 models gp-rbd errs least on 4000 held-out samples",
            "shoulder, gp: 0.0100",
            "<td class=\"n best\">0.0200</td>",
            "<td class=\"n\">91-96 %</td>",
            "shoulder.position (rad) 1.25",
            "gp: the search at elbow was stopped",
            "plumbline.learning/1",
        ] {
            assert!(page.contains(expected), "{expected} is missing in {page}");
        }
        assert!(!page.contains("/home") && !page.contains("NaN"));
        comparison.models.clear();
        assert!(comparison.page().unwrap().contains("No model has an error"));
    }
}
