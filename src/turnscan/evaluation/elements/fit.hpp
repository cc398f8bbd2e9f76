#pragma once
// Least-squares fits of shapes to points of a mesh, and how well they are known.
//
// Fit: Gauss-Newton on the sum of w d^2, d the distance from the shape, w the point's share of the
// surface, so that a finer triangulation does not count more.
//
// Uncertainty: neighbouring vertices of a scan share frames, voxels and smoothing, so that they are
// no independent measurements. No model of that correlation is assumed but that it ends within the
// element. The points are grouped into blocks, each of the points nearest to one of G seeds as far
// apart as possible, and the covariance is the delete-one-block jackknife (Kuensch 1989), with the
// fit without a block from the normal equations (Bell and McCaffrey 2002, CR3):
//
//   V_G = (G - 1) / G sum_b t_b t_b^T,   t_b = (A - A_b)^-1 g_b
//
// A_b and g_b: what the block adds to the normal matrix and to the gradient. G = 30 blocks: more
// bring little, fewer make V uncertain (Schmeiser 1982, 10 to 30). What is correlated across the
// blocks' borders is missing in V_G, in proportion to the borders' length: V_G = V - c G^(1/k) for
// k = 2 dimensions, and c G on a curve. Blocks that double the borders (four times as many; on a
// curve twice) show it, and the result is V = V_G + (V_G - V_2)+ (lugsail estimator, Vats and
// Flegal 2022), where + leaves out directions in which the difference is negative.

#include <optional>
#include <span>
#include <turnscan/evaluation/elements/shape.hpp>
#include <vector>

namespace turnscan::elements {

/// A point of the surface. weight: area or length that it stands for.
struct Sample {
  Vec3d point = Vec3d::Zero();
  Vec3d normal = Vec3d::UnitZ();  ///< within the plane for points of a section
  double weight = 1.0;
};

struct Fit {
  Shape shape;
  /// Columns whose outer products sum up to the covariance of a Change of the shape. Without
  /// known(): the freedoms, for a length of 1 um.
  Changes spread = Changes::Zero();
  bool known = false;  ///< false: too few points to know it, 40 on a surface and 20 on a curve
  double form_m = 0.0, rms_m = 0.0;  ///< range and weighted rms of the distances
};

/// Fits from a start close to the result. nullopt: the points do not determine the shape. Its
/// `point`, if it may be any, is the one nearest to the centroid of the points.
std::optional<Shape> fit_shape(std::span<const Sample> samples, const Shape& start);

/// How well the points fit the shape that was fitted to them, and determine it.
Fit judged_fit(std::span<const Sample> samples, const Shape& shape);

}  // namespace turnscan::elements
