use crate::common::error::FormatError;

/// A topic of a bag.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Topic {
    pub name: String,
    /// Type of the messages.
    pub kind: String,
    /// Encoding of the messages.
    pub encoding: String,
}

/// A message of a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Message<'a> {
    /// The bytes in the topic's encoding.
    pub data: &'a [u8],
    /// Time at which it was recorded (ns), where the storage tells it.
    pub recorded_ns: Option<i64>,
}

/// Receives the topics and messages of a bag.
pub(crate) trait MessageSink {
    /// Receives a topic, before its messages.
    ///
    /// # Errors
    ///
    /// [`FormatError::Broken`] where there are more topics than a bag may have.
    fn add_topic(&mut self, topic: &Topic) -> Result<(), FormatError>;

    /// Whether the messages of a topic are wanted. Other messages may be skipped.
    fn wants(&self, topic: &Topic) -> bool;

    /// Receives a message.
    fn add_message(&mut self, topic: &Topic, message: &Message) -> Result<(), FormatError>;
}
