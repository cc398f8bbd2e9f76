#pragma once
// Eigen, such that it gives the same bytes on x86-64 and arm64.

#include <Eigen/Core>

#ifdef EIGEN_VECTORIZE_NEON
/// arm64 alone has vectors of two floats, with which the sums of three products would be added in
/// another order than on x86-64: vectors of four, or none.
template <int Size>
struct Eigen::internal::find_best_packet_helper<Size, Eigen::internal::Packet4f, false> {
  using type = Packet4f;
};
#endif
