use std::collections::{BTreeMap, BTreeSet};

use crate::error::RobotError;

/// Which joint hangs on which link; every link is reached from one root.
#[derive(Debug)]
pub(super) struct Tree {
    /// Index of the link that nothing carries.
    pub root: usize,
    /// Per link, the joints that leave it, in the order of the file.
    pub joints_of: Vec<Vec<usize>>,
    /// Per joint, the link it carries.
    pub child: Vec<usize>,
}

impl Tree {
    /// The tree of the links and joints of a file.
    ///
    /// # Errors
    ///
    /// [`RobotError::DuplicateName`], [`RobotError::UnknownName`],
    /// [`RobotError::TwoParents`], [`RobotError::SeveralRoots`], [`RobotError::Loop`].
    pub(super) fn new(
        links: &[urdf_rs::Link],
        joints: &[urdf_rs::Joint],
    ) -> Result<Self, RobotError> {
        unique("joint", joints.iter().map(|j| &j.name))?;
        unique("link", links.iter().map(|l| &l.name))?;
        let names: Vec<&str> = links.iter().map(|l| l.name.as_str()).collect();
        let index: BTreeMap<&str, usize> = names.iter().copied().zip(0..).collect();
        let find = |joint: &urdf_rs::Joint, name: &str| {
            let place = || format!("joint {}", joint.name);
            let found = index.get(name).copied();
            found.ok_or_else(|| RobotError::unknown_name(place(), "link", name, &names))
        };
        let mut tree = Self { root: 0, joints_of: vec![vec![]; links.len()], child: vec![] };
        let mut carried_by: Vec<Option<usize>> = vec![None; links.len()];
        for (i, joint) in joints.iter().enumerate() {
            let (parent, child) =
                (find(joint, &joint.parent.link)?, find(joint, &joint.child.link)?);
            if let Some(first) = carried_by[child].replace(i) {
                return Err(RobotError::TwoParents {
                    link: names[child].to_owned(),
                    first: joints[first].name.clone(),
                    second: joint.name.clone(),
                });
            }
            tree.joints_of[parent].push(i);
            tree.child.push(child);
        }
        let mut parent = vec![None; links.len()];
        for (from, joints) in tree.joints_of.iter().enumerate() {
            joints.iter().for_each(|&j| parent[tree.child[j]] = Some(from));
        }
        tree.root = root(&parent, &names)?;
        match tree.unreached_link() {
            Some(link) => Err(loop_error(&parent, link, &names)),
            None => Ok(tree),
        }
    }

    /// A link that the root does not reach.
    fn unreached_link(&self) -> Option<usize> {
        let mut reached = vec![false; self.joints_of.len()];
        let mut stack = vec![self.root];
        while let Some(link) = stack.pop() {
            reached[link] = true;
            stack.extend(self.joints_of[link].iter().map(|&j| self.child[j]));
        }
        reached.iter().position(|r| !r)
    }
}

/// The one link without a parent.
fn root(parent: &[Option<usize>], names: &[&str]) -> Result<usize, RobotError> {
    let mut roots = (0..names.len()).filter(|&l| parent[l].is_none());
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(root),
        (Some(first), Some(second)) => Err(RobotError::SeveralRoots {
            first: names[first].to_owned(),
            second: names[second].to_owned(),
        }),
        (None, _) if names.is_empty() => Err(RobotError::Malformed {
            line: 1,
            reason: "no <link> was found, at least one was expected".to_owned(),
        }),
        (None, _) => Err(loop_error(parent, 0, names)),
    }
}

/// The loop that `link`, or one of its ancestors, is part of, by its first link in the file.
fn loop_error(parent: &[Option<usize>], link: usize, names: &[&str]) -> RobotError {
    let up = |at: usize| parent[at].unwrap_or(at);
    // As many steps up as there are links end inside the ring, not on a branch of it.
    let inside = (0..parent.len()).fold(link, |at, _| up(at));
    let (mut first, mut at) = (inside, up(inside));
    while at != inside {
        (first, at) = (first.min(at), up(at));
    }
    RobotError::Loop { link: names[first].to_owned() }
}

fn unique<'a>(
    what: &'static str,
    names: impl Iterator<Item = &'a String>,
) -> Result<(), RobotError> {
    let mut seen = BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(RobotError::DuplicateName { what, name: name.clone() });
        }
    }
    Ok(())
}
