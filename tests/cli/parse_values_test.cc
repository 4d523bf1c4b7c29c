// Option values: what is taken, and what near misses are met with.
#include "src/cli/parse_values.h"

#include <doctest/doctest.h>

namespace swell {
namespace {

TEST_CASE("ParseCount: takes whole numbers in range and nothing else") {
  CHECK(*ParseCount("1", 1, 10) == 1);
  CHECK(*ParseCount("10", 1, 10) == 10);
  CHECK(*ParseCount("4294967295", 0, UINT32_MAX) == UINT32_MAX);
  for (const char* text : {"0", "11", "", " 1", "1 ", "+1", "-1", "1.0", "1e1", "0x1", "one",
                           "18446744073709551617"}) {
    INFO(text);
    CHECK(!ParseCount(text, 1, 10));
  }
}

TEST_CASE("ParseResolution: takes WIDTHxHEIGHT from 1 to 65535") {
  const auto size = ParseResolution("1280x720");
  REQUIRE(static_cast<bool>(size));
  CHECK((*size)[0] == 1280);
  CHECK((*size)[1] == 720);
  CHECK(static_cast<bool>(ParseResolution("65535x1")));
  for (const char* text : {"", "x", "1280", "1280x", "x720", "0x720", "1280x0", "65536x1",
                           "1x65536", "1280X720", "1280,720", "12 80x720", "1x2x3", "-1x5"}) {
    INFO(text);
    CHECK(!ParseResolution(text));
  }
}

TEST_CASE("ParseCropWindow: takes a window inside the frame that is not empty") {
  const auto window = ParseCropWindow("0,0.5,0.25,1");
  REQUIRE(static_cast<bool>(window));
  CHECK(*window == std::array<float, 4>{0, 0.5f, 0.25f, 1});
  for (const char* text :
       {"", "0,1,0", "0,1,0,1,1", "0,1,0,", "0,1.01,0,1", "-0.1,1,0,1", "0,0,0,1", "0.5,0.25,0,1",
        "0,1,1,0", "nan,1,0,1", "0,inf,0,1", "0 1 0 1", "a,b,c,d"}) {
    INFO(text);
    CHECK(!ParseCropWindow(text));
  }
}

TEST_CASE("ParseName: an unknown name is met with the closest, or with all") {
  const std::vector<std::string> names{"auto", "packet", "single"};
  CHECK(*ParseName("traversal", "single", names) == 2);
  CHECK(ParseName("traversal", "pakcet", names).error().message ==
        "unknown traversal 'pakcet'; did you mean 'packet'?");
  CHECK(ParseName("traversal", "stream", names).error().message ==
        "unknown traversal 'stream'; use auto, packet or single");
}

}  // namespace
}  // namespace swell
