//! Flow in a graph of conductors: one pressure per node, flows that sum to the source of every node.
//!
//! The matrix is a graph Laplacian, symmetric and positive definite once one node of each component without a given pressure has the
//! pressure 0. It is factored by Cholesky, with one symbolic factorization per graph.
//!
//! The ratio of conductances may exceed the range of double precision: open throats conduct far better than menisci. Nodes joined by
//! conductors marked as good form a cluster. Its unknowns are the pressure of one of its nodes and the differences of the others from it, so
//! that the balance of a cluster is an equation of its own, without the flows inside.

use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};

use meniscus_core::math::{factor_in_one_thread, root};

/// The matrix of a network does not fit into memory, or its conductances are not positive numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the flow through a network of {nodes} nodes could not be solved: its conductances differ too much, or memory is short"
)]
pub struct FlowError {
    /// Number of nodes.
    pub nodes: usize,
}

/// Start and end node of a conductor; without an end it leads to a given pressure.
pub(crate) type Ends = (usize, Option<usize>);

/// A conductor: flow = conductance × (pressure of its first node + jump − pressure of its second node).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Conductor {
    /// Flow over pressure difference, above 0.
    pub(crate) conductance: f64,
    /// Additional pressure difference between both ends.
    pub(crate) jump: f64,
}

/// Pressures and flows.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Flow {
    /// Pressure of each node.
    pub(crate) pressure: Vec<f64>,
    /// Flow through each conductor, from its first node to its second. Node balances hold to rounding of the flows, however much larger
    /// pressures are than their differences.
    pub(crate) through: Vec<f64>,
}

/// A conductor of a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Edge {
    /// Start and end.
    pub(crate) ends: Ends,
    /// Whether it may conduct far better than others.
    pub(crate) is_good: bool,
}

/// A graph of conductors.
#[derive(Debug, Clone)]
pub(crate) struct Laplacian {
    nodes: usize,
    edges: Vec<Edge>,
    /// By edge.
    incidences: Vec<Incidence>,
    /// For each node the unknowns whose sum is its pressure: that of its cluster and its own.
    rows_of: Vec<[Option<usize>; 2]>,
    /// `None` if there is nothing to solve.
    pattern: Option<Pattern>,
}

#[derive(Debug, Clone)]
struct Pattern {
    matrix: SymbolicSparseColMat<usize>,
    order: Argsort<usize>,
    elimination: SymbolicLlt<usize>,
    size: usize,
}

/// Maximum number of corrections of the flows by the residuals of the nodes.
const REFINEMENTS: usize = 12;
/// Tolerance of the residual of a node, over the largest flow.
const LEFT: f64 = 1e-15;
/// Least reduction of the residual by a correction; otherwise it is rounding.
const IMPROVED: f64 = 0.5;

/// The unknowns that an edge joins, and whether they count negatively in the difference of pressures.
type Incidence = [Option<(u32, bool)>; 4];

/// The unknowns that an edge joins, with their signs.
fn signed(incidence: &Incidence) -> impl Iterator<Item = (usize, f64)> {
    incidence.iter().flatten().map(|&(row, is_negative)| (row as usize, if is_negative { -1.0 } else { 1.0 }))
}

impl Laplacian {
    /// The graph of conductors between `nodes` nodes.
    ///
    /// # Errors
    /// [`FlowError`] if it does not fit into memory.
    pub(crate) fn new(nodes: usize, edges: Vec<Edge>) -> Result<Self, FlowError> {
        factor_in_one_thread();
        let (rows_of, size) = unknowns(nodes, &edges);
        let incidences = edges.iter().map(|edge| incidence(edge, &rows_of)).collect();
        let mut laplacian = Self { nodes, edges, incidences, rows_of, pattern: None };
        let mut pairs = Vec::with_capacity(3 * laplacian.edges.len());
        laplacian.each_entry(|_, row, col, _| pairs.push(Pair { row, col }));
        if size > 0 {
            let error = FlowError { nodes };
            let (matrix, order) = SymbolicSparseColMat::try_new_from_indices(size, size, &pairs).map_err(|_| error)?;
            let elimination = SymbolicLlt::try_new(matrix.as_ref(), Side::Lower).map_err(|_| error)?;
            laplacian.pattern = Some(Pattern { matrix, order, elimination, size });
        }
        Ok(laplacian)
    }

    /// Whether a node is connected to a given pressure.
    pub(crate) fn is_connected_to_pressure(&self, node: usize) -> bool {
        let mut parent = parts(self.nodes, self.edges.iter().map(|edge| edge.ends));
        let part = root(&mut parent, node);
        self.edges.iter().any(|edge| edge.ends.1.is_none() && root(&mut parent, edge.ends.0) == part)
    }

    /// Calls `f` with conductor, row, column and sign of each entry of the lower triangle.
    fn each_entry(&self, mut f: impl FnMut(usize, usize, usize, f64)) {
        for (index, incidence) in self.incidences.iter().enumerate() {
            for (row, sign) in signed(incidence) {
                for (col, other) in signed(incidence).filter(|&(col, _)| col <= row) {
                    f(index, row, col, sign * other);
                }
            }
        }
    }

    /// The pressure drop along an edge.
    pub(crate) fn drop(&self, edge: usize, pressure: &[f64]) -> f64 {
        let (from, to) = self.edges[edge].ends;
        pressure[from] - to.map_or(0.0, |to| pressure[to])
    }

    /// The conductances, ready to be solved with.
    ///
    /// # Errors
    /// [`FlowError`] if a conductance is not a positive number.
    pub(crate) fn factor(&self, conductances: Vec<f64>) -> Result<Factored<'_>, FlowError> {
        let error = FlowError { nodes: self.nodes };
        let Some(Pattern { matrix, order, elimination, .. }) = &self.pattern else {
            return Ok(Factored { laplacian: self, conductances, factors: None });
        };
        let mut values = Vec::with_capacity(3 * conductances.len());
        self.each_entry(|index, _, _, sign| values.push(sign * conductances[index]));
        let matrix = SparseColMat::new_from_argsort(matrix.clone(), order, &values).map_err(|_| error)?;
        let factors =
            Llt::try_new_with_symbolic(elimination.clone(), matrix.as_ref(), Side::Lower).map_err(|_| error)?;
        Ok(Factored { laplacian: self, conductances, factors: Some(factors) })
    }

    /// Pressures and flows, with the sources of all nodes.
    ///
    /// # Errors
    /// [`FlowError`] if a conductance is not a positive number.
    pub(crate) fn solve(&self, conductors: &[Conductor], sources: &[f64]) -> Result<Flow, FlowError> {
        let jumps: Vec<f64> = conductors.iter().map(|conductor| conductor.jump).collect();
        let factored = self.factor(conductors.iter().map(|conductor| conductor.conductance).collect())?;
        let mut flow = factored.solve(&jumps, sources)?;
        factored.balance(&mut flow, sources)?;
        Ok(flow)
    }
}

/// A graph with its conductances.
pub(crate) struct Factored<'a> {
    laplacian: &'a Laplacian,
    conductances: Vec<f64>,
    /// `None` if there is nothing to solve.
    factors: Option<Llt<usize, f64>>,
}

impl Factored<'_> {
    /// By conductor.
    pub(crate) fn conductances(&self) -> &[f64] {
        &self.conductances
    }

    /// Pressures and flows with the jumps of all conductors and the sources of all nodes, by one solution without refinement: residuals of the
    /// nodes are the rounding error of pressures.
    ///
    /// # Errors
    /// [`FlowError`] if they are not finite.
    pub(crate) fn solve(&self, jumps: &[f64], sources: &[f64]) -> Result<Flow, FlowError> {
        let mut flow = Flow {
            pressure: vec![0.0; self.laplacian.nodes],
            through: self.conductances.iter().zip(jumps).map(|(conductance, jump)| conductance * jump).collect(),
        };
        let (left, _) = self.left_over(&flow, sources);
        self.correct(&mut flow, left);
        self.finite(flow)
    }

    /// Corrects flows by the residuals of the nodes until these are rounding errors of flows.
    ///
    /// # Errors
    /// [`FlowError`] if they are not finite.
    pub(crate) fn balance(&self, flow: &mut Flow, sources: &[f64]) -> Result<(), FlowError> {
        let mut before = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let (left, largest) = self.left_over(flow, sources);
            let most = left.col_as_slice(0).iter().fold(0.0_f64, |most, left| most.max(left.abs()));
            if most <= LEFT * largest || most > IMPROVED * before {
                break;
            }
            before = most;
            self.correct(flow, left);
        }
        *flow = self.finite(std::mem::take(flow))?;
        Ok(())
    }

    fn finite(&self, flow: Flow) -> Result<Flow, FlowError> {
        let is_finite = flow.pressure.iter().all(|p| p.is_finite());
        if is_finite { Ok(flow) } else { Err(FlowError { nodes: self.laplacian.nodes }) }
    }

    /// Residuals by unknown, and the largest flow.
    fn left_over(&self, flow: &Flow, sources: &[f64]) -> (faer::Mat<f64>, f64) {
        let graph = self.laplacian;
        let size = graph.pattern.as_ref().map_or(0, |pattern| pattern.size);
        let mut left = faer::Mat::<f64>::zeros(size, 1);
        for (&source, rows) in sources.iter().zip(&graph.rows_of) {
            rows.iter().flatten().for_each(|&row| left[(row, 0)] += source);
        }
        let mut largest: f64 = 0.0;
        for (incidence, &through) in graph.incidences.iter().zip(&flow.through) {
            largest = largest.max(through.abs());
            signed(incidence).for_each(|(row, sign)| left[(row, 0)] -= sign * through);
        }
        (left, largest)
    }

    fn correct(&self, flow: &mut Flow, mut left: faer::Mat<f64>) {
        let Some(factors) = &self.factors else { return };
        let graph = self.laplacian;
        factors.solve_in_place(left.as_mut());
        for (pressure, rows) in flow.pressure.iter_mut().zip(&graph.rows_of) {
            *pressure += rows.iter().flatten().map(|&row| left[(row, 0)]).sum::<f64>();
        }
        for ((incidence, conductance), through) in
            graph.incidences.iter().zip(&self.conductances).zip(&mut flow.through)
        {
            let drop: f64 = signed(incidence).map(|(row, sign)| sign * left[(row, 0)]).sum();
            *through += conductance * drop;
        }
    }
}

/// The unknowns that an edge joins.
fn incidence(edge: &Edge, rows_of: &[[Option<usize>; 2]]) -> Incidence {
    let (from, to) = edge.ends;
    let from = rows_of[from];
    let Some(to) = to.map(|to| rows_of[to]) else { return [plus(from[0]), plus(from[1]), None, None] };
    let minus = |row: Option<usize>| row.map(|row| (row as u32, true));
    let mut all = [plus(from[0]), plus(from[1]), minus(to[0]), minus(to[1])];
    for k in 0..2 {
        // The pressure of a cluster drives no flow within it, nor that of a node to its own periodic image.
        if from[k] == to[k] {
            (all[k], all[k + 2]) = (None, None);
        }
    }
    all
}

fn plus(row: Option<usize>) -> Option<(u32, bool)> {
    row.map(|row| (row as u32, false))
}

/// The unknowns of each node and their number: one node of each component without a given pressure has the pressure 0.
fn unknowns(nodes: usize, edges: &[Edge]) -> (Vec<[Option<usize>; 2]>, usize) {
    let mut parent = parts(nodes, edges.iter().map(|edge| edge.ends));
    let mut cluster = parts(nodes, edges.iter().filter(|edge| edge.is_good).map(|edge| edge.ends));
    let mut is_given = vec![false; nodes];
    for edge in edges.iter().filter(|edge| edge.ends.1.is_none()) {
        is_given[root(&mut parent, edge.ends.0)] = true;
    }
    let mut rows = 0;
    let mut next = || {
        rows += 1;
        rows - 1
    };
    let mut of_cluster: Vec<Option<usize>> = vec![None; nodes];
    let found = (0..nodes)
        .map(|node| {
            let (part, first) = (root(&mut parent, node), root(&mut cluster, node));
            // The first node of a component is the first of its cluster, since the smallest index labels both.
            if first == node && (part != node || is_given[part]) {
                of_cluster[node] = Some(next());
            }
            [of_cluster[first], (first != node).then(&mut next)]
        })
        .collect();
    (found, rows)
}

/// A union-find forest whose roots label the components of the graph by their smallest index.
pub(crate) fn parts(nodes: usize, ends: impl Iterator<Item = Ends>) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..nodes).collect();
    for (from, to) in ends {
        if let Some(to) = to {
            let (a, b) = (root(&mut parent, from), root(&mut parent, to));
            parent[a.max(b)] = a.min(b);
        }
    }
    parent
}
