//! Why a tree cannot be lowered.

/// A node of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The material's name.
    pub material: String,
    /// The node's name as the user sees it.
    pub node: String,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "material \"{}\", node \"{}\"", self.material, self.node)
    }
}

/// Why a tree cannot be lowered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LowerError {
    /// A value needs itself.
    #[error("{0}: its input depends on its own output")]
    Cycle(Place),
    /// A group is inside of itself.
    #[error("{0}: the group \"{1}\" contains itself")]
    Nested(Place, String),
    /// A tree or a node that a file refers to is not there.
    #[error("material \"{material}\": node tree {tree} does not exist")]
    Tree {
        /// The material's name.
        material: String,
        /// The index that was given.
        tree: u32,
    },
    /// A link ends nowhere.
    #[error("material \"{material}\", tree \"{tree}\": link {link} has a loose end")]
    Link {
        /// The material's name.
        material: String,
        /// The tree's name.
        tree: String,
        /// Position among the tree's links.
        link: usize,
    },
    /// A socket that the node's type has is not in the file.
    #[error("{0}: socket \"{1}\" is missing")]
    Socket(Place, String),
    /// A property has a value that its node's type does not know, or none.
    #[error("{0}: property \"{1}\" is {2}")]
    Property(Place, String, String),
    /// Content that a node needs is not in the file.
    #[error("{0}: its {1} is missing")]
    Content(Place, &'static str),
    /// Groups in groups make too many nodes.
    #[error("material \"{0}\": its groups, written out, have more than {1} nodes")]
    Size(String, usize),
}
