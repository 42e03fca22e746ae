use robot::Robot;

/// An impossible value in a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// Key of the value, inside the effect.
    pub key: &'static str,
    /// What was found and what was expected.
    pub found: String,
}

/// The index of a joint that a scenario names.
pub(crate) fn joint_of(robot: &Robot, name: &str) -> Result<usize, Mistake> {
    robot.joint_index(name).ok_or_else(|| {
        let names: Vec<&str> = robot.joint_names().collect();
        let hint = hint("joints", name, &names);
        let found = format!("no joint of robot {} is called {name}, {hint}", robot.name());
        Mistake { key: "joint", found }
    })
}

/// The bound that holds for the kind of a joint: of one that turns, or of one that slides.
pub(crate) fn by_kind(robot: &Robot, joint: usize, turning: f64, sliding: f64) -> f64 {
    let turns = robot.links().get(joint).is_none_or(|link| link.joint.kind.is_rotation());
    if turns { turning } else { sliding }
}

/// The index of a moving link that a scenario names.
pub(crate) fn link_of(robot: &Robot, name: &str) -> Result<usize, Mistake> {
    let links = robot.links();
    if let Some(index) = links.iter().position(|l| l.name == name) {
        return Ok(index);
    }
    let found = match links.iter().find(|l| l.merged.iter().any(|m| m == name)) {
        Some(link) => format!("{name} is fixed to {0}, {0} was expected", link.name),
        None => {
            let names: Vec<&str> = links.iter().map(|l| l.name.as_str()).collect();
            let hint = hint("moving links", name, &names);
            format!("no moving link of robot {} is called {name}, {hint}", robot.name())
        }
    };
    Err(Mistake { key: "link", found })
}

/// Suggests the nearest name, or lists all names.
fn hint(things: &str, name: &str, names: &[&str]) -> String {
    document::suggest(name, names.iter().copied()).map_or_else(
        || format!("its {things} are {}", names.join(", ")),
        |near| format!("did you mean {near}?"),
    )
}

/// Refuses a number outside of `low..=high`.
pub(crate) fn within(key: &'static str, value: f64, low: f64, high: f64) -> Result<(), Mistake> {
    if value.is_finite() && (low..=high).contains(&value) {
        return Ok(());
    }
    let found = format!("{value}, a number from {low} to {high} was expected");
    Err(Mistake { key, found })
}
