use std::path::{Path, PathBuf};

use document::{Document, KeyPath};
use motion::{Coefficients, MotionSpec};

use super::ScenarioSpec;

/// The scenario as TOML that says everything, extends nothing and can be read from any folder.
pub(super) fn resolved(document: &Document, spec: &ScenarioSpec) -> String {
    let mut spec = spec.clone();
    let folder = |path: &KeyPath| document.directory_of(path).to_owned();
    spec.robot = absolute(&folder(&KeyPath::root().key("robot")).join(&spec.robot));
    for (i, run) in spec.run.iter_mut().enumerate() {
        let path = KeyPath::root().key("run").index(i).key("motion");
        make_absolute(&mut run.motion, &folder(&path));
    }
    toml::to_string(&spec).unwrap_or_else(|_| document.to_toml())
}

fn make_absolute(motion: &mut MotionSpec, folder: &Path) {
    match motion {
        MotionSpec::Recorded(recorded) => {
            recorded.file = absolute(&folder.join(&recorded.file));
            recorded.map = recorded.map.as_ref().map(|map| absolute(&folder.join(map)));
        }
        MotionSpec::Fourier(fourier) => {
            if let Coefficients::File(file) = &mut fourier.coefficients {
                *file = absolute(&folder.join(&*file));
            }
        }
        MotionSpec::Sequence(motions) => {
            motions.iter_mut().for_each(|motion| make_absolute(motion, folder));
        }
        _ => {}
    }
}

fn absolute(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
