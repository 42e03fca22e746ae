use std::{
    collections::{BTreeMap, BTreeSet},
    fs::File,
    path::{Path, PathBuf},
};

use crate::{
    common::{
        bounds::{MOST_ENTRIES, too_many_rows},
        damage::Damage,
        error::FormatError,
        sha256::sha256_of_files,
        table::{Needed, RowRefusal, Table},
    },
    file_format::{FileFormat, Magic, Opened, Request},
    formats::bag::{
        folder_files::files_of,
        joint_states::JointStates,
        message_kind::{self, MessageKind},
        storage::Storage,
        topic::{Message, MessageSink, Topic},
    },
};

/// The topic that is read by default.
const USUAL_TOPIC: &str = "/joint_states";
/// The joint states of a ROS 2 bag.
pub(crate) struct Bag {
    path: PathBuf,
    topic: String,
    states: JointStates,
}

impl Bag {
    /// Reads the joint states of a topic from several files in sequence. Where the files have none of the usual kind,
    /// they are read again for the others.
    pub(crate) fn open(
        path: &Path,
        files: &[(PathBuf, Storage, File)],
        topic: Option<&str>,
        damage: &mut Damage,
    ) -> Result<Self, FormatError> {
        let mut read = |kinds| {
            let (by_topic, others) = (BTreeMap::new(), BTreeSet::new());
            let mut states = TopicStates { path, topic, kinds, by_topic, others };
            for (path, storage, file) in files {
                (storage.read)(path, file, &mut states, damage)?;
            }
            Ok(states)
        };
        let states: TopicStates = read(message_kind::USUAL)?;
        match states.by_topic.is_empty() {
            true => read(message_kind::OTHERS)?.choose(),
            false => states.choose(),
        }
    }
}

impl Opened for Bag {
    fn names(&self) -> Result<Vec<String>, FormatError> {
        Ok(self.states.names().to_vec())
    }

    /// A message without any of the needed columns is left out.
    fn load(&self, needed: &Needed, _: &mut Damage) -> Result<Table, FormatError> {
        self.states.load(needed).map_err(|(message, refusal)| match refusal {
            RowRefusal::NoNumber(column) => FormatError::NotInMessage {
                path: self.path.clone(),
                topic: self.topic.clone(),
                message,
                column: self.states.names().get(column).cloned().unwrap_or_default(),
            },
            RowRefusal::TooMany => too_many_rows(&self.path, self.states.names().len()),
        })
    }

    fn sha256(&self) -> Result<String, FormatError> {
        if self.path.is_dir() {
            return sha256_of_files(files_of(&self.path)?.iter().map(PathBuf::as_path));
        }
        sha256_of_files([self.path.as_path()])
    }
}

impl FileFormat for Storage {
    fn name(&self) -> &'static str {
        self.name
    }

    fn magic(&self) -> &'static [Magic] {
        self.magic
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        request: &Request,
        damage: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        let files = [(path.to_owned(), *self, file)];
        Ok(Box::new(Bag::open(path, &files, request.topic, damage)?))
    }
}

/// The joint states of each topic that may be read.
struct TopicStates<'a> {
    path: &'a Path,
    topic: Option<&'a str>,
    /// The kinds of message that are read.
    kinds: &'static [MessageKind],
    by_topic: BTreeMap<String, JointStates>,
    /// Topics of other types, with their type.
    others: BTreeSet<String>,
}

impl TopicStates<'_> {
    /// The kind of the messages of a topic that is to be read.
    fn kind_of(&self, topic: &Topic) -> Option<MessageKind> {
        let is_asked_for = self.topic.is_none_or(|asked| asked == topic.name);
        self.kinds.iter().find(|kind| is_asked_for && (kind.is_of)(topic)).copied()
    }

    /// Selects the joint states of one topic.
    fn choose(mut self) -> Result<Bag, FormatError> {
        let path = self.path.to_owned();
        let wanted = self.topic.unwrap_or(USUAL_TOPIC);
        if let Some(states) = self.by_topic.remove(wanted) {
            return Ok(Bag { path, topic: wanted.to_owned(), states });
        }
        let found: Vec<String> = self.by_topic.keys().cloned().collect();
        match self.by_topic.pop_first() {
            Some((topic, states)) if self.by_topic.is_empty() => Ok(Bag { path, topic, states }),
            Some(_) => Err(FormatError::SeveralTopics { path, found }),
            None => Err(FormatError::NoTopic {
                path,
                topic: self.topic.map(str::to_owned),
                found: self.others.into_iter().collect(),
            }),
        }
    }
}

impl MessageSink for TopicStates<'_> {
    fn add_topic(&mut self, topic: &Topic) -> Result<(), FormatError> {
        if self.kind_of(topic).is_some() {
            self.by_topic.entry(topic.name.clone()).or_insert_with(JointStates::new);
        } else {
            let named = format!("{} ({}, {})", topic.name, topic.kind, topic.encoding);
            self.others.insert(named.replace(char::is_control, "?"));
        }
        if self.by_topic.len() + self.others.len() > MOST_ENTRIES {
            let reason = format!("it has more than {MOST_ENTRIES} topics");
            return Err(FormatError::broken(self.path, "bag", &reason));
        }
        Ok(())
    }

    fn wants(&self, topic: &Topic) -> bool {
        self.kind_of(topic).is_some()
    }

    fn add_message(&mut self, topic: &Topic, message: &Message) -> Result<(), FormatError> {
        let Some(kind) = self.kind_of(topic) else { return Ok(()) };
        let states = self.by_topic.entry(topic.name.clone()).or_insert_with(JointStates::new);
        let result = (kind.decode)(message).and_then(|message| states.push(message));
        result.map_err(|reason| FormatError::BadMessage {
            path: self.path.to_owned(),
            topic: topic.name.replace(char::is_control, "?"),
            message: states.count() + 1,
            reason,
        })
    }
}
