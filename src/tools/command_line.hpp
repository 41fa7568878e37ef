/// Common to the command-line tools: errors, and options that need more than boost's parser.
#pragma once

#include <boost/algorithm/string/replace.hpp>
#include <boost/program_options.hpp>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// Help of --params, the same for every tool.
constexpr const char* kParamsHelp =
    "yaml file laid over the defaults, as config:= of launch files: its first level names the nodes, and the "
    "vehicle";

/// Help of --overwrite, for tools that write files a user may have changed.
constexpr const char* kOverwriteHelp = "replaces files that are there already";

/// `count` finite numbers separated by commas; 0: any count. \throws InputError that names the option
inline std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  bool good = true;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    char* end = nullptr;
    values.push_back(std::strtod(part.c_str(), &end));
    good = good && !part.empty() && *end == '\0' && std::isfinite(values.back());
  }
  const bool as_many = count == 0 ? !values.empty() : values.size() == count;
  if (!good || !as_many)
    throw InputError(option + ": '" + text + "' is not " + (count == 0 ? "" : std::to_string(count) + " ") +
                     "numbers with commas between");
  return values;
}

/// Any count of numbers, each within two bounds. \throws InputError
inline std::vector<double> numbersWithin(const std::string& option, const std::string& text, double least,
                                         double most) {
  const std::vector<double> values = numbers(option, text, 0);
  for (const double value : values)
    if (value < least || value > most)
      throw InputError(option + formatted(": needs numbers from %g to %g", least, most));
  return values;
}

/// Content of a file; empty if it cannot be read.
inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Makes the folder if it is missing. \throws InputError
inline void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) throw InputError(folder + ": cannot make this folder");
}

/// \throws InputError if two files have the same name without folder and ending, by which results are named
inline void checkNamesDiffer(const std::vector<std::string>& files) {
  std::set<std::string> names;
  for (const std::string& file : files)
    if (const auto name = std::filesystem::path(file).stem().string(); !names.insert(name).second)
      throw InputError(file + ": another file is called " + name + ", too: its results would be replaced");
}

/// \throws InputError if one of the files exists, because it may still be needed
inline void checkReplacesNothing(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files)
    if (std::filesystem::is_regular_file(file))
      throw InputError(file.string() + " is there already: --overwrite replaces it, or give another name");
}

/// Runs a tool. An exception becomes lines on stderr, one per fault, and the exit code: 2 for wrong usage or
/// unusable input, 1 for a failed job.
template <typename Body>
int runTool(const char* name, const Body& body) {
  const auto fail = [name](const std::string& what, int code) {
    std::istringstream lines(what);
    for (std::string line; std::getline(lines, line);) std::cerr << name << ": " << line << "\n";
    return code;
  };
  try {
    return body();
  } catch (const boost::program_options::too_many_positional_options_error&) {
    return fail("unexpected value: give it after its option; see --help", 2);
  } catch (const boost::program_options::error& error) {
    return fail(std::string(error.what()) + "; see --help", 2);
  } catch (const std::invalid_argument& error) {
    return fail(error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}

/// Limits of a number.
struct Bounds {
  double least, most;
};

/// The options of a tool, each bound to a variable that holds its default. A bool is a switch, a vector takes
/// any number of values; `required` takes no default.
class OptionList : public boost::program_options::options_description {
 public:
  explicit OptionList(const std::string& usage) : options_description(usage + "\n\nOptions") {
    add_options()("help,h", "this text");
  }

  void required(const char* name, std::string& variable, const std::string& text) {
    add_options()(name, boost::program_options::value(&variable)->required(), text.c_str());
  }

  template <typename Number>
  void operator()(const std::string& name, Number& number, const std::string& text, const Bounds& bounds) {
    auto* const value = boost::program_options::value(&number);
    value->default_value(number, formatted("%g", static_cast<double>(number)));
    value->notifier([name, bounds](const Number& given) {
      if (!(given >= bounds.least && given <= bounds.most))
        throw InputError(formatted("--%s: needs %g to %g", name.c_str(), bounds.least, bounds.most));
    });
    add_options()(name.c_str(), value, text.c_str());
  }

  template <typename Variable>
  void operator()(const char* name, Variable& variable, const std::string& text) {
    auto* const value = boost::program_options::value(&variable);
    if constexpr (std::is_same_v<Variable, bool>)
      value->default_value(false)->zero_tokens();
    else if constexpr (std::is_floating_point_v<Variable>)
      value->default_value(variable, formatted("%g", variable));
    else if constexpr (std::is_arithmetic_v<Variable>)
      value->default_value(variable);
    else if constexpr (!std::is_same_v<Variable, std::string>)
      value->composing()->multitoken();
    else if (!variable.empty())
      value->default_value(variable);
    add_options()(name, value, text.c_str());
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& option : options()) names.push_back(option->long_name());
    return names;
  }

  boost::program_options::positional_options_description unnamed;  ///< options given without a name
};

/// \throws InputError if --output is an input file, which would be lost
inline void checkReplacesNoInput(const boost::program_options::variables_map& given) {
  if (given.count("output") == 0) return;
  const auto& output = given["output"].as<std::string>();
  if (!std::filesystem::is_regular_file(output)) return;
  for (const auto& [name, option] : given) {
    std::vector<std::string> files;
    if (const auto* file = boost::any_cast<std::string>(&option.value())) files = {*file};
    if (const auto* several = boost::any_cast<std::vector<std::string>>(&option.value())) files = *several;
    for (const std::string& file : files)
      if (std::error_code none; name != "output" && std::filesystem::equivalent(file, output, none))
        throw InputError("--output " + output + " is also an input: give another name");
  }
}

/// The same after parsing the arguments: full names only, --seed does not stand for --seeds.
/// \param describe binds an `Options` to what --help prints
template <typename Options, typename Body>
int runTool(const char* name, int argc, char** argv, OptionList (*describe)(Options&), const Body& body) {
  return runTool(name, [&] {
    namespace po = boost::program_options;
    namespace style = po::command_line_style;
    Options options;
    const OptionList list = describe(options);
    po::command_line_parser parser(argc, argv);
    parser.options(list).positional(list.unnamed).style(style::default_style & ~style::allow_guessing);
    po::variables_map given;
    try {
      po::store(parser.run(), given);
    } catch (const po::unknown_option& error) {
      const std::string option = error.get_option_name();
      std::string meant = parameters::didYouMean(option.substr(option.find_first_not_of('-')), list.names());
      boost::replace_first(meant, "did you mean '", "did you mean '--");
      throw InputError(error.what() + meant + "; see --help");
    }
    if (given.count("help") > 0) {
      std::cout << list;
      return 0;
    }
    po::notify(given);
    checkReplacesNoInput(given);
    return body(options);
  });
}

/// Prints a progress line on stderr now and then.
class Progress {
 public:
  /// \param what unit that is counted: "images"
  Progress(std::string tool, std::string what, std::size_t total)
      : tool_(std::move(tool)), what_(std::move(what)), total_(total) {}

  void passed() {
    ++done_;
    const auto now = std::chrono::steady_clock::now();
    if (now - said_ < std::chrono::seconds(2)) return;
    said_ = now;
    const double left_sec =
        std::chrono::duration<double>(now - began_).count() * (double(total_) / double(done_) - 1.0);
    std::cerr << tool_ << ": " << done_ << " of " << total_ << " " << what_ << ", " << std::lround(left_sec)
              << " s left" << std::endl;
  }

 private:
  std::string tool_, what_;
  std::size_t total_, done_ = 0;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point said_ = began_;
};

}  // namespace window_ingress::tools
