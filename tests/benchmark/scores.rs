//! Scores of answers that are made up: never worse than by hand, spoilt logs, bodies, sizes told and reasons.
#![expect(
    clippy::float_cmp,
    reason = "shares of counts and differences of small integers are exact"
)]

use benchmark::{
    HeldOut, JudgedSpoiling, Judgement, Measure, PairedComparison, PanelTally, Record, Share,
    SpoilingOutcome,
};
use catalogue::EffectKind::{
    self, AsymmetricFriction, Backlash, CoulombFriction, InertialParameters, LoadDependentFriction,
    Payload, PositionDependentFriction, PreslidingFriction, StribeckFriction, TorqueOffset,
    ViscousFriction,
};
use diagnosis::{Diagnosis, EffectAt, Estimate, Finding, Negligible, RuledOut, Verdict};
use population::{CauseRole, TrueCause, TruthSheet};
use simulator::Truth;

use crate::made_up::{FAINT, SEEN, answers, at, diagnosis, estimate, finding, sheet, stranger};

fn judge(sheet: &TruthSheet, diagnosis: Diagnosis) -> Judgement {
    let mut said = answers(Verdict::Consistent, Vec::new());
    said.diagnosis = Ok(diagnosis);
    Judgement::new(sheet, &said)
}

/// Held-out errors of joints whose torque is 10 and 2 N m.
fn predicted(extended: [f64; 2], by_hand: [f64; 2]) -> Judgement {
    let some = |errors: [f64; 2]| Some(errors.map(Some).to_vec());
    let mut said = answers(Verdict::Explained, Vec::new());
    said.held_out = HeldOut {
        nominal: some([1.0, 0.2]),
        extended: some(extended),
        least_squares: some(by_hand),
    };
    Judgement::new(&sheet(&[]), &said)
}

/// Two per cent above least squares and one above the description are allowed, at a joint and over all.
#[test]
fn an_error_is_worse_than_by_hand_from_two_per_cent_on() {
    let near = predicted([0.509, 0.1], [0.5, 0.1]);
    assert_eq!(near.prediction.worse_than_by_hand(), Some(false));
    assert_eq!(near.prediction.joints_worse_than_by_hand().hits, 0.0);
    // 0.052 and 0.05 of the torque against 0.05 and 0.05: 2.02 % over both.
    let beyond = predicted([0.52, 0.1], [0.5, 0.1]);
    assert_eq!(beyond.prediction.joints_worse_than_by_hand().hits, 1.0);
    assert_eq!(beyond.prediction.worse_than_by_hand(), Some(true));
    assert_eq!(beyond.prediction.worse(), Some(false));
    let ratio = beyond.prediction.by_hand_ratio().unwrap();
    let expected = ((0.052_f64.powi(2) + 0.05_f64.powi(2)) / (2.0 * 0.05_f64.powi(2))).sqrt();
    assert!((ratio - expected).abs() < 1e-12);
    // One joint is 5 % above the description, the other makes up for it.
    let traded = predicted([1.05, 0.01], [1.0, 0.2]);
    assert_eq!(
        (traded.prediction.worse(), traded.prediction.worse_joints().hits),
        (Some(false), 1.0)
    );
    assert_eq!(predicted([f64::NAN, 0.1], [0.5, 0.1]).prediction.worse_than_by_hand(), Some(true));

    let tally = PanelTally::of(&[near, beyond, traded]);
    let all = &tally.rows[0];
    assert_eq!(all.worse_than_by_hand, Share::new(1, 3));
    assert_eq!(
        (all.joints_worse_than_by_hand.value, all.joints_worse_than_by_hand.items),
        (Some(2.0 / 6.0), 6)
    );
    assert_eq!(all.worse_joints.value, Some(1.0 / 6.0));
    assert_eq!(all.worse, Share::new(0, 3));
}

fn outcome(
    name: &str,
    joint: Option<&str>,
    diagnosis: Result<Diagnosis, String>,
) -> JudgedSpoiling {
    let mut spoilt = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    let mut other = stranger(SEEN);
    (other.name, other.joint) = (format!("log: {name}"), joint.map(str::to_owned));
    spoilt.strangers.push(other);
    let mut said = answers(Verdict::Consistent, Vec::new());
    said.diagnosis = diagnosis;
    Judgement::new(&spoilt, &said).spoilings.remove(0)
}

fn warned(verdict: Verdict, warning: &str) -> Result<Diagnosis, String> {
    let warnings = if warning.is_empty() { Vec::new() } else { vec![warning.to_owned()] };
    Ok(Diagnosis { warnings, ..diagnosis(verdict, Vec::new()) })
}

#[test]
fn spoilt_logs_have_one_outcome_of_five() {
    use SpoilingOutcome as O;
    let sign =
        "The effort of joint elbow seems to have the other sign. Turn the sign of the column.";
    let of = |diagnosis| outcome("effort sign", Some("elbow"), diagnosis).outcome;
    assert_eq!(of(warned(Verdict::DataInadequate, sign)), O::ToldRightly);
    let elsewhere = sign.replace("elbow", "shoulder");
    assert_eq!(of(warned(Verdict::DataInadequate, &elsewhere)), O::ToldWrongly);
    let another = "The efforts of joints shoulder and elbow seem to be exchanged.";
    assert_eq!(of(warned(Verdict::PartlyExplained, another)), O::ToldWrongly);
    // A joint whose name begins like another's is another joint.
    assert_eq!(of(warned(Verdict::Unexplained, &sign.replace("elbow", "elbow_2"))), O::ToldWrongly);
    let mut read =
        warned(Verdict::PartlyExplained, &format!("{sign} Until then the logs are read so."));
    assert_eq!(of(read.clone()), O::ToldRightly, "it is not said to be read so in the data");
    read.as_mut().unwrap().data.put_right = true;
    assert_eq!(of(read), O::ReadRightly);
    assert_eq!(of(Err("log_1: no sample".to_owned())), O::Refused);
    assert_eq!(of(Err(sign.to_owned())), O::ToldRightly);
    assert_eq!(of(warned(Verdict::DataInadequate, "")), O::Refused);
    assert_eq!(of(warned(Verdict::Unexplained, "")), O::Refused);
    assert_eq!(of(warned(Verdict::Explained, "")), O::TakenIn);
    let false_name = vec![finding(at(Backlash, "elbow"), 0.5, &[])];
    assert_eq!(of(Ok(diagnosis(Verdict::PartlyExplained, false_name))), O::TakenIn);
    let clock = "Effort and motion disagree on what a second is: 1.1 in the column `time` are one.";
    assert_eq!(
        outcome("time stretched", None, warned(Verdict::DataInadequate, clock)).outcome,
        O::ToldRightly
    );
}

/// A model that reads joints wrongly is told by the same sentences as logs that are so.
#[test]
fn what_a_model_misreads_is_judged_as_a_spoiling() {
    let outcome_of = |name: &str, joint: Option<&str>, warning: &str| {
        let mut sheet = sheet(&[(CoulombFriction, "elbow", SEEN)]);
        let mut misread = stranger(SEEN);
        (misread.name, misread.joint) = (name.to_owned(), joint.map(str::to_owned));
        sheet.strangers = vec![misread];
        let mut answers = answers(Verdict::DataInadequate, Vec::new());
        answers.diagnosis = warned(Verdict::DataInadequate, warning);
        let judgement = Judgement::new(&sheet, &answers);
        assert!(judgement.is_spoilt() && judgement.causes_to_name().next().is_none(), "{name}");
        judgement.spoilings[0].outcome
    };
    let sign = "The position of joint elbow seems to have the other sign.";
    let exchanged = "The efforts of joints shoulder and elbow seem to be exchanged.";
    use SpoilingOutcome as O;
    assert_eq!(outcome_of("model: axis turned", Some("elbow"), sign), O::ToldRightly);
    assert_eq!(outcome_of("model: axis turned", Some("shoulder"), sign), O::ToldWrongly);
    assert_eq!(outcome_of("model: joints exchanged", None, exchanged), O::ToldRightly);
    assert_eq!(outcome_of("log: columns exchanged", None, exchanged), O::ToldRightly);
    assert_eq!(outcome_of("model: joints exchanged", None, sign), O::ToldWrongly);
}

#[test]
fn spoilt_trials_leave_all_other_scores_and_have_a_table() {
    let causes = [(CoulombFriction, "elbow", SEEN)];
    let named = || {
        vec![
            finding(at(CoulombFriction, "elbow"), 0.5, &[]),
            finding(at(Backlash, "elbow"), 0.4, &[]),
        ]
    };
    let mut spoilt = sheet(&causes);
    spoilt.strangers.push(stranger(SEEN));
    spoilt.strangers[0].name = "log: spikes".to_owned();
    let one = judge(&spoilt, diagnosis(Verdict::Explained, named()));
    assert_eq!((one.precision(), one.recall().items), (None, 0));
    assert_eq!(
        (one.false_assurance(), one.false_alarm(), one.is_misled()),
        (None, None, Some(true))
    );
    assert_eq!((one.right(), one.fair_prediction().is_none()), (Some(false), true));
    assert!(one.strangers.is_empty());
    // What an oracle does not see spoils nothing.
    spoilt.strangers[0].strength = FAINT;
    let faint = judge(&spoilt, diagnosis(Verdict::Explained, named()));
    assert_eq!((faint.recall().hits, faint.is_misled()), (1.0, None));

    let mut fooled = one.clone();
    fooled.seed = 8;
    fooled.spoilings[0].outcome = SpoilingOutcome::ToldRightly;
    let tally = PanelTally::of(&[one, fooled, faint]);
    let [spikes, all] = &tally.spoilings[..] else { panic!("{:?}", tally.spoilings) };
    assert_eq!((spikes.name.as_str(), all.name.as_str()), ("spikes", "all"));
    assert_eq!(
        (spikes.taken_in, spikes.told_rightly, spikes.refused),
        (Share::new(1, 2), Share::new(1, 2), Share::new(0, 2))
    );
    let row = &tally.rows[0];
    assert_eq!(
        (row.trials, row.spoilt, row.named.precision.items, row.named.recall.items),
        (3, 2, 2, 1)
    );
    assert!(tally.text().contains("read so rightly"));
    let coulomb = &tally.kinds[0];
    assert_eq!((coulomb.visible, coulomb.named.value), (1, Some(1.0)));
}

#[test]
fn coulomb_friction_is_named_where_a_form_of_dry_friction_of_its_joint_bears_it() {
    let hidden = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    let named = |effect: EffectKind, joint: &str| {
        let one = judge(
            &hidden,
            diagnosis(Verdict::Explained, vec![finding(at(effect, joint), 0.5, &[])]),
        );
        (one.recall().hits > 0.5, one.findings[0].is_true)
    };
    let forms = [
        AsymmetricFriction,
        StribeckFriction,
        PreslidingFriction,
        LoadDependentFriction,
        PositionDependentFriction,
    ];
    for form in forms {
        // The cause is named, and the form that is not in the arm stays a false name.
        assert_eq!(named(form, "elbow"), (true, false), "{}", form.name());
        assert_eq!(named(form, "shoulder"), (false, false), "{}", form.name());
    }
    assert_eq!(named(ViscousFriction, "elbow"), (false, false));
    // Nothing but Coulomb friction is borne.
    let hidden = sheet(&[(StribeckFriction, "elbow", SEEN)]);
    let said =
        diagnosis(Verdict::Explained, vec![finding(at(PreslidingFriction, "elbow"), 0.5, &[])]);
    assert_eq!(judge(&hidden, said).recall().hits, 0.0);
}

fn at_link(effect: EffectKind, link: &str) -> EffectAt {
    EffectAt { effect, joint: None, link: Some(link.to_owned()) }
}

fn body(effect: EffectKind, link: &str, parameters: Vec<Estimate>) -> Finding {
    Finding { parameters, ..finding(at_link(effect, link), 0.2, &[]) }
}

fn at_body(effect: EffectKind, link: &str, parameters: &[(&str, f64)]) -> TrueCause {
    TrueCause {
        role: CauseRole::Hidden,
        truth: Truth::at_link(effect, link, parameters),
        strength: SEEN,
    }
}

/// A link of 3 kg that is described with 2.5 kg, a payload of 1 kg, and a link that is as described.
#[test]
fn bodies_are_off_where_mass_or_centre_is_outside_its_interval_and_weigh_what_they_say() {
    let mut arm = sheet(&[]);
    arm.causes = vec![
        at_body(InertialParameters, "forearm", &[("mass", 3.0), ("com_x", 0.2)]),
        at_body(Payload, "palm", &[("mass", 1.0), ("com_x", 0.1)]),
    ];
    let number = |name, value: f64, width: f64, nominal: f64| Estimate {
        nominal,
        ..estimate(name, value, [value - width, value + width])
    };
    let off = |findings: Vec<Finding>| {
        let fraction = judge(&arm, diagnosis(Verdict::Explained, findings)).bodies_off();
        (fraction.hits, fraction.of)
    };
    let forearm = |mass: f64, com: f64| {
        let numbers = vec![number("mass", mass, 0.2, 2.5), number("com_x", com, 0.02, 0.25)];
        body(InertialParameters, "forearm", numbers)
    };
    assert_eq!(off(vec![forearm(3.1, 0.21)]), (0.0, 3.1));
    assert_eq!(off(vec![forearm(3.3, 0.2)]), (3.3, 3.3), "its mass");
    assert_eq!(off(vec![forearm(3.0, 0.23)]), (3.0, 3.0), "its centre");
    // A link that is as described.
    let upper = |mass: f64| body(InertialParameters, "upper", vec![number("mass", mass, 0.5, 4.0)]);
    assert_eq!(off(vec![upper(4.4), forearm(3.0, 0.2)]), (0.0, 7.4));
    assert_eq!(off(vec![upper(39.0), forearm(3.0, 0.2)]), (39.0, 42.0));
    // A payload that is called the body of its link: 0.5 kg at 0 and 1 kg at 0.1 are 1.5 kg at 1/15.
    let palm = |mass: f64, com: f64| {
        body(
            InertialParameters,
            "palm",
            vec![number("mass", mass, 0.1, 0.5), number("com_x", com, 0.01, 0.0)],
        )
    };
    assert_eq!(off(vec![palm(1.5, 1.0 / 15.0)]), (0.0, 1.5));
    assert_eq!(off(vec![palm(1.5, 0.1)]), (1.5, 1.5));
    // A payload where there is none, and one where the link itself differs, which the sheet does not decide.
    let payload = |link: &str| body(Payload, link, vec![number("mass", 0.4, 0.1, 0.0)]);
    assert_eq!(off(vec![payload("upper")]), (0.4, 0.4));
    assert_eq!(off(vec![payload("forearm")]), (0.0, 0.0));

    let tally = PanelTally::of(&[judge(
        &arm,
        diagnosis(Verdict::Explained, vec![upper(39.0), forearm(3.0, 0.2)]),
    )]);
    assert_eq!(tally.rows[0].bodies_off.value, Some(39.0 / 42.0));
    let links = tally.kinds.iter().find(|row| row.kind.starts_with("IN02")).unwrap();
    assert_eq!(links.bodies_off.value, Some(39.0 / 42.0));
}

#[test]
fn a_size_is_told_where_the_logs_determine_it_and_the_sharpest_parameter_counts() {
    let told = Finding {
        parameters: vec![
            estimate("level", 2.0, [1.8, 2.2]),
            Estimate { determined: false, ..estimate("share", 0.5, [0.49, 0.51]) },
        ],
        ..finding(at(CoulombFriction, "elbow"), 0.5, &[])
    };
    let both = Finding {
        parameters: vec![
            estimate("forward", -4.0, [-4.4, -3.6]),
            estimate("backward", 1.0, [0.0, 2.0]),
        ],
        ..finding(at(AsymmetricFriction, "shoulder"), 0.4, &[])
    };
    let open = finding(at(TorqueOffset, "elbow"), 0.1, &[]);
    let hidden = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    let one = judge(&hidden, diagnosis(Verdict::Explained, vec![told, both, open]));
    let sharpness: Vec<Option<f64>> = one.findings.iter().map(|f| f.sharpness).collect();
    let near = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-12;
    assert!(near(sharpness[0], 0.2) && near(sharpness[1], 0.2) && sharpness[2].is_none());
    assert_eq!((one.sizes_told().hits, one.sizes_told().of), (2.0, 3.0));
    let tally = PanelTally::of(&[one]);
    assert_eq!(tally.rows[0].sizes_told.value, Some(2.0 / 3.0));
    assert!(near(tally.rows[0].sharpness, 0.2));
    let offset = tally.kinds.iter().find(|row| row.kind.starts_with("DR03")).unwrap();
    assert_eq!((offset.told.value, offset.sharpness), (Some(0.0), None));
}

fn rule_out(at: EffectAt, because: &str) -> RuledOut {
    let because = because.to_owned();
    RuledOut { at, parameter: "level", smallest_detectable: Some(0.1), unit: "N m", because }
}

#[test]
fn a_reason_against_a_true_cause_and_one_against_the_answer_are_counted() {
    let hidden = sheet(&[(CoulombFriction, "elbow", SEEN), (Backlash, "elbow", FAINT)]);
    let small = "it adds 0.4 to the log evidence, 3 are needed";
    let does_its_work = "the search ended with other causes that do its work";
    let same = "a finding changes the same numbers by another name";
    let with = |findings: Vec<Finding>, ruled_out: Vec<RuledOut>| Diagnosis {
        ruled_out,
        ..diagnosis(Verdict::PartlyExplained, findings)
    };
    let missed = with(
        Vec::new(),
        vec![rule_out(at(CoulombFriction, "elbow"), small), rule_out(at(Backlash, "elbow"), small)],
    );
    let one = judge(&hidden, missed);
    // The faint one is asked for by nobody.
    assert_eq!((one.ruled_out().hits, one.ruled_out().of), (1.0, 1.0));
    assert_eq!(one.causes[0].ruled_out.as_deref(), Some(small));
    assert_eq!((one.contradicting().hits, one.contradicting().of), (0.0, 2.0));
    let tally = PanelTally::of(&[one]);
    assert_eq!(
        (tally.rows[0].ruled_out.value, tally.kinds[0].ruled_out.value),
        (Some(1.0), Some(1.0))
    );

    // Ruled out, but a rival of a finding: it is named.
    let rival = vec![finding(at(ViscousFriction, "elbow"), 0.5, &[at(CoulombFriction, "elbow")])];
    let one = judge(&hidden, with(rival, vec![rule_out(at(CoulombFriction, "elbow"), same)]));
    assert_eq!((one.ruled_out().hits, one.contradicting().hits), (0.0, 0.0));

    let contradictions = |findings: Vec<Finding>, because: &str| {
        let ruled_out = vec![rule_out(at(TorqueOffset, "elbow"), because)];
        judge(&hidden, with(findings, ruled_out)).contradicting().hits
    };
    let at_shoulder = || vec![finding(at(ViscousFriction, "shoulder"), 0.5, &[])];
    let at_elbow = || vec![finding(at(ViscousFriction, "elbow"), 0.5, &[])];
    let of_link = || vec![finding(at_link(Payload, "palm"), 0.5, &[])];
    for because in [does_its_work, same] {
        assert_eq!(contradictions(Vec::new(), because), 1.0, "{because}");
        assert_eq!(contradictions(at_shoulder(), because), 1.0, "{because}");
        assert_eq!(contradictions(at_elbow(), because), 0.0, "{because}");
        assert_eq!(contradictions(of_link(), because), 0.0, "{because}");
    }
    assert_eq!(contradictions(vec![finding(at(TorqueOffset, "elbow"), 0.5, &[])], small), 1.0);
    // What is told as too small to matter acts as well.
    let negligible = Negligible {
        at: at(ViscousFriction, "elbow"),
        most_at: "elbow".to_owned(),
        rms_nm: 0.01,
        least_nm: 0.02,
    };
    let told = Diagnosis {
        negligible: vec![negligible],
        ..with(Vec::new(), vec![rule_out(at(TorqueOffset, "elbow"), same)])
    };
    let one = judge(&hidden, told);
    assert_eq!(one.contradicting().hits, 0.0);
}

/// The second result reads spoilt logs rightly, keeps below least squares and contradicts itself no more.
#[test]
fn the_scores_are_compared_trial_by_trial() {
    let folder = tempfile::tempdir().unwrap();
    let table = |name: &str, records: &[Record]| {
        let path = folder.path().join(name);
        Record::write(&path, records).unwrap();
        path
    };
    let record = |task: usize, judged: Judgement| Record {
        task,
        hidden: None,
        seed: 7,
        campaign: "0123456789".to_owned(),
        score: Ok(Box::new(judged)),
    };
    let mut spoilt = sheet(&[]);
    spoilt.strangers.push(stranger(SEEN));
    spoilt.strangers[0].name = "log: spikes".to_owned();
    let fooled = judge(&spoilt, diagnosis(Verdict::Consistent, Vec::new()));
    let refused = judge(&spoilt, diagnosis(Verdict::DataInadequate, Vec::new()));
    let reason = |because: &str| {
        let ruled_out = vec![rule_out(at(TorqueOffset, "elbow"), because)];
        let one = diagnosis(Verdict::Consistent, Vec::new());
        judge(&sheet(&[]), Diagnosis { ruled_out, ..one })
    };
    let first = table(
        "a.parquet",
        &[
            record(0, fooled),
            record(1, predicted([0.6, 0.1], [0.5, 0.1])),
            record(2, reason("a finding already changes the same numbers")),
        ],
    );
    let second = table(
        "b.parquet",
        &[
            record(0, refused),
            record(1, predicted([0.4, 0.1], [0.5, 0.1])),
            record(2, reason("these logs cannot show it")),
        ],
    );
    let compared = PairedComparison::read(&first, &second).unwrap();
    for measure in [Measure::Misled, Measure::WorseThanByHand, Measure::Contradicting] {
        let share = compared.shares.iter().find(|share| share.measure == measure).unwrap();
        assert_eq!((share.trials, share.wins, share.losses), (1, 1, 0), "{measure}");
    }
    assert_eq!(compared.turned.len(), 3);
    assert!(compared.turned[0].words().ends_with("better: right, misled by spoilt logs"));
}
