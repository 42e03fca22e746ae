use catalogue::{EffectKind, Parameter};
use effects::Location;

/// How a diagnosis finds an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HowFound {
    /// The method, in a few words.
    pub how: &'static str,
    /// The parameters that it finds.
    pub parameters: &'static [Parameter],
}

/// Whether and how a diagnosis finds an effect.
///
/// # Errors
///
/// The reason why no diagnosis finds the effect.
pub fn how_found(kind: EffectKind) -> Result<HowFound, &'static str> {
    let parameters = kind.entry().parameters;
    match kind {
        EffectKind::TorqueRipple => {
            Ok(HowFound { how: "as a line of the spectrum over position", parameters })
        }
        EffectKind::ExternalDisturbance => Ok(HowFound {
            how: "as a line of the spectrum over time",
            parameters: &parameters[..3],
        }),
        EffectKind::TorqueSaturation => {
            Ok(HowFound { how: "as effort beyond a limit that moves nothing", parameters })
        }
        _ => {
            let model = effects::model(kind)?;
            let how = if model.traits().location == Location::BeforeTheLink {
                "by its columns in a regression: of the effort, or of what two encoders differ by"
            } else {
                "by its columns in a regression"
            };
            Ok(HowFound { how, parameters: model.parameters() })
        }
    }
}
