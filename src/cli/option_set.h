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

  // `positional` is how the arguments that are no options are written: "SCENE...".
  OptionSet(const std::string& help, const std::string& command, const char* positional,
            const char* positional_help);

  // An option with a value, given at most once unless `repeatable`.
  void Value(const char* name, const char* type, const char* group, const char* help, Read read,
             bool repeatable = false);
  void Flag(const char* name, bool& value, const char* group, const char* help);
  void Footer(const char* text) { app_.footer(text); }

  // True if help was asked for.
  Result<bool> Parse(const std::vector<std::string>& arguments);

  // After Parse.
  const std::vector<std::string>& positionals() const { return positionals_; }

  std::string HelpText() const;

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
  std::vector<std::string> positionals_;
  std::deque<Option> options_;  // CLI11 keeps their addresses
  std::vector<std::string> names_;
};

}  // namespace swell

#endif  // SWELL_CLI_OPTION_SET_H_
