// What swell list says of materials, lights, shapes and instruction sets.
#include "src/cli/list_text.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace swell {
namespace {

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("MaterialsText: says type, default, range, meaning and named values of parameters") {
  const NamedValue indices[] = {{"water", {1.333f, 0, 0}}, {"diamond", {2.417f, 0, 0}}};
  const NamedValue choices[] = {{"exact", {0, 0, 0}}, {"schlick", {1, 0, 0}}};
  const ParamSpec params[] = {
      {"eta", ParamType::kFloat, {1.5f, 0, 0}, 0.05f, 20, "index of refraction", indices, 2},
      {"fresnel", ParamType::kChoice, {1, 0, 0}, 0, 1, "reflected share", choices, 2},
      {"tint", ParamType::kRgb, {0.25f, 0.5f, 1}, 0, 1, "of what passes", nullptr, 0}};
  MaterialInfo glass{};
  glass.name = "glass";
  glass.help = "smooth glass";
  glass.params = params;
  glass.param_count = 3;
  const MaterialInfo* const kinds[] = {&glass};
  const std::string text = MaterialsText(kinds);
  for (const char* part :
       {"glass\n  smooth glass\n", "float eta", "1.5", "0.05 to 20", "index of refraction",
        "water, diamond", "string fresnel", "schlick", "exact, schlick", "rgb tint", "0.25 0.5 1",
        "of what passes", "interface\n", "mix\n", "without compensation of multiple scattering"}) {
    INFO(part);
    CHECK(Has(text, part));
  }
}

TEST_CASE("MaterialsText: long lists of names are broken into lines") {
  std::vector<NamedValue> names(40, NamedValue{"a-long-name", {0, 0, 0}});
  const ParamSpec param{"eta", ParamType::kFloat, {1, 0, 0}, 0, 2, "help", names.data(), 40};
  MaterialInfo info{};
  info.name = "m";
  info.help = "h";
  info.params = &param;
  info.param_count = 1;
  const MaterialInfo* const kinds[] = {&info};
  const std::string text = MaterialsText(kinds);
  size_t line = 0, longest = 0;
  for (char c : text) {
    line = c == '\n' ? 0 : line + 1;
    longest = std::max(longest, line);
  }
  CHECK(longest <= 100);
  size_t count = 0;
  for (size_t at = 0; (at = text.find("a-long-name", at)) != std::string::npos; ++at) ++count;
  CHECK(count == 40);
}

TEST_CASE("LightsText and ShapesText: name every type that scene files may use") {
  for (const char* name : {"infinite\n", "point\n", "distant\n", "spot\n", "goniometric\n",
                           "projection\n", "diffuse\n", "float power", "string filename"}) {
    INFO(name);
    CHECK(Has(LightsText(), name));
  }
  for (const char* name : {"sphere\n", "trianglemesh\n", "plymesh\n", "disk\n", "bilinearmesh\n",
                           "innerradius", "cylinder\n", "curve\n", "loopsubdiv\n"}) {
    INFO(name);
    CHECK(Has(ShapesText(), name));
  }
}

TEST_CASE("SamplersText and FiltersText: name every type that scene files may use") {
  for (const char* name : {"sobol\n", "zsobol\n", "halton\n", "stratified\n", "independent\n",
                           "integer pixelsamples", "integer xsamples"}) {
    INFO(name);
    CHECK(Has(SamplersText(), name));
  }
  for (const char* name : {"box\n", "triangle\n", "gaussian\n", "mitchell\n", "sinc\n",
                           "float xradius, yradius", "float sigma", "float B, C", "float tau"}) {
    INFO(name);
    CHECK(Has(FiltersText(), name));
  }
}

TEST_CASE("IsasText: says of each set whether it works here") {
  const std::string text = IsasText({{"avx3", "AVX-512", 16, true, 1, false, true, false},
                                     {"sse4", "SSE4.2", 4, false, 2, false, false, true},
                                     {"scalar", "plain", 1, false, 4, true, true, true}});
  CHECK(Has(text, "avx3    16 lanes  not this CPU"));
  CHECK(Has(text, "sse4    4 lanes   not in this build"));
  CHECK(Has(text, "scalar  1 lanes   yes"));
}

}  // namespace
}  // namespace swell
