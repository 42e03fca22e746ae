use crate::model::{Dynamics, Workspace};
use crate::regressor::PARAMETERS_PER_LINK;

/// One column of a regressor: the parameter it multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RegressorColumn {
    /// Inertial parameter of a link, in the order of [`robot::Inertia::parameters`].
    Inertial {
        /// Index of the link.
        link: usize,
        /// Which of the ten parameters.
        parameter: usize,
    },
    /// Rotor inertia (kg m² or kg): `qdd`.
    Rotor {
        /// Index of the joint.
        joint: usize,
    },
    /// Viscous friction (N·m·s/rad or N·s/m): `qd`.
    Viscous {
        /// Index of the joint.
        joint: usize,
    },
    /// Coulomb friction (N·m or N): `sign(qd)`, 0 at rest.
    Coulomb {
        /// Index of the joint.
        joint: usize,
    },
    /// Torque offset (N·m or N): 1.
    Offset {
        /// Index of the joint.
        joint: usize,
    },
}

/// The families of columns that are added to the inertial ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ColumnSet {
    /// Rotor inertias.
    pub rotor: bool,
    /// Viscous friction.
    pub viscous: bool,
    /// Coulomb friction.
    pub coulomb: bool,
    /// Torque offsets.
    pub offset: bool,
}

impl ColumnSet {
    /// Inertial parameters only.
    pub const INERTIAL: Self = Self { rotor: false, viscous: false, coulomb: false, offset: false };
    /// Every family.
    pub const ALL: Self = Self { rotor: true, viscous: true, coulomb: true, offset: true };

    /// The families that appear among `columns`.
    pub fn of(columns: &[RegressorColumn]) -> Self {
        let any = |is: fn(&RegressorColumn) -> bool| columns.iter().any(is);
        Self {
            rotor: any(|c| matches!(c, RegressorColumn::Rotor { .. })),
            viscous: any(|c| matches!(c, RegressorColumn::Viscous { .. })),
            coulomb: any(|c| matches!(c, RegressorColumn::Coulomb { .. })),
            offset: any(|c| matches!(c, RegressorColumn::Offset { .. })),
        }
    }

    /// The columns for `joints` joints, in order: inertial link by link, then rotor,
    /// viscous, Coulomb and offset joint by joint.
    pub fn columns(self, joints: usize) -> Vec<RegressorColumn> {
        let inertial = (0..joints).flat_map(|link| {
            (0..PARAMETERS_PER_LINK)
                .map(move |parameter| RegressorColumn::Inertial { link, parameter })
        });
        let all = 0..joints;
        let rotor =
            all.clone().map(|joint| RegressorColumn::Rotor { joint }).filter(|_| self.rotor);
        let viscous =
            all.clone().map(|joint| RegressorColumn::Viscous { joint }).filter(|_| self.viscous);
        let coulomb =
            all.clone().map(|joint| RegressorColumn::Coulomb { joint }).filter(|_| self.coulomb);
        let offset = all.map(|joint| RegressorColumn::Offset { joint }).filter(|_| self.offset);
        inertial.chain(rotor).chain(viscous).chain(coulomb).chain(offset).collect()
    }
}

impl std::fmt::Display for RegressorColumn {
    /// Short name with 1-based numbers, as in the literature: `mx3`, `Izz7`, `Ia2`, `fv4`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const NAMES: [&str; PARAMETERS_PER_LINK] =
            ["m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz"];
        match *self {
            Self::Inertial { link, parameter } => {
                write!(f, "{}{}", NAMES.get(parameter).unwrap_or(&"?"), link + 1)
            }
            Self::Rotor { joint } => write!(f, "Ia{}", joint + 1),
            Self::Viscous { joint } => write!(f, "fv{}", joint + 1),
            Self::Coulomb { joint } => write!(f, "fc{}", joint + 1),
            Self::Offset { joint } => write!(f, "fo{}", joint + 1),
        }
    }
}

impl Dynamics {
    /// The regressor with the columns of `set`, row-major, n rows of
    /// `set.columns(n).len()` entries; allocates nothing. Signs and units as in
    /// [`Dynamics::torque_regressor`]: every column enters `tau` with a plus.
    ///
    /// # Panics
    ///
    /// When a slice has the wrong length or `ws` belongs to another robot.
    pub fn columns_into(
        &self,
        ws: &mut Workspace,
        [q, qd, qdd]: [&[f64]; 3],
        set: ColumnSet,
        y: &mut [f64],
    ) {
        let n = self.joint_count();
        let inertial = PARAMETERS_PER_LINK * n;
        let families = [set.rotor, set.viscous, set.coulomb, set.offset];
        let width = inertial + n * families.iter().filter(|&&included| included).count();
        assert_eq!(y.len(), n * width, "the rows have {width} entries each");
        let (compact, _) = y.split_at_mut(n * inertial);
        self.torque_regressor_into(ws, q, qd, qdd, compact);
        // Widen the rows in place, last row first.
        for i in (0..n).rev() {
            y.copy_within(i * inertial..(i + 1) * inertial, i * width);
            let drive = &mut y[i * width + inertial..(i + 1) * width];
            drive.fill(0.0);
            let sign = if qd[i] == 0.0 { 0.0 } else { qd[i].signum() };
            let values = families.into_iter().zip([qdd[i], qd[i], sign, 1.0]);
            for (family, (_, value)) in values.filter(|(included, _)| *included).enumerate() {
                drive[family * n + i] = value;
            }
        }
    }
}
