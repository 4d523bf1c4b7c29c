// Command line words in, values read or one line of error out.
#include "src/cli/option_set.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "src/base/suggest.h"

namespace swell {
namespace {

// CLI11's layout without its marks for "may be repeated", which most options may not.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) {}

  std::string make_usage(const CLI::App*, std::string) const override {
    return "\nUsage: " + usage_ + "\n";
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_positional()) return "";
    const std::string type = option->get_type_name();
    return type.empty() ? "" : " " + type;
  }

 private:
  std::string usage_;
};

}  // namespace

OptionSet::OptionSet(const std::string& help, const std::string& command, const char* positional,
                     const char* positional_help)
    : app_(help, "swell " + command), command_(command) {
  app_.allow_extras();
  app_.set_help_flag("-h,--help", "this text");
  app_.add_option(positional, positionals_, positional_help)->type_name("");
  const auto formatter =
      std::make_shared<HelpFormatter>("swell " + command + " " + positional + " [OPTIONS]");
  formatter->column_width(34);
  app_.formatter(formatter);
}

void OptionSet::Value(const char* name, const char* type, const char* group, const char* help,
                      Read read, bool repeatable) {
  options_.push_back({name, {}, std::move(read), repeatable});
  names_.push_back(name);
  app_.add_option(name, options_.back().values, help)
      ->type_name(type)
      ->group(group)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

void OptionSet::Flag(const char* name, bool& value, const char* group, const char* help) {
  names_.push_back(name);
  app_.add_flag(name, value, help)->group(group);
}

std::string OptionSet::HelpText() const {
  std::string text = app_.help();
  for (size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

Result<bool> OptionSet::Parse(const std::vector<std::string>& arguments) {
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants it
  try {
    app_.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    return true;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    return Error{"option '" + text.substr(0, text.find(':')) + "' needs a value"};
  } catch (const CLI::Error& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return Error{text};
  }
  for (const std::string& extra : app_.remaining()) {
    if (extra == "--") continue;  // ends the options; CLI11 keeps it
    if (extra.size() > 1 && extra[0] == '-') return UnknownOption(extra);
    return Error{"unexpected argument '" + extra + "'"};
  }
  if (Status read = ReadValues(); !read) return read.error();
  return false;
}

Status OptionSet::ReadValues() const {
  for (const Option& option : options_) {
    if (option.values.size() > 1 && !option.repeatable) {
      return Error{"option '" + option.name + "' is given twice"};
    }
    for (const std::string& value : option.values) {
      if (Status read = option.read(value); !read) {
        return Error{option.name + ": " + read.error().message};
      }
    }
  }
  return Done{};
}

Error OptionSet::UnknownOption(const std::string& argument) const {
  const std::string name = argument.substr(0, argument.find('='));
  std::vector<std::string_view> known(names_.begin(), names_.end());
  known.push_back("--help");
  std::string close = DidYouMean(name, known);
  if (close.empty()) close = "; see 'swell " + command_ + " --help'";
  return Error{"unknown option '" + name + "'" + close};
}

}  // namespace swell
