#pragma once

namespace quartet {

/// Runs the program. Returns its exit code: 0 done, 1 failed, 2 wrong usage; what went wrong is one
/// line on stderr.
int run_command_line(int argc, const char* const* argv);

}  // namespace quartet
