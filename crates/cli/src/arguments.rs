use clap::{Parser, Subcommand};

use crate::commands::{
    compare, completions, demo, design, diagnose, effects, explain, export, learn, log_info, man,
    replay, robot_check, robot_init, run, schema, simulate, track, trials, view,
};

const EXIT_CODES: &str = "\
Exit codes:
  0  explained or consistent; for other commands: done
  1  a gap is left unexplained, or the data cannot show one; robot check: an impossible inertia
  2  usage: arguments, or an output folder that cannot be written
  3  unusable data: a robot, a log or a column map";

const SIMULATION_EXIT_CODES: &str = "\
Exit codes:
  0  done
  2  usage: arguments, or an output folder that cannot be made
  3  a scenario, a robot or a log that cannot be used, or a joint that ran away";

const LEARN_EXIT_CODES: &str = "\
Exit codes:
  0  done, if only as far as Ctrl-C let it
  2  usage: arguments, or an output folder that cannot be made
  3  unusable data: a robot, a log or a column map";

const VIEW_EXIT_CODES: &str = "\
Exit codes:
  0  done
  2  no program opens what there is
  3  there is nothing to look at";

const EXAMPLES: &str = "\
Examples:
  plumbline demo
  plumbline log info run_1.csv --robot robot.urdf
  plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --out out
  plumbline explain FR02";

const DIAGNOSE_EXAMPLES: &str = "\
Examples:
  plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --out out
  plumbline diagnose --robot out/extended.toml --log run_3.csv --out check
  plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --residual gp --out out

Logs have a column time (s) and the columns <joint>.position (rad or m) and <joint>.effort
(N m or N), and <joint>.velocity, <joint>.acceleration where they were recorded, and
<joint>.link_position (rad or m) of a second encoder behind the gear.

The output folder holds
  report.html     the whole answer for a browser
  recording.rrd   the measured arm beside the simulated one, for rerun's viewer: plumbline view out
  figure.svg      the answer in one figure
  diagnosis.json  the whole answer for programs
  extended.toml   the robot with the findings, for --robot; needs robot.urdf beside it
  extended.urdf   the given URDF with what of them it can hold: plumbline export out says what is left
  models/named-gp.parquet
                  the same with a process of what is left, for track --learned; with --residual";

const COMPARE_EXIT_CODES: &str = "\
Exit codes:
  0  nothing has changed that these logs could show
  1  something has changed
  2  usage: arguments, or an output folder that cannot be written
  3  unusable data: a robot, a log or a column map";

const COMPARE_EXAMPLES: &str = "\
Examples:
  plumbline compare --robot robot.toml --before monday_*.csv --after friday_*.csv --out changes

The logs may be those of one arm before and after, early and late in a session, or of two arms that
should be alike; the motions need not be the same. The output folder holds
  before/  the diagnosis of the first logs
  after/   the diagnosis of the others, of the robot as the first logs found it: its findings are the
           changes, and was means before";

const EXPORT_EXIT_CODES: &str = "\
Exit codes:
  0  done
  2  usage: arguments, or an output folder that cannot be made
  3  a robot or a log that cannot be used, or a folder without a robot";

const EXPORT_EXAMPLES: &str = "\
Examples:
  plumbline export out
  plumbline export out --to mjcf,isaac --out models
  plumbline export robot.toml --to urdf,sdf --out models
  plumbline export out --to mjcf --log held_out.parquet

The folder holds
  extended.urdf  the user's own URDF with friction, inertias and origins as found
  extended.xml   an MJCF for MuJoCo, with rotors, springs and the actuators' delays as well
  extended.sdf   an SDF for Gazebo
  extended.usda  a USD layer of bodies and joints for Isaac Sim

Every quantity is printed with its fate: exact, approximated (how), dropped (why). With --log the
torque error of what each file holds stands beside those of the nominal and the extended robot.";

const INIT_EXAMPLES: &str = "\
Examples:
  plumbline robot init robot.urdf --out robots/mine
  plumbline robot init mobile.urdf --joints arm_1,arm_2,arm_3 --out robots/arm

The folder holds
  robot.toml     rotors, gains, rate, sensing: guesses that are called so, to be replaced
  scenario.toml  three runs within the robot's limits, for simulate and run";

const DESIGN_EXIT_CODES: &str = "\
Exit codes:
  0  done, or nothing is open in the diagnosis: nothing is written
  1  no motion settles what is open: nothing is written
  2  usage: arguments, or an output folder that cannot be made
  3  unusable data: a robot, a diagnosis or a log";

const DESIGN_EXAMPLES: &str = "\
Examples:
  plumbline design --robot robot.toml --diagnosis out --out next
  plumbline design --robot robot.toml --separate FR01@elbow --from FR02@elbow --out next

The output folder holds
  motion.csv      time (s) and <joint>.position, .velocity, .acceleration and .effort, the effort
                  that the robot as described needs
  motion.parquet  the same
  motion.toml     the motion as a scenario, for simulate; to run it on another arm extend both:
                  extends = [\"arm.toml\", \"next/motion.toml\"]";

const SIMULATE_EXAMPLES: &str = "\
Examples:
  plumbline simulate scenarios/effects/coulomb_friction.toml --out out
  plumbline simulate scenarios/demos/hidden_effects.toml --out out --seed 7
  plumbline simulate scenarios/demos/hidden_effects.toml --out out --set sensors.log_rate_hz=250

The output folder holds
  NAME.parquet   the log of each run, which tells nothing of what was put in
  scenario.toml  the scenario with all that it extends, --set and --seed: run again it gives
                 the same logs
  truth.json     what was put in: for scoring, never for a diagnosis

plumbline effects lists the effects, plumbline schema prints what a scenario may say.";

const LEARN_EXAMPLES: &str = "\
Examples:
  plumbline learn --robot robot.toml --train run_1.csv run_2.csv --test run_3.csv --out out
  plumbline learn --robot robot.urdf --train run_1.csv --test run_3.csv --models gp-rbd --out out
  plumbline learn --robot robot.toml --benchmark --out out

The output folder holds
  learning.json         errors, times, hyperparameters and how their searches ended
  figure.svg            the errors by joint and model
  models/NAME.parquet   the models

Ctrl-C ends the searches: every model is finished with what was found until then. Pressed
again it ends the program.";

const TRACK_EXAMPLES: &str = "\
Examples:
  plumbline track scenarios/tracking/low_gains.toml --out out
  plumbline track scenarios/tracking/low_gains.toml --out out --set prediction.clock=wall
  plumbline track scenarios/paper/fig3_4_tracking.toml --out out --learned out/models

The output folder holds
  report.html           the comparison for a browser
  tracking.json         the same for programs
  errors.svg            the errors by joint and model
  motion.svg            the first 10 s of three joints
  gains.svg             the errors against the gains, where the scenario has a sweep
  logs/NAME.parquet     the log of each run
  recordings/NAME.rrd   the recording of each run, for rerun's viewer: plumbline view out
  models/NAME.parquet   the models, for --learned
  scenario.toml         the scenario with all that it extends and --set

Ctrl-C ends the runs where they are. A run that is killed leaves NAME.rrd as far as it came, and
its log as NAME.csv.";

const REPLAY_EXAMPLES: &str = "\
Examples:
  plumbline replay --robot robot.toml --log run_1.parquet --out replay
  plumbline replay --robot out/extended.toml --log run_1.parquet --out replay --window-ms 100

The output folder holds for each run
  NAME_forward_50ms.parquet  the motion simulated under the torque of the log, for each length
                             of time, beside <joint>.measured_position
  NAME_motion.parquet        the torque simulated along the motion of the log, beside
                             <joint>.measured_effort, if the robot.toml has gains";

const RUN_EXAMPLES: &str = "\
Examples:
  plumbline run scenarios/demos/hidden_effects.toml --seed 7
  plumbline run scenarios/motions/every_effect_shows.toml \\
      --set \"effect=[{ backlash={ joint='j3_shoulder_yaw', gap_rad=0.01 } }]\"
  plumbline run scenarios/tracking/low_gains.toml --set control.gains=low-tenth
  plumbline run scenarios/paper/fig2_learning.toml

A scenario of an arm is what simulate takes. All its runs but the last are diagnosed; the last shows
what that gains, and its motion is tracked with the softest gains of robot.toml that hold the arm, as
described and extended, against gravity. A tracking scenario, which track takes, says which runs are
learned from, and the motion, the gains and the models that are tracked.

The output folder holds
  report.html    what was put in, what was found, what that gains
  recording.rrd  the measured arm beside the simulated one, for rerun's viewer: plumbline view out
  metrics.json   the numbers, the same for the same scenario and seed
  scenario.toml  the scenario with all that it extends, --set and --seed, to run again
  logs/          what simulate writes: the logs, and apart from them what was put in
  diagnosis/     what diagnose writes, the extended model among it
  models/        the models that are fed forward
  tracking/      what track writes
  stages/        of what every stage was made: one that is there and whole is not made again

A scenario that says [figure.prediction_time] or [figure.learning] draws that figure of Nguyen-Tuong &
Peters 2010 and says of every claim whether it holds. Its folder has report.html, metrics.json,
scenario.toml, stages/ and the figures as *.svg, and of the learning logs/, diagnosis/ and models/,
each with simulated/ and real/. A tracking scenario that feeds all of the paper's models forward is
told against its figures 3 and 4.

Ctrl-C ends the run; what was finished is kept.";

const DEMO_EXAMPLES: &str = "\
Examples:
  plumbline demo
  plumbline demo --seed 7 --out other
  plumbline demo --robot ur5e

The scenario is scenarios/demos/wam.toml of the repository, or that of the robot; it and the robot
are in the program and are written to source/ in the output folder, which plumbline run --help
describes.";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  plumbline completions bash > ~/.local/share/bash-completion/completions/plumbline
  plumbline completions zsh > ~/.zfunc/_plumbline
  plumbline completions fish > ~/.config/fish/completions/plumbline.fish";

const MAN_EXAMPLES: &str = "\
Examples:
  plumbline man --out ~/.local/share/man/man1";

const TRIALS_EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  trials are left to make, or to make again: a damaged shard or one of another campaign
  2  usage: arguments, a folder that cannot be written or holds another campaign, or a job that
     cannot be submitted
  3  a campaign, a scenario or a robot that cannot be used";

const TRIALS_EXAMPLES: &str = "\
Examples:
  plumbline trials plan scenarios/campaigns/trials.toml --out blind
  plumbline trials work blind --jobs 8
  plumbline trials work blind --part 1/4
  plumbline trials submit blind --sbatch --partition=short
  plumbline trials status blind
  plumbline trials merge blind

The folder holds
  campaign.toml    what is to be made
  scenario.toml    the scenario of every trial, with all that it extends
  shards/          a file for every trial that is made: to make one again, remove it
  slurm/           the job of submit, job.sh, and what its tasks have said
  trials.parquet   all of them, one row a trial; with merge
  tally.json       how often what was hidden was named, by kind and size; with merge
  report.html      the same for a browser; with merge

A trial is made in a folder of its own and its shard put in place when it is whole. Work that is
killed loses the trials that were being made, no more; Ctrl-C lets them come to their end.";

/// Shows what a simulation gets wrong in a recorded log, names the cause, extends the
/// model and measures the gain.
#[derive(Debug, Parser)]
#[command(name = "plumbline", version, after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"), arg_required_else_help = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Hides two effects in a simulated arm, finds them in its logs, and shows what that gains
    #[command(after_help = format!("{DEMO_EXAMPLES}\n\n{SIMULATION_EXIT_CODES}"))]
    Demo(demo::Arguments),
    /// Simulates an arm with effects, diagnoses it from its logs, and measures what that gains
    #[command(after_help = format!("{RUN_EXAMPLES}\n\n{SIMULATION_EXIT_CODES}"))]
    Run(run::Arguments),
    /// Names what a model gets wrong in logs, writes the extended model, a report and a figure
    #[command(after_help = format!("{DIAGNOSE_EXAMPLES}\n\n{EXIT_CODES}"))]
    Diagnose(diagnose::Arguments),
    /// Names what changed from one set of logs to another
    #[command(after_help = format!("{COMPARE_EXAMPLES}\n\n{COMPARE_EXIT_CODES}"))]
    Compare(compare::Arguments),
    /// Searches the motion that tells apart what a diagnosis could not, within the robot's limits
    #[command(after_help = format!("{DESIGN_EXAMPLES}\n\n{DESIGN_EXIT_CODES}"))]
    Design(design::Arguments),
    /// Writes the robot with its findings as URDF, MJCF, SDF and USD, and says what each leaves out
    #[command(after_help = format!("{EXPORT_EXAMPLES}\n\n{EXPORT_EXIT_CODES}"))]
    Export(export::Arguments),
    /// Looks at a robot description: joints, limits, masses, consistency
    #[command(subcommand)]
    Robot(RobotCommand),
    /// Looks at logs: rate, gaps, ranges, noise, time skew
    #[command(subcommand)]
    Log(LogCommand),
    /// Lists the effects: code, name, what each is, whether it is diagnosed and compensated
    Effects(effects::Arguments),
    /// Explains an effect by its code or name; lists all effects without one
    Explain(explain::Arguments),
    /// Simulates the runs of a scenario: logs, and apart from them what was put in
    #[command(after_help = format!("{SIMULATE_EXAMPLES}\n\n{SIMULATION_EXIT_CODES}"))]
    Simulate(simulate::Arguments),
    /// Learns models of the torque from logs and compares them on others
    #[command(after_help = format!("{LEARN_EXAMPLES}\n\n{LEARN_EXIT_CODES}"))]
    Learn(learn::Arguments),
    /// Compares a simulation with logs: motion under their torque, torque along their motion
    #[command(after_help = format!("{REPLAY_EXAMPLES}\n\n{SIMULATION_EXIT_CODES}"))]
    Replay(replay::Arguments),
    /// Tracks a motion with low gains and the torque of models fed forward, and compares them
    #[command(after_help = format!("{TRACK_EXAMPLES}\n\n{SIMULATION_EXIT_CODES}"))]
    Track(track::Arguments),
    /// Blind trials: effects hidden in a simulated arm, diagnosed from its logs, and scored
    #[command(subcommand, after_help = format!("{TRIALS_EXAMPLES}\n\n{TRIALS_EXIT_CODES}"))]
    Trials(trials::Action),
    /// Opens the report of an output folder in the browser, its recordings in rerun's viewer
    #[command(after_help = VIEW_EXIT_CODES)]
    View(view::Arguments),
    /// Prints the JSON schema of scenario files
    Schema(schema::Arguments),
    /// Prints the script with which a shell completes commands and options
    #[command(after_help = COMPLETIONS_EXAMPLES)]
    Completions(completions::Arguments),
    /// Writes a manual page for the program and for every command
    #[command(after_help = MAN_EXAMPLES)]
    Man(man::Arguments),
}

/// Commands on a robot description.
#[derive(Debug, Subcommand)]
pub enum RobotCommand {
    /// Prints joints, limits, masses, consistency and the number of base parameters
    #[command(after_help = EXIT_CODES)]
    Check(robot_check::Arguments),
    /// Writes a robot.toml with what a URDF cannot say, guessed, and a scenario that moves the robot
    #[command(after_help = format!("{INIT_EXAMPLES}\n\n{SIMULATION_EXIT_CODES}"))]
    Init(robot_init::Arguments),
}

/// Commands on logs.
#[derive(Debug, Subcommand)]
pub enum LogCommand {
    /// Prints rate, jitter, gaps, ranges, quantisation, saturation and time skew
    #[command(after_help = EXIT_CODES)]
    Info(log_info::Arguments),
}
