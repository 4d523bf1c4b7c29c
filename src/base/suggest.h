// A misspelt word and the words that exist -> "; did you mean 'diffuse'?".
#ifndef SWELL_BASE_SUGGEST_H_
#define SWELL_BASE_SUGGEST_H_

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace swell {

// Insertions, deletions, replacements and swaps of neighbours that make `a` of `b`, ignoring case.
size_t EditDistance(std::string_view a, std::string_view b);

// "; did you mean 'X'?" for the nearest candidate, or "" if none is near.
std::string DidYouMean(std::string_view word, const std::vector<std::string_view>& candidates);

// "a, b, c", sorted.
std::string ListOf(std::vector<std::string_view> words);

// "; did you mean 'X'? (known: X, Y)", or without the question if none is near.
std::string KnownWords(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace swell

#endif  // SWELL_BASE_SUGGEST_H_
