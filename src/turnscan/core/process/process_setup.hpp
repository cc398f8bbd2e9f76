#pragma once
// What every program does before anything else.

namespace turnscan::process {

/// Opens /dev/null on those of the descriptors 0 to 2 that are closed: the first files that a
/// program opened would else be its standard streams, and its messages would go into them. Takes
/// SIGPIPE and SIGXFSZ for errors of write(), which programs report, in place of their silent end.
void set_up_process();

}  // namespace turnscan::process
