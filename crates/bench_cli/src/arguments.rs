use clap::{Parser, Subcommand};

use crate::commands::missing::Folder;
use crate::commands::submit::submission;
use crate::commands::times::measure;
use crate::commands::{
    account, board, compare, damage, export, figure, plan, schema, score, sheets, work,
};

const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  trials are left to make, or to make again: a damaged shard or one of another campaign
  2  usage: arguments, a folder that cannot be written or holds another campaign, or a job that
     cannot be submitted
  3  a campaign, a scenario or a robot that cannot be used";

const EXAMPLES: &str = "\
Examples:
  plumbline-bench plan scenarios/campaigns/trials.toml --out blind
  plumbline-bench work blind --jobs 8
  plumbline-bench work blind --part 1/4
  plumbline-bench submit blind --sbatch --partition=short
  plumbline-bench submit core --answers mine -- my_method core mine
  plumbline-bench status blind
  plumbline-bench merge blind

A campaign's folder holds
  campaign.toml    what is to be made
  scenario.toml    the scenario of every trial, with all that it extends
  shards/          a file for every trial that is made: to make one again, remove it
  slurm/           the job of submit, job.sh, and what its tasks have said
  trials.parquet   all of them, one row a trial; with merge
  tally.json       all scores, by corner and kind; with merge
  report.html      the same for a browser; with merge
  accounts/        of every trial, where its names are lost; with account
  account.json     all of them, by stage and kind; with account

A trial is made in a folder of its own and its shard put in place when it is whole. Work that is
killed loses the trials that were being made, no more; Ctrl-C lets them come to their end.";

const FIGURE_EXAMPLES: &str = "\
Examples:
  plumbline-bench figure scenarios/paper/fig1_prediction_time.toml
  plumbline-bench figure scenarios/paper/fig2_learning.toml --out out

A scenario says [figure.prediction_time] or [figure.learning]: which figure of Nguyen-Tuong & Peters 2010
is drawn. Of every claim of the paper it is said whether it holds.

The output folder holds
  report.html    the claims, the figures and the tables behind them
  metrics.json   the numbers, the same for the same scenario and seed
  *.svg          the figures
  scenario.toml  the scenario with all that it extends, --set and --seed, to draw it again
  logs/, diagnosis/, models/
                 of figure 2, each with simulated/ and real/
  stages/        of what every stage was made: one that is there and whole is not made again

Ctrl-C ends the run; what was finished is kept.";

/// Counts how well a diagnosis names what is hidden in simulated and recorded arms, and draws the
/// figures of Nguyen-Tuong & Peters 2010.
#[derive(Debug, Parser)]
#[command(name = "plumbline-bench", version, after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"), arg_required_else_help = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: BenchCommand,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum BenchCommand {
    /// Puts a campaign into a folder, with all that it needs
    Plan(plan::Arguments),
    /// Makes every trial that is left; may be ended and begun again, and run several times at once
    Work(work::Arguments),
    /// Has a cluster that shares the folder make every trial that is left, or answer it by an entrant of CauseBench, a
    /// part a task
    Submit(submission::Arguments),
    /// Says how many trials are made, failed, broken and left
    Status(Folder),
    /// Puts the trials that are made together: tables, trials.parquet, tally.json, report.html
    Merge(Folder),
    /// Says of every missed visible cause and every false finding at which stage it is lost
    Account(account::Arguments),
    /// Compares two results of the same trials, trial by trial: wins, losses and which trials turned
    Compare(compare::Arguments),
    /// Spoils the logs of a few trials more and more, kind by kind, and says what the answers become: a new name
    /// with nothing left open is the fault, and ends with code 1
    Damage(damage::Arguments),
    /// Writes a set of CauseBench: trials for any method, without their truth
    Export(export::Arguments),
    /// Scores the answers of any method to a set of CauseBench
    Score(score::Arguments),
    /// Prints the page of the book on CauseBench, with the scores of several entrants
    Board(board::Arguments),
    /// Works out anew what could be seen in the trials of a store; their logs stay
    Sheets(sheets::Arguments),
    /// Draws a figure of the paper and says of every claim about it whether it holds
    #[command(after_help = FIGURE_EXAMPLES)]
    Figure(figure::arguments::Arguments),
    /// Times one prediction of every model against the number of training points
    Times(measure::Arguments),
    /// Prints the JSON schema of campaigns, figures, or the files of CauseBench
    Schema(schema::Arguments),
}
