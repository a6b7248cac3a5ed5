#pragma once
// Where a run keeps its finished work until the output is written.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/name_lock.hpp"

namespace tinsmith {

/// What the result depends on, a line each as "name: value": a run goes on only from work with the same lines.
using Identity = std::vector<std::string>;

/// A folder `.NAME.tinsmith` beside the output, or in `tmp` when that is given (with a name of its own for each
/// output's path). One run at a time holds it, and one run at a time holds the output, whatever its folder. What it
/// holds survives the end of the run, unless remove() was called or nothing was done yet.
class RunFolder {
 public:
  /// Takes over what is there when the identity is the same, or `fresh` says that it is to be thrown away.
  /// Throws UsageError when it is another run's, OutputError when it is in use or can't be made or emptied.
  RunFolder(const std::string& output, const std::string& tmp, const Identity& identity, bool fresh);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder();

  /// A folder within, made when it is not there: for one of several attempts.
  std::string subfolder(const std::string& name) const;

  /// Of all files in it.
  std::uint64_t size_bytes() const;

  void remove_subfolder(const std::string& name) const;

  /// A file within, for what is to be known of all attempts.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

  /// The output is written: nothing of this is needed any more.
  void remove();

 private:
  // Held until the process ends, however it ends.
  class Lock {
   public:
    Lock(const std::string& file, const std::string& output);
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock();

    /// Not when the run that held it before has removed it meanwhile.
    bool is_there() const;

   private:
    std::string file_;
    int descriptor_;
  };
  void take_over(const Identity& identity, bool fresh);
  bool has_work() const;
  void make_empty();

  NameLock output_lock_;  // runs with other folders see each other, too
  std::string path_;
  std::optional<Lock> lock_;
};

}  // namespace tinsmith
