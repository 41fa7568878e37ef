/// Whether a file may be laid over the defaults; see --help. Launch files ask before they start anything.
#include <boost/program_options.hpp>
#include <iostream>
#include <string>

#include "command_line.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace {

namespace po = boost::program_options;

struct Options {
  std::string file;
};

po::options_description describe(Options& o) {
  po::options_description description(
      "Usage: check_overlay FILE.yaml\n"
      "Whether the file can be given as config:= to launch files and as --params to tools: prints its name "
      "if each\n"
      "key is read by somebody and each value may be; else says which is not.\n"
      "Exit code: 0 it can, 2 it cannot.\n\nOptions");
  description.add_options()("help,h", "this text")("file", po::value(&o.file), "the same as FILE.yaml");
  return description;
}

int check(const Options& o) {
  if (o.file.empty()) throw window_ingress::tools::UsageError("no file given; see --help");
  window_ingress::configuration::readOverlay(o.file);
  std::cout << o.file;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  po::positional_options_description positional;
  positional.add("file", 1);
  return window_ingress::tools::runTool("check_overlay", argc, argv, describe, check, positional);
}
