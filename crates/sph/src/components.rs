//! Connected components of a graph.

/// The component of each node, numbered from 0 in the order of their first nodes. `neighbors(a)` lists the nodes connected to a.
pub(crate) fn components<I: Iterator<Item = usize>>(count: usize, neighbors: impl Fn(usize) -> I) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut part = vec![NONE; count];
    let mut next = 0;
    for first in 0..count {
        if part[first] != NONE {
            continue;
        }
        part[first] = next;
        let mut open = vec![first];
        while let Some(a) = open.pop() {
            for b in neighbors(a) {
                if part[b] == NONE {
                    part[b] = next;
                    open.push(b);
                }
            }
        }
        next += 1;
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_numbered_in_the_order_of_their_first_nodes() {
        let joined = [vec![3], vec![], vec![4, 5], vec![0], vec![2], vec![2]];
        assert_eq!(components(joined.len(), |a| joined[a].iter().copied()), [0, 1, 2, 0, 2, 2]);
    }
}
