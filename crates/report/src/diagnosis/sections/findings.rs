use askama::Template;
use pages::ReportError;

use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::tables::{Cause, cause};

/// The effects that were found.
#[derive(Template)]
#[template(path = "diagnosis/sections/findings.html")]
pub(crate) struct FoundEffects {
    causes: Vec<Cause>,
}

impl<'a> Section<'a> for FoundEffects {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let causes = report.diagnosis.findings.iter().map(|finding| cause(report, finding));
        Ok(Some(Self { causes: causes.collect() }))
    }
}
