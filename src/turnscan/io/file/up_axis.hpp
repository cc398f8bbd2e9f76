#pragma once

namespace turnscan {

/// The axis that points up in a file. In memory it is always +Y.
enum class UpAxis {
  kFormat,  ///< as programs expect it of the format: z in STL and 3MF, else y
  kY,
  kZ
};

}  // namespace turnscan
