#pragma once

#include <turnscan/api/reconstruct.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>

namespace turnscan {

struct ReconstructedScan::Impl {
  ReconstructRun run;
  ReconstructOptions options;  ///< as they were asked for
};

}  // namespace turnscan
