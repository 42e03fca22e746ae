//! Scores of diagnoses that are made up, by truths that are written down here.

use std::collections::BTreeMap;

use benchmark::{Power, Tally, TallyRow, TrialGroup};
use catalogue::EffectKind::{
    self, Backlash, CoulombFriction, GravityDirection, InertialParameters, Payload, TorqueConstant,
    TorqueOffset, ViscousFriction,
};
use diagnosis::{Diagnosis, EffectAt, Estimate, Finding, RuledOut, Verdict};
use experiment::Score;
use simulator::Truth;

use crate::made_up::{at as at_joint, diagnosis, finding};

const ELBOW: &str = "elbow";

fn at_link(effect: EffectKind, link: &str) -> EffectAt {
    EffectAt { effect, joint: None, link: Some(link.to_owned()) }
}

fn score(verdict: Verdict, findings: Vec<Finding>, truth: &[Truth]) -> Score {
    Score::new(&diagnosis(verdict, findings), truth, 7)
}

/// Whether it is named exactly, as one of the first, found at all, and how many are stray.
fn answer(score: &Score) -> (bool, bool, bool, usize) {
    (score.exactly, score.as_one_of, score.is_found(), score.stray.len())
}

fn coulomb() -> Truth {
    Truth::at_joint(CoulombFriction, ELBOW, &[("level", 0.5)])
}

#[test]
fn the_effect_at_its_place_named_first_is_exact() {
    let true_one = finding(at_joint(CoulombFriction, ELBOW), 0.8, &[]);
    let small = finding(at_joint(TorqueOffset, "wrist"), 0.1, &[]);
    let first = score(Verdict::Explained, vec![true_one.clone(), small.clone()], &[coulomb()]);
    assert_eq!(answer(&first), (true, true, true, 1));
    assert_eq!(first.stray, [at_joint(TorqueOffset, "wrist")]);
    assert_eq!((first.injected[0].finding, first.injected[0].one_of), (Some(0), Some(0)));

    // The largest share is the first, in whatever order they are listed.
    let listed_last = score(Verdict::Explained, vec![small, true_one], &[coulomb()]);
    assert_eq!(listed_last.findings, first.findings);
    assert!(listed_last.exactly);
    let words = "FR02 Coulomb friction at elbow, seed 7: explained, named \
                 FR02 Coulomb friction at elbow (80 %); DR03 torque offset at wrist (10 %)";
    assert_eq!(first.words(), words);
}

#[test]
fn the_effect_named_second_is_found_and_no_more() {
    let larger = finding(at_joint(TorqueOffset, ELBOW), 0.8, &[]);
    let true_one = finding(at_joint(CoulombFriction, ELBOW), 0.1, &[]);
    let second = score(Verdict::Explained, vec![larger, true_one], &[coulomb()]);
    assert_eq!(answer(&second), (false, false, true, 1));
    assert_eq!(second.injected[0].finding, Some(1));
}

#[test]
fn a_rival_of_the_first_is_one_of_it_and_neither_is_stray() {
    let rivals = [at_link(Payload, "palm"), at_link(InertialParameters, "wrist")];
    let palm = finding(at_link(InertialParameters, "palm"), 0.7, &rivals);
    let truth = [Truth::at_link(Payload, "palm", &[("mass", 1.0)])];
    let named = score(Verdict::Explained, vec![palm], &truth);
    assert_eq!(answer(&named), (false, true, true, 0));
    assert_eq!((named.injected[0].finding, named.injected[0].one_of), (None, Some(0)));
    assert_eq!(named.findings[0].not_separable_from, rivals);

    // What a true finding may as well be is no stray beside it, though it does not say so itself.
    let first = finding(at_link(Payload, "palm"), 0.7, &[at_link(InertialParameters, "palm")]);
    let rival = finding(at_link(InertialParameters, "palm"), 0.2, &[]);
    let other = finding(at_link(InertialParameters, "wrist"), 0.1, &[]);
    let named = score(Verdict::Explained, vec![first, rival, other], &truth);
    assert_eq!(named.stray, [at_link(InertialParameters, "wrist")]);
}

#[test]
fn the_right_effect_at_another_place_and_another_effect_at_the_place_are_wrong() {
    for wrong in [at_joint(CoulombFriction, "wrist"), at_joint(ViscousFriction, ELBOW)] {
        let score = score(Verdict::Explained, vec![finding(wrong.clone(), 0.9, &[])], &[coulomb()]);
        assert_eq!(answer(&score), (false, false, false, 1));
        assert_eq!(score.stray, [wrong]);
        assert_eq!(score.injected[0].sizes[0].estimate, None);
    }
}

#[test]
fn of_two_effects_both_must_be_first() {
    let truth = [coulomb(), Truth::at_joint(Backlash, ELBOW, &[("gap", 0.001)])];
    let [a, b] = [at_joint(CoulombFriction, ELBOW), at_joint(Backlash, ELBOW)];
    let [first, second] = [finding(a.clone(), 0.3, &[]), finding(b.clone(), 0.6, &[])];
    let both = score(Verdict::Explained, vec![first.clone(), second.clone()], &truth);
    assert_eq!(answer(&both), (true, true, true, 0));
    let between = finding(at_joint(TorqueOffset, ELBOW), 0.4, &[]);
    let third = score(Verdict::Explained, vec![first.clone(), between, second], &truth);
    assert_eq!(answer(&third), (false, false, true, 1));
    let half = score(Verdict::Explained, vec![first], &truth);
    assert_eq!(answer(&half), (false, false, false, 0));
    let rival = finding(a, 0.3, &[b]);
    let as_one = score(Verdict::Explained, vec![rival], &truth);
    assert_eq!(answer(&as_one), (false, true, true, 0));
}

#[test]
fn of_a_clean_arm_nothing_is_to_be_named() {
    let silent = score(Verdict::Consistent, Vec::new(), &[]);
    assert_eq!(answer(&silent), (true, true, true, 0));
    assert_eq!(silent.words(), "clean, seed 7: consistent, named nothing");
    let alarm = vec![finding(at_joint(CoulombFriction, ELBOW), 0.1, &[])];
    assert_eq!(answer(&score(Verdict::Explained, alarm, &[])), (false, false, true, 1));
}

#[test]
fn an_unknown_effect_is_left_open_and_not_called_by_another_name() {
    let unknown = |verdict, findings| score(verdict, findings, &[coulomb()]).unknown();
    assert!(unknown(Verdict::Unexplained, Vec::new()));
    assert!(unknown(Verdict::PartlyExplained, Vec::new()));
    assert!(!unknown(Verdict::Consistent, Vec::new()), "it was not seen");
    assert!(!unknown(Verdict::Explained, Vec::new()));
    let wrong = vec![finding(at_joint(TorqueOffset, ELBOW), 0.8, &[])];
    assert!(!unknown(Verdict::PartlyExplained, wrong));
}

/// Half an effect of 0.5 N m would have been found, or only ten times as much.
#[test]
fn what_the_logs_would_not_have_shown_is_counted_apart() {
    let missed = |smallest: f64| {
        let ruled_out = RuledOut {
            at: at_joint(CoulombFriction, ELBOW),
            parameter: "level",
            smallest_detectable: Some(smallest),
            unit: "N m",
            because: String::new(),
        };
        let diagnosis = diagnosis(Verdict::Consistent, Vec::new());
        let diagnosis = Diagnosis { ruled_out: vec![ruled_out], ..diagnosis };
        Score::new(&diagnosis, &[coulomb()], 7)
    };
    let found = vec![finding(at_joint(CoulombFriction, ELBOW), 0.8, &[])];
    let scores = [missed(0.25), missed(5.0), score(Verdict::Explained, found, &[coulomb()])];
    assert_eq!(scores.each_ref().map(Score::visible), [true, false, true]);
    let tally = Tally::of(&scores);
    let row = row(&tally, TrialGroup::One);
    assert_eq!((row.exactly.count, row.exactly.of), (1, 3));
    assert_eq!((row.visibly.count, row.visibly.of), (1, 2));
}

/// However small an effect is said to be, a wrong name for it and the right one count.
#[test]
fn what_is_small_excuses_no_wrong_name() {
    let mut named = score(
        Verdict::Explained,
        vec![finding(at_joint(TorqueOffset, ELBOW), 0.8, &[])],
        &[coulomb()],
    );
    named.injected[0].of_smallest = Some(0.0);
    assert!(named.visible() && !named.exactly);
    named.stray.clear();
    assert!(!named.visible());
    named.injected[0].one_of = Some(0);
    assert!(named.visible());
}

#[test]
fn effects_that_are_not_looked_for_are_a_group_of_their_own() {
    let unknown =
        Score { looked_for: false, ..score(Verdict::Unexplained, Vec::new(), &[coulomb()]) };
    let tally = Tally::of(&[unknown.clone(), unknown]);
    assert_eq!(tally.rows.len(), 1);
    let row = row(&tally, TrialGroup::Unknown);
    assert_eq!((row.unknown.count, row.exactly.count, row.trials), (2, 0, 2));
    assert_eq!(row.injected.to_string(), "not looked for");
}

#[test]
fn the_sizes_of_the_finding_that_names_it_are_compared() {
    let level = |value: f64, determined: bool| {
        let ci95 = [value - 0.05, value + 0.05];
        let estimate = Estimate {
            name: "level",
            value,
            ci95,
            noise95: ci95,
            nominal: 0.25,
            unit: "N m",
            determined,
        };
        let at = at_joint(CoulombFriction, ELBOW);
        Finding { parameters: vec![estimate], ..finding(at, 0.8, &[]) }
    };
    let scores: Vec<Score> = [(0.75, true), (0.85, true), (0.77, true), (3.0, false)]
        .map(|(value, determined)| {
            score(Verdict::Explained, vec![level(value, determined)], &[coulomb()])
        })
        .to_vec();
    let of = |score: &Score| score.injected[0].sizes[0].estimate.clone().unwrap();
    // 0.5 was added to the 0.25 of the description.
    assert!((of(&scores[1]).value - 0.6).abs() < 1e-12 && !of(&scores[1]).covers);
    assert!(of(&scores[2]).covers);
    let tally = Tally::of(&scores);
    let sizes = &row(&tally, TrialGroup::Kind(CoulombFriction)).sizes[0];
    assert_eq!((sizes.name.as_str(), sizes.estimates, sizes.determined), ("level", 4, 3));
    assert!((sizes.median_error.unwrap() - 0.04).abs() < 1e-12, "of 0, 4 and 20 %");
    assert_eq!((sizes.covered.count, sizes.covered.of), (2, 3));
    let all = &row(&tally, TrialGroup::One).sizes;
    assert_eq!(all.len(), 1);
    assert_eq!((all[0].name.as_str(), all[0].covered), ("all", sizes.covered));
}

fn row(tally: &Tally, group: TrialGroup) -> &TallyRow {
    tally.rows.iter().find(|row| row.injected == group).unwrap()
}

/// Four trials with Coulomb friction, one with backlash, one with both, two clean ones.
fn campaign() -> Vec<Score> {
    let named = |effect| vec![finding(at_joint(effect, ELBOW), 0.8, &[])];
    let backlash = Truth::at_joint(Backlash, ELBOW, &[("gap", 0.001)]);
    let rival = finding(at_joint(ViscousFriction, ELBOW), 0.8, &[at_joint(CoulombFriction, ELBOW)]);
    vec![
        score(Verdict::Explained, named(CoulombFriction), &[coulomb()]),
        score(Verdict::Explained, named(CoulombFriction), &[coulomb()]),
        score(Verdict::Explained, vec![rival], &[coulomb()]),
        score(Verdict::Explained, named(TorqueOffset), &[coulomb()]),
        score(Verdict::Unexplained, Vec::new(), std::slice::from_ref(&backlash)),
        score(Verdict::PartlyExplained, named(CoulombFriction), &[coulomb(), backlash]),
        score(Verdict::Consistent, Vec::new(), &[]),
        score(Verdict::Explained, named(TorqueOffset), &[]),
    ]
}

#[test]
fn a_tally_counts_every_answer_in_its_row() {
    let tally = Tally::of(&campaign());
    let groups: Vec<TrialGroup> = tally.rows.iter().map(|row| row.injected).collect();
    let kinds = [TrialGroup::Kind(CoulombFriction), TrialGroup::Kind(Backlash)];
    assert_eq!(
        groups,
        [&kinds[..], &[TrialGroup::One, TrialGroup::Two, TrialGroup::Clean]].concat()
    );
    let counts = |row: &TallyRow| {
        let shares = [row.exactly, row.as_one_of, row.unknown, row.stray];
        assert!(shares.iter().all(|share| share.of == row.trials));
        let shares = [row.exactly, row.as_one_of, row.found, row.unknown, row.stray];
        shares.map(|share| share.count)
    };
    assert_eq!(counts(row(&tally, kinds[0])), [2, 3, 3, 0, 1]);
    assert_eq!(counts(row(&tally, kinds[1])), [0, 0, 0, 1, 0]);
    assert_eq!(counts(row(&tally, TrialGroup::One)), [2, 3, 3, 1, 1]);
    assert_eq!(counts(row(&tally, TrialGroup::Two)), [0, 0, 0, 1, 0]);
    assert_eq!(counts(row(&tally, TrialGroup::Clean)), [1, 1, 0, 0, 1]);
    assert_eq!(row(&tally, TrialGroup::Clean).found.of, 0);
    let first = &row(&tally, kinds[0]).named_first;
    assert_eq!(*first, BTreeMap::from([("FR02", 2), ("FR01", 1), ("DR03", 1)]));
    assert_eq!(row(&tally, kinds[1]).named_first, BTreeMap::from([("nothing", 1)]));
}

#[test]
fn a_tally_is_the_same_in_any_order_and_can_be_read_by_people_and_programs() {
    let mut scores = campaign();
    let tally = Tally::of(&scores);
    scores.reverse();
    assert_eq!(Tally::of(&scores), tally);
    let expected = "\
named first, a column a code; `none` where nothing was
put in      DR FR FR TR none
            03 01 02 01
FR02         1  1  2  .    .
TR01         .  .  .  .    1
two effects  .  .  1  .    .
clean        1  .  .  .    1
";
    assert!(tally.text().contains(expected), "{}", tally.text());
    let line = " FR02 Coulomb friction       4  50 % 15-85  50 % 15-85  75 % 30-95  75 % 30-95      0 % 0-49  25 % 5-70";
    assert!(tally.text().contains(line), "{}", tally.text());
    let json = serde_json::to_value(&tally).unwrap();
    assert_eq!(json["rows"][0]["put_in"], "FR02 Coulomb friction");
    assert_eq!(json["rows"][0]["exactly"]["count"], 2);
    let score = serde_json::to_value(&scores).unwrap();
    assert_eq!(score[7]["put_in"][0]["code"], "FR02");
    assert_eq!(score[7]["findings"][0]["joint"], ELBOW);
}

/// Every kind taken for every other, hundreds of times.
#[test]
fn the_largest_tables_are_within_120_columns() {
    let of = |effect: EffectKind| {
        let parameters: Vec<_> = effect.entry().parameters.iter().map(|p| (p.name, 1.0)).collect();
        Truth::at_joint(effect, ELBOW, &parameters)
    };
    let named = |effect: EffectKind| {
        let estimate = |p: &catalogue::Parameter| Estimate {
            name: p.name,
            value: 1e-3,
            ci95: [0.0, 1.0],
            noise95: [0.0, 1.0],
            nominal: 0.0,
            unit: p.unit,
            determined: true,
        };
        let parameters = effect.entry().parameters.iter().map(estimate).collect();
        Finding { parameters, ..finding(at_joint(effect, ELBOW), 1.0, &[]) }
    };
    let mut scores = Vec::new();
    for injected in EffectKind::ALL {
        for other in EffectKind::ALL {
            let score = score(Verdict::Explained, vec![named(other)], &[of(injected)]);
            scores.extend(vec![score; 100]);
        }
        scores.push(score(Verdict::Unexplained, Vec::new(), &[of(injected)]));
    }
    scores.push(score(Verdict::Consistent, Vec::new(), &[]));
    let text = Tally::of(&scores).text();
    let longest = text.lines().map(|line| line.chars().count()).max().unwrap();
    assert!(longest <= 120, "{longest}:\n{text}");
    assert_eq!(text.lines().filter(|line| line.contains(" 100 100 100")).count(), 27, "{text}");
    let parameters: usize = EffectKind::ALL.iter().map(|kind| kind.entry().parameters.len()).sum();
    assert_eq!(
        text.lines().filter(|line| line.contains(" 100         100 ")).count(),
        parameters,
        "{text}"
    );
}

/// Friction is named from 0.35 N m on, a tilted base (a vector) never.
#[test]
fn the_power_is_told_in_three_classes_of_equal_number_by_size() {
    let friction = |level: f64| {
        let truth = Truth::at_joint(CoulombFriction, ELBOW, &[("level", level)]);
        let named = finding(at_joint(CoulombFriction, ELBOW), 0.9, &[]);
        let findings = if level > 0.35 { vec![named] } else { Vec::new() };
        score(Verdict::Explained, findings, &[truth])
    };
    let tilted = Truth::everywhere(GravityDirection, &[("tilt_1", -0.03), ("tilt_2", 0.04)]);
    let gain = Truth::at_joint(TorqueConstant, ELBOW, &[("gain", 0.9)]);
    let mut scores: Vec<Score> = [0.6, 0.1, 0.4, 0.2, 0.5, 0.3].map(friction).to_vec();
    scores.push(score(Verdict::Unexplained, Vec::new(), &[tilted]));
    scores.push(score(Verdict::Unexplained, Vec::new(), &[gain]));
    scores.push(score(Verdict::Unexplained, Vec::new(), &[coulomb(), coulomb()]));
    let power = Power::all(&scores);
    let told = |power: &Power| {
        let classes = power.classes.iter();
        classes.map(|c| (c.sizes, c.exactly.count, c.exactly.of)).collect::<Vec<_>>()
    };
    let kinds = [TorqueConstant, GravityDirection, CoulombFriction].map(TrialGroup::Kind);
    assert_eq!(power.iter().map(|power| power.injected).collect::<Vec<_>>(), kinds);
    let expected = [([0.1, 0.2], 0, 2), ([0.3, 0.4], 1, 2), ([0.5, 0.6], 2, 2)];
    assert_eq!((power[2].parameter, told(&power[2])), ("level", expected.to_vec()));
    assert_eq!((power[1].unit, told(&power[1])), ("rad", vec![([0.05, 0.05], 0, 1)]));
    assert!((power[0].classes[0].sizes[0] - 0.1).abs() < 1e-12);
    scores.reverse();
    assert_eq!(Power::all(&scores), power);
}
