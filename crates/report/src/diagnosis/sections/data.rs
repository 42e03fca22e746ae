use askama::Template;
use diagnosis::DataSummary;
use pages::ReportError;

use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;

/// The logs and what was done to them.
#[derive(Template)]
#[template(path = "diagnosis/sections/data.html")]
pub(crate) struct Data<'a> {
    data: &'a DataSummary,
}

impl<'a> Section<'a> for Data<'a> {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        Ok(Some(Self { data: &report.diagnosis.data }))
    }
}

/// Filters of the template.
mod filters {
    use pages::significant;

    /// Three significant digits.
    #[askama::filter_fn]
    pub fn short(value: &f64, _: &dyn askama::Values) -> askama::Result<String> {
        Ok(significant(*value, 3))
    }
}
