// Aborts with file and line on a bug. For bad input use Result.
#ifndef SWELL_BASE_CHECK_H_
#define SWELL_BASE_CHECK_H_

#include <cstdio>
#include <cstdlib>

#define SWELL_CHECK(condition)                                                                \
  do {                                                                                        \
    if (!(condition)) {                                                                       \
      std::fprintf(stderr, "%s:%d: bug: %s does not hold\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                           \
    }                                                                                         \
  } while (false)

#endif  // SWELL_BASE_CHECK_H_
