use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use rerun::{
    Asset3D, Boxes3D, Capsules3D, Cylinders3D, Ellipsoids3D, EntityPath, Quaternion,
    RecordingStream, RecordingStreamResult, Transform3D,
};
use robot::{Shape, Visual};

use crate::colour::Paint;

/// Draws one shape on a link, at `path`; `false` when its file cannot be read.
pub(crate) fn draw(
    stream: &RecordingStream,
    path: &EntityPath,
    visual: &Visual,
    paint: Paint,
) -> RecordingStreamResult<bool> {
    let pose = &visual.link_from_shape;
    let (center, turn) = ([point(&pose.translation.vector)], [quaternion(&pose.rotation)]);
    let path = path.clone();
    match &visual.shape {
        Shape::Box { size_m } => stream.log_static(
            path,
            &Boxes3D::from_centers_and_sizes(center, [point(size_m)])
                .with_quaternions(turn)
                .with_colors([paint.color])
                .with_fill_mode(paint.fill),
        )?,
        Shape::Cylinder { radius_m, length_m } => stream.log_static(
            path,
            &Cylinders3D::from_lengths_and_radii([*length_m as f32], [*radius_m as f32])
                .with_centers(center)
                .with_quaternions(turn)
                .with_colors([paint.color])
                .with_fill_mode(paint.fill),
        )?,
        Shape::Sphere { radius_m } => stream.log_static(
            path,
            &Ellipsoids3D::from_centers_and_radii(center, [*radius_m as f32])
                .with_colors([paint.color])
                .with_fill_mode(paint.fill),
        )?,
        Shape::Capsule { radius_m, length_m } => {
            let half = Vector3::z() * (0.5 * length_m);
            let ends = [pose * Point3::from(-half), pose * Point3::from(half)];
            stick(stream, &path, [ends[0].coords, ends[1].coords], *radius_m, paint)?;
        }
        Shape::Mesh { file, scale } => {
            let Ok(mesh) = Asset3D::from_file_path(file) else { return Ok(false) };
            stream.log_static(path.clone(), &mesh.with_albedo_factor(paint.of_mesh().0))?;
            let place = Transform3D::from_translation_rotation_scale(
                center[0],
                turn[0],
                rerun::Scale3D::from(point(scale)),
            );
            stream.log_static(path, &place)?;
        }
        _ => return Ok(false),
    }
    Ok(true)
}

/// Draws a rod with round ends between two points of a link.
pub(crate) fn stick(
    stream: &RecordingStream,
    path: &EntityPath,
    ends: [Vector3<f64>; 2],
    radius_m: f64,
    paint: Paint,
) -> RecordingStreamResult<()> {
    let along = ends[1] - ends[0];
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    stream.log_static(
        path.clone(),
        &Capsules3D::from_lengths_and_radii([along.norm() as f32], [radius_m as f32])
            .with_translations([point(&ends[0])])
            .with_quaternions([quaternion(&turn)])
            .with_colors([paint.color])
            .with_fill_mode(paint.fill),
    )
}

/// Draws a ball about a point of a link.
pub(crate) fn ball(
    stream: &RecordingStream,
    path: &EntityPath,
    center: &Vector3<f64>,
    radius_m: f64,
    paint: Paint,
) -> RecordingStreamResult<()> {
    let ball = Ellipsoids3D::from_centers_and_radii([point(center)], [radius_m as f32]);
    stream.log_static(path.clone(), &ball.with_colors([paint.color]).with_fill_mode(paint.fill))
}

/// A pose as the viewer takes it.
pub(crate) fn pose(pose: &Isometry3<f64>) -> Transform3D {
    Transform3D::from_translation_rotation(
        point(&pose.translation.vector),
        quaternion(&pose.rotation),
    )
}

pub(crate) fn point(v: &Vector3<f64>) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

pub(crate) fn quaternion(rotation: &UnitQuaternion<f64>) -> Quaternion {
    let [x, y, z, w] = rotation.coords.map(|c| c as f32).into();
    Quaternion::from_xyzw([x, y, z, w])
}
