#pragma once
// Three levels of checking. What a caller or a file can get wrong is thrown as one of tinsmith/error.hpp;
// what only we can get wrong is asserted here.

#include <cstdio>
#include <cstdlib>

// On in debug builds, tests and sanitizers. O(1).
#ifdef TINSMITH_CHECKED
#define TINSMITH_ASSERT(condition)                                                           \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: broken invariant: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define TINSMITH_ASSERT(condition) static_cast<void>(0)
#endif
