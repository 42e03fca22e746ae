use std::f64::consts::TAU;
use std::ops::Range;

use effects::Frame;
use logs::{FourierTransform, LogError, Prepared};
use nalgebra::Complex;
use rayon::prelude::*;
use robot::Robot;

use crate::oscillations::lines::Oscillations;
use crate::oscillations::moving_runs::MovingRuns;
use crate::oscillations::run_parts::{low_pass, windows};
use crate::oscillations::spectral_lines::{
    AROUND, Follows, SpectralLine, SpectralLines, surprisal,
};
use crate::oscillations::tone_fit::{Coherence, Sampled, ToneFit};
use crate::oscillations::turning_sum::TurningSum;
use crate::signals::along::Along;
use crate::signals::log::Log;
use crate::signals::rest::Rest;
use crate::signals::tone::{Beat, Tone};
use crate::thresholds::tones::ToneThresholds;

/// Number of zeros that are appended to a run before its spectrum is taken, in lengths of the longest run.
const PADDED: usize = 4;

/// Values on either side of a line among which its beat is looked for, a tenth of the step of the spectrum apart, and then
/// a hundredth.
const NEAR: usize = 10;

/// Conditions for the tones of a log.
pub(crate) struct ToneQuestion<'a> {
    /// Frequency below which a line may come from the motion (Hz).
    pub slowest_hz: f64,
    /// Least fall of the RMS error of each joint that counts (N·m or N).
    pub practical: &'a [f64],
    /// Least share of the residual of a joint.
    pub open_share: f64,
}

/// The oscillations in the residual efforts of a robot in a wide band, at the joints that moved: lines of the
/// spectrum over time or position that stand out of all runs together and that lower the error by enough. The robot is
/// `found` by a search; a tone must also be in the difference from the one as it is `described`.
///
/// A line as slow as the motion counts under two conditions: it is most of the residual at all times, and at some
/// times no joint moves much at its frequency.
pub(crate) fn tones(
    [found, described]: [&Robot; 2],
    wide: &Prepared,
    log: &Log,
    question: &ToneQuestion,
) -> Result<Oscillations, LogError> {
    let (cutoff_hz, t) = (wide.cutoff_hz, &log.thresholds.tones);
    let runs = rests(found, wide, log)?;
    let bands =
        Bands { cutoff_hz, band_hz: log.prepared.cutoff_hz, slowest_hz: question.slowest_hz };
    let at = |j: usize| {
        if log.moved[j] {
            let least = Least { rms: question.practical[j], share: question.open_share };
            at_joint(&runs, j, least, bands, t)
        } else {
            Vec::new()
        }
    };
    let looked_for = |tone: &Tone| !log.without.contains(&tone.hypothesis().kind);
    let mut lines: Vec<Vec<Tone>> = (0..log.moved.len()).into_par_iter().map(at).collect();
    if lines.iter().any(|lines| !lines.is_empty()) {
        let gaps = rests(described, wide, log)?;
        let is_in_gap = |tone: &Tone| {
            let gap = || gaps.iter().flat_map(|run| &run.left[tone.joint]);
            let power = gap().map(|x| x * x).sum::<f64>() / gap().count().max(1) as f64;
            0.5 * tone.amplitude().powi(2) <= t.most_of_gap * power
        };
        lines.iter_mut().for_each(|lines| lines.retain(is_in_gap));
    }
    let mut found = Oscillations::default();
    for lines in lines {
        found.add(lines, t);
    }
    found.tones.retain(looked_for);
    Ok(found)
}

/// What the residual efforts of a robot have of tones that other logs show: those of the same joints and beats. `None`
/// where no run determines it.
pub(crate) fn tones_at(
    beats: &[(usize, Beat)],
    robot: &Robot,
    wide: &Prepared,
    log: &Log,
) -> Result<Vec<Option<Tone>>, LogError> {
    let t = &log.thresholds.tones;
    let runs = rests(robot, wide, log)?;
    let tone = |&(j, beat): &(usize, Beat)| {
        let moving = MovingRuns::new(&runs, j, wide.cutoff_hz, t);
        let follows = match beat {
            Beat::Position(_) => Follows::Position,
            Beat::Clock(_) => Follows::Clock,
        };
        let joint = Joint::new(&moving, follows, Least { rms: 0.0, share: 0.0 }, t);
        (!moving.runs.is_empty()).then(|| joint.fit_tone(beat.rate(), 0.0))?
    };
    Ok(beats.iter().map(tone).collect())
}

/// The residual efforts of a robot in a wide band.
fn rests<'a>(robot: &Robot, wide: &'a Prepared, log: &Log<'a>) -> Result<Vec<Rest<'a>>, LogError> {
    let frame = &Frame::of_logs(wide);
    let of = |run| {
        let signals = &log.thresholds.signals;
        let along = Along::new(robot, frame, run, wide.cutoff_hz, log.limits, signals)?;
        Ok(Rest::new(along.with_even_noise()))
    };
    wide.runs.iter().map(of).collect()
}

/// Least fall of the RMS error that counts (N·m or N), and least share of the residual's power.
#[derive(Debug, Clone, Copy)]
struct Least {
    rms: f64,
    share: f64,
}

/// Cut-offs of the wide band and of the diagnosis, and the frequency below which a line may come from the motion
/// (Hz).
#[derive(Debug, Clone, Copy)]
struct Bands {
    cutoff_hz: f64,
    band_hz: f64,
    slowest_hz: f64,
}

/// One joint: its residual in every run, and the variable that the phase of a tone in it may follow.
struct Joint<'a> {
    index: usize,
    least: Least,
    thresholds: &'a ToneThresholds,
    follows: Follows,
    runs: &'a [&'a Rest<'a>],
    /// `[run][sample]`.
    left: &'a [Vec<f64>],
    /// `[run][sample]`: the highest value of the beat (rad per unit) at which a sample counts.
    highest: &'a [Vec<f64>],
}

/// The tones of joint `j` in the runs in which it moves, the strongest first.
fn at_joint(runs: &[Rest], j: usize, least: Least, bands: Bands, t: &ToneThresholds) -> Vec<Tone> {
    let Bands { cutoff_hz, band_hz, slowest_hz } = bands;
    let moving = MovingRuns::new(runs, j, cutoff_hz, t);
    let mut left = moving.left.clone();
    let slowest_hz = slowest_hz.max(t.lowest_hz);
    let mut tones: Vec<Tone> = Vec::new();
    while tones.len() < t.most_tones {
        let of = |follows| Joint { left: &left, ..Joint::new(&moving, follows, least, t) };
        let (clock, position) = (of(Follows::Clock), of(Follows::Position));
        let line = |band_hz: [f64; 2]| clock.strongest_tone(|clock| clock.lines(band_hz));
        let found = [
            position.strongest_tone(|position| position.waves()),
            line([slowest_hz, t.highest * cutoff_hz])
                .filter(|tone| is_much_of_its_band(tone, &clock, band_hz)),
            line([t.lowest_hz, slowest_hz]).filter(|tone| is_no_motion(tone, &clock, slowest_hz)),
        ];
        let strongest = found.into_iter().flatten().max_by(|a, b| a.share.total_cmp(&b.share));
        let Some(tone) = strongest else { break };
        left = clock.without(&tone);
        tones.push(tone);
    }
    tones
}

/// Whether a tone is faster than the band of the diagnosis, or at least half of the residual in it (RMS). In that
/// band an effect that was not found has lines too, which come from the motion.
fn is_much_of_its_band(tone: &Tone, clock: &Joint, band_hz: f64) -> bool {
    let Beat::Clock(frequency_hz) = tone.beat else { return false };
    let power = |left: &[Vec<f64>]| -> f64 {
        let of = |(x, run): (&Vec<f64>, &&Rest)| low_pass(x, &run.time, band_hz);
        left.iter().zip(clock.runs).flat_map(of).map(|x| x * x).sum()
    };
    frequency_hz > band_hz || {
        let share = clock.thresholds.share_in_band;
        power(&clock.without(tone)) < (1.0 - share.powi(2)) * power(clock.left)
    }
}

/// Whether a slow tone is most of the residual in every window in which the joint moves most of the time, and some of these
/// windows have no joint with much of its velocity at the frequency of the tone.
fn is_no_motion(tone: &Tone, clock: &Joint, slowest_hz: f64) -> bool {
    let Beat::Clock(frequency_hz) = tone.beat else { return false };
    let (runs, t) = (clock.runs, clock.thresholds);
    let slow = |left: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let of = |(x, run): (&Vec<f64>, &&Rest)| low_pass(x, &run.time, t.slow_band * slowest_hz);
        left.iter().zip(runs).map(of).collect()
    };
    let (with, without) = (slow(clock.left), slow(&clock.without(tone)));
    let window_s = t.window_s.max(t.window_periods / frequency_hz);
    let moves = |(r, w): &(usize, Range<usize>)| {
        let highest = clock.highest[*r].get(w.clone()).unwrap_or_default();
        2 * highest.iter().filter(|highest| **highest > 0.0).count() > w.len()
    };
    let windows = || {
        let of = |(r, run): (usize, &&Rest)| {
            windows(&run.time, window_s).into_iter().map(move |w| (r, w))
        };
        runs.iter().enumerate().flat_map(of).filter(moves)
    };
    let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
    let in_window = |x: &[f64], w: &Range<usize>| x.get(w.clone()).map_or(0.0, power);
    let is_most = |(r, w): (usize, Range<usize>)| {
        in_window(&without[r], &w) < (1.0 - t.share_of_slow) * in_window(&with[r], &w)
    };
    let is_still = |(r, w): &(usize, Range<usize>)| {
        let moves = |qd: &Vec<f64>| {
            let samples = qd.iter().zip(&runs[*r].time).take(w.end).skip(w.start);
            let turning = samples.map(|(v, time)| Complex::cis(-TAU * frequency_hz * time) * v);
            // Of a sine alone the sum is n / 2 times its amplitude, the power n / 2 times its square.
            2.0 * turning.sum::<Complex<f64>>().norm_sqr() / w.len().max(1) as f64
                > t.share_of_motion * in_window(qd, w)
        };
        !runs[*r].qd.iter().any(moves)
    };
    windows().all(is_most) && windows().filter(is_still).count() >= t.fewest_still
}

impl<'a> Joint<'a> {
    fn new(
        moving: &'a MovingRuns,
        follows: Follows,
        least: Least,
        thresholds: &'a ToneThresholds,
    ) -> Self {
        let highest = match follows {
            Follows::Position => &moving.highest_by_position,
            Follows::Clock => &moving.highest_by_clock,
        };
        let MovingRuns { joint: index, runs, left, .. } = moving;
        Self { index: *index, least, thresholds, follows, runs, left, highest }
    }

    /// The variable that the phase follows in run `r` (s; or rad or m).
    fn beat(&self, r: usize) -> &[f64] {
        match self.follows {
            Follows::Position => &self.runs[r].q[self.index],
            Follows::Clock => &self.runs[r].time,
        }
    }

    /// The tone of the strongest line of a spectrum, if over all runs it stands out from the spectrum without it. The
    /// tone is removed for this comparison because a line is wide, especially over position.
    fn strongest_tone(&self, spectrum: impl Fn(&Joint) -> Option<SpectralLines>) -> Option<Tone> {
        let line = spectrum(self)?.line()?;
        let mut tone = self.tone(&line)?;
        let left = self.without(&tone);
        let rest = spectrum(&Joint { left: &left, ..*self })?;
        let around: Vec<f64> = rest.around(line.index)?;
        let ratios = line.power.iter().zip(&around).map(|(p, a)| p / a.max(f64::MIN_POSITIVE));
        tone.stands_out = surprisal(ratios);
        tone.error = tone.error.map(|error| error * rest.beside(line.index, &around).sqrt());
        (tone.stands_out > self.thresholds.above_spectrum).then_some(tone)
    }

    /// The residual without a tone, `[run][sample]`.
    fn without(&self, tone: &Tone) -> Vec<Vec<f64>> {
        let of = |(r, left): (usize, &Vec<f64>)| {
            let wave = self.runs[r].along.wave(self.index, tone.beat, 0.0);
            let without = |((x, sine), highest): ((&f64, Complex<f64>), &f64)| {
                if *highest > 0.0 { x - (tone.z[r] * sine).re } else { *x }
            };
            left.iter().zip(wave.values).zip(&self.highest[r]).map(without).collect()
        };
        self.left.iter().enumerate().map(of).collect()
    }

    /// The spectrum over position of all runs together, which share its phase.
    fn waves(&self) -> Option<SpectralLines> {
        let all = || (0..self.runs.len()).flat_map(|r| self.beat(r).iter().copied());
        let (low, high) =
            all().fold((f64::INFINITY, -f64::INFINITY), |(l, h), q| (l.min(q), h.max(q)));
        let wave = TAU / (high - low);
        if !wave.is_finite() {
            return None;
        }
        let step = 0.25 * wave;
        let (fewest, most) = (self.thresholds.fewest_waves, self.thresholds.most_waves);
        let first = fewest * wave;
        let count = (4.0 * (most - fewest)) as usize;
        let runs: Vec<Vec<(Complex<f64>, usize)>> = (0..self.left.len())
            .into_par_iter()
            .map(|r| self.scan(r, first, step, count))
            .collect();
        let longest = runs.iter().map(Vec::len).max().unwrap_or(0);
        let power = |k: usize| {
            let sums = runs.iter().filter_map(|run| run.get(k));
            let start = (Complex::new(0.0, 0.0), 0);
            let (sum, n) = sums.fold(start, |(sum, n), &(z, m)| (sum + z, n + m));
            sum.norm_sqr() / n.max(1) as f64
        };
        Some(SpectralLines { powers: vec![(0..longest).map(power).collect()], first, step })
    }

    /// `sum r exp(-i periods q)` of one run over the samples that count, and their number. It ends where fewer samples are
    /// left than a spectrum needs.
    fn scan(&self, r: usize, first: f64, step: f64, count: usize) -> Vec<(Complex<f64>, usize)> {
        let mut order: Vec<usize> = (0..self.left[r].len()).collect();
        order.sort_by(|&a, &b| self.highest[r][b].total_cmp(&self.highest[r][a]));
        let beat = self.beat(r);
        let at_all = |at: f64| order.iter().map(move |&t| Complex::cis(-at * beat[t]));
        let mut terms = TurningSum::new(
            at_all(first).zip(&order).map(|(z, &t)| z * self.left[r][t]),
            at_all(step),
        );
        let mut sums = Vec::with_capacity(count);
        for k in 0..count {
            let at = first + k as f64 * step;
            let counted = order.partition_point(|&t| self.highest[r][t] >= at);
            if counted < AROUND {
                break;
            }
            sums.push((terms.sum_and_turn(counted), counted));
        }
        sums
    }

    /// The spectra over time between two frequencies (Hz).
    fn lines(&self, [lowest_hz, highest_hz]: [f64; 2]) -> Option<SpectralLines> {
        let longest = self.left.iter().map(Vec::len).max()?;
        let size = (PADDED * longest).next_power_of_two();
        let times = self.runs.iter().map(|run| &run.time).max_by_key(|t| t.len())?;
        let period_s = (times.last()? - times.first()?) / (longest.saturating_sub(1)) as f64;
        let step = (size as f64 * period_s).recip();
        if !step.is_finite() {
            return None;
        }
        let [first, last] = [lowest_hz, highest_hz].map(|f| (f / step) as usize);
        let mut fourier = FourierTransform::default();
        let power = |x: &Vec<f64>| -> Option<Vec<f64>> {
            let mut padded = x.clone();
            padded.resize(size, 0.0);
            let spectrum = fourier.of(&mut padded);
            let used = spectrum.get(first..=last)?;
            Some(used.iter().map(|z| z.norm_sqr() / x.len() as f64).collect())
        };
        let powers: Vec<Vec<f64>> = self.left.iter().map(power).collect::<Option<_>>()?;
        Some(SpectralLines { powers, first: TAU * first as f64 * step, step: TAU * step })
    }

    /// The tone of a line, if it has the same amplitude in all runs and is large enough. Its errors are those for
    /// noise of variance one.
    fn tone(&self, line: &SpectralLine) -> Option<Tone> {
        let (mut at, mut step) = (line.at, line.step);
        for _ in 0..2 {
            at = self.strongest_near(at, 0.1 * step);
            step *= 0.1;
        }
        let sums = (0..self.left.len()).map(|r| self.sum(r, at));
        let sizes: Vec<(f64, usize)> =
            sums.map(|(z, n)| (2.0 * z.norm() / n.max(1) as f64, n)).collect();
        let (least, most) =
            sizes.iter().fold((f64::INFINITY, 0.0), |(l, m), (z, _)| (z.min(l), z.max(m)));
        if least < self.thresholds.same_in_runs * most {
            return None;
        }
        if !self.lasts(at) {
            return None;
        }
        let mut tone = self.fit_tone(at, step)?;
        // A tone whose phase differs from run to run follows another variable.
        let even = tone.amplitude() > self.thresholds.same_phase * least;
        tone.share = 1.0 - self.power_of(&self.without(&tone)) / self.power_of(self.left);
        let Least { rms, share } = self.least;
        let pays = tone.share * self.power_of(self.left) > rms.powi(2) * self.sample_count();
        (even && pays && tone.share > share).then_some(tone)
    }

    /// The value of the beat (rad per unit) of most power among those up to [`NEAR`] steps from `at`.
    fn strongest_near(&self, at: f64, step: f64) -> f64 {
        let (first, count) = (at - NEAR as f64 * step, 2 * NEAR + 1);
        let runs: Vec<Vec<Complex<f64>>> =
            (0..self.left.len()).map(|r| self.sums(r, first, step, count)).collect();
        let power = |k: usize| -> f64 {
            let sums = runs.iter().map(|sums| sums[k]);
            match self.follows {
                Follows::Position => sums.sum::<Complex<f64>>().norm_sqr(),
                Follows::Clock => sums.map(|z| z.norm_sqr()).sum(),
            }
        };
        let best = (0..count).max_by(|&a, &b| power(a).total_cmp(&power(b)));
        first + best.unwrap_or(NEAR) as f64 * step
    }

    /// `sum r exp(-i at beat)` of one run over the samples that count, at `count` values of `at` from `first`.
    fn sums(&self, r: usize, first: f64, step: f64, count: usize) -> Vec<Complex<f64>> {
        let mut sums = vec![Complex::new(0.0, 0.0); count];
        let all = self.left[r].iter().zip(self.beat(r)).zip(&self.highest[r]);
        for ((x, beat), highest) in all.filter(|(_, highest)| **highest >= first) {
            let (mut z, turn) = (Complex::cis(-first * beat) * *x, Complex::cis(-step * beat));
            let counted = sums.iter_mut().zip(0_u32..);
            for (sum, _) in counted.take_while(|(_, k)| first + f64::from(*k) * step <= *highest) {
                *sum += z;
                z *= turn;
            }
        }
        sums
    }

    /// Whether the first halves of all runs have the same amplitude at a beat (rad per unit) as the second halves, within
    /// [`ToneThresholds::same_in_runs`]. What comes from a motion that changes its pace does not.
    fn lasts(&self, at: f64) -> bool {
        let half = |is_second: bool| {
            let of = |r: usize| {
                let middle = self.middle(r, at);
                let samples = if is_second { middle..self.left[r].len() } else { 0..middle };
                self.sum_over(r, samples, at)
            };
            let sums = (0..self.left.len()).map(of);
            sums.fold((0.0, 0), |(size, n), (z, count)| (size + z.norm(), n + count))
        };
        let [first, second] = [half(false), half(true)].map(|(size, n)| size / n.max(1) as f64);
        first.min(second) >= self.thresholds.same_in_runs * first.max(second)
    }

    /// The sample at which the second half of a run begins. Over time the halves are of what counts. Over position they are of
    /// the run: a joint that moves in a part of it alone, by a stroke or two, has lines there that come from its starts.
    fn middle(&self, r: usize, at: f64) -> usize {
        if self.follows == Follows::Position {
            return self.left[r].len() / 2;
        }
        let mut counted = (0..self.left[r].len()).filter(|&t| self.highest[r][t] >= at);
        counted.nth(self.count(r, at) / 2).unwrap_or(0)
    }

    /// Number of samples of one run that count at a beat (rad per unit).
    fn count(&self, r: usize, at: f64) -> usize {
        self.highest[r].iter().filter(|highest| **highest >= at).count()
    }

    /// The tone near a value of the beat (rad per unit), by least squares.
    fn fit_tone(&self, at: f64, step: f64) -> Option<Tone> {
        let highest = self.highest.iter();
        let counts: Vec<Vec<bool>> =
            highest.map(|run| run.iter().map(|highest| *highest >= at).collect()).collect();
        let beat_sum = |r: usize| {
            let samples = self.beat(r).iter().zip(&counts[r]).filter(|(_, counts)| **counts);
            samples.fold((0.0, 0), |(sum, n), (beat, _)| (sum + beat, n + 1))
        };
        let own = |(sum, n): (f64, usize)| sum / n.max(1) as f64;
        let each: Vec<(f64, usize)> = (0..self.left.len()).map(beat_sum).collect();
        let all = own(each.iter().fold((0.0, 0), |a, b| (a.0 + b.0, a.1 + b.1)));
        let samples = |r: usize| Sampled {
            left: &self.left[r],
            counts: &counts[r],
            origin: match self.follows {
                Follows::Position => all,
                Follows::Clock => own(each[r]),
            },
        };
        let (coherence, per_unit) = match self.follows {
            Follows::Position => (Coherence::AllRuns, 1.0),
            Follows::Clock => (Coherence::EachRun, TAU),
        };
        let beat = |at: f64| match self.follows {
            Follows::Position => Beat::Position(at),
            Follows::Clock => Beat::Clock(at / TAU),
        };
        let sampled: Vec<Sampled> = (0..self.left.len()).map(samples).collect();
        let wave =
            |r: usize, at: f64, origin: f64| self.runs[r].along.wave(self.index, beat(at), origin);
        let fit = ToneFit::new(&sampled, coherence, [at, step], wave)?;
        let [of_amplitude, of_beat, of_phase] = fit.variances.map(f64::sqrt);
        let error = [of_amplitude, of_beat / per_unit, of_phase];
        let beat = beat(fit.at);
        Some(Tone { joint: self.index, beat, z: fit.z, error, stands_out: 0.0, share: 0.0 })
    }

    /// Number of samples over all runs that count at any beat.
    fn sample_count(&self) -> f64 {
        self.highest.iter().flatten().filter(|highest| **highest > 0.0).count() as f64
    }

    /// Sum of squares over all runs, where samples count at any beat.
    fn power_of(&self, left: &[Vec<f64>]) -> f64 {
        let counted = left.iter().flatten().zip(self.highest.iter().flatten());
        let counted = counted.filter(|(_, highest)| **highest > 0.0);
        counted.map(|(x, _)| x * x).sum::<f64>().max(f64::MIN_POSITIVE)
    }

    /// `sum r exp(-i at beat)` of one run over the samples that count, and their number.
    fn sum(&self, r: usize, at: f64) -> (Complex<f64>, usize) {
        self.sum_over(r, 0..self.left[r].len(), at)
    }

    /// The same over a part of the run.
    fn sum_over(&self, r: usize, part: Range<usize>, at: f64) -> (Complex<f64>, usize) {
        let all = self.left[r].iter().zip(self.beat(r)).zip(&self.highest[r]);
        let samples = all.skip(part.start).take(part.len());
        let counted = samples.filter(|(_, highest)| **highest >= at);
        counted.fold((Complex::new(0.0, 0.0), 0), |(sum, n), ((x, beat), _)| {
            (sum + Complex::cis(-at * beat) * *x, n + 1)
        })
    }
}
