//! At which stage a name is lost: logs that are made up so that every stage is known, searched by the program.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::num::NonZeroUsize;

use benchmark::{
    AccountProgress, Campaign, CampaignAccount, CampaignFolder, ChosenTrials, Judgement, LossStage,
    LostName, NameError, OracleEffortNoise, Part, TrialAccount, TrialLogs, Workers, make_accounts,
    work,
};
use catalogue::EffectKind;
use catalogue::EffectKind::{
    CoulombFriction, ExternalDisturbance, InertialParameters, Payload, PreslidingFriction,
    StribeckFriction, TorqueOffset, ViscousFriction,
};
use checks::synthetic::{Noise, State, Truth, run, wam};
use diagnosis::{
    EffectAt, JointReach, LookedFor, PlaceAccount, PlaceTest, SearchAccount, SearchFate, Settings,
    Taker, Verdict, account_for,
};
use document::Document;
use logs::Run;
use population::{CauseRole, Strength, TrueCause, TruthSheet};

use crate::made_up::{SEEN, answers, at, finding, sheet, stranger};
use crate::small_panel::Quiet;

fn at_link(effect: EffectKind, link: &str) -> EffectAt {
    EffectAt { effect, joint: None, link: Some(link.to_owned()) }
}

/// A passed test of the search.
const PASSED: PlaceTest = PlaceTest {
    evidence: 50.0,
    least_evidence: 3.0,
    sigmas: 10.0,
    is_possible: true,
    pays: true,
    fall: 4.0,
};

/// A search of the arm of [`sheet`] that looked for one place by its columns and did not find it.
fn searched(place: PlaceAccount) -> SearchAccount {
    let joint = |name: &str| JointReach {
        name: name.to_owned(),
        range: 1.0,
        speed: 0.5,
        effort_noise: 0.1,
        encoder_noise: 0.0,
    };
    SearchAccount {
        found: Vec::new(),
        kept: Vec::new(),
        lines_hz: Some([0.3, 15.0]),
        cutoff_hz: 10.0,
        joints: ["shoulder", "elbow"].map(joint).to_vec(),
        places: vec![place],
    }
}

fn place(effect: EffectKind) -> PlaceAccount {
    PlaceAccount {
        at: at(effect, "elbow"),
        looked_for: LookedFor::ByColumns,
        fate: SearchFate::NotFound,
        beside_truth: Some(PASSED),
        with_known_noise: Some(PASSED),
        beside_found: Some(PASSED),
        takers: Vec::new(),
    }
}

/// Density of white noise with the known RMS of [`searched`], .1 N m in a band of .898 cut-offs of 10 Hz.
fn as_known() -> OracleEffortNoise {
    OracleEffortNoise { density: vec![0.01 / (2.0 * 0.897_91 * 10.0); 2] }
}

/// The stage of a cause at the elbow that was missed.
fn stage_of(sheet: &TruthSheet, oracle: &OracleEffortNoise, place: PlaceAccount) -> LossStage {
    let judgement = Judgement::new(sheet, &answers(Verdict::Unexplained, Vec::new()));
    let account = TrialAccount::of_search(sheet, &judgement, oracle, &searched(place));
    assert_eq!((account.lost.len(), account.lost[0].error), (1, NameError::Missed));
    account.lost[0].stage
}

#[test]
fn every_test_that_fails_is_a_stage() {
    let elbow = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    let stage = |change: fn(&mut PlaceAccount)| {
        let mut place = place(CoulombFriction);
        change(&mut place);
        stage_of(&elbow, &as_known(), place)
    };
    const WEAK: PlaceTest = PlaceTest { evidence: 1.0, ..PASSED };
    const IMPOSSIBLE: PlaceTest = PlaceTest { is_possible: false, ..PASSED };
    const USELESS: PlaceTest = PlaceTest { pays: false, ..PASSED };
    let nowhere = |p: &mut PlaceAccount| p.looked_for = LookedFor::Nowhere("it stands".to_owned());
    assert_eq!(stage(nowhere), LossStage::NoHypothesis);
    assert_eq!(
        stage(|p| p.fate = SearchFate::SizeVaries("load".to_owned())),
        LossStage::SizeVaries
    );
    assert_eq!(stage(|p| p.fate = SearchFate::Kept), LossStage::HeldOut);
    assert_eq!(stage(|p| p.fate = SearchFate::Dropped), LossStage::OtherName);
    // Beside the true names it fails already: the known noise says whether noise is to blame.
    let beside_truth = |truth, known| {
        let place = PlaceAccount {
            beside_truth: Some(truth),
            with_known_noise: Some(known),
            ..place(CoulombFriction)
        };
        stage_of(&elbow, &as_known(), place)
    };
    assert_eq!(beside_truth(WEAK, WEAK), LossStage::KnownNoise);
    assert_eq!(beside_truth(WEAK, PASSED), LossStage::TrueNames);
    assert_eq!(beside_truth(USELESS, USELESS), LossStage::HeldOut);
    assert_eq!(beside_truth(IMPOSSIBLE, IMPOSSIBLE), LossStage::Physical);
    // Beside what was found it fails.
    assert_eq!(stage(|p| p.beside_found = Some(WEAK)), LossStage::FoundNames);
    assert_eq!(stage(|p| p.beside_found = Some(USELESS)), LossStage::HeldOut);
    let taken = |excludes, is_exchanged| {
        let taker = Taker { at: at(TorqueOffset, "elbow"), excludes, is_exchanged };
        let place = PlaceAccount {
            beside_found: Some(WEAK),
            takers: vec![taker],
            ..place(CoulombFriction)
        };
        stage_of(&elbow, &as_known(), place)
    };
    assert_eq!(taken(true, false), LossStage::OtherName);
    assert_eq!(taken(false, true), LossStage::OtherName);
    assert_eq!(taken(false, false), LossStage::Exchange);
    assert_eq!(stage(|_| {}), LossStage::Exchange, "the search ended without it");
}

#[test]
fn a_cause_below_the_real_noise_and_spoilt_logs_are_the_judges() {
    let elbow = sheet(&[(CoulombFriction, "elbow", SEEN)]);
    // 50 sigmas at a tenth of the noise are five, unless the search shows it with the known noise.
    let of_share = |share: f64, known: PlaceTest| {
        let density = as_known().density.iter().map(|d| share * share * d).collect();
        let place = PlaceAccount { with_known_noise: Some(known), ..place(CoulombFriction) };
        stage_of(&elbow, &OracleEffortNoise { density }, place)
    };
    const UNSEEN: PlaceTest = PlaceTest { sigmas: 2.0, ..PASSED };
    assert_eq!(
        [of_share(0.11, UNSEEN), of_share(0.09, UNSEEN), of_share(0.09, PASSED)],
        [LossStage::Exchange, LossStage::Judge, LossStage::Exchange]
    );

    let judged = |findings| Judgement::new(&elbow, &answers(Verdict::Explained, findings));
    let spoilt = population::TrueStranger { name: "log: effort sign".to_owned(), ..stranger(SEEN) };
    let spoilt = TruthSheet { strangers: vec![spoilt], ..elbow.clone() };
    let account = TrialAccount::of_logs(&spoilt, &judged(Vec::new())).unwrap();
    assert_eq!(account.lost[0].because, "the logs are spoilt, log: effort sign");
    let mut refused = answers(Verdict::Unexplained, Vec::new());
    refused.diagnosis = Err("too short".to_owned());
    let account = TrialAccount::of_logs(&elbow, &Judgement::new(&elbow, &refused)).unwrap();
    assert_eq!(
        (account.lost[0].stage, account.lost[0].because.as_str()),
        (LossStage::Judge, "the logs are refused: too short")
    );
    assert!(TrialAccount::of_logs(&elbow, &judged(Vec::new())).is_none(), "it takes a search");
    let named = vec![finding(at(CoulombFriction, "elbow"), 0.5, &[])];
    assert!(TrialAccount::of_logs(&elbow, &judged(named)).unwrap().lost.is_empty());

    // Coulomb friction inside another form of the joint counts as named, beside another cause it does not.
    let inside = |kind, joint| {
        let sheet = sheet(&[(CoulombFriction, "elbow", SEEN), (kind, joint, SEEN)]);
        let findings = vec![finding(at(kind, joint), 0.5, &[])];
        let judgement = Judgement::new(&sheet, &answers(Verdict::Explained, findings));
        let account = searched(place(CoulombFriction));
        let account = TrialAccount::of_search(&sheet, &judgement, &as_known(), &account);
        account.lost.first().map(|lost| lost.stage)
    };
    assert_eq!(inside(PreslidingFriction, "elbow"), None);
    assert_eq!(inside(StribeckFriction, "shoulder"), Some(LossStage::Exchange));
    assert_eq!(inside(ViscousFriction, "elbow"), Some(LossStage::Exchange));
}

#[test]
fn a_false_finding_has_the_test_that_it_fails_beside_the_truth() {
    let stage = |change: fn(&mut PlaceAccount), truth: &TruthSheet| {
        let mut place = place(TorqueOffset);
        (place.fate, place.at.joint) = (SearchFate::Kept, Some("shoulder".to_owned()));
        change(&mut place);
        let findings = vec![finding(at(TorqueOffset, "shoulder"), 0.5, &[])];
        let judgement = Judgement::new(truth, &answers(Verdict::Explained, findings));
        let account = TrialAccount::of_search(truth, &judgement, &as_known(), &searched(place));
        assert_eq!((account.lost[0].error, account.lost[0].strength), (NameError::False, None));
        account.lost[0].stage
    };
    let clean = sheet(&[]);
    const WEAK: PlaceTest = PlaceTest { evidence: 1.0, ..PASSED };
    assert_eq!(stage(|p| p.beside_truth = Some(WEAK), &clean), LossStage::FoundNames);
    assert_eq!(stage(|p| p.with_known_noise = Some(WEAK), &clean), LossStage::KnownNoise);
    assert_eq!(stage(|_| {}, &clean), LossStage::TrueNames);
    let useless = |p: &mut PlaceAccount| {
        p.beside_truth = Some(PlaceTest { pays: false, ..PASSED });
    };
    assert_eq!(stage(useless, &clean), LossStage::HeldOut);
    assert_eq!(stage(|p| p.looked_for = LookedFor::AsLine, &clean), LossStage::Line);
    let strange = TruthSheet { strangers: vec![stranger(SEEN)], ..sheet(&[]) };
    assert_eq!(stage(|_| {}, &strange), LossStage::Judge);
}

/// Index of the palm.
const PALM: usize = 6;

/// Frequencies of the two tones (Hz): logs of 250 Hz have lines up to .85 of 60 Hz.
const TONES_HZ: [f64; 2] = [70.0, 9.0];

/// A WAM with dry friction at the elbow, another load in its wrist pitch link, a tone at 70 Hz and a palm that stands.
fn made_up_logs() -> Vec<Run> {
    let mut robot = wam();
    robot.link_mut(5).unwrap().inertia.mass += 1.0;
    let torque = |joint: usize, [_, qd, _]: State| {
        let level = if joint == 3 { 0.8 } else { 0.0 };
        if qd > 0.0 {
            level
        } else if qd < 0.0 {
            -level
        } else {
            0.0
        }
    };
    let truth = Truth { robot: &robot, torque: &torque, reading: &|_, effort| effort };
    let mut runs: Vec<Run> =
        (0..3).map(|seed| run(&truth, &Noise::of_a_wam(), 12.0, 700 + seed)).collect();
    for run in &mut runs {
        for (t, effort) in run.time.iter().zip(&mut run.joints[2].effort) {
            *effort += (TAU * TONES_HZ[0] * t).sin();
        }
        let palm = &mut run.joints[PALM];
        palm.position.fill(0.3);
        palm.velocity.iter_mut().flatten().for_each(|v| *v = 0.0);
        palm.effort = run.time.iter().map(|t| 0.01 * t.sin()).collect();
    }
    runs
}

fn cause(at: &EffectAt, parameters: &[(&str, f64)]) -> TrueCause {
    let parameters: BTreeMap<String, f64> =
        parameters.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let truth = simulator::Truth {
        effect: at.effect,
        joint: at.joint.clone(),
        link: at.link.clone(),
        parameters,
    };
    TrueCause { role: CauseRole::Hidden, truth, strength: Strength { sigmas: 1e4, ..SEEN } }
}

#[test]
fn a_made_up_trial_loses_every_name_at_the_stage_that_is_known() {
    let [elbow, wrist] = ["j4_elbow_pitch", "j2_shoulder_pitch"];
    let friction = at(CoulombFriction, elbow);
    let load = at_link(InertialParameters, "wrist_pitch");
    let standing = at(CoulombFriction, "j7_palm_yaw");
    let fast = at(ExternalDisturbance, "j3_shoulder_yaw");
    let absent = at(ExternalDisturbance, "j1_base_yaw");
    let weak = at(ViscousFriction, wrist);
    let causes = [
        cause(&friction, &[("level", 0.8)]),
        cause(&load, &[]),
        cause(&standing, &[("level", 0.1)]),
        cause(&fast, &[("frequency", TONES_HZ[0])]),
        cause(&absent, &[("frequency", TONES_HZ[1])]),
        cause(&weak, &[("viscous", 0.0)]),
    ];
    let robot = wam();
    let sheet = TruthSheet {
        joints: robot.joint_names().map(str::to_owned).collect(),
        torque_rms: vec![1.0; robot.joint_count()],
        causes: causes.to_vec(),
        ..sheet(&[])
    };
    // The judge is told of a false name that does not do their work, and of none of the true ones.
    let wrong = at(TorqueOffset, wrist);
    let findings = vec![finding(wrong.clone(), 0.1, &[])];
    let judgement = Judgement::new(&sheet, &answers(Verdict::PartlyExplained, findings));
    let truth: Vec<EffectAt> =
        [&friction, &load, &standing, &fast, &absent, &weak].map(Clone::clone).to_vec();
    let asked = [&truth[..], std::slice::from_ref(&wrong)].concat();
    let settings = Settings::default();
    let account = account_for(&robot, &made_up_logs(), &settings, &truth, &asked).unwrap();
    // An oracle with the noise that is known.
    let per_rms = 2.0 * 0.897_91 * account.cutoff_hz;
    let density = account.joints.iter().map(|j| j.effort_noise.powi(2) / per_rms).collect();
    let trial =
        TrialAccount::of_search(&sheet, &judgement, &OracleEffortNoise { density }, &account);
    let lost = |at: &EffectAt| -> &LostName { trial.lost.iter().find(|l| l.at == *at).unwrap() };
    let stages: Vec<(String, LossStage, &str)> =
        trial.lost.iter().map(|l| (l.at.words(), l.stage, l.because.as_str())).collect();

    assert!(account.kept.contains(&friction), "{:?}", account.kept);
    assert_eq!(
        lost(&friction).stage,
        LossStage::HeldOut,
        "kept, and not in the answer: {stages:?}"
    );
    assert_eq!(lost(&standing).stage, LossStage::NoHypothesis, "{stages:?}");
    assert!(lost(&standing).because.starts_with("the joint moves over 0.0000 rad"), "{stages:?}");
    assert_eq!(lost(&fast).stage, LossStage::OutsideTheBand, "{stages:?}");
    assert_eq!(lost(&fast).because, "70.0 Hz, lines are looked for up to 51.0 Hz");
    assert_eq!(lost(&absent).stage, LossStage::Line, "{stages:?}");
    assert_eq!(lost(&weak).stage, LossStage::KnownNoise, "{stages:?}");
    assert!(lost(&weak).with_known_noise.unwrap().sigmas < 5.0, "{stages:?}");
    assert_eq!(lost(&wrong).stage, LossStage::FoundNames, "{stages:?}");
    assert_eq!(trial.not_found_again, [wrong.words()], "the finding is made up");
}

/// A payload and the inertia of the last link are the same numbers: the search names the first.
#[test]
fn the_inertia_of_a_link_that_carries_a_payload_is_named_as_another() {
    let mut robot = wam();
    robot.link_mut(PALM).unwrap().inertia.mass += 1.0;
    let truth = Truth::of(&robot);
    let runs: Vec<Run> =
        (0..3).map(|seed| run(&truth, &Noise::of_a_wam(), 12.0, 720 + seed)).collect();
    let [inertia, payload] = [InertialParameters, Payload].map(|kind| at_link(kind, "palm"));
    let sheet = TruthSheet { causes: vec![cause(&inertia, &[])], ..sheet(&[]) };
    let findings = vec![finding(payload.clone(), 0.9, &[])];
    let judgement = Judgement::new(&sheet, &answers(Verdict::Explained, findings));
    let asked = [inertia.clone(), payload.clone()];
    let account = account_for(&wam(), &runs, &Settings::default(), &asked[..1], &asked).unwrap();
    assert!(account.kept.contains(&payload), "{:?}", account.kept);
    let oracle = OracleEffortNoise::default();
    let lost = TrialAccount::of_search(&sheet, &judgement, &oracle, &account).lost;
    let stages: Vec<(NameError, LossStage)> = lost.iter().map(|l| (l.error, l.stage)).collect();
    let expected = [NameError::Missed, NameError::False].map(|error| (error, LossStage::OtherName));
    assert_eq!(stages, expected, "{lost:?}");
    assert_eq!(lost[0].takers, [payload]);
}

/// Counts accounts, and stops after some.
struct StopAfter {
    most: usize,
    made: std::sync::atomic::AtomicUsize,
}

impl StopAfter {
    fn new(most: usize) -> Self {
        Self { most, made: std::sync::atomic::AtomicUsize::new(0) }
    }

    fn made(&self) -> usize {
        self.made.load(std::sync::atomic::Ordering::Relaxed)
    }
}

impl AccountProgress for StopAfter {
    fn begin(&self, _: usize) {}

    fn finish_account(&self) {
        self.made.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    }

    fn is_stopped(&self) -> bool {
        self.made() >= self.most
    }
}

#[test]
fn accounts_are_taken_up_where_they_were_ended_and_sum_to_what_was_judged() {
    let root = tempfile::tempdir().unwrap();
    let text = "[population]\ntrials = 4\nseed = 5\narms = [\"hobby\"]\nlogs = [1, 1]\nlog_s = [5.0, 6.0]\n\
                longest_s = 6.0\nclean = 0.0\nspoilt = 0.0\n";
    let campaign = Campaign::from_document(&Document::from_text("c.toml", text).unwrap()).unwrap();
    let folder = CampaignFolder::plan(&root.path().join("campaign"), campaign).unwrap();
    let store = root.path().join("logs");
    let workers = Workers {
        jobs: 2,
        part: Part::WHOLE,
        logs: TrialLogs::Removed,
        store: Some(store.clone()),
        chosen: ChosenTrials::All,
    };
    work(&folder, &workers, &Quiet).unwrap();

    let make = |progress: &StopAfter, store: Option<&std::path::Path>| {
        make_accounts(&folder, (Part::WHOLE, NonZeroUsize::MIN), store, progress).unwrap();
        CampaignAccount::read(&folder, &folder.manifest().unwrap())
    };
    let first = make(&StopAfter::new(1), Some(&store));
    assert_eq!((first.trials + first.failed.len(), first.left), (1, 3));
    let rest = StopAfter::new(usize::MAX);
    let whole = make(&rest, Some(&store));
    assert_eq!((rest.made(), whole.trials, whole.left), (3, 4, 0), "{:?}", whole.failed);
    let again = StopAfter::new(usize::MAX);
    assert_eq!((make(&again, None), again.made()), (whole.clone(), 0));
    assert!(whole.made_otherwise.is_empty(), "{:?}", whole.made_otherwise);

    let records = folder.manifest().unwrap().records;
    let judged: Vec<&Judgement> = records.values().filter_map(|r| r.judgement()).collect();
    let missed = judged.iter().flat_map(|j| j.visible()).filter(|c| !c.is_named()).count();
    let wrong = judged.iter().flat_map(|j| &j.findings).filter(|f| !f.is_true).count();
    let of = |error| whole.lost.iter().filter(|lost| lost.name.error == error).count();
    assert_eq!((of(NameError::Missed), of(NameError::False)), (missed, wrong));
    assert!(missed > 0, "nothing is missed in these trials");
    let text = whole.text();
    assert!(text.lines().filter(|line| line.contains("missed, ")).count() == missed, "{text}");
    let longest =
        whole.tables().map(|t| t.text(1)).join("").lines().map(|l| l.chars().count()).max();
    assert!(longest.unwrap() <= 120, "{text}");

    // Without a store the logs are made again, and the account is the same.
    std::fs::remove_dir_all(folder.root().join("accounts")).unwrap();
    assert_eq!(make(&StopAfter::new(usize::MAX), None), whole);
}
