// Edit distances and the suggestions made of them.
#include "src/base/suggest.h"

#include <doctest/doctest.h>

namespace swell {

TEST_CASE("EditDistance: counts insertions, deletions, replacements and swaps") {
  CHECK(EditDistance("diffuse", "diffuse") == 0);
  CHECK(EditDistance("difuse", "diffuse") == 1);
  CHECK(EditDistance("difffuse", "diffuse") == 1);
  CHECK(EditDistance("diffuze", "diffuse") == 1);
  CHECK(EditDistance("idffuse", "diffuse") == 1);
  CHECK(EditDistance("", "abc") == 3);
  CHECK(EditDistance("kitten", "sitting") == 3);
  CHECK(EditDistance("FOV", "fov") == 0);
}

TEST_CASE("DidYouMean: names the nearest word and keeps silent when none is near") {
  CHECK(DidYouMean("difuse", {"dielectric", "diffuse"}) == "; did you mean 'diffuse'?");
  CHECK(DidYouMean("Shpae", {"Scale", "Shape"}) == "; did you mean 'Shape'?");
  CHECK(DidYouMean("xyzzy", {"dielectric", "diffuse"}) == "");
  CHECK(DidYouMean("", {"diffuse"}) == "");
}

TEST_CASE("ListOf: sorts") { CHECK(ListOf({"b", "a", "c"}) == "a, b, c"); }

TEST_CASE("DidYouMean: speaks only of names that are close") {
  CHECK(DidYouMean("--ssp", {"--spp", "--seed"}) == "; did you mean '--spp'?");
  CHECK(DidYouMean("--checkpoint", {"--spp", "--seed"}).empty());
  CHECK(DidYouMean("", {"on", "off"}).empty());
}

}  // namespace swell
