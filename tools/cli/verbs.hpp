#pragma once
// The verbs of the command line, one file each. Each adds itself to the program; when the command line names
// it, `run` becomes what it does, and returns the exit code.

#include <CLI/CLI.hpp>
#include <functional>

namespace tinsmith::cli {

using Run = std::function<int()>;

void add_compress(CLI::App& program, Run& run);
void add_simplify(CLI::App& program, Run& run);
void add_verify(CLI::App& program, Run& run);
void add_render(CLI::App& program, Run& run);
void add_info(CLI::App& program, Run& run);

}  // namespace tinsmith::cli
