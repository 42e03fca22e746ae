//! Every option and every key that names a file.

/// What becomes of a file that is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// The program `plumbline` reads it: `X` stands for the name in these arguments, and in a text that is written
    /// before: that of `x.toml`, of `x.toml.xml` where it begins with `<`, and with `{` of `diagnosis/diagnosis.json`.
    Read(&'static str, &'static [&'static str]),
    /// It is written, or is a folder whose files have names of their own.
    Folder,
    /// The program `plumbline-bench` reads it, in the same way.
    Bench(&'static str, &'static [&'static str]),
    /// It names what the program itself has written.
    Own,
}

impl Use {
    /// The text and the arguments with which a program reads it; `None` where that program does not.
    pub fn read_by(self, program: &str) -> Option<(&'static str, &'static [&'static str])> {
        match self {
            Self::Read(text, arguments) if program.ends_with("plumbline") => {
                Some((text, arguments))
            }
            Self::Bench(text, arguments) if program.ends_with("-bench") => Some((text, arguments)),
            _ => None,
        }
    }
}

/// A figure from the data of two arms.
const FIGURE: &str = r#"[figure.learning]
learn = { train = ["training"], regression = ["regression"], points = 300 }
test = ["test"]
simulated.plant = "X"
real.plant = "X"
outside.sinusoids = { seed = 1, terms = 3, lowest_hz = 0.1, highest_hz = 0.3, duration_s = 10.0 }
"#;

/// A diagnosis of the arm that left nothing open.
const DIAGNOSIS: &str = r#"{"schema": "plumbline.diagnosis/1", "joints": [{"name": "shoulder"}, {"name": "elbow"}], "findings": [],
    "data": {"cutoff_hz": 10.0}, "provenance": {"files": [{"role": "robot", "path": "../arm.urdf", "sha256": ""}]}}"#;

/// The source file below `crates/`, the type and the field of everything that names a file.
pub const KEYS: &[(&str, &str, &str, Use)] = &[
    ("bench_cli/src/commands/account.rs", "Arguments", "folder", Use::Folder),
    ("bench_cli/src/commands/account.rs", "Arguments", "store", Use::Folder),
    ("bench_cli/src/commands/board.rs", "Arguments", "scores", Use::Bench("", &["board", "X"])),
    ("bench_cli/src/commands/compare.rs", "Arguments", "first", Use::Folder),
    ("bench_cli/src/commands/compare.rs", "Arguments", "second", Use::Folder),
    (
        "bench_cli/src/commands/damage.rs",
        "Arguments",
        "campaign",
        Use::Bench("", &["damage", "X", "--out", "out"]),
    ),
    ("bench_cli/src/commands/damage.rs", "Arguments", "out", Use::Folder),
    ("bench_cli/src/commands/export.rs", "Arguments", "data", Use::Folder),
    ("bench_cli/src/commands/export.rs", "Arguments", "out", Use::Folder),
    ("bench_cli/src/commands/export.rs", "Arguments", "truth", Use::Folder),
    (
        "bench_cli/src/commands/figure/arguments.rs",
        "Arguments",
        "scenario",
        Use::Bench("", &["figure", "X"]),
    ),
    ("bench_cli/src/commands/missing.rs", "Folder", "folder", Use::Folder),
    (
        "bench_cli/src/commands/plan.rs",
        "Arguments",
        "campaign",
        Use::Bench("", &["plan", "X", "--out", "out"]),
    ),
    ("bench_cli/src/commands/plan.rs", "Arguments", "out", Use::Folder),
    ("bench_cli/src/commands/plan.rs", "Arguments", "made", Use::Folder),
    ("bench_cli/src/commands/score.rs", "Arguments", "answers", Use::Folder),
    ("bench_cli/src/commands/score.rs", "Arguments", "folder", Use::Folder),
    ("bench_cli/src/commands/score.rs", "Arguments", "replay", Use::Own),
    ("bench_cli/src/commands/score.rs", "Arguments", "truth", Use::Own),
    ("bench_cli/src/commands/sheets.rs", "Arguments", "store", Use::Folder),
    ("bench_cli/src/commands/submit/submission.rs", "Arguments", "answers", Use::Folder),
    ("bench_cli/src/commands/submit/submission.rs", "Arguments", "folder", Use::Folder),
    (
        "bench_cli/src/commands/times/measure.rs",
        "Arguments",
        "robot",
        Use::Bench("", &["times", "--robot", "X"]),
    ),
    ("bench_cli/src/commands/times/measure.rs", "Arguments", "out", Use::Folder),
    ("bench_cli/src/commands/work.rs", "Arguments", "folder", Use::Folder),
    ("bench_cli/src/commands/work.rs", "Arguments", "store", Use::Folder),
    (
        "benchmark/src/paper/figure_spec.rs",
        "PredictionTimeFigureSpec",
        "robot",
        Use::Bench(
            "[figure.prediction_time]\nrobot = \"X\"\npoints = [10]\n",
            &["figure", "x.toml"],
        ),
    ),
    (
        "benchmark/src/paper/figure_spec.rs",
        "DataSpec",
        "plant",
        Use::Bench(FIGURE, &["figure", "x.toml"]),
    ),
    (
        "benchmark/src/trials/scenario_campaign.rs",
        "CampaignSpec",
        "scenario",
        Use::Bench(
            "scenario = \"X\"\nhidden = [\"clean\"]\nseeds = 1\nseed = 1\n",
            &["plan", "x.toml", "--out", "out"],
        ),
    ),
    (
        "cli/src/columns.rs",
        "ColumnArguments",
        "map",
        Use::Read("", &["log", "info", "run_0.csv", "--robot", "arm.urdf", "--map", "X"]),
    ),
    (
        "cli/src/commands/compare.rs",
        "Arguments",
        "before",
        Use::Read("", &["compare", "--robot", "arm.urdf", "--before", "X", "--after", "run_0.csv"]),
    ),
    (
        "cli/src/commands/compare.rs",
        "Arguments",
        "after",
        Use::Read("", &["compare", "--robot", "arm.urdf", "--before", "run_0.csv", "--after", "X"]),
    ),
    ("cli/src/commands/compare.rs", "Arguments", "out", Use::Folder),
    (
        "cli/src/commands/design.rs",
        "Arguments",
        "robot",
        Use::Read(DIAGNOSIS, &["design", "--robot", "X", "--diagnosis", "diagnosis"]),
    ),
    (
        "cli/src/commands/design.rs",
        "Arguments",
        "diagnosis",
        Use::Read("", &["design", "--robot", "arm.urdf", "--diagnosis", "X"]),
    ),
    (
        "cli/src/commands/design.rs",
        "Arguments",
        "logs",
        Use::Read(
            DIAGNOSIS,
            &["design", "--robot", "arm.urdf", "--diagnosis", "diagnosis", "--log", "X"],
        ),
    ),
    ("cli/src/commands/design.rs", "Arguments", "out", Use::Folder),
    ("cli/src/commands/design/diagnosis_file.rs", "DiagnosisFile", "path", Use::Own),
    (
        "cli/src/commands/diagnose.rs",
        "Arguments",
        "logs",
        Use::Read("", &["diagnose", "--robot", "arm.urdf", "--log", "X"]),
    ),
    ("cli/src/commands/diagnose.rs", "Arguments", "out", Use::Folder),
    ("cli/src/commands/export.rs", "Arguments", "path", Use::Read("", &["export", "X"])),
    ("cli/src/commands/export.rs", "Arguments", "out", Use::Folder),
    (
        "cli/src/commands/learn/arguments.rs",
        "Arguments",
        "train",
        Use::Read("", &["learn", "--robot", "arm.urdf", "--train", "X", "--test", "run_0.csv"]),
    ),
    (
        "cli/src/commands/learn/arguments.rs",
        "Arguments",
        "test",
        Use::Read("", &["learn", "--robot", "arm.urdf", "--train", "run_0.csv", "--test", "X"]),
    ),
    (
        "cli/src/commands/learn/arguments.rs",
        "Arguments",
        "regression",
        Use::Read(
            "",
            &[
                "learn",
                "--robot",
                "arm.urdf",
                "--train",
                "run_0.csv",
                "--test",
                "run_1.csv",
                "--regression",
                "X",
            ],
        ),
    ),
    (
        "cli/src/commands/learn/arguments.rs",
        "Arguments",
        "named",
        Use::Read(
            "",
            &[
                "learn",
                "--robot",
                "arm.urdf",
                "--train",
                "run_0.csv",
                "--test",
                "run_1.csv",
                "--named",
                "X",
            ],
        ),
    ),
    ("cli/src/commands/learn/arguments.rs", "Arguments", "out", Use::Folder),
    ("cli/src/commands/log_info.rs", "Arguments", "files", Use::Read("", &["log", "info", "X"])),
    (
        "cli/src/commands/log_info.rs",
        "Arguments",
        "robot",
        Use::Read("", &["log", "info", "run_0.csv", "--robot", "X"]),
    ),
    ("cli/src/commands/man.rs", "Arguments", "out", Use::Folder),
    (
        "cli/src/commands/replay.rs",
        "Arguments",
        "robot",
        Use::Read("", &["replay", "--robot", "X", "--log", "run_0.csv"]),
    ),
    (
        "cli/src/commands/replay.rs",
        "Arguments",
        "diagnosis",
        Use::Read("", &["replay", "--diagnosis", "X"]),
    ),
    (
        "cli/src/commands/replay.rs",
        "Arguments",
        "logs",
        Use::Read("", &["replay", "--robot", "arm.urdf", "--log", "X"]),
    ),
    ("cli/src/commands/replay.rs", "Arguments", "out", Use::Folder),
    (
        "cli/src/commands/robot_check.rs",
        "Arguments",
        "file",
        Use::Read("", &["robot", "check", "X"]),
    ),
    ("cli/src/commands/robot_init.rs", "Arguments", "file", Use::Read("", &["robot", "init", "X"])),
    ("cli/src/commands/robot_init.rs", "Arguments", "out", Use::Folder),
    ("cli/src/commands/run.rs", "Arguments", "scenario", Use::Read("", &["run", "X"])),
    ("cli/src/commands/run.rs", "Output", "out", Use::Folder),
    ("cli/src/commands/simulate.rs", "Arguments", "scenario", Use::Read("", &["simulate", "X"])),
    ("cli/src/commands/simulate.rs", "Arguments", "out", Use::Folder),
    ("cli/src/commands/track.rs", "Arguments", "scenario", Use::Read("", &["track", "X"])),
    ("cli/src/commands/track.rs", "Arguments", "out", Use::Folder),
    ("cli/src/commands/track.rs", "Arguments", "learned", Use::Folder),
    ("cli/src/commands/view.rs", "Arguments", "folder", Use::Folder),
    (
        "cli/src/diagnosed_input.rs",
        "SourceFile",
        "path",
        Use::Read(
            r#"{"provenance": {"files": [{"role": "robot", "path": "../X", "sha256": ""}]}}"#,
            &["design", "--diagnosis", "diagnosis"],
        ),
    ),
    ("cli/src/input.rs", "PartArguments", "package", Use::Folder),
    (
        "cli/src/input.rs",
        "RobotArguments",
        "robot",
        Use::Read("", &["diagnose", "--robot", "X", "--log", "run_0.csv"]),
    ),
    (
        "cli/src/loss.rs",
        "LossArguments",
        "logs",
        Use::Read("", &["export", "arm.urdf", "--out", "o", "--log", "X"]),
    ),
    (
        "cli/src/loss.rs",
        "LossArguments",
        "nominal",
        Use::Read(
            "",
            &["export", "arm.urdf", "--out", "o", "--log", "run_0.csv", "--nominal", "X"],
        ),
    ),
    (
        "experiment/src/scenario/tracking_spec.rs",
        "TrackingSpec",
        "plant",
        Use::Read(
            "plant = \"X\"\nmotion.sinusoids = { seed = 2, terms = 3, lowest_hz = 0.3, highest_hz = 1.0, duration_s = 2.0 }\n",
            &["track", "x.toml"],
        ),
    ),
    ("experiment/src/stage.rs", "Product", "files", Use::Own),
    ("experiment/src/stage.rs", "Stored", "files", Use::Own),
    (
        "motion/src/spec/fourier.rs",
        "Coefficients",
        "File",
        Use::Read(
            "robot = \"arm.urdf\"\ncontrol.kp_nm_per_rad = { shoulder = 9.0, elbow = 9.0 }\ncontrol.kd_nm_s_per_rad = { shoulder = 1.0, elbow = 1.0 }\n[[run]]\nname = \"a\"\nmotion.fourier = { duration_s = 2.0, coefficients.file = \"X\" }\n",
            &["simulate", "x.toml"],
        ),
    ),
    (
        "motion/src/spec/recorded.rs",
        "Recorded",
        "file",
        Use::Read(
            "robot = \"arm.urdf\"\ncontrol.kp_nm_per_rad = { shoulder = 9.0, elbow = 9.0 }\ncontrol.kd_nm_s_per_rad = { shoulder = 1.0, elbow = 1.0 }\n[[run]]\nname = \"a\"\nmotion.recorded.file = \"X\"\n",
            &["simulate", "x.toml"],
        ),
    ),
    (
        "motion/src/spec/recorded.rs",
        "Recorded",
        "map",
        Use::Read(
            "robot = \"arm.urdf\"\ncontrol.kp_nm_per_rad = { shoulder = 9.0, elbow = 9.0 }\ncontrol.kd_nm_s_per_rad = { shoulder = 1.0, elbow = 1.0 }\n[[run]]\nname = \"a\"\nmotion.recorded = { file = \"run_0.csv\", map = \"X\" }\n",
            &["simulate", "x.toml"],
        ),
    ),
    ("population/src/spec.rs", "RecordedSpec", "data", Use::Folder),
    ("report/src/diagnosis/input_options.rs", "InputOptions", "packages", Use::Folder),
    (
        "simulator/src/scenario/spec.rs",
        "ScenarioSpec",
        "robot",
        Use::Read(
            "robot = \"X\"\n[[run]]\nname = \"a\"\nmotion.sinusoids = { seed = 2, terms = 3, lowest_hz = 0.3, highest_hz = 1.0, duration_s = 2.0 }\n",
            &["simulate", "x.toml"],
        ),
    ),
];

/// What names files without being a path in Rust: keys that are strings there, and attributes of XML.
pub const WORDS: &[(&str, Use)] = &[
    ("extends", Use::Read("extends = \"X\"\n", &["run", "x.toml"])),
    ("urdf", Use::Read("urdf = \"X\"\n", &["robot", "check", "x.toml"])),
    (
        "map of a diagnosis",
        Use::Read(
            r#"{"provenance": {"files": [{"role": "robot", "path": "../arm.urdf", "sha256": ""},
                {"role": "map", "path": "../X", "sha256": ""}, {"role": "log", "path": "../run_0.csv", "sha256": ""}]}}"#,
            &["replay", "--diagnosis", "diagnosis"],
        ),
    ),
    (
        "log of a diagnosis",
        Use::Read(
            r#"{"provenance": {"files": [{"role": "robot", "path": "../arm.urdf", "sha256": ""},
                {"role": "log", "path": "../X", "sha256": ""}]}}"#,
            &["replay", "--diagnosis", "diagnosis"],
        ),
    ),
    (
        "include of an MJCF",
        Use::Read(
            "<mujoco><worldbody/><include file=\"X\"/></mujoco>",
            &["robot", "check", "x.toml.xml"],
        ),
    ),
];
