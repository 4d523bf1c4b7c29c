// Samplers from their table and pixel filters, as the scene readers take them; the layout of
// entries.
#include "src/cli/list_entries.h"
#include "src/cli/list_text.h"

#include <string_view>

#include "kernels/sampler.h"

namespace swell {

std::string Padded(std::string text, size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string EntriesText(const std::vector<Entry>& entries) {
  std::string text;
  for (const Entry& entry : entries) {
    text += std::string(entry.name) + "\n  " + entry.help + "\n";
    for (const Param& param : entry.params) {
      text += "    " + Padded(param.name, 24) + Padded(param.fallback, 16) + param.help + "\n";
    }
  }
  return text;
}

std::string SamplersText() {
  std::vector<Entry> samplers;
  for (const SamplerInfo& sampler : kSamplers) {
    std::vector<Param> params{{"integer pixelsamples", "16", "samples per pixel"}};
    if (std::string_view(sampler.name) == "stratified") {
      params = {{"integer xsamples", "4", ""},
                {"integer ysamples", "4", "times xsamples: samples per pixel"}};
    }
    params.push_back({"integer seed", "0", "of the random numbers"});
    samplers.push_back({sampler.name, sampler.help, params});
  }
  return "Sampler \"type\" parameters, or --sampler; the first is the default. Types, then their "
         "parameters:\nname, default, meaning. All converge to the same picture.\n\n" +
         EntriesText(samplers);
}

std::string FiltersText() {
  static const auto with = [](const char* radius, std::vector<Param> more) {
    std::vector<Param> params{{"float xradius, yradius", radius, "half the size in pixels"}};
    params.insert(params.end(), more.begin(), more.end());
    return params;
  };
  static const std::vector<Entry> kFilters{
      {"gaussian", "a bell less its value at the edge",
       with("1.5", {{"float sigma", "0.5", "standard deviation in pixels"}})},
      {"box", "the same weight for all", with("0.5", {})},
      {"triangle", "falls to the edge", with("2", {})},
      {"mitchell", "cubic, negative near the edge (Mitchell and Netravali 1988)",
       with("2", {{"float B, C", "1/3", "blur and ringing"}})},
      {"sinc", "sinc(x) sinc(x / tau), in part negative (Lanczos)",
       with("4", {{"float tau", "3", "zeros of the window in pixels"}})},
  };
  return "PixelFilter \"type\" parameters; the first is the default. Types, then their parameters: "
         "name, default,\nmeaning. Samples are drawn from the filter, so each belongs to one "
         "pixel.\n\n" +
         EntriesText(kFilters);
}

}  // namespace swell
