use colours::Rgb;
use nalgebra::{Isometry3, Vector3};
use rerun::{EntityPath, LineStrips3D, RecordingStream, RecordingStreamResult, Transform3D};
use robot::{Looks, Visual};

use crate::colour::Paint;
use crate::entities::{part, time_column};
use crate::scene::{Arm, SceneRole};
use crate::skeleton::Skeleton;
use crate::{colour, shapes};

/// Parts of the reach: radius of the drawn path and of the ball at the tip.
const PATH: f64 = 0.002;
const BALL: f64 = 0.012;

/// Scale of an arm that is not shown; a scale of zero is no transform to the viewer.
const UNSEEN: f32 = 1e-6;

/// An arm in the picture and the poses that wait to be written.
#[derive(Debug)]
pub(crate) struct ArmTrack {
    /// Entity of every link below that of its parent.
    links: Vec<EntityPath>,
    /// The path that the tip leaves behind, where it is drawn.
    path: Option<EntityPath>,
    time_s: Vec<f64>,
    /// Per waiting row, the poses of all links; none where the arm is not shown.
    poses: Vec<Option<Vec<Isometry3<f64>>>>,
    is_shown: bool,
    /// Whether it was hidden at any time; before, no row says how large it is.
    was_hidden: bool,
    /// The tip since the last piece of the path, its end first.
    piece: Vec<[f32; 3]>,
}

impl ArmTrack {
    /// Draws the arm, which does not move yet.
    pub fn new(
        stream: &RecordingStream,
        arm: &Arm<'_>,
        skeleton: &Skeleton,
        looks: &Looks,
    ) -> RecordingStreamResult<Self> {
        let root = EntityPath::new(vec![part("world"), part("arms"), part(arm.name)]);
        let mut links: Vec<EntityPath> = vec![];
        for (name, parent) in skeleton.links.iter().zip(&skeleton.parents) {
            links
                .push(parent.map_or(&root, |p| &links[p]).join(&EntityPath::new(vec![part(name)])));
        }
        let base = Isometry3::from_parts(Default::default(), skeleton.world_from_base);
        stream.log_static(root.clone(), &shapes::pose(&base))?;
        let brush = Brush { stream, skeleton, role: arm.role };
        for (i, link) in links.iter().enumerate() {
            let visuals = looks.links.get(i).map_or(&[][..], Vec::as_slice);
            brush.link(link, visuals, &skeleton.joints_on(Some(i)))?;
        }
        if arm.role == SceneRole::Actual {
            brush.base(&root, &looks.base)?;
        }
        let path = matches!(arm.role, SceneRole::Actual | SceneRole::Desired)
            .then(|| EntityPath::new(vec![part("world"), part("paths"), part(arm.name)]));
        if let Some(path) = &path {
            let line = LineStrips3D::update_fields()
                .with_colors([colour::solid(colour::rgb(arm.role))])
                .with_radii([(PATH * skeleton.reach_m) as f32]);
            stream.log_static(path.clone(), &line)?;
        }
        if let Some(last) = links.get(skeleton.last) {
            let paint = Paint::solid(colour::rgb(arm.role));
            let radius_m = BALL * skeleton.reach_m;
            shapes::ball(stream, &below(last, "tip"), &skeleton.tip_in_last, radius_m, paint)?;
        }
        Ok(Self {
            links,
            path,
            time_s: vec![],
            poses: vec![],
            is_shown: true,
            was_hidden: false,
            piece: vec![],
        })
    }

    /// Takes the pose at `q`; where it is not known the arm is not shown and its path is
    /// interrupted.
    pub fn push(
        &mut self,
        stream: &RecordingStream,
        time_s: f64,
        q: &[f64],
        skeleton: &Skeleton,
    ) -> RecordingStreamResult<()> {
        if !q.iter().all(|q| q.is_finite()) {
            self.flush_path(stream)?;
            self.piece.clear();
            self.was_hidden = true;
            if std::mem::replace(&mut self.is_shown, false) {
                self.time_s.push(time_s);
                self.poses.push(None);
            }
            return Ok(());
        }
        self.is_shown = true;
        let poses = skeleton.parent_from_child(q);
        if self.path.is_some() {
            self.piece.push(shapes::point(&skeleton.tip_in_world(&poses)));
        }
        self.time_s.push(time_s);
        self.poses.push(Some(poses));
        Ok(())
    }

    /// Writes what waits.
    pub fn flush(&mut self, stream: &RecordingStream) -> RecordingStreamResult<()> {
        self.flush_path(stream)?;
        for (i, link) in self.links.iter().enumerate() {
            let of_link = || self.poses.iter().map(move |row| row.as_ref().map(|poses| &poses[i]));
            let pose = |p: Option<&Isometry3<f64>>| p.copied().unwrap_or_default();
            // All parts in every row: the viewer does not join a static one with a moving one.
            let place = |p| shapes::point(&pose(p).translation.vector);
            let mut rows = Transform3D::update_fields()
                .with_many_translation(of_link().map(place))
                .with_many_quaternion(of_link().map(|p| shapes::quaternion(&pose(p).rotation)));
            if self.was_hidden {
                let scale = |p: Option<_>| [if p.is_some() { 1.0 } else { UNSEEN }; 3];
                rows = rows.with_many_scale(of_link().map(scale));
            }
            if !self.time_s.is_empty() {
                let columns = rows.columns_of_unit_batches()?;
                stream.send_columns(link.clone(), [time_column(&self.time_s)], columns)?;
            }
        }
        self.time_s.clear();
        self.poses.clear();
        Ok(())
    }

    /// Writes one more piece of the path; the next one starts where it ends.
    fn flush_path(&mut self, stream: &RecordingStream) -> RecordingStreamResult<()> {
        let (Some(path), Some(&end), Some(&time_s)) =
            (&self.path, self.piece.last(), self.time_s.last())
        else {
            return Ok(());
        };
        if self.piece.len() > 1 {
            let piece = std::mem::replace(&mut self.piece, vec![end]);
            let columns =
                LineStrips3D::update_fields().with_strips([piece]).columns_of_unit_batches()?;
            stream.send_columns(path.clone(), [time_column(&[time_s])], columns)?;
        }
        Ok(())
    }
}

/// Draws the links of one arm.
struct Brush<'a> {
    stream: &'a RecordingStream,
    skeleton: &'a Skeleton,
    role: SceneRole,
}

impl Brush<'_> {
    /// The shapes of a link; without any, sticks to the joints on it.
    fn link(
        &self,
        path: &EntityPath,
        visuals: &[Visual],
        joints: &[Vector3<f64>],
    ) -> RecordingStreamResult<()> {
        let own = colour::rgb(self.role);
        if self.shapes(path, visuals, own)? {
            return Ok(());
        }
        let (radius_m, paint) = (self.skeleton.stick_m(), Paint::on_arm(own, self.role));
        let hub = below(path, "joint");
        shapes::ball(self.stream, &hub, &Vector3::zeros(), 1.4 * radius_m, paint)?;
        let far = joints.iter().filter(|to| to.norm() > self.skeleton.stick_m());
        for (i, to) in far.enumerate() {
            let ends = [Vector3::zeros(), *to];
            shapes::stick(self.stream, &below(path, &format!("stick{i}")), ends, radius_m, paint)?;
        }
        Ok(())
    }

    fn base(&self, root: &EntityPath, visuals: &[Visual]) -> RecordingStreamResult<()> {
        let path = below(root, "base");
        if self.shapes(&path, visuals, colour::BASE)? {
            return Ok(());
        }
        let (radius_m, paint) = (self.skeleton.stick_m(), Paint::solid(colour::BASE));
        for (i, to) in self.skeleton.joints_on(None).into_iter().enumerate() {
            let ends = [Vector3::zeros(), to];
            shapes::stick(self.stream, &below(&path, &format!("stick{i}")), ends, radius_m, paint)?;
        }
        Ok(())
    }

    /// Whether there was something to draw.
    fn shapes(
        &self,
        path: &EntityPath,
        visuals: &[Visual],
        own: Rgb,
    ) -> RecordingStreamResult<bool> {
        let mut drawn = false;
        for (i, visual) in visuals.iter().enumerate() {
            let given = visual.color_rgba.filter(|_| self.role == SceneRole::Actual);
            let rgb = given.map_or(own, |[r, g, b, _]| Rgb([r, g, b].map(|c| (255.0 * c) as u8)));
            let paint = Paint::on_arm(rgb, self.role);
            drawn |= shapes::draw(self.stream, &below(path, &format!("shape{i}")), visual, paint)?;
        }
        Ok(drawn)
    }
}

fn below(path: &EntityPath, name: &str) -> EntityPath {
    path.join(&EntityPath::new(vec![part("shapes"), part(name)]))
}
