//! Regions merged to pores by persistence: a throat nearly as wide as the smaller of its pores does not separate them.
//!
//! Throats are processed from wide to narrow. If half the width exceeds f times the smaller of both inscribed radii, both pores are merged.
//! Loops remain: two pores may keep two throats, and a pore one to itself.

use crate::graph::{Network, Pores};
use meniscus_core::math::root;

impl Pores {
    /// The pores for the persistence ratio f, above 0 and at most 1; 1 keeps all.
    pub fn merged(network: &Network, persistence: f64) -> Self {
        let regions = &network.regions;
        // The region with the largest circle represents its set.
        let mut parent: Vec<usize> = (0..regions.len()).collect();
        let mut order: Vec<usize> = (0..network.throats.len()).collect();
        order.sort_by(|&a, &b| network.throats[b].width.total_cmp(&network.throats[a].width).then(a.cmp(&b)));
        let mut is_dissolved = vec![false; network.throats.len()];
        for throat in order {
            let [a, b] = network.throats[throat].regions.map(|region| root(&mut parent, region));
            let (low, high) = if (regions[a].radius, b) <= (regions[b].radius, a) { (a, b) } else { (b, a) };
            if a != b && 0.5 * network.throats[throat].width > persistence * regions[low].radius {
                parent[low] = high;
                is_dissolved[throat] = true;
            }
        }
        let main_of: Vec<usize> = (0..regions.len()).map(|region| root(&mut parent, region)).collect();
        let main_region: Vec<usize> = (0..regions.len()).filter(|&region| main_of[region] == region).collect();
        let mut number = vec![0; regions.len()];
        main_region.iter().enumerate().for_each(|(pore, &region)| number[region] = pore);
        let pore_of: Vec<usize> = main_of.iter().map(|&region| number[region]).collect();
        let mut area = vec![0.0; main_region.len()];
        pore_of.iter().zip(regions).for_each(|(&pore, region)| area[pore] += region.area);
        let throats = (0..network.throats.len()).filter(|&throat| !is_dissolved[throat]).collect();
        Self { persistence, pore_of, main_region, area, throats }
    }
}
