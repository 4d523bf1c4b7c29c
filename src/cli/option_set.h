// The options of one command: their help text, and how the values given are read.
#ifndef SWELL_CLI_OPTION_SET_H_
#define SWELL_CLI_OPTION_SET_H_

#include <CLI/CLI.hpp>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "src/base/result.h"

namespace swell {

// CLI11 splits the command line; every value is read by a function of ours, so that every error
// is one line that says what would be right.
class OptionSet {
 public:
  using Read = std::function<Status(const std::string&)>;

  OptionSet(const std::string& help, const std::string& command);

  // Arguments that are no options.
  void Positional(const char* name, std::vector<std::string>& values, const char* help);
  // An option with a value, given at most once unless `repeatable`.
  void Value(const char* name, const char* type, const char* group, const char* help, Read read,
             bool repeatable = false);
  void Flag(const char* name, bool& value, const char* group, const char* help);
  void Footer(const char* text) { app_.footer(text); }

  // True if help was asked for.
  Result<bool> Parse(const std::vector<std::string>& arguments);

  std::string HelpText() const { return app_.help(); }

 private:
  struct Option {
    std::string name;
    std::vector<std::string> values;
    Read read;
    bool repeatable;
  };

  Status ReadValues() const;
  Error UnknownOption(const std::string& argument) const;

  CLI::App app_;
  std::string command_;
  std::deque<Option> options_;  // CLI11 keeps their addresses
  std::vector<std::string> names_;
};

}  // namespace swell

#endif  // SWELL_CLI_OPTION_SET_H_
