/// Folders in which meshes outside packages may lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MeshFolders {
    /// The folder of the URDF and its subfolders.
    #[default]
    Below,
    /// Any folder.
    Anywhere,
}
