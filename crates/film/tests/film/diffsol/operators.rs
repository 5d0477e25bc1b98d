//! The system as operators of the library: F with its Jacobian, M, and the start.

use ::diffsol::{
    ConstantOp, FaerContext, FaerSparseMat, FaerVec, LinearOp, Matrix, NonLinearOp, NonLinearOpJacobian, OdeEquations,
    OdeEquationsRef, Op, ParameterisedOp, UnitCallable, Vector,
};

use super::system::System;

type Sparsity = <FaerSparseMat<f64> as Matrix>::Sparsity;

/// F as the library sees it.
pub struct RightSide<'a>(&'a System);
/// M as the library sees it.
pub struct Mass<'a>(&'a System);
/// y at the start of the step, as the library sees it.
pub struct Start<'a>(&'a System);

macro_rules! operator {
    ($name:ty, $system:ident => $of:expr) => {
        impl Op for $name {
            type T = f64;
            type V = FaerVec<f64>;
            type M = FaerSparseMat<f64>;
            type C = FaerContext;

            fn context(&self) -> &FaerContext {
                let $system = self;
                &$of.context
            }

            fn nstates(&self) -> usize {
                let $system = self;
                $of.start.len()
            }

            fn nout(&self) -> usize {
                self.nstates()
            }

            fn nparams(&self) -> usize {
                0
            }
        }
    };
}

operator!(System, system => system);
operator!(RightSide<'_>, system => system.0);
operator!(Mass<'_>, system => system.0);
operator!(Start<'_>, system => system.0);

/// A matrix of entries; the library's own pattern is made of the same ones.
fn filled(rows: usize, places: Vec<(usize, usize)>, values: Vec<f64>, into: &mut FaerSparseMat<f64>) {
    // Entries within the matrix, none twice: there is nothing to refuse.
    if let Ok(matrix) = FaerSparseMat::try_from_triplets(rows, rows, places, values, *into.context()) {
        *into = matrix;
    }
}

/// The pattern of a matrix with entries at these places.
fn pattern(rows: usize, places: Vec<(usize, usize)>) -> Option<Sparsity> {
    let values = vec![1.0; places.len()];
    let matrix = FaerSparseMat::try_from_triplets(rows, rows, places, values, FaerContext::default()).ok()?;
    matrix.sparsity()?.to_owned().ok()
}

impl NonLinearOp for RightSide<'_> {
    fn call_inplace(&self, x: &FaerVec<f64>, _: f64, y: &mut FaerVec<f64>) {
        let mut out = vec![0.0; self.nstates()];
        self.0.right_side(&x.clone_as_vec(), &mut out);
        *y = FaerVec::from_vec(out, *self.context());
    }
}

impl NonLinearOpJacobian for RightSide<'_> {
    fn jac_mul_inplace(&self, x: &FaerVec<f64>, _: f64, v: &FaerVec<f64>, y: &mut FaerVec<f64>) {
        let (v, mut out) = (v.clone_as_vec(), vec![0.0; self.nstates()]);
        self.0.jacobian(&x.clone_as_vec(), |row, column, value| out[row] += value * v[column]);
        *y = FaerVec::from_vec(out, *self.context());
    }

    fn jacobian_inplace(&self, x: &FaerVec<f64>, _: f64, y: &mut FaerSparseMat<f64>) {
        let (mut places, mut values) = (Vec::new(), Vec::new());
        self.0.jacobian(&x.clone_as_vec(), |row, column, value| {
            places.push((row, column));
            values.push(value);
        });
        filled(self.nstates(), places, values, y);
    }

    fn jacobian_sparsity(&self) -> Option<Sparsity> {
        let mut places = Vec::new();
        self.0.jacobian(&self.0.start, |row, column, _| places.push((row, column)));
        pattern(self.nstates(), places)
    }
}

impl Mass<'_> {
    fn factor(&self, row: usize) -> f64 {
        if row.is_multiple_of(self.0.block) { 1.0 } else { 0.0 }
    }
}

impl LinearOp for Mass<'_> {
    fn gemv_inplace(&self, x: &FaerVec<f64>, _: f64, beta: f64, y: &mut FaerVec<f64>) {
        let (x, old) = (x.clone_as_vec(), y.clone_as_vec());
        let out = (0..x.len()).map(|row| self.factor(row) * x[row] + beta * old[row]).collect();
        *y = FaerVec::from_vec(out, *self.context());
    }

    fn matrix_inplace(&self, _: f64, y: &mut FaerSparseMat<f64>) {
        let rows = self.nstates();
        filled(rows, (0..rows).map(|row| (row, row)).collect(), (0..rows).map(|row| self.factor(row)).collect(), y);
    }

    fn sparsity(&self) -> Option<Sparsity> {
        pattern(self.nstates(), (0..self.nstates()).map(|row| (row, row)).collect())
    }
}

impl ConstantOp for Start<'_> {
    fn call_inplace(&self, _: f64, y: &mut FaerVec<f64>) {
        *y = FaerVec::from_slice(&self.0.start, *self.context());
    }
}

type Unit<'a> = ParameterisedOp<'a, UnitCallable<FaerSparseMat<f64>>>;

impl<'a> OdeEquationsRef<'a> for System {
    type Mass = Mass<'a>;
    type Rhs = RightSide<'a>;
    type Root = Unit<'a>;
    type Init = Start<'a>;
    type Out = Unit<'a>;
    type Reset = Unit<'a>;
}

impl OdeEquations for System {
    fn rhs(&self) -> RightSide<'_> {
        RightSide(self)
    }

    fn mass(&self) -> Option<Mass<'_>> {
        Some(Mass(self))
    }

    fn init(&self) -> Start<'_> {
        Start(self)
    }

    fn set_params(&mut self, _: &FaerVec<f64>) {}

    fn get_params(&self, _: &mut FaerVec<f64>) {}
}
