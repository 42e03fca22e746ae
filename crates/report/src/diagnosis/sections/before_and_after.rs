use askama::Template;
use diagnosis::FoldGain;
use pages::{ReportError, significant};

use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::spectra::spectra;
use crate::diagnosis::tables::{JointRow, joint_rows};

/// The errors of both models joint by joint.
#[derive(Template)]
#[template(path = "diagnosis/sections/before_and_after.html")]
pub(crate) struct BeforeAndAfter<'a> {
    held_out: &'a str,
    joints: Vec<JointRow>,
    /// What is left beside the noise, over frequency, as SVG.
    spectra: Vec<String>,
    folds: Vec<Fold<'a>>,
}

impl<'a> Section<'a> for BeforeAndAfter<'a> {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let gain = &report.diagnosis.gain.inverse;
        Ok(Some(Self {
            held_out: &gain.held_out,
            joints: joint_rows(report),
            spectra: spectra(report)?,
            folds: gain.folds.iter().map(Fold).collect(),
        }))
    }
}

/// The gain on one held-out part.
struct Fold<'a>(&'a FoldGain);

impl Fold<'_> {
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Error before and after, joint by joint.
    fn errors(&self) -> Vec<(String, String)> {
        let pairs = self.0.rms_before_nm.iter().zip(&self.0.rms_after_nm);
        pairs.map(|(&before, &after)| (significant(before, 3), significant(after, 3))).collect()
    }
}
