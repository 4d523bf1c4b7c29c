// Errors of files in, the claims that all their messages keep out.
#ifndef SWELL_TESTS_SUPPORT_ERROR_LINES_H_
#define SWELL_TESTS_SUPPORT_ERROR_LINES_H_

#include <doctest/doctest.h>

#include <string>

#include "src/base/result.h"

namespace swell::test {

// One line that names the path and says more than that.
inline void CheckIsLineAbout(const Error& error, const std::string& path) {
  CAPTURE(error.message);
  CHECK(error.message.find(path) != std::string::npos);
  CHECK(error.message.find('\n') == std::string::npos);
  CHECK(error.message.size() > path.size() + 10);
}

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_ERROR_LINES_H_
