use std::path::Path;

use files::FileError;

use crate::cause_bench::answer_fault::AnswerFault;
use crate::cause_bench::bench_truth::TrialTruth;
use crate::cause_bench::table_file::{NamedColumns, read};

/// Error of predicted efforts of a held-out log.
///
/// ```text
/// nMSE = sum over j, k of ((p_jk - e_jk) / s_j)^2 / sum over j, k of (e_jk / s_j)^2
/// ```
///
/// with `p_jk` the predicted and `e_jk` the true effort of joint `j` in row `k` (N m or N) and `s_j` the torque of the
/// joint in the logs (`torque_rms` of the sheet), over the rows `k` in which joint `j` moves. No prediction is one of zero, whose error is 1.
pub(super) fn nmse(truth: &TrialTruth, predicted: &NamedColumns) -> Option<f64> {
    let (mut left, mut all) = (0.0, 0.0);
    for (joint, scale) in truth.sheet.joints.iter().zip(&truth.sheet.torque_rms) {
        let Some(efforts) = truth.held_out_effort.get(joint) else { continue };
        let column = predicted.iter().find(|(name, _)| *name == format!("{joint}.effort"));
        let weight = if *scale > 0.0 { scale.powi(-2) } else { 0.0 };
        let stretches = truth.moving.get(joint).into_iter().flatten();
        for k in stretches.flat_map(|[from, to]| *from..(*to).min(efforts.len())) {
            let effort = f64::from(efforts[k]);
            let predicted = column.and_then(|(_, samples)| samples.get(k)).unwrap_or(&0.0);
            left += weight * (predicted - effort).powi(2);
            all += weight * effort.powi(2);
        }
    }
    (all > 0.0).then(|| left / all)
}

/// Reads a prediction and checks that it has every joint and every row, all finite.
///
/// # Errors
///
/// [`AnswerFault`]: the prediction then counts as none, but where the disk failed.
pub(super) fn read_prediction(
    path: &Path,
    truth: &TrialTruth,
) -> Result<NamedColumns, AnswerFault> {
    let fault = |place: &str, found: String, expected: String| AnswerFault {
        path: path.to_owned(),
        place: place.to_owned(),
        found,
        expected,
        is_unread: false,
    };
    let table = "a table of the columns time and JOINT.effort".to_owned();
    // A decoder that cannot read on calls the file broken, so that the disk is asked before.
    if let Err(FileError::Unreadable { reason }) = files::each_piece(path, |_| ()) {
        return Err(AnswerFault { is_unread: true, ..fault("", reason, table) });
    }
    let columns = read(path).map_err(|error| fault("", error.to_string(), table))?;
    for (joint, efforts) in &truth.held_out_effort {
        let name = format!("{joint}.effort");
        let place = format!("column {name}: ");
        let rows = format!("{} finite numbers, one a row of the held-out log,", efforts.len());
        match columns.iter().find(|(column, _)| *column == name) {
            None => return Err(fault(&place, "no such column".to_owned(), rows)),
            Some((_, samples)) if samples.len() != efforts.len() => {
                return Err(fault(&place, format!("{} rows", samples.len()), rows));
            }
            Some((_, samples)) if samples.iter().any(|x| !x.is_finite()) => {
                return Err(fault(&place, "a number that is not finite".to_owned(), rows));
            }
            Some(_) => {}
        }
    }
    Ok(columns)
}
