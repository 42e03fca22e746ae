/// Which folders the meshes of a URDF may lie in, packages apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MeshFolders {
    /// That of the URDF, and those in it.
    #[default]
    Below,
    /// All.
    Anywhere,
}
