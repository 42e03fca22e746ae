use catalogue::Parameter;
use robot::Robot;

use crate::outcome::effect_at::effect_at;
use crate::result::{Estimate, Finding};
use crate::signals::tone::{Beat, Tone};

/// Half width of a 95 per cent interval in standard errors.
const HALF_WIDTH: f64 = 1.96;

/// A tone as a finding. Its share is of the residual of the other findings, over the whole band.
pub(crate) fn tone_finding(robot: &Robot, tone: &Tone, common_phase: f64) -> Finding {
    let hypothesis = tone.hypothesis();
    let (beat, unit, what) = match tone.beat {
        Beat::Position(periods) => (periods, "periods in a turn", "the position of the joint"),
        Beat::Clock(frequency_hz) => (frequency_hz, "Hz", "the clock"),
    };
    let runs = tone.z.len();
    let mut evidence = vec![format!(
        "a line at {beat:.4} {unit} stands out of the spectrum around it in {}: noise has one in exp({:.0}) frequencies",
        if runs == 1 { "one run".to_owned() } else { format!("{runs} runs together") },
        tone.stands_out
    )];
    evidence.push(format!(
        "it keeps time with {what}, and is {:.0} % of what the other findings leave at the joint in the wide band",
        100.0 * tone.share
    ));
    let undetermined = match (tone.beat, tone.sine_phase(common_phase)) {
        (Beat::Clock(_), Some(_)) => {
            vec!["it is no part of the robot: the extended model leaves it out".to_owned()]
        }
        (Beat::Clock(_), None) => vec![
            "it is no part of the robot: the extended model leaves it out".to_owned(),
            "its phase differs from run to run".to_owned(),
        ],
        (Beat::Position(_), _) => Vec::new(),
    };
    Finding {
        at: effect_at(robot, hypothesis),
        parameters: parameters(robot, tone, common_phase),
        share_explained: tone.share,
        log_evidence: tone.stands_out,
        held_out_gain: tone.share,
        not_separable_from: Vec::new(),
        told_apart_by: None,
        evidence,
        undetermined,
    }
}

fn parameters(robot: &Robot, tone: &Tone, common_phase: f64) -> Vec<Estimate> {
    let kind = tone.hypothesis().kind;
    let rotation = robot.links()[tone.joint].joint.kind.is_rotation();
    let ripple = robot.links()[tone.joint].actuator.ripple;
    let (Beat::Position(beat) | Beat::Clock(beat)) = tone.beat;
    let of = |parameter: &Parameter, value: f64, error: f64, nominal: f64| Estimate {
        name: parameter.name,
        value,
        ci95: [value - HALF_WIDTH * error, value + HALF_WIDTH * error],
        noise95: [value - HALF_WIDTH * error, value + HALF_WIDTH * error],
        nominal,
        unit: if rotation { parameter.unit } else { parameter.unit_prismatic },
        determined: true,
    };
    let all = kind.entry().parameters;
    let [of_amplitude, of_beat, _] = tone.error;
    let mut estimates = vec![
        of(&all[0], tone.amplitude(), of_amplitude, ripple.map_or(0.0, |r| r.amplitude)),
        of(&all[1], beat, of_beat, f64::INFINITY),
    ];
    estimates.extend(
        tone.sine_phase(common_phase)
            .map(|(phase, error)| of(&all[2], phase, error, f64::INFINITY)),
    );
    estimates
}
