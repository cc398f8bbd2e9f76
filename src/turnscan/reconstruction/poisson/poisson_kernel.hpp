#pragma once
// The inner loops of the Poisson solver, on plain arrays.  Quadratic B-splines on cells of side 1;
// blocks of 12^3 and bricks of 8^3 as in poisson_bricks.hpp.

#include <cstddef>

namespace turnscan::poisson {

/// out[512] = the stiffness matrix times the coefficients of a block: for cell i the sum over j of
/// the integral of grad B_i . grad B_j, times u_j.
void stiffness(const float* block, float* out);

/// out[512] = the integrals of V . grad B_i for the vector field of these coefficients.
void divergence(const float* x, const float* y, const float* z, float* out);

/// The block around a brick from the coefficients of 8^3 cells of the next coarser level around it,
/// starting two cells before its first one: the same function (Chaikin's rule along each axis).
void refine(const float* coarse, float* block);

/// out[512] += half of the transpose of refine() applied to the 18^3 cells of the next finer level
/// around a brick, starting one cell before its first one: loads are in units of the cell's side.
void coarsen(const float* fine, float* out);

/// Sum of a[i] * b[i] in double precision, in an order that depends on n alone, a multiple of 8.
double dot(const float* a, const float* b, std::size_t n);

/// One step of conjugate gradients on n values: x += step p, r -= step q; returns the sum of
/// inverse_diagonal r^2 as dot() does.
double update_solution(float step, const float* p, const float* q, const float* inverse_diagonal,
                       float* x, float* r, std::size_t n);

/// p = inverse_diagonal r + beta p
void update_direction(float beta, const float* inverse_diagonal, const float* r, float* p,
                      std::size_t n);

}  // namespace turnscan::poisson
