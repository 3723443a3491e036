//! The tree of nodes, flattened.

use super::accessor::Buffers;
use super::animation::{CameraTrack, NodeTrack, transform_of};
use crate::model::{Model, ModelCamera};
use glam::DAffine3;
use gltf::camera::Projection;
use gltf::{Document, Node};

/// A node with its place at rest.
pub(super) struct Placed<'a> {
    pub(super) node: Node<'a>,
    pub(super) world_from_node: DAffine3,
    /// Where in the list its parent stands.
    parent: Option<usize>,
}

/// All nodes of the default scene (of the first, without a default; all roots, without a scene),
/// parents before children.
pub(super) fn placed(document: &Document) -> Result<Vec<Placed<'_>>, String> {
    let nodes: Vec<Node> = document.nodes().collect();
    let mut seen = vec![false; nodes.len()];
    let mut waiting: Vec<(usize, Option<usize>)> =
        roots(document).into_iter().rev().map(|root| (root, None)).collect();
    let mut all: Vec<Placed> = Vec::new();
    while let Some((index, parent)) = waiting.pop() {
        if std::mem::replace(&mut seen[index], true) {
            return Err(format!("node {index} hangs below itself or below two nodes"));
        }
        let node = nodes[index].clone();
        let above = parent.map_or(DAffine3::IDENTITY, |parent: usize| all[parent].world_from_node);
        let children: Vec<usize> = node.children().map(|child| child.index()).collect();
        waiting.extend(children.into_iter().rev().map(|child| (child, Some(all.len()))));
        all.push(Placed { world_from_node: above * transform_of(&node.transform()), node, parent });
    }
    Ok(all)
}

fn roots(document: &Document) -> Vec<usize> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        return scene.nodes().map(|node| node.index()).collect();
    }
    let mut is_child = vec![false; document.nodes().len()];
    document.nodes().for_each(|node| node.children().for_each(|child| is_child[child.index()] = true));
    (0..is_child.len()).filter(|&index| !is_child[index]).collect()
}

/// What the file calls a node, or its number.
pub(super) fn name_of(node: &Node, of_content: Option<&str>) -> String {
    let given = node.name().or(of_content).filter(|name| !name.is_empty());
    given.map_or_else(|| format!("node {}", node.index()), str::to_owned)
}

/// The camera of the node at this place in the list, if it has one that is perspective.
pub(super) fn add_camera(
    model: &mut Model,
    all: &[Placed],
    at: usize,
    (document, buffers): (&Document, &Buffers),
) -> Result<(), String> {
    let node = &all[at].node;
    let Some(camera) = node.camera() else { return Ok(()) };
    let mut name = name_of(node, camera.name());
    let yfov_radians = match camera.projection() {
        Projection::Perspective(lens) => f64::from(lens.yfov()),
        Projection::Orthographic(_) => {
            model.notes.push(format!("camera '{name}' is orthographic and left out"));
            return Ok(());
        }
    };
    if !(yfov_radians > 0.0 && yfov_radians < std::f64::consts::PI) {
        return Err(format!("camera '{name}' has a field of view of {yfov_radians} radians"));
    }
    while model.cameras.iter().any(|other| other.name == name) {
        name.push_str(" again");
    }
    let upwards = std::iter::successors(Some(at), |&at| all[at].parent);
    let chain = upwards.map(|at| NodeTrack::read(document, &all[at].node, buffers));
    let mut chain = chain.collect::<Result<Vec<_>, _>>()?;
    chain.reverse();
    let track = CameraTrack { world_from_file: DAffine3::IDENTITY, chain };
    model.cameras.push(ModelCamera { name, yfov_radians, track });
    Ok(())
}
