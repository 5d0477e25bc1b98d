//! The names of the measures of each solver; the comment above a name is its meaning in docs/reference/measures.md.

/// Measures of every direct simulation.
pub(super) const EVERY_RUN: &[&str] = &[
    // Root mean square of `V_0/V − 1` of the fluid particles
    "density-error",
    // Largest magnitude of `V_0/V − 1` of a fluid particle
    "largest-density-error",
    // Smallest distance of two fluid particles over `dx`; below 0.5 particles pair up
    "smallest-particle-distance-ratio",
];
/// With a wall.
pub(super) const WITH_WALLS: &[&str] = &[
    // With a solid or a wall at a side: signed wall distance of the nearest fluid particle, negative inside the wall
    "smallest-wall-distance-m",
];
/// With a tension.
pub(super) const WITH_TENSION: &[&str] = &[
    // Area of the wetting phase over that of both phases
    "saturation",
    // Larger relative area change of a phase, without the flow through open sides
    "area-drift",
    // Mean pressure of the non-wetting minus the wetting phase, away from the interface
    "capillary-pressure-Pa",
    // Length of the contour c = 0.5
    "interface-length-m",
    // Length of the wall under the wetting phase
    "wetted-length-m",
    // Number of connected parts of the wetting phase
    "wetting-blobs",
    // Number of particles where their phase is thinner than about three particles, over the number of particles of the smaller phase
    "below-resolution-share",
    // Number of connected parts of either phase with fewer than 20 particles, at the end
    "small-pieces",
    // Largest number of connected parts with fewer than 20 particles at any record
    "most-small-pieces",
];
/// With a wetting model.
pub(super) const WITH_WETTING: &[&str] = &[
    // With a wetting model: mean contact angle; at an edge, relative to the face below the wetting phase
    "contact-angle-deg",
    // With a wetting model: mean static angle at the contact lines
    "requested-angle-deg",
    // With a wetting model: slip length of walls near [contact lines](../numerics/walls.md#slip-near-contact-lines)
    "line-slip-length-m",
];
/// With open sides, or with a prescribed flow through periodic ones.
pub(super) const OPEN_SIDES: &[&str] = &[
    // Net inflow minus gain of mass, over the initial mass; the larger of both phases
    "balance-error",
    // Change of the total area minus net inflow, over the initial area
    "open-area-drift",
    // Mean net inflow through all sides where area enters; with a prescribed velocity or flow rate by the displacements in the buffers
    "inflow-m2-per-s",
];
/// Of two phases between open sides.
pub(super) const BREAKTHROUGH: &[&str] = &[
    // Two phases: time at which 20 particles of the entering phase (that of the larger inflow) have left, in the middle between two records
    "breakthrough-time-s",
    // Two phases: saturation of the entering phase at that time
    "saturation-at-breakthrough",
];
/// With a prescribed velocity or flow rate, at an inlet or through periodic sides.
pub(super) const GIVEN_FLOW: &[&str] = &[
    // Prescribed inflow, with a prescribed velocity or flow rate
    "asked-inflow-m2-per-s",
    // Inflow through the sides with a prescribed velocity or flow rate, by the displacements in the buffers, over the prescribed inflow
    "inflow-ratio",
];
/// Of a chip with a depth between open sides.
pub(super) const INFLOW_OF_CHIP: &[&str] = &[
    // With [`geometry.depth`](../tutorials/depth.md): `inflow-m2-per-s` times the depth
    "inflow-m3-per-s",
];
/// Of a chip with a depth and a prescribed velocity or flow rate.
pub(super) const GIVEN_FLOW_OF_CHIP: &[&str] = &[
    // With [`geometry.depth`](../tutorials/depth.md): `asked-inflow-m2-per-s` times the depth
    "asked-inflow-m3-per-s",
];
/// Of a moving drop in a chip with a depth.
pub(super) const FORCES_OF_CHIP: &[&str] = &[
    // With `geometry.depth`: retention times the depth
    "retention-N",
    "wall-retention-N",
    // With `geometry.depth`: drag times the depth, with the friction of floor and lid
    "stream-drag-N",
    "net-drag-N",
];
/// With a prescribed flow through periodic sides.
pub(super) const PERIODIC_FLOW: &[&str] = &[
    // Periodic sides with a prescribed flow: largest relative error of the flow rate in a step
    "largest-flow-rate-error",
    // Periodic sides with a prescribed flow: final mean driving pressure gradient times the period
    "driving-pressure-drop-Pa",
];
/// With a pressure that rises in steps.
pub(super) const PRESSURE_STEPS: &[&str] = &[
    // With `pressure-steps`: middle between the last pressure difference at which the menisci rested and that at which 20 particles of the entering
    // phase had left, uncertain by half of their difference
    "burst-pressure-Pa",
];
/// Of the permeability tensor by the force along x.
pub(super) const PERMEABILITY_X: &[&str] = &[
    // Viscosity times the mean velocity along x and y, over the force per volume along x
    "permeability-xx-m2",
    "permeability-yx-m2",
    // Rate of change of the momentum over the body force, at the end of the force along x
    "unsteady-share-x",
];
/// The same along y.
pub(super) const PERMEABILITY_Y: &[&str] = &[
    // Viscosity times the mean velocity along x and y, over the force per volume along y
    "permeability-xy-m2",
    "permeability-yy-m2",
    // Rate of change of the momentum over the body force, at the end of the force along y
    "unsteady-share-y",
];
/// Of every pore network.
pub(super) const NETWORK: &[&str] = &[
    // Closed-form pore area over the area of the domain
    "porosity",
    // Number of maxima of the wall distance, joined by the persistence ratio
    "pores",
    // Number of saddles of the wall distance between pores, without openings
    "throats",
    // Width of the narrowest of these throats
    "narrowest-throat-m",
    // Width of the widest of these throats
    "widest-throat-m",
    // Permeability along x and y; needs open or periodic sides; 0 where nothing leads through; with a warning at solid fractions below 0.3
    "permeability-x-m2",
    "permeability-y-m2",
    // Smallest, median and largest entry pressure of all throats in drainage, at the receding angle
    "smallest-entry-pressure-Pa",
    "median-entry-pressure-Pa",
    "largest-entry-pressure-Pa",
    // Saturation of the invading phase when it first reaches the outlet
    "saturation-at-breakthrough",
    // Final saturation of the displaced phase where it has no path to the outlet
    "trapped-saturation",
    // Final saturation of the wetting phase
    "final-wetting-saturation",
    // Number of events of all kinds and half cycles
    "events",
];
/// Of a quasi-static one.
pub(super) const NETWORK_QUASI_STATIC: &[&str] = &[
    // Permeability of the throats between regions of the phase over that of all, at the end of the last half cycle; of the wetting phase in drainage
    // 0 once the invading phase holds all openings of the inlet
    "relative-permeability-wetting",
    "relative-permeability-non-wetting",
    // With `network.measured`: number of throats whose measured entry pressure replaces the formula in the first half cycle
    "measured-entry-pressures",
    // Capillary pressure of the event by which the invading phase first reaches the outlet
    "breakthrough-pressure-Pa",
    // Final saturation of the displaced phase
    "residual-saturation",
    // With `films`: share of the pore space in films at the end, a part of the wetting saturation
    "film-saturation",
    // With `films`: number of throats that films closed
    "snap-offs",
    // Applied capillary pressure of largest magnitude in the first half cycle
    "largest-capillary-pressure-Pa",
    // Cycles: integral of the capillary pressure over the saturation that events displaced in the last drainage and imbibition
    "hysteresis-work-J-per-m3",
];
/// Of a displacement in time.
pub(super) const NETWORK_IN_TIME: &[&str] = &[
    // Time at which the invading phase reaches the outlet
    "breakthrough-time-s",
    // Pressure at the inlet minus that at the outlet at breakthrough
    "breakthrough-pressure-difference-Pa",
    // Largest pressure at the inlet minus that at the outlet; at vanishing rate the capillary pressure of breakthrough
    "largest-pressure-difference-Pa",
    // Area that passed the inlet over that of the pores
    "injected-pore-volumes",
    // Viscosity of the invading phase times inflow, over side length and tension; mean over the records
    "capillary-number",
    // Viscosity of the invading over that of the displaced phase
    "viscosity-ratio",
    // Mean width of fingers on lines across the flow, solids included
    "finger-width-m",
    // Mean number of fingers on these lines
    "fingers-per-line",
    // Final length of the menisci
    "interface-length-m",
    // Area gained by the invading phase minus its net inflow, over the area that it holds
    "balance-error",
    // Number of linear solves over that of events
    "solves-per-event",
];
/// Of every thin film.
pub(super) const THIN_FILM: &[&str] = &[
    // Position of the contact line in m
    "contact-line-position",
    // Height at x = 0 in m
    "center-height",
    // Angle of the tangent at the steepest point
    "contact-angle-deg",
    // Number of maxima of the film above a twentieth of the highest
    "droplet-count",
    // Exponent in time of the position of the contact line, from 1/50 of the run on
    "contact-line-exponent",
];
/// Of a film of particles.
pub(super) const FILM_PARTICLES: &[&str] = &[
    // Particles: position of the last particle in m
    "last-particle-position",
    // Particles: exponent in time of the position of the last particle, from 1/50 of the run on
    "last-particle-exponent",
    // Particles with their lattice energy: slope imitated by the lattice over that of the film
    "lattice-slope-ratio",
];
/// Of a film with a contact angle at rest.
pub(super) const FILM_ANGLE: &[&str] = &[
    // Partial wetting: slope at the steepest point over that at rest
    "contact-angle-ratio",
];
/// Of a droplet whose shape at rest is a parabola.
pub(super) const FILM_CAP: &[&str] = &[
    // Partial wetting with a precursor film: slope at the wall of the parabola through the top, over that at rest
    "cap-angle-ratio",
];
/// Of a droplet whose shape at rest is known.
pub(super) const FILM_REST: &[&str] = &[
    // Partial wetting of one droplet, geometric equation: area between the profile and that at rest, over the area of the droplet
    "equilibrium-l1-error",
];
/// Of a film with a contact angle at rest that is not a parabola.
pub(super) const FILM_COX_VOINOV: &[&str] = &[
    // Partial wetting: fitted factor of `Ca ln(x/d)` in the cubed angle, over 9
    "cox-voinov-ratio",
    // Partial wetting: fitted length `d`
    "cox-voinov-length-m",
    // Partial wetting: root mean square misfit of the cubed angle, over that at rest
    "cox-voinov-error",
];
/// Of a droplet that spreads by the similarity solution.
pub(super) const FILM_SIMILARITY: &[&str] = &[
    // Complete wetting in the plane: fitted f''(0) of the self-similar shape
    "similarity-curvature",
    // Complete wetting in the plane: largest misfit of the self-similar shape over f(0)
    "similarity-error",
];
/// Of a run that can end when steady.
pub(super) const STEADY: &[&str] = &[
    // With `[time.steady]`: time of the first [steady](output.md#steady-runs) record
    "steady-at-s",
];

/// Of a comparison of a direct simulation with a network.
pub(super) const COMPARISON: &[&str] = &[
    // Area that both have invaded over the area that either has; mean over the records
    "mean-overlap",
    // Spearman's rank correlation of the order of invasion, over the elements that both filled
    "rank-correlation",
    // Number of elements that both filled
    "elements-in-both",
    // Largest capillary pressure until an element at the outlet is filled; in imbibition the smallest
    "network-breakthrough-pressure-Pa",
    "direct-breakthrough-pressure-Pa",
    // Saturation of the wetting phase when an element at the outlet is filled
    "network-saturation-at-breakthrough",
    "direct-saturation-at-breakthrough",
    // With `[network.dynamic]`: time at which the invading phase reaches the outlet
    "network-breakthrough-time-s",
    "direct-breakthrough-time-s",
    // Permeability along x, where measured
    "network-permeability-m2",
    "direct-permeability-m2",
    // Number of pores of the network
    "network-pores",
    // Number of particles of the direct simulation
    "direct-particles",
    // Processor time
    "network-cpu-s",
    "direct-cpu-s",
];
