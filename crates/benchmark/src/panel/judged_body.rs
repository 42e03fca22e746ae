use catalogue::EffectKind;
use diagnosis::{EffectAt, Estimate, Finding};
use experiment::{Size, stored};
use population::TrueCause;
use serde::{Deserialize, Serialize};

use crate::panel::place::place;

/// What a finding says of the body of a link, compared with the truth.
///
/// ```text
/// holds   95 per cent intervals of mass and centre of mass contain the true ones
/// true body of a link: that of its cause; else the described one, with the payload that it has
///   m = m0 + mp,   c = (m0 c0 + mp cp) / m
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JudgedBody {
    /// Mass of the body or payload that the finding states (kg): its weight among others.
    #[serde(deserialize_with = "stored::number")]
    pub mass: f64,
    /// Whether the intervals hold the truth.
    pub holds: bool,
}

/// Parameters of a body that are compared.
const COMPARED: [&str; 4] = ["mass", "com_x", "com_y", "com_z"];

impl JudgedBody {
    /// `None` for a finding that is not about a link, and for a payload where the body of the link itself differs:
    /// the sheet does not say from what.
    pub(super) fn new(finding: &Finding, causes: &[TrueCause]) -> Option<Self> {
        let estimates: Vec<&Estimate> =
            finding.parameters.iter().filter(|e| COMPARED.contains(&e.name)).collect();
        let mass = estimates.iter().find(|e| e.name == "mass")?.value.abs();
        let at_link = |kind: EffectKind| {
            let at = EffectAt { effect: kind, ..finding.at.clone() };
            causes.iter().find(|cause| place(cause) == at)
        };
        let holds = match (finding.at.effect, at_link(finding.at.effect)) {
            (EffectKind::InertialParameters | EffectKind::Payload, Some(cause)) => {
                let sizes = Size::all(&cause.truth, &finding.parameters);
                let compared = sizes.iter().filter(|size| COMPARED.contains(&size.name.as_str()));
                compared.filter_map(|size| size.estimate.as_ref()).all(|estimate| estimate.covers)
            }
            (EffectKind::InertialParameters, None) => {
                let payload = at_link(EffectKind::Payload);
                estimates
                    .iter()
                    .all(|e| contains(e.ci95, with_payload(e.name, &estimates, payload)))
            }
            (EffectKind::Payload, None) if at_link(EffectKind::InertialParameters).is_none() => {
                // Without a payload its centre of mass is nowhere.
                estimates.iter().filter(|e| e.name == "mass").all(|e| contains(e.ci95, e.nominal))
            }
            _ => return None,
        };
        Some(Self { mass: if mass.is_finite() { mass } else { 0.0 }, holds })
    }

    /// Its mass as a weight.
    pub fn weight(&self) -> f64 {
        if self.mass.is_finite() { self.mass } else { 0.0 }
    }
}

fn contains([low, high]: [f64; 2], value: f64) -> bool {
    (low..=high).contains(&value)
}

/// A parameter of the described body with the payload of its link.
fn with_payload(name: &str, estimates: &[&Estimate], payload: Option<&TrueCause>) -> f64 {
    let described =
        |name: &str| estimates.iter().find(|e| e.name == name).map_or(0.0, |e| e.nominal);
    let added = |name: &str| payload.and_then(|p| p.truth.parameters.get(name)).copied();
    let (mass, more) = (described("mass"), added("mass").unwrap_or(0.0));
    match name {
        "mass" => mass + more,
        _ if mass + more > 0.0 => {
            (mass * described(name) + more * added(name).unwrap_or(0.0)) / (mass + more)
        }
        _ => described(name),
    }
}
