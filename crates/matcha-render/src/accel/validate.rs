//! What must hold of a structure.

use super::Accel;
use super::node::{Bounds, Link, WIDTH};

impl Accel {
    /// Checks that every link leads somewhere, that boxes contain what is below them, and that
    /// every triangle and placement is reached; the first breach in words.
    pub fn validate(&self) -> Result<(), String> {
        if self.nodes.is_empty() {
            return Ok(());
        }
        let mut seen_packs = vec![false; self.packs.len()];
        let mut seen_placements = vec![false; self.placements.len()];
        let mut roots: Vec<Link> = vec![self.root];
        roots.extend(self.placements.iter().map(|p| p.root));
        roots.sort_by_key(|link| link.0);
        roots.dedup();
        for root in roots {
            self.check(root, &mut seen_packs, &mut seen_placements)?;
        }
        if let Some(pack) = seen_packs.iter().position(|seen| !seen) {
            return Err(format!("pack {pack} cannot be reached"));
        }
        if let Some(placement) = seen_placements.iter().position(|seen| !seen) {
            return Err(format!("placement {placement} cannot be reached"));
        }
        Ok(())
    }

    fn check(&self, root: Link, packs: &mut [bool], placements: &mut [bool]) -> Result<(), String> {
        let everything = Bounds {
            min: glam::Vec3::NEG_INFINITY,
            max: glam::Vec3::INFINITY,
        };
        let mut stack = vec![(root, everything, 0usize)];
        let mut visited = 0;
        while let Some((link, bounds, entries)) = stack.pop() {
            visited += 1;
            if visited > self.nodes.len() + self.packs.len() + self.placements.len() + 1 {
                return Err("the hierarchy has a loop".into());
            }
            if link.is_leaf() {
                self.check_leaf(link, &bounds, packs)?;
            } else if link.is_instance() {
                *placements
                    .get_mut(link.index())
                    .ok_or("placement out of range")? = true;
            } else if link.is_node() {
                let node = self.nodes.get(link.index()).ok_or("node out of range")?;
                let used = node
                    .children
                    .iter()
                    .filter(|&&child| child != Link::EMPTY)
                    .count();
                if entries + used > self.depth {
                    return Err(format!(
                        "a walk needs more than {} stack entries",
                        self.depth
                    ));
                }
                for slot in (0..WIDTH).filter(|&s| node.children[s] != Link::EMPTY) {
                    let inner = node.child_bounds(slot);
                    if inner.min.cmplt(bounds.min).any() || inner.max.cmpgt(bounds.max).any() {
                        return Err(format!("node {} leaves its parent's box", link.index()));
                    }
                    stack.push((node.children[slot], inner, entries + used));
                }
            } else {
                return Err("a link of no kind".into());
            }
        }
        Ok(())
    }

    /// Split triangles may reach out of a leaf's box, but every leaf's box touches its triangles'.
    fn check_leaf(&self, link: Link, bounds: &Bounds, seen: &mut [bool]) -> Result<(), String> {
        for index in link.index()..link.index() + link.packs() {
            let pack = self.packs.get(index).ok_or("pack out of range")?;
            *seen.get_mut(index).ok_or("pack out of range")? = true;
            for lane in (0..super::node::PACK).filter(|&l| pack.primitive[l] != u32::MAX) {
                let mut own = Bounds::EMPTY;
                pack.triangle(lane)
                    .into_iter()
                    .for_each(|corner| own.grow(corner));
                if own.min.cmpgt(bounds.max).any() || own.max.cmplt(bounds.min).any() {
                    return Err(format!("pack {index} lies outside of its leaf's box"));
                }
            }
        }
        Ok(())
    }
}
