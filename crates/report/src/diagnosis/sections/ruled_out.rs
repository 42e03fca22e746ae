use askama::Template;
use diagnosis::RuledOut;
use pages::{ReportError, significant, unit};

use crate::diagnosis::places::joint_of;
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::tables::name_beside_joint;

/// Effects that were tested and not found.
#[derive(Template)]
#[template(path = "diagnosis/sections/ruled_out.html")]
pub(crate) struct RuledOutEffects {
    /// Joint by joint; the first name is that of the whole robot.
    groups: Vec<(String, Vec<RuledOutRow>)>,
}

impl<'a> Section<'a> for RuledOutEffects {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let places = std::iter::once(None).chain((0..report.diagnosis.joints.len()).map(Some));
        let groups = places.map(|place| {
            let name = place.and_then(|i| report.diagnosis.joints.get(i)).map(|j| j.name.clone());
            let here =
                report.diagnosis.ruled_out.iter().filter(|r| joint_of(report, &r.at) == place);
            (name.unwrap_or_else(|| "whole robot".to_owned()), here.map(ruled_out_row).collect())
        });
        let has_rows = |(_, rows): &(String, Vec<RuledOutRow>)| !rows.is_empty();
        Ok(Some(Self { groups: groups.filter(has_rows).collect() }))
    }
}

/// An effect that was looked for and not found, as text.
struct RuledOutRow {
    effect: String,
    smallest: String,
    because: String,
}

fn ruled_out_row(ruled_out: &RuledOut) -> RuledOutRow {
    let smallest = match ruled_out.smallest_detectable {
        Some(size) => {
            let parameter = ruled_out.parameter.replace('_', " ");
            let of = if ruled_out.at.effect.grows_as_its_size_falls() { "up to " } else { "" };
            format!("{parameter} {of}{} {}", significant(size, 2), unit(ruled_out.unit))
        }
        None => "these logs cannot show any".to_owned(),
    };
    RuledOutRow {
        effect: name_beside_joint(&ruled_out.at),
        smallest: smallest.trim_end().to_owned(),
        because: ruled_out.because.clone(),
    }
}
