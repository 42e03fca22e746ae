//! Benchmarks of a diagnosis: campaigns of blind trials, baselines, and the paper's figures.
//!
//! ```text
//! Campaign --plan--> CampaignFolder --work--> shards of Records --> MergedPanel
//! trial of a scenario or a population: nominal/, logs/ --diagnose blind--> Answers
//! TruthSheet, Answers --> Judgement --many--> PanelTally
//! two results of the same trials --> PairedComparison
//! LearningFigure --simulate, diagnose, learn--> LearningErrors --judge--> Claims
//! MergedPanel, LearningErrors, PredictionTimes --> pages, drawings, text, JSON
//! ```
//!
//! - `panel` judges one trial by its truth, `trials` plans and makes campaigns;
//! - `account` says at which stage every missed cause and every false finding of a campaign is lost;
//! - `tables` adds trials up, `paired` compares two results of the same trials;
//! - `alarms` is what was said of clean logs, corner by corner;
//! - `damage` spoils the logs of a trial more and more;
//! - `cause_bench` hands out trials without their truth, and scores the answers of any method;
//! - `baselines` is plain least squares, `statistics` shares and rates with their intervals;
//! - `paper` measures the figures of Nguyen-Tuong & Peters 2010, `reports` shows all of it.

mod account;
mod alarms;
mod baselines;
mod cause_bench;
mod damage;
mod disk_failure;
mod error;
mod paired;
mod panel;
mod paper;
mod reports;
mod statistics;
mod tables;
mod trial_folder;
mod trials;

pub use account::account_work::{AccountProgress, make_accounts};
pub use account::campaign_account::{ACCOUNT_SCHEMA, CampaignAccount, LostInTrial};
pub use account::loss_stage::LossStage;
pub use account::lost_name::{LostName, NameError};
pub use account::oracle_noise::OracleEffortNoise;
pub use account::trial_account::TrialAccount;
pub use alarms::alarm::Alarm;
pub use alarms::alarm_ledger::AlarmLedger;
pub use alarms::alarm_row::AlarmRow;
pub use alarms::false_name::FalseName;
pub use baselines::baseline::Baseline;
pub use baselines::least_squares::least_squares;
pub use cause_bench::answer::{NamedCause, NamedPlace, NamedSize, TrialAnswer};
pub use cause_bench::answer_fault::AnswerFault;
pub use cause_bench::bench_set::BenchSet;
pub use cause_bench::bench_truth::{BenchTruth, TrialTruth};
pub use cause_bench::board::BenchBoard;
pub use cause_bench::export::{ExportRequest, export_set};
pub use cause_bench::manifest::{BenchLog, BenchManifest, BenchTrial, MANIFEST_SCHEMA};
pub use cause_bench::name_match::NameMatch;
pub use cause_bench::replay_drift::{REPLAY_TIMES_MS, ReplayDrift};
pub use cause_bench::score_row::ScoreRow;
pub use cause_bench::scores::{BenchScores, SCORES_SCHEMA};
pub use cause_bench::spoken::SpokenAnswer;
pub use damage::curves::{
    DAMAGE_SCHEMA, DAMAGE_SIZES, DamageCurves, DamagePoint, DamageTrial, damage_kinds,
};
pub use damage::outcome::DamageOutcome;
pub use error::BenchmarkError;
pub use paired::comparison::PairedComparison;
pub use paired::measures::{Measure, TrialQuantity};
pub use paired::paired_mean::PairedMean;
pub use paired::paired_share::PairedShare;
pub use paired::turned::Turned;
pub use panel::answers::{Answers, Costs, HeldOut};
pub use panel::judged_body::JudgedBody;
pub use panel::judged_cause::JudgedCause;
pub use panel::judged_finding::{BaselineClaim, JudgedFinding};
pub use panel::judged_reasons::JudgedReasons;
pub use panel::judged_spoiling::{JudgedSpoiling, SpoilingOutcome};
pub use panel::judgement::Judgement;
pub use panel::panel_side::PanelSide;
pub use panel::prediction::{Prediction, RelativeError};
pub use paper::figure_spec::{
    DataSpec, FigureScenario, FigureSpec, LearningFigureSpec, PredictionTimeFigureSpec,
};
pub use paper::learning_claims::learning_claims;
pub use paper::learning_errors::{LearningErrors, ModelErrors};
pub use paper::learning_figure::{LearningFigure, PaperData, PaperPlant};
pub use paper::prediction_time_figure::PredictionTimeFigure;
pub use paper::time_claims::{ModelTime, time_claims};
pub use reports::paper::learning_figure::{LEARNING_FIGURE_SCHEMA, LearningFigureReport};
pub use reports::paper::prediction_time_figure::{
    PREDICTION_TIME_FIGURE_SCHEMA, PredictionTimeFigureReport,
};
pub use reports::times::prediction_times::{Maker, PredictionTimes, TimeCurve, TimePoint};
pub use reports::trials::panel_page::panel_page;
pub use statistics::middle::Middle;
pub use statistics::rate::{Fraction, Rate};
pub use statistics::share::Share;
pub use statistics::text_table::TextTable;
pub use tables::kind_row::KindRow;
pub use tables::merged_panel::{MergedPanel, PANEL_SCHEMA};
pub use tables::panel_row::{Naming, PanelRow, Ratios};
pub use tables::panel_tally::PanelTally;
pub use tables::size_tally::SizeTally;
pub use tables::slow_diagnosis::SlowDiagnosis;
pub use tables::spoiling_row::SpoilingRow;
pub use tables::stranger_row::StrangerRow;
pub use trials::campaign::{Campaign, PopulationCampaign};
pub use trials::campaign_folder::{BrokenShard, CampaignFolder, Manifest, read_finished};
pub use trials::failure::Failure;
pub use trials::hidden::Hidden;
pub use trials::kind_count::KindCount;
pub use trials::part::{BadPart, Part};
pub use trials::record::Record;
pub use trials::scenario_campaign::{CampaignSpec, ScenarioCampaign};
pub use trials::trial::Trial;
pub use trials::work::{ChosenTrials, TrialLogs, WorkProgress, Workers, work};
