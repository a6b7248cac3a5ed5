#pragma once
// Ctrl-C and kill ask the work to stop where it leaves nothing half-written.

namespace tinsmith::cli {

/// From now on SIGINT and SIGTERM are remembered instead of ending the program, and a file-size limit is an
/// error of the write instead of a signal.
void catch_signals();

bool is_interrupted();

}  // namespace tinsmith::cli
