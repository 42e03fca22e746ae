use robot::TorqueSource;

use crate::columns::run_design::{JointDesign, RunDesign};
use crate::outcome::answer::Answer;
use crate::outcome::findings::Found;
use crate::outcome::limit_finding::limit_finding;
use crate::outcome::spectrum::Spectrum;
use crate::outcome::structure::{Probe, Structure};
use crate::outcome::tone_finding::tone_finding;
use crate::outcome::torque_noise::TorqueNoise;
use crate::outcome::verdict::{Situation, hides, overall};
use crate::readiness::extent::range;
use crate::regression::noise::integrated_time;
use crate::result::{
    DataSummary, Diagnosis, Finding, Gain, JointReport, Negligible, NoiseSpectrum, RuledOut,
    SCHEMA, Unexplained, Verdict,
};
use crate::search::record::Record;
use crate::search::study::Study;
use crate::signals::along::REGRESSION_RATE;

impl Study<'_> {
    /// The answer; `data.runs` and `warnings` are left for the caller.
    pub fn report(&self, record: &Record, answer: &Answer) -> Diagnosis {
        let noise = TorqueNoise::new(self.nominal, self.design, self.log.prepared);
        let least = record.practical;
        let joint = |j: usize| self.joint(answer, (&noise, least), j);
        let reports: Vec<(JointReport, Structure)> = (0..self.design.joints()).map(joint).collect();
        let unexplained = reports.iter().filter_map(unexplained).collect();
        let joints: Vec<JointReport> = reports.into_iter().map(|(j, _)| j).collect();
        let hides = |((joint, unseen), inadequate): &((&JointReport, &f64), &Option<String>)| {
            joint.verdict == Verdict::DataInadequate
                && inadequate.is_none()
                && hides(**unseen, joint.torque_rms_nm)
        };
        let each = joints.iter().zip(&answer.unseen_friction).zip(self.inadequate);
        let hiding = each.filter(hides).count();
        Diagnosis {
            schema: SCHEMA,
            robot: self.robot.name().to_owned(),
            verdict: overall(&joints.iter().map(|j| j.verdict).collect::<Vec<_>>(), hiding),
            joints,
            findings: self.findings(answer, least),
            negligible: self.negligible(answer, least),
            unexplained,
            ruled_out: self.ruled_out(answer),
            gain: Gain { inverse: answer.gain.inverse.clone() },
            data: self.data(record, answer),
            warnings: Vec::new(),
        }
    }

    fn joint(
        &self,
        answer: &Answer,
        (noise, least): (&TorqueNoise, &[f64]),
        j: usize,
    ) -> (JointReport, Structure) {
        let heard = self.heard_at(j);
        // What a search without a part of the record takes for a cause is none where the search
        // over all of it has dropped it again.
        let is_named = heard > 0 || answer.found.iter().any(|f| f.fall[j].abs() > 0.0);
        let left = if is_named { &answer.left[j] } else { &answer.gap[j] };
        let (gap, rest) = (self.told_of(&answer.gap[j], j), self.told_of(left, j));
        let structure = self.structure(answer, left, j);
        let spectrum = Spectrum::of(left, self.design.rate_hz);
        let lowered = || answer.found.iter().filter(|f| f.fall[j] > least[j].powi(2));
        let name = &self.robot.links()[j].joint.name;
        let is_own = |f: &&Found| f.finding.at.joint.as_ref() == Some(name);
        let situation = Situation {
            inadequate: self.inadequate[j].clone(),
            findings: lowered().count() + heard,
            own: lowered().filter(is_own).count() + heard,
            between: answer.between.as_ref().map_or(0, |b| b.at(name)),
            unseen: answer.unseen_friction[j],
            torque_rms: self.torque_rms(j),
            nominal_rms: rms(&gap),
            remaining_rms: rms(&rest),
            samples: independent(&rest),
            noise: noise.rms(j),
            is_command: self.nominal.links()[j].actuator.torque_source == TorqueSource::Commanded,
            near_rest: self.near_rest(j),
            failed: answer.failed.is_told_at(self.design, j),
            practical: self.settings.open_share,
            structure: structure.share,
            above_hz: spectrum.above_hz(),
            motion_hz: self.log.prepared.motion_hz,
        };
        let spectra = spectra(noise.spectrum(j), &spectrum);
        let report = self.joint_report(&situation, (spectra, &rest), j);
        (report, Structure { share: situation.unexplained(), ..structure })
    }

    fn joint_report(
        &self,
        situation: &Situation,
        (spectrum, rest): (NoiseSpectrum, &[Vec<f64>]),
        j: usize,
    ) -> JointReport {
        let (verdict, because) = situation.verdict();
        let time = integrated_time(rest);
        JointReport {
            name: self.robot.links()[j].joint.name.clone(),
            verdict,
            because,
            torque_rms_nm: situation.torque_rms,
            residual_rms_nm: situation.nominal_rms,
            remaining_rms_nm: situation.remaining_rms,
            noise_floor_rms_nm: situation.noise.0,
            noise_floor_from: situation.noise.1,
            spectrum,
            autocorrelation_time_s: time / self.design.rate_hz,
            effective_samples: rest.iter().map(Vec::len).sum::<usize>() as f64 / time,
            range: range(self.log.prepared, j),
        }
    }

    /// RMS of the dry friction of the description that may be anything up to its level while the joint
    /// turns (N·m or N):
    ///
    /// ```text
    /// level sqrt(share / 3)   with `share` of the samples that tell near a turn
    /// ```
    fn near_rest(&self, j: usize) -> f64 {
        let joints = || self.design.runs.iter().map(|run| &run.joints[j]);
        let told = joints().flat_map(|joint| &joint.tells).filter(|t| **t).count();
        let slides = |joint: &JointDesign| {
            joint.tells.iter().zip(&joint.slides).filter(|(t, s)| **t && **s).count()
        };
        let sliding: usize = joints().map(slides).sum();
        let drive = &self.nominal.links()[j].actuator;
        let level = 0.5 * (drive.coulomb_forward + drive.coulomb_backward);
        let gain = drive.transmission_ratio * drive.torque_gain;
        (gain * level).abs() * ((told - sliding) as f64 / (3 * told.max(1)) as f64).sqrt()
    }

    /// Number of tones and limits of joint `j`.
    fn heard_at(&self, j: usize) -> usize {
        let tones = self.log.tones.iter().filter(|t| t.joint == j).count();
        tones + self.log.limits.iter().filter(|l| l.joint == j).count()
    }

    /// RMS of the effort of joint `j` where it tells (N·m or N).
    fn torque_rms(&self, j: usize) -> f64 {
        let efforts = self.design.runs.iter().map(|run| run.joints[j].measured.clone());
        rms(&self.told_of(&efforts.collect::<Vec<_>>(), j))
    }

    /// What a flexible predictor finds in what is left of joint `j`.
    fn structure(&self, answer: &Answer, left: &[Vec<f64>], j: usize) -> Structure {
        if !self.design.moved[j] {
            return Structure { share: 0.0, depends_on: Vec::new() };
        }
        let parts = (answer.by_run.blocks, answer.by_run.folds.as_slice());
        Probe::new(self.robot, self.design, parts, j).structure(left, self.settings.open_share)
    }

    /// What is left of joint `j`, `[run][sample]`, at the samples that tell of its effort.
    fn told_of(&self, left: &[Vec<f64>], j: usize) -> Vec<Vec<f64>> {
        let of_run = |(left, run): (&Vec<f64>, &RunDesign)| {
            run.joints[j].told(left.iter().copied()).collect()
        };
        left.iter().zip(&self.design.runs).map(of_run).collect()
    }

    fn data(&self, record: &Record, answer: &Answer) -> DataSummary {
        let samples: usize = self.design.runs.iter().map(|r| r.time.len()).sum();
        DataSummary {
            runs: Vec::new(),
            put_right: false,
            cutoff_hz: self.log.prepared.cutoff_hz,
            cutoff_reason: self.log.prepared.cutoff_reason.clone(),
            regression_rate_hz: self.design.rate_hz,
            block_s: samples as f64 / record.blocks.len() as f64 / self.design.rate_hz,
            blocks: record.blocks.len(),
            hypotheses: answer.hypotheses + answer.between.as_ref().map_or(0, |b| b.hypotheses),
        }
    }

    /// What is found by the search and by listening, the largest share first.
    fn findings(&self, answer: &Answer, least: &[f64]) -> Vec<Finding> {
        let heard = self.log.tones.iter().map(|tone| tone_finding(self.nominal, tone));
        let limited = self.log.limits.iter().map(|limit| limit_finding(self.nominal, limit));
        let between = answer.between.iter().flat_map(|b| b.found.clone());
        let found = answer.found.iter().filter(|f| matters(f, least)).map(|f| f.finding.clone());
        let mut findings: Vec<Finding> = found.chain(between).chain(heard).chain(limited).collect();
        findings.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
        findings
    }

    /// What is seen and does not matter.
    fn negligible(&self, answer: &Answer, least: &[f64]) -> Vec<Negligible> {
        let told = |found: &Found| {
            let size =
                |j: &usize| found.fall[*j].max(0.0).sqrt() / least[*j].max(f64::MIN_POSITIVE);
            let most = (0..least.len()).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            Some(Negligible {
                at: found.finding.at.clone(),
                most_at: self.robot.links()[most].joint.name.clone(),
                rms_nm: found.fall[most].max(0.0).sqrt(),
                least_nm: least[most],
            })
        };
        answer.found.iter().filter(|f| !matters(f, least)).filter_map(told).collect()
    }

    fn ruled_out(&self, answer: &Answer) -> Vec<RuledOut> {
        let between = answer.between.iter().flat_map(|b| &b.ruled_out);
        answer.ruled_out.iter().chain(between).cloned().collect()
    }
}

/// Whether a finding takes more off the held-out error of a joint than what does not matter there.
fn matters(found: &Found, least: &[f64]) -> bool {
    found.fall.iter().zip(least).any(|(fall, least)| *fall > least.powi(2))
}

/// Number of independent samples of noise in the band, were what is left noise: two a cut-off of 2.5.
fn independent(left: &[Vec<f64>]) -> f64 {
    left.iter().map(Vec::len).sum::<usize>() as f64 * 2.0 / REGRESSION_RATE
}

fn rms(left: &[Vec<f64>]) -> f64 {
    let (n, sum) = left.iter().flatten().fold((0_usize, 0.0), |(n, s), x| (n + 1, s + x * x));
    (sum / n.max(1) as f64).sqrt()
}

fn spectra(noise: &[(f64, f64)], left: &Spectrum) -> NoiseSpectrum {
    let (hz, noise_nm2_per_hz): (Vec<f64>, Vec<f64>) = noise.iter().copied().unzip();
    NoiseSpectrum { left_nm2_per_hz: left.densities(&hz), hz, noise_nm2_per_hz }
}

fn unexplained((joint, structure): &(JointReport, Structure)) -> Option<Unexplained> {
    let left = matches!(joint.verdict, Verdict::PartlyExplained | Verdict::Unexplained);
    left.then(|| {
        let ratio = joint.remaining_rms_nm / joint.residual_rms_nm.max(f64::MIN_POSITIVE);
        Unexplained {
            joint: joint.name.clone(),
            share: (structure.share * ratio * ratio).min(1.0),
            depends_on: structure.depends_on.clone(),
        }
    })
}
