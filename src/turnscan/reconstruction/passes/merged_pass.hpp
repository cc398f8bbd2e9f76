#pragma once
// Merges joined passes into one.

#include <span>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

class MergedPass {
 public:
  /// Merges the surfaces, each part once, and the free space of all passes, in the target frame of
  /// T_here_pass; one motion per pass.
  MergedPass(std::span<const PreparedPass* const> passes, std::span<const Pose> T_here_pass);

  const PreparedPass& prepared() const { return *prepared_; }

 private:
  void add(const PreparedPass& pass, const Pose& T_here_pass);

  std::unique_ptr<PassSurface> surface_;
  std::unique_ptr<PreparedPass> prepared_;
};

}  // namespace turnscan::passes
