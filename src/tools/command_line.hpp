/// What the command-line tools share: their errors, and options that need more than boost's parser.
#pragma once

#include <boost/program_options/errors.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// Of --params, the same for every tool.
constexpr const char* kParamsHelp =
    "yaml file laid over the defaults, as config:= of launch files: its first level names the nodes, and the "
    "vehicle";

/// `count` finite numbers with commas between, any number of them for 0. \throws InputError that names the
/// option
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

/// Any number of them, each between two bounds. \throws InputError
inline std::vector<double> numbersWithin(const std::string& option, const std::string& text, double least,
                                         double most) {
  const std::vector<double> values = numbers(option, text, 0);
  for (const double value : values)
    if (value < least || value > most)
      throw InputError(option + formatted(": needs numbers from %g to %g", least, most));
  return values;
}

/// Makes the folder if it is missing. \throws InputError
inline void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) throw InputError(folder + ": cannot make this folder");
}

/// Runs a tool. What it throws becomes a line on stderr, one for each fault, and the exit code: 2 for wrong
/// usage and for input that cannot be used, 1 for a job that failed.
template <typename Body>
int runTool(const char* name, const Body& body) {
  const auto fail = [name](const std::string& what, int code) {
    std::istringstream lines(what);
    for (std::string line; std::getline(lines, line);) std::cerr << name << ": " << line << "\n";
    return code;
  };
  try {
    return body();
  } catch (const boost::program_options::error& error) {
    return fail(std::string(error.what()) + "; see --help", 2);
  } catch (const std::invalid_argument& error) {
    return fail(error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}

/// The arguments by their names, whole ones: --seed is not taken for --seeds. Throws boost's errors.
inline boost::program_options::variables_map parsed(
    int argc, char** argv, const boost::program_options::options_description& description,
    const boost::program_options::positional_options_description& positional = {}) {
  namespace options = boost::program_options;
  namespace style = options::command_line_style;
  options::variables_map given;
  options::store(options::command_line_parser(argc, argv)
                     .options(description)
                     .positional(positional)
                     .style(style::default_style & ~style::allow_guessing)
                     .run(),
                 given);
  return given;
}

/// The same, with the arguments taken apart first.
/// \param describe binds an `Options` to their description, which --help prints
/// \param positional options that need no name
template <typename Options, typename Body>
int runTool(const char* name, int argc, char** argv,
            boost::program_options::options_description (*describe)(Options&), const Body& body,
            const boost::program_options::positional_options_description& positional = {}) {
  return runTool(name, [&] {
    Options options;
    const auto description = describe(options);
    auto given = parsed(argc, argv, description, positional);
    if (given.count("help") > 0) {
      std::cout << description;
      return 0;
    }
    boost::program_options::notify(given);
    return body(options);
  });
}

}  // namespace window_ingress::tools
