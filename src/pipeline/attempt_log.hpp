#pragma once
// What attempts came to whose work is not kept any more.

#include <optional>
#include <string>
#include <vector>

#include "pipeline/search.hpp"

namespace tinsmith {

/// A file of lines, one for each attempt, which the next run with the same folder reads again. A line that is torn
/// is as good as none.
class AttemptLog {
 public:
  explicit AttemptLog(std::string file);

  std::optional<Attempt> find(double tolerance) const;

  /// Throws OutputError.
  void add(const Attempt& attempt);

 private:
  std::string file_;
  std::vector<Attempt> attempts_;
};

}  // namespace tinsmith
