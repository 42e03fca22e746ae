use rerun::blueprint::{Blueprint, BlueprintActivation, ContainerLike};
use rerun::external::re_log_types::{BlueprintActivationCommand, LogMsg, StoreKind};
use rerun::external::re_sdk_types::blueprint::archetypes::ContainerBlueprint;
use rerun::log::Chunk;
use rerun::{AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder};

use crate::error::{RecordingError, refusal};

/// Properties of views, which the library's views have no methods for in this version.
///
/// They are written at `<path of the view>/<name of the property>` beside the rest.
#[derive(Default)]
pub(crate) struct Properties {
    of_views: Vec<(EntityPath, Box<dyn AsComponents>)>,
    opened: Option<[String; 2]>,
}

impl Properties {
    /// Gives a view a property.
    pub fn set(
        &mut self,
        view: ContainerLike,
        name: &str,
        property: impl AsComponents + 'static,
    ) -> ContainerLike {
        if let ContainerLike::View(view) = &view {
            let path = view.blueprint_path().join(&EntityPath::from_single_string(name));
            self.of_views.push((path, Box::new(property)));
        }
        view
    }

    /// Opens the one of some tabs that has a name; the tabs have one too.
    pub fn open(&mut self, tabs: &str, tab: &str) {
        self.opened = Some([tabs, tab].map(str::to_owned));
    }

    /// Sends a layout with the properties of its views, and makes it the one that is shown.
    pub fn send(self, layout: &Blueprint, to: &RecordingStream) -> Result<(), RecordingError> {
        let activation = BlueprintActivation { make_active: true, make_default: true };
        let info = to.store_info().ok_or_else(|| refusal("it is turned off"))?;
        let draft = RecordingStreamBuilder::new(info.application_id().clone());
        let (draft, messages) = draft.memory().map_err(refusal)?;
        layout.send(&draft, activation).map_err(refusal)?;
        draft.flush_blocking().map_err(refusal)?;
        let of_layout = |m: &LogMsg| {
            let of_layout = m.store_id().kind() == StoreKind::Blueprint;
            of_layout && !matches!(m, LogMsg::BlueprintActivationCommand(_))
        };
        let mut layout: Vec<LogMsg> = messages.take().into_iter().filter(of_layout).collect();
        let id = layout.first().ok_or_else(|| refusal("the layout is empty"))?.store_id().clone();

        let more = RecordingStreamBuilder::from_store_id(&id).send_properties(false);
        let (more, messages) = more.memory().map_err(refusal)?;
        more.set_time_sequence("blueprint", 0);
        for (path, property) in &self.of_views {
            more.log(path.clone(), property.as_ref()).map_err(refusal)?;
        }
        let opened = self.opened.map(|names| names.map(|name| container(&layout, &name)));
        if let Some([Some(tabs), Some(tab)]) = opened {
            let active = ContainerBlueprint::update_fields().with_active_tab(tab.to_string());
            more.log(tabs, &active).map_err(refusal)?;
        }
        more.flush_blocking().map_err(refusal)?;
        let messages = messages.take().into_iter();
        layout.extend(messages.filter(|m| !matches!(m, LogMsg::SetStoreInfo(_))));
        let command =
            BlueprintActivationCommand { blueprint_id: id, make_active: true, make_default: true };
        to.send_blueprint(layout, command);
        Ok(())
    }
}

/// Where a layout has the container of a name: the library draws the paths and tells nobody.
fn container(layout: &[LogMsg], name: &str) -> Option<EntityPath> {
    let of = |message: &LogMsg| {
        let LogMsg::ArrowMsg(_, rows) = message else { return None };
        let chunk = Chunk::from_arrow_msg(rows).ok()?;
        let component = ContainerBlueprint::descriptor_display_name().component;
        let is_named = chunk.iter_slices::<String>(component).flatten().any(|n| n.as_str() == name);
        is_named.then(|| chunk.entity_path().clone())
    };
    layout.iter().find_map(of)
}

#[cfg(test)]
mod tests {
    use rerun::blueprint::{Tabs, Vertical};

    use super::*;

    #[test]
    fn the_tab_of_a_name_is_open() {
        let (stream, messages) = RecordingStreamBuilder::new("tabs").memory().unwrap();
        let tab = |name| ContainerLike::from(Vertical::new([]).with_name(name));
        let layout = Blueprint::new(Tabs::new(["elbow", "wrist"].map(tab)).with_name("joints"));
        let mut properties = Properties::default();
        properties.open("joints", "wrist");
        properties.send(&layout, &stream).unwrap();
        stream.flush_blocking().unwrap();
        let messages = messages.take();
        let wrist = container(&messages, "wrist").unwrap().to_string();
        let component = ContainerBlueprint::descriptor_active_tab().component;
        let active = messages.iter().filter_map(|message| {
            let LogMsg::ArrowMsg(_, rows) = message else { return None };
            let chunk = Chunk::from_arrow_msg(rows).unwrap();
            let of = chunk.iter_slices::<String>(component).flatten().next();
            of.map(|tab| (chunk.entity_path().clone(), tab.as_str().to_owned()))
        });
        let joints = container(&messages, "joints").unwrap();
        assert_eq!(active.collect::<Vec<_>>(), [(joints, wrist)]);
    }
}
