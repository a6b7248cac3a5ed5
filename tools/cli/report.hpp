#pragma once
// The certificate and the run as JSON, and as a table for people.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tinsmith/certificate.hpp"
#include "tinsmith/progress.hpp"

namespace tinsmith::cli {

using Json = nlohmann::ordered_json;

/// What a run took, whatever it did.
struct Resources {
  double seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
};

/// Seconds since the program started to work, and the most memory it ever had.
Resources resources_so_far();

/// Every key of the report, null for what was not measured: a certificate fills in its part, the verb the rest.
Json empty_report(const std::vector<std::string>& inputs, const std::string& output);

/// The certificate's keys, and `holds` and `broken` for this tolerance (none: null, and only what a mesh alone
/// must keep counts).
void add_certificate(Json& report, const Certificate& certificate, std::optional<double> tolerance);

/// `key value unit`, a line for each number that was measured.
void print_table(const Json& report);

/// To standard output for "-", else to a file, aside and renamed. Throws OutputError.
void write_json(const Json& report, const std::string& path);

/// Throws OutputError when a file can't be written there: before the work, not after it.
void require_writable(const std::string& path);

/// Throws UsageError when an output is one of the inputs, or two outputs are the same file. "" and "-" are none.
void require_apart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Broken promises on standard error, in one line; the exit code.
int verdict(const Json& report, const std::string& mesh);

}  // namespace tinsmith::cli
