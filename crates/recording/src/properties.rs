use rerun::blueprint::{Blueprint, BlueprintActivation, ContainerLike};
use rerun::external::re_log_types::{BlueprintActivationCommand, LogMsg, StoreKind};
use rerun::{AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder};

use crate::RecordingError;
use crate::error::refused;

/// Properties of views, which the library's views have no methods for in this version.
///
/// They are written at `<path of the view>/<name of the property>` beside the rest.
#[derive(Default)]
pub(crate) struct Properties(Vec<(EntityPath, Box<dyn AsComponents>)>);

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
            self.0.push((path, Box::new(property)));
        }
        view
    }

    /// Sends a layout with the properties of its views, and makes it the one that is shown.
    pub fn send(self, layout: &Blueprint, to: &RecordingStream) -> Result<(), RecordingError> {
        let activation = BlueprintActivation { make_active: true, make_default: true };
        let info = to.store_info().ok_or_else(|| refused("it is turned off"))?;
        let draft = RecordingStreamBuilder::new(info.application_id().clone());
        let (draft, messages) = draft.memory().map_err(refused)?;
        layout.send(&draft, activation).map_err(refused)?;
        draft.flush_blocking().map_err(refused)?;
        let of_layout = |m: &LogMsg| {
            let of_layout = m.store_id().kind() == StoreKind::Blueprint;
            of_layout && !matches!(m, LogMsg::BlueprintActivationCommand(_))
        };
        let mut layout: Vec<LogMsg> = messages.take().into_iter().filter(of_layout).collect();
        let id = layout.first().ok_or_else(|| refused("the layout is empty"))?.store_id().clone();

        let more = RecordingStreamBuilder::from_store_id(&id).send_properties(false);
        let (more, messages) = more.memory().map_err(refused)?;
        more.set_time_sequence("blueprint", 0);
        for (path, property) in &self.0 {
            more.log(path.clone(), property.as_ref()).map_err(refused)?;
        }
        more.flush_blocking().map_err(refused)?;
        let messages = messages.take().into_iter();
        layout.extend(messages.filter(|m| !matches!(m, LogMsg::SetStoreInfo(_))));
        let command =
            BlueprintActivationCommand { blueprint_id: id, make_active: true, make_default: true };
        to.send_blueprint(layout, command);
        Ok(())
    }
}
