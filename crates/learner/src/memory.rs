use crate::error::LearnerError;

/// Share of the free memory that is left for other programs.
const SPARE: f64 = 0.1;

/// Refuses a training of exact processes that would not fit into the memory that is free now:
/// the inverse covariance of every joint, `n² / 2` numbers each, and as much again for the
/// one that is being made. Where the system does not tell what is free, nothing is refused.
pub(crate) fn check(points: usize, joints: usize) -> Result<(), LearnerError> {
    let Some(available) = available_bytes() else { return Ok(()) };
    fits(points, joints, available * (1.0 - SPARE))
}

fn fits(points: usize, joints: usize, available: f64) -> Result<(), LearnerError> {
    const GIGA: f64 = 1e9;
    let bytes_per_square = 4.0 * (joints as f64 + 1.0);
    let needed = bytes_per_square * (points as f64).powi(2);
    if needed <= available {
        return Ok(());
    }
    Err(LearnerError::Memory {
        points,
        needed_gb: needed / GIGA,
        available_gb: available / GIGA,
        fitting: (available / bytes_per_square).sqrt() as usize,
    })
}

/// Memory that can be taken without swapping (bytes), as Linux tells it.
pub fn available_bytes() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilo: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kilo)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_told_with_what_would() {
        assert!(fits(3000, 7, 1e9).is_ok());
        let refused = fits(100_000, 7, 20e9).unwrap_err();
        let LearnerError::Memory { needed_gb, fitting, .. } = refused else { panic!("{refused}") };
        assert!((needed_gb - 320.0).abs() < 1e-9);
        assert!(fits(fitting, 7, 20e9).is_ok() && fits(fitting + 2, 7, 20e9).is_err());
    }
}
