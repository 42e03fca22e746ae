//! What stands behind the options in the help of each command.

use crate::after_help::HelpPart::{self, Examples, List, Words};

const EXIT: &str = "Exit codes:";

const USAGE: (&str, &str) = ("2", "usage: arguments, or an output folder that cannot be written");
const UNUSABLE: (&str, &str) = ("3", "unusable data: a robot, a log or a column map");

const EXIT_CODES: HelpPart = List(
    EXIT,
    &[
        ("0", "explained or consistent; for other commands: done"),
        (
            "1",
            "a gap is left unexplained, or the data cannot show one; robot check: an impossible inertia",
        ),
        USAGE,
        UNUSABLE,
    ],
);

const DIAGNOSIS_EXIT_CODES: HelpPart = List(
    EXIT,
    &[
        ("0", "explained or consistent"),
        ("1", "a gap is left unexplained, or the data cannot show one"),
        USAGE,
        UNUSABLE,
    ],
);

const SIMULATION_EXIT_CODES: HelpPart = List(
    EXIT,
    &[
        ("0", "done"),
        USAGE,
        ("3", "a scenario, a robot or a log that cannot be used, or a joint that ran away"),
    ],
);

pub const PROGRAM: &[HelpPart] = &[
    Examples(&[
        "plumbline demo",
        "plumbline log info run_1.csv --robot robot.urdf",
        "plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --out out",
        "plumbline explain FR02",
    ]),
    EXIT_CODES,
];

pub const DIAGNOSE: &[HelpPart] = &[
    Examples(&[
        "plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --out out",
        "plumbline diagnose --robot out/extended.toml --log run_3.csv --out check",
        "plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --residual gp --out out",
    ]),
    Words(
        "Logs have a column time (s) and the columns <joint>.position (rad or m) and <joint>.effort (N m or N), and \
         <joint>.velocity, <joint>.acceleration where they were recorded, and <joint>.link_position (rad or m) of a \
         second encoder behind the gear.",
    ),
    List(
        "The output folder holds",
        &[
            ("report.html", "the whole answer for a browser"),
            (
                "recording.rrd",
                "the measured arm beside the simulated one, for rerun's viewer: plumbline view out",
            ),
            ("figure.svg", "the answer in one figure"),
            (
                "diagnosis.json",
                "the whole answer for programs, and how robot and logs were read, for export, design and replay",
            ),
            (
                "extended.toml",
                "the robot with the findings, for --robot; needs robot.urdf beside it",
            ),
            (
                "extended.urdf",
                "the given URDF with those findings that a URDF can hold: plumbline export out says which",
            ),
            (
                "models/named-gp.parquet",
                "the robot with the findings and a process of what they leave, for track --learned; with --residual",
            ),
        ],
    ),
    DIAGNOSIS_EXIT_CODES,
];

pub const COMPARE: &[HelpPart] = &[
    Examples(&[
        "plumbline compare --robot robot.toml --before monday_*.csv --after friday_*.csv --out changes",
    ]),
    Words(
        "The logs may be those of one arm before and after, early and late in a session, or of two arms that should \
         be alike; the motions need not be the same.",
    ),
    List(
        "The output folder holds",
        &[
            ("report.html", "what changed, for a browser"),
            ("comparison.json", "what changed, for programs"),
            ("before/", "the diagnosis of the first logs"),
            (
                "after/",
                "the diagnosis of the other logs, of the robot as the first logs found it (before/extended.toml): its \
                 findings are the changes, and \"was\" is the size before",
            ),
        ],
    ),
    List(
        EXIT,
        &[
            ("0", "nothing has changed that these logs could show"),
            ("1", "something has changed"),
            USAGE,
            UNUSABLE,
        ],
    ),
];

pub const EXPORT: &[HelpPart] = &[
    Examples(&[
        "plumbline export out",
        "plumbline export out --to mjcf,isaac --out models",
        "plumbline export robot.toml --to urdf,sdf --out models",
        "plumbline export out --to mjcf --log held_out.parquet",
    ]),
    List(
        "The folder holds",
        &[
            ("extended.urdf", "the user's own URDF with friction, inertias and origins as found"),
            (
                "extended.xml",
                "an MJCF for MuJoCo, with rotors, springs and the actuators' delays as well",
            ),
            ("extended.sdf", "an SDF for Gazebo"),
            ("extended.usda", "a USD layer of bodies and joints for Isaac Sim"),
            (
                "extended_actuator.xml, .py and .json",
                "the servos for MuJoCo, Isaac Lab and BAM, where robot.toml describes their position loop",
            ),
        ],
    ),
    Words(
        "Every quantity is printed with its fate: exact, approximated (how), dropped (why). With --log the torque \
         error of what each file holds stands beside those of the nominal and the extended robot. Joints and column \
         names are those of the diagnosis in the same folder, where the command line says nothing else.",
    ),
    List(
        EXIT,
        &[
            ("0", "done"),
            USAGE,
            ("3", "a robot or a log that cannot be used, or a folder without a robot"),
        ],
    ),
];

pub const ROBOT_CHECK: &[HelpPart] = &[
    Examples(&[
        "plumbline robot check robot.urdf",
        "plumbline robot check mobile.urdf --joints arm_1,arm_2,arm_3",
        "plumbline robot check menagerie:ur5e",
    ]),
    List(
        EXIT,
        &[
            ("0", "the inertia of every moving body is possible"),
            ("1", "one is impossible, or far from any body of its size"),
            ("2", "usage: arguments"),
            ("3", "a robot that cannot be used"),
        ],
    ),
];

pub const ROBOT_INIT: &[HelpPart] = &[
    Examples(&[
        "plumbline robot init robot.urdf --out robots/mine",
        "plumbline robot init mobile.urdf --joints arm_1,arm_2,arm_3 --out robots/arm",
    ]),
    List(
        "The folder holds",
        &[
            (
                "robot.toml",
                "rotors, gains, rate, sensing: guesses that are called so, to be replaced",
            ),
            ("scenario.toml", "three runs within the robot's limits, for simulate and run"),
        ],
    ),
    SIMULATION_EXIT_CODES,
];

pub const LOG_INFO: &[HelpPart] = &[
    Examples(&[
        "plumbline log info run_1.csv",
        "plumbline log info run_1.csv run_2.csv --robot robot.urdf --map map.toml",
        "plumbline log info bag --robot robot.urdf --topic /arm/joint_states",
    ]),
    List(EXIT, &[("0", "done"), ("2", "usage: arguments"), UNUSABLE]),
];

pub const DESIGN: &[HelpPart] = &[
    Examples(&[
        "plumbline design --diagnosis out --out next",
        "plumbline design --robot robot.toml --separate FR01@elbow --from FR02@elbow --out next",
    ]),
    List(
        "The output folder holds",
        &[
            (
                "motion.csv",
                "time (s) and <joint>.position, .velocity, .acceleration and .effort, the effort that the robot as \
                 described needs",
            ),
            ("motion.parquet", "the same"),
            (
                "motion.toml",
                "the motion as a scenario, for simulate; to run it on another arm extend both: \
                 extends = [\"arm.toml\", \"next/motion.toml\"]",
            ),
        ],
    ),
    List(
        EXIT,
        &[
            ("0", "done, or nothing is open in the diagnosis: nothing is written"),
            ("1", "no motion settles what is open: nothing is written"),
            USAGE,
            ("3", "unusable data: a robot, a diagnosis or a log"),
        ],
    ),
];

pub const SIMULATE: &[HelpPart] = &[
    Examples(&[
        "plumbline simulate scenarios/effects/coulomb_friction.toml --out out",
        "plumbline simulate scenarios/demos/hidden_effects.toml --out out --seed 7",
        "plumbline simulate scenarios/demos/hidden_effects.toml --set sensors.log_rate_hz=250",
    ]),
    List(
        "The output folder holds",
        &[
            ("NAME.parquet", "the log of each run, which tells nothing of what was put in"),
            (
                "scenario.toml",
                "the scenario with all that it extends, --set and --seed: run again it gives the same logs",
            ),
            ("truth.json", "what was put in: for scoring, never for a diagnosis"),
        ],
    ),
    Words("plumbline explain lists the effects, plumbline schema prints what a scenario may say."),
    SIMULATION_EXIT_CODES,
];

pub const LEARN: &[HelpPart] = &[
    Examples(&[
        "plumbline learn --robot robot.toml --train run_1.csv run_2.csv --test run_3.csv --out out",
        "plumbline learn --robot robot.urdf --train run_1.csv --test run_3.csv --models gp-rbd",
    ]),
    List(
        "The output folder holds",
        &[
            ("report.html", "the comparison for a browser"),
            (
                "learning.json",
                "errors, times, hyperparameters and how their searches ended, for programs",
            ),
            ("figure.svg", "the errors by joint and model"),
            ("models/NAME.parquet", "the models"),
        ],
    ),
    Words(
        "Ctrl-C ends the searches: every model is finished with what was found until then. Pressed again it ends the \
         program.",
    ),
    List(EXIT, &[("0", "done, if only as far as Ctrl-C let it"), USAGE, UNUSABLE]),
];

pub const TRACK: &[HelpPart] = &[
    Examples(&[
        "plumbline track scenarios/tracking/low_gains.toml --out out",
        "plumbline track scenarios/tracking/low_gains.toml --out out --set prediction.clock=wall",
        "plumbline track scenarios/paper/fig3_4_tracking.toml --out out --learned out/models",
    ]),
    List(
        "The output folder holds",
        &[
            ("report.html", "the comparison for a browser"),
            ("tracking.json", "the same for programs"),
            ("errors.svg", "the errors by joint and model"),
            ("motion.svg", "the first 10 s of three joints"),
            ("gains.svg", "the errors against the gains, where the scenario has a sweep"),
            ("logs/NAME.parquet", "the log of each run"),
            (
                "recordings/NAME.rrd",
                "the recording of each run, for rerun's viewer: plumbline view out",
            ),
            ("models/NAME.parquet", "the models, for --learned"),
            ("scenario.toml", "the scenario with all that it extends and --set"),
        ],
    ),
    Words(
        "Ctrl-C ends the runs where they are. A run that is killed leaves NAME.rrd as far as it came, and its log as \
         NAME.csv.",
    ),
    SIMULATION_EXIT_CODES,
];

pub const REPLAY: &[HelpPart] = &[
    Examples(&[
        "plumbline replay --diagnosis out",
        "plumbline replay --robot robot.toml --log run_1.parquet --out replay",
        "plumbline replay --robot out/extended.toml --log run_1.parquet --window-ms 100",
    ]),
    List(
        "The output folder holds",
        &[
            ("report.html", "drift and torque error of every run, for a browser"),
            ("replay.json", "the same for programs"),
        ],
    ),
    List(
        "and for each run",
        &[
            (
                "NAME_forward_50ms.parquet",
                "the motion simulated under the torque of the log, for each length of time, beside \
                 <joint>.measured_position",
            ),
            (
                "NAME_motion.parquet",
                "the torque simulated along the motion of the log, beside <joint>.measured_effort, if the robot.toml \
                 has gains",
            ),
        ],
    ),
    SIMULATION_EXIT_CODES,
];

pub const RUN: &[HelpPart] = &[
    Examples(&[
        "plumbline run scenarios/demos/hidden_effects.toml --seed 7",
        "plumbline run scenarios/motions/every_effect_shows.toml \\\n      \
         --set \"effect=[{ backlash={ joint='j3_shoulder_yaw', gap_rad=0.01 } }]\"",
        "plumbline run scenarios/tracking/low_gains.toml --set control.gains=low-tenth",
    ]),
    Words(
        "A scenario of an arm is what simulate takes. All its runs but the last are diagnosed. The last one measures \
         what the answer gains: its motion is tracked with the softest gains of robot.toml that hold the arm against \
         gravity, once with the robot as described and once with the extended one. A tracking scenario, which track \
         takes, says which runs are learned from, and the motion, the gains and the models that are tracked.",
    ),
    List(
        "The output folder holds",
        &[
            ("report.html", "what was put in, what was found, what that gains"),
            (
                "recording.rrd",
                "the measured arm beside the simulated one, for rerun's viewer: plumbline view out",
            ),
            ("metrics.json", "the numbers, the same for the same scenario and seed"),
            (
                "scenario.toml",
                "the scenario with all that it extends, --set and --seed, to run again",
            ),
            ("logs/", "what simulate writes: the logs, and apart from them what was put in"),
            ("diagnosis/", "what diagnose writes, the extended model among it"),
            ("models/", "the models that are fed forward"),
            ("tracking/", "what track writes"),
            (
                "stages/",
                "what every stage was made of: one that is there and whole is not made again",
            ),
        ],
    ),
    Words(
        "A tracking scenario that feeds all models of Nguyen-Tuong & Peters 2010 forward is compared with figures \
         3 and 4 of that paper.",
    ),
    Words("Ctrl-C ends the run; what was finished is kept."),
    SIMULATION_EXIT_CODES,
];

pub const DEMO: &[HelpPart] = &[
    Examples(&[
        "plumbline demo",
        "plumbline demo --seed 7 --out other",
        "plumbline demo --robot ur5e",
    ]),
    Words(
        "A demo is a run of a scenario that the program holds: scenarios/demos/wam.toml of the repository, or that of the \
         robot. Scenario and robot are written to source/ in the output folder, which plumbline run --help describes.",
    ),
    SIMULATION_EXIT_CODES,
];

pub const VIEW: &[HelpPart] = &[
    Examples(&["plumbline view out", "plumbline view out --print"]),
    List(
        EXIT,
        &[
            ("0", "done"),
            ("2", "no program opens what there is"),
            ("3", "there is nothing to look at"),
        ],
    ),
];

pub const COMPLETIONS: &[HelpPart] = &[Examples(&[
    "plumbline completions bash > ~/.local/share/bash-completion/completions/plumbline",
    "plumbline completions zsh > ~/.zfunc/_plumbline",
    "plumbline completions fish > ~/.config/fish/completions/plumbline.fish",
])];

pub const EXPLAIN: &[HelpPart] = &[
    Examples(&["plumbline explain", "plumbline explain FR02", "plumbline explain payload --json"]),
    List(EXIT, &[("0", "done"), ("2", "usage: arguments, or a name of no effect")]),
];

pub const SCHEMA: &[HelpPart] = &[Examples(&[
    "plumbline schema",
    "plumbline schema robot > robot.schema.json",
    "plumbline schema map --markdown",
])];

pub const MAN: &[HelpPart] = &[Examples(&["plumbline man --out ~/.local/share/man/man1"])];
