use crate::columns::run_design::RunDesign;
use crate::outcome::finding_builder::FindingWithFall;
use crate::outcome::limit_finding::limit_finding;
use crate::outcome::spectrum::Spectrum;
use crate::outcome::structure::{Probe, Structure};
use crate::outcome::tested_findings::TestedFindings;
use crate::outcome::tone_finding::tone_finding;
use crate::outcome::torque_noise::TorqueNoise;
use crate::outcome::verdict::{Situation, hides_friction, overall};
use crate::readiness::extent::range;
use crate::regression::noise::integrated_time;
use crate::result::{
    DataSummary, Diagnosis, Finding, Gain, JointReport, Negligible, NoiseSpectrum, RuledOut,
    SCHEMA, Unexplained, Verdict,
};
use crate::search::dataset::Dataset;
use crate::search::friction_error::friction_level;
use crate::search::inputs::Inputs;
use crate::signals::along::REGRESSION_RATE;
use crate::signals::tone::Tone;

impl Inputs<'_> {
    /// Assembles the diagnosis; the caller fills `data.runs` and `warnings`.
    pub fn assemble(&self, dataset: &Dataset, tested: &TestedFindings) -> Diagnosis {
        let t = self.thresholds();
        let noise = TorqueNoise::new(self.nominal, self.design, self.log.prepared, &t.signals);
        let least = dataset.practical;
        let joint = |j: usize| self.joint(tested, &noise, least, j);
        let reports: Vec<(JointReport, Structure)> = (0..self.design.joints()).map(joint).collect();
        let unexplained = reports.iter().filter_map(find_unexplained).collect();
        let joints: Vec<JointReport> = reports.into_iter().map(|(j, _)| j).collect();
        let hides = |((joint, unseen), inadequate): &((&JointReport, &f64), &Option<String>)| {
            joint.verdict == Verdict::DataInadequate
                && inadequate.is_none()
                && hides_friction(**unseen, joint.torque_rms_nm, &t.verdict)
        };
        let each = joints.iter().zip(&tested.unseen_friction).zip(self.inadequate);
        let hiding = each.filter(hides).count();
        Diagnosis {
            schema: SCHEMA,
            robot: self.robot.name().to_owned(),
            verdict: overall(&joints.iter().map(|j| j.verdict).collect::<Vec<_>>(), hiding),
            joints,
            findings: self.all_findings(tested, least),
            negligible: self.negligible(tested, least),
            unexplained,
            also_fitted: tested.also_fitted.clone(),
            ruled_out: self.ruled_out_causes(tested),
            gain: Gain { inverse: tested.gain.inverse.clone() },
            data: self.data(dataset, tested),
            warnings: Vec::new(),
        }
    }

    fn joint(
        &self,
        tested: &TestedFindings,
        noise: &TorqueNoise,
        least: &[f64],
        j: usize,
    ) -> (JointReport, Structure) {
        let oscillations = self.oscillations_at(j);
        // Causes of a search without some blocks do not count where the search over all blocks has none at the joint.
        let is_named = oscillations > 0 || tested.found.iter().any(|f| f.fall[j].abs() > 0.0);
        let left = if is_named { &tested.left[j] } else { &tested.gap[j] };
        let (gap, rest) =
            (self.informative_part(&tested.gap[j], j), self.informative_part(left, j));
        let structure = self.structure(tested, left, j);
        let spectrum = Spectrum::of(left, self.design.rate_hz);
        let effective_findings = || tested.found.iter().filter(|f| f.fall[j] > least[j].powi(2));
        let name = &self.robot.links()[j].joint.name;
        let is_own = |f: &&FindingWithFall| f.finding.at.joint.as_ref() == Some(name);
        let situation = Situation {
            inadequate: self.inadequate[j].clone(),
            findings: effective_findings().count() + oscillations,
            tones: oscillations,
            own: effective_findings().filter(is_own).count() + oscillations,
            between_encoders: tested.second_encoder.as_ref().map_or(0, |found| found.at(name)),
            unseen: tested.unseen_friction[j],
            torque_rms: self.torque_rms(j),
            nominal_rms: rms(&gap),
            remaining_rms: rms(&rest),
            samples: independent(&rest),
            noise: noise.rms(j),
            source: self.nominal.links()[j].actuator.torque_source,
            friction: self
                .friction_error(j)
                .of_at_most(friction_level(&tested.extended.links()[j].actuator)),
            sliding_rms: rms(&self.sliding_part(left, j)),
            keeps_nominal: tested.kept_nominal.has_dropped_at(self.design, j),
            practical: self.settings.open_share,
            structure: structure.share,
            above_hz: spectrum.above_hz(self.thresholds().verdict.mostly_above),
            motion_hz: self.log.prepared.motion_hz,
            thresholds: &self.thresholds().verdict,
        };
        let spectra = spectra(noise.spectrum(j), &spectrum);
        let report = self.joint_report(&situation, (spectra, &rest), j);
        (report, Structure { share: situation.unexplained_share(), ..structure })
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
            is_lost_in_noise: situation.is_drowned(),
            spectrum,
            autocorrelation_time_s: time / self.design.rate_hz,
            effective_samples: rest.iter().map(Vec::len).sum::<usize>() as f64 / time,
            range: range(self.log.prepared, j),
        }
    }

    /// Number of tones and limits of joint `j`.
    fn oscillations_at(&self, j: usize) -> usize {
        let tones = self.log.tones.iter().filter(|t| t.joint == j).count();
        tones + self.log.limits.iter().filter(|l| l.joint == j).count()
    }

    /// RMS of the informative samples of the effort of joint `j` (N·m or N).
    fn torque_rms(&self, j: usize) -> f64 {
        let efforts = self.design.runs.iter().map(|run| run.joints[j].measured.clone());
        rms(&self.informative_part(&efforts.collect::<Vec<_>>(), j))
    }

    /// Structure in the residual of joint `j`.
    fn structure(&self, tested: &TestedFindings, left: &[Vec<f64>], j: usize) -> Structure {
        if !self.design.moved[j] {
            return Structure { share: 0.0, depends_on: Vec::new() };
        }
        let parts = (tested.by_run.blocks, tested.by_run.folds.as_slice());
        Probe::new(self.robot, self.design, parts, j).structure(left, self.settings.open_share)
    }

    /// The informative samples of a residual of joint `j`, `[run][sample]`.
    fn informative_part(&self, left: &[Vec<f64>], j: usize) -> Vec<Vec<f64>> {
        let of_run = |(left, run): (&Vec<f64>, &RunDesign)| {
            run.joints[j].informative(left.iter().copied()).collect()
        };
        left.iter().zip(&self.design.runs).map(of_run).collect()
    }

    /// The samples of a residual in which joint `j` slides, `[run][sample]`.
    fn sliding_part(&self, left: &[Vec<f64>], j: usize) -> Vec<Vec<f64>> {
        let of_run = |(left, run): (&Vec<f64>, &RunDesign)| run.joints[j].sliding(left).collect();
        left.iter().zip(&self.design.runs).map(of_run).collect()
    }

    fn data(&self, dataset: &Dataset, tested: &TestedFindings) -> DataSummary {
        let samples: usize = self.design.runs.iter().map(|r| r.time.len()).sum();
        DataSummary {
            runs: Vec::new(),
            put_right: false,
            cutoff_hz: self.log.prepared.cutoff_hz,
            cutoff_reason: self.log.prepared.cutoff_reason.clone(),
            regression_rate_hz: self.design.rate_hz,
            block_s: samples as f64 / dataset.blocks.len() as f64 / self.design.rate_hz,
            blocks: dataset.blocks.len(),
            hypotheses: tested.hypotheses
                + tested.second_encoder.as_ref().map_or(0, |found| found.hypotheses),
        }
    }

    /// Findings of the search and of second encoders, tones and limits, the largest share first.
    fn all_findings(&self, tested: &TestedFindings, least: &[f64]) -> Vec<Finding> {
        let common_phase = self.thresholds().tones.common_phase;
        let tone = |tone: &Tone| tone_finding(self.nominal, tone, common_phase);
        let tones = self.log.tones.iter().map(tone);
        let limits = self.log.limits.iter().map(|limit| limit_finding(self.nominal, limit));
        let between = tested.second_encoder.iter().flat_map(|of| of.found.clone());
        let found = tested.found.iter().filter(|f| matters(f, least)).map(|f| f.finding.clone());
        let mut findings: Vec<Finding> = found.chain(between).chain(tones).chain(limits).collect();
        findings.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
        findings
    }

    /// Findings that are too small to matter.
    fn negligible(&self, tested: &TestedFindings, least: &[f64]) -> Vec<Negligible> {
        let negligible = |found: &FindingWithFall| {
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
        tested.found.iter().filter(|f| !matters(f, least)).filter_map(negligible).collect()
    }

    fn ruled_out_causes(&self, tested: &TestedFindings) -> Vec<RuledOut> {
        let between = tested.second_encoder.iter().flat_map(|of| &of.ruled_out);
        tested.ruled_out.iter().chain(between).cloned().collect()
    }
}

/// Whether a finding lowers the held-out error of its joints, and that of some joint by more than the practical share there.
fn matters(found: &FindingWithFall, least: &[f64]) -> bool {
    let is_large = |(fall, least): (&f64, &f64)| *fall > least.powi(2);
    found.finding.held_out_gain > 0.0 && found.fall.iter().zip(least).any(is_large)
}

/// Number of independent samples in the band if the residual were noise: two per 2.5 samples.
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

fn find_unexplained((joint, structure): &(JointReport, Structure)) -> Option<Unexplained> {
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
