use std::io::{Cursor, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::error::LogError;
use crate::writing::write::replace_file;

/// Bytes before the text of a header of NPY 1.0: magic, version, length.
const PREFIX: usize = 10;

/// Writes columns as npz of NumPy: one array of `float64` a column, under its name, uncompressed. The bytes follow from
/// the columns alone: entries have the earliest time that zip knows.
///
/// # Errors
///
/// [`LogError::Unwritable`].
pub fn write_npz<N: AsRef<str>, C: AsRef<[f64]>>(
    path: &Path,
    columns: &[(N, C)],
) -> Result<(), LogError> {
    replace_file(path, |file| {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default());
        for (name, column) in columns {
            let column = column.as_ref();
            archive.start_file(format!("{}.npy", name.as_ref()), options)?;
            let bytes: Vec<u8> = column.iter().flat_map(|x| x.to_le_bytes()).collect();
            archive.write_all(&header(column.len()))?;
            archive.write_all(&bytes)?;
        }
        Ok(file.write_all(archive.finish()?.get_ref())?)
    })
}

/// The header of a vector of `float64`, padded to a multiple of 64 bytes (NumPy, NEP 1).
fn header(length: usize) -> Vec<u8> {
    let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({length},), }}");
    // With the line break at the end.
    let padded = (PREFIX + text.len() + 1).next_multiple_of(64) - PREFIX;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(padded).unwrap_or(u16::MAX).to_le_bytes());
    bytes.extend(format!("{text:<width$}\n", width = padded - 1).into_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ReadOptions;
    use robot::Robot;

    #[test]
    fn what_is_written_as_npz_is_read_back_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log.npz");
        let columns = [
            ("time", vec![0.0, 0.1, 0.2]),
            ("a.position", vec![1.0 / 3.0, -0.0, 5e-324]),
            ("a.effort", vec![1e300, 2.0, -3.5]),
        ];
        write_npz(&path, &columns).unwrap();
        let urdf = r#"<robot name="arm"><link name="base"/>
            <link name="upper"><inertial><mass value="2"/>
            <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
            <joint name="a" type="revolute"><parent link="base"/><child link="upper"/>
            <axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="3" effort="50"/></joint></robot>"#;
        let run = crate::read_run(&path, &Robot::from_urdf(urdf).unwrap(), &ReadOptions::default());
        let run = run.unwrap();
        let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&run.time), bits(&columns[0].1));
        assert_eq!(bits(&run.joints[0].position), bits(&columns[1].1));
        assert_eq!(bits(&run.joints[0].effort), bits(&columns[2].1));
        let first = std::fs::read(&path).unwrap();
        write_npz(&path, &columns).unwrap();
        assert!(first == std::fs::read(&path).unwrap());
    }
}
