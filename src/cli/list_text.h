// What this build supports, as text.
#ifndef SWELL_CLI_LIST_TEXT_H_
#define SWELL_CLI_LIST_TEXT_H_

#include <span>
#include <string>
#include <vector>

#include "kernels/material.h"
#include "src/stats/isa.h"

namespace swell {

std::string MaterialsText(std::span<const MaterialInfo* const> kinds);
std::string LightsText();
std::string TexturesText();
std::string ShapesText();
std::string SamplersText();
std::string FiltersText();
std::string IsasText(const std::vector<IsaInfo>& isas);

}  // namespace swell

#endif  // SWELL_CLI_LIST_TEXT_H_
