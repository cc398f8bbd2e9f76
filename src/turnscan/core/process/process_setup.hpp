#pragma once
// Process-wide setup that every program does first.

namespace turnscan::process {

/// Opens /dev/null on those of the descriptors 0 to 2 that are closed; otherwise the first files
/// that a program opens would become its standard streams and receive its messages. Turns SIGPIPE
/// and SIGXFSZ into errors of write(), which programs report, instead of terminating silently.
void set_up_process();

}  // namespace turnscan::process
