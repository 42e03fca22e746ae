use askama::Template;
use exchange::{Export, Format};
use pages::ReportError;

use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;

/// The extended robot in the files of other programs, to copy.
#[derive(Template)]
#[template(path = "diagnosis/sections/descriptions.html")]
pub(crate) struct Descriptions<'a> {
    descriptions: &'a [(Format, Export)],
}

impl<'a> Section<'a> for Descriptions<'a> {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let descriptions = report.descriptions;
        Ok((!descriptions.is_empty()).then_some(Self { descriptions }))
    }
}
