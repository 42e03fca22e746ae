use diagnosis::EffectAt;
use population::TrueCause;

/// The effect of a cause and its place.
pub(crate) fn place(cause: &TrueCause) -> EffectAt {
    let (joint, link) = (cause.truth.joint.clone(), cause.truth.link.clone());
    EffectAt { effect: cause.truth.effect, joint, link }
}
