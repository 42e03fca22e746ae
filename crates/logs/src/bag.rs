use std::{
    collections::{BTreeMap, BTreeSet},
    fs::{self, File},
    path::{Path, PathBuf},
};

use crate::{
    LogError,
    damage::Damage,
    joint_state::{JointState, TYPE},
    joint_states::JointStates,
    kind::NO_BAG_FILE,
    mcap_file, sqlite_file,
    table::{Needed, Table},
    topic::{Listener, Topic},
};

/// The topic that is read where no other one is asked for.
const USUAL_TOPIC: &str = "/joint_states";
/// What stands in a folder that is a bag.
const DESCRIPTION: &str = "metadata.yaml";
/// How files of a bag end, those that are packed have more behind it.
const ENDINGS: [&str; 2] = [".mcap", ".db3"];
/// How files of a database end that are no database.
const BESIDE: [&str; 3] = ["-wal", "-shm", "-journal"];

/// How the messages of a bag are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Storage {
    Mcap,
    Sqlite,
}

/// The joint states of a bag of ROS 2.
pub(crate) struct Bag {
    path: PathBuf,
    topic: String,
    states: JointStates,
}

impl Bag {
    /// Reads the joint states of a topic from files, one after the other.
    pub(crate) fn open(
        path: &Path,
        files: &[(PathBuf, Storage, File)],
        topic: Option<&str>,
        damage: &mut Damage,
    ) -> Result<Self, LogError> {
        let (states, others) = (BTreeMap::new(), BTreeSet::new());
        let mut collected = Collected { path, topic, states, others };
        for (path, storage, file) in files {
            match storage {
                Storage::Mcap => mcap_file::read(path, file, &mut collected, damage)?,
                Storage::Sqlite => sqlite_file::read(path, file, &mut collected, damage)?,
            }
        }
        collected.choose()
    }

    /// Names of the columns.
    pub(crate) fn names(&self) -> &[String] {
        self.states.names()
    }

    /// Columns by name. A message that holds none of those that are needed is left out.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, LogError> {
        self.states.load(needed).map_err(|(message, column)| LogError::NotInMessage {
            path: self.path.clone(),
            topic: self.topic.clone(),
            message,
            column: self.names().get(column).cloned().unwrap_or_default(),
        })
    }
}

/// What was heard of a bag.
struct Collected<'a> {
    path: &'a Path,
    topic: Option<&'a str>,
    /// By their topic.
    states: BTreeMap<String, JointStates>,
    /// Topics of other types, with their type.
    others: BTreeSet<String>,
}

impl Collected<'_> {
    fn is_wanted(&self, topic: &Topic) -> bool {
        let is_asked_for = self.topic.is_none_or(|asked| asked == topic.name);
        topic.kind == TYPE && topic.encoding == "cdr" && is_asked_for
    }

    /// The joint states that are read.
    fn choose(mut self) -> Result<Bag, LogError> {
        let path = self.path.to_owned();
        let wanted = self.topic.unwrap_or(USUAL_TOPIC);
        if let Some(states) = self.states.remove(wanted) {
            return Ok(Bag { path, topic: wanted.to_owned(), states });
        }
        let found: Vec<String> = self.states.keys().cloned().collect();
        match self.states.pop_first() {
            Some((topic, states)) if self.states.is_empty() => Ok(Bag { path, topic, states }),
            Some(_) => Err(LogError::SeveralTopics { path, found }),
            None => Err(LogError::NoTopic {
                path,
                topic: self.topic.map(str::to_owned),
                found: self.others.into_iter().collect(),
            }),
        }
    }
}

impl Listener for Collected<'_> {
    fn topic(&mut self, topic: &Topic) {
        if self.is_wanted(topic) {
            self.states.entry(topic.name.clone()).or_insert_with(JointStates::new);
        } else {
            let named = format!("{} ({}, {})", topic.name, topic.kind, topic.encoding);
            self.others.insert(named.replace(char::is_control, "?"));
        }
    }

    fn wants(&self, topic: &Topic) -> bool {
        self.is_wanted(topic)
    }

    fn message(&mut self, topic: &Topic, message: &[u8]) -> Result<(), LogError> {
        let states = self.states.entry(topic.name.clone()).or_insert_with(JointStates::new);
        let result = JointState::decode(message).and_then(|state| states.push(state));
        result.map_err(|reason| LogError::BadMessage {
            path: self.path.to_owned(),
            topic: topic.name.replace(char::is_control, "?"),
            message: states.count() + 1,
            reason,
        })
    }
}

/// The files of the folder of a bag, in their order.
pub(crate) fn files_of(path: &Path) -> Result<Vec<PathBuf>, LogError> {
    if !path.join(DESCRIPTION).is_file() {
        return Err(LogError::NotAFile { path: path.to_owned(), found: "a directory" });
    }
    let unreadable = |e: std::io::Error| LogError::unreadable(path, &e);
    let mut files = Vec::new();
    for entry in fs::read_dir(path).map_err(unreadable)? {
        let name = entry.map_err(unreadable)?.file_name().to_string_lossy().into_owned();
        let is_beside = BESIDE.iter().any(|end| name.ends_with(end));
        if !is_beside && ENDINGS.iter().any(|ending| name.contains(ending)) {
            files.push(name);
        }
    }
    if files.is_empty() {
        return Err(LogError::other_kind(path, NO_BAG_FILE));
    }
    files.sort_by_key(|name| (number_of(name), name.clone()));
    Ok(files.iter().map(|name| path.join(name)).collect())
}

/// The number behind the last `_` of a name: files of a bag are counted so.
fn number_of(name: &str) -> u64 {
    let end = ENDINGS.iter().find_map(|ending| name.find(ending)).unwrap_or(name.len());
    let stem = &name[..end];
    stem.rsplit('_').next().and_then(|number| number.parse().ok()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_in_the_order_of_their_numbers() {
        let mut names = ["arm_10.mcap", "arm_2.mcap.zstd", "arm_0.mcap"];
        names.sort_by_key(|name| number_of(name));
        assert_eq!(names, ["arm_0.mcap", "arm_2.mcap.zstd", "arm_10.mcap"]);
        assert_eq!([number_of("bag.mcap"), number_of("bag_3.db3")], [0, 3]);
    }
}
