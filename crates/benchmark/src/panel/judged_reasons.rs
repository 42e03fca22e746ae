use catalogue::EffectKind;
use diagnosis::{Diagnosis, EffectAt, RuledOut};
use serde::{Deserialize, Serialize};

/// Phrases of reasons that name another finding as the one that does the work of an effect.
const NAMES_A_FINDING: [&str; 2] = ["a finding", "other causes that do its work"];

/// The reasons for which a diagnosis rules effects out, tested against its own answer.
///
/// A reason contradicts the answer where the effect is a finding after all, or where it says that a finding does the
/// effect's work and none acts at its place.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct JudgedReasons {
    /// Number of effects that are ruled out with a reason.
    pub given: usize,
    /// The contradicting ones: effect, place and reason in words.
    pub contradicting: Vec<String>,
}

impl JudgedReasons {
    pub(super) fn new(diagnosis: &Diagnosis) -> Self {
        let named = diagnosis.findings.iter().map(|finding| &finding.at);
        let named: Vec<&EffectAt> =
            named.chain(diagnosis.negligible.iter().map(|small| &small.at)).collect();
        let contradicts = |ruled_out: &&RuledOut| {
            let cites = NAMES_A_FINDING.iter().any(|words| ruled_out.because.contains(words));
            diagnosis.findings.iter().any(|finding| finding.at == ruled_out.at)
                || cites && !named.iter().any(|at| acts_at(at, &ruled_out.at))
        };
        let words = |one: &RuledOut| format!("{}: {}", one.at.words(), one.because);
        Self {
            given: diagnosis.ruled_out.len(),
            contradicting: diagnosis.ruled_out.iter().filter(contradicts).map(words).collect(),
        }
    }
}

/// Whether a finding acts where another effect does. Effects of links and of the whole arm act at many joints, a
/// coupling at two of which its place names one.
fn acts_at(finding: &EffectAt, place: &EffectAt) -> bool {
    finding.joint.is_none()
        || place.joint.is_none()
        || finding.effect == EffectKind::DifferentialCoupling
        || place.effect == EffectKind::DifferentialCoupling
        || finding.joint == place.joint
}
