use crate::formats::bag::{
    controller_state, joint_message::JointMessage, joint_state, json_joint_state, topic::Message,
    topic::Topic,
};

/// A kind of message that tells the state of joints.
#[derive(Clone, Copy)]
pub(crate) struct MessageKind {
    /// Whether the messages of a topic are of this kind.
    pub is_of: fn(&Topic) -> bool,
    /// Decodes a message, or gives the reason why it cannot be read.
    pub decode: fn(&Message) -> Result<JointMessage, String>,
}

/// The kind that is read wherever a bag has it.
pub(crate) const USUAL: &[MessageKind] = &[JOINT_STATE];

/// The kinds that are read where a bag has none of the usual one.
pub(crate) const OTHERS: &[MessageKind] = &[CONTROLLER_STATE, JSON_JOINT_STATE];

const JOINT_STATE: MessageKind = MessageKind {
    is_of: |topic| topic.kind == joint_state::TYPE && topic.encoding == "cdr",
    decode: |message| joint_state::decode(message.data),
};

const CONTROLLER_STATE: MessageKind = MessageKind {
    is_of: |topic| topic.kind == controller_state::TYPE && topic.encoding == "cdr",
    decode: |message| controller_state::decode(message.data),
};

const JSON_JOINT_STATE: MessageKind = MessageKind {
    is_of: |topic| {
        topic.encoding == "json" && topic.kind.to_ascii_lowercase().contains("jointstate")
    },
    decode: json_joint_state::decode,
};
