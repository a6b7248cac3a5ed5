#pragma once
// What can go wrong, one class per kind of failure. Everything that the library throws on purpose is an
// Error; its text says in one line what is wrong, where, and what to do about it.

#include <stdexcept>

namespace tinsmith {

/// Base of all failures. exit_code() is the one that the command line documents for the kind.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  virtual int exit_code() const noexcept = 0;
};

/// The caller asked for something that makes no sense (an option out of range, an unknown extension).
class UsageError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 2; }
};

/// An input can't be used: missing, damaged, not a raster, no valid sample, grids that don't match.
class InputError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 3; }
};

/// An input that can't be opened, or samples of it that can't be read, as opposed to one that makes no sense.
class UnreadableError : public InputError {
 public:
  using InputError::InputError;
};

/// The output can't be written; what stood there before still stands there.
class OutputError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 4; }
};

/// Memory, scratch space or a format's limit does not suffice.
class ResourceError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 5; }
};

/// The result can't be what was asked for (for example fewer triangles than the outline alone needs).
class ResultError : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 1; }
};

/// The progress callback asked to stop.
class Interrupted : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 130; }
};

}  // namespace tinsmith
