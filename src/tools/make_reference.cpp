/// Makes the operator's reference from an image of the target: four corners, clicked or given. See --help.
#include <boost/program_options.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "adapters/images/reference_source.hpp"
#include "adapters/sources/parameters.hpp"
#include "command_line.hpp"
#include "corner_clicks.hpp"
#include "corner_fit.hpp"
#include "display.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace {

namespace fs = std::filesystem;
namespace options = boost::program_options;
using namespace window_ingress;

struct Job {
  std::string image, output = "reference.png", corners, params;
  bool fit = false;
};

options::options_description describe(Job& job) {
  options::options_description description(
      "Usage: make_reference IMAGE [OPTION...]\n"
      "Writes the image, a yaml file of the same name for config:=, and NAME_understood.png, which shows the "
      "inner border and the regions whose colours are compared.\nWithout --corners a window opens: click the "
      "four inner corners of the opening, top left first, then clockwise; drag to correct,\nf: fit them to "
      "the edges, u: undo, Enter: save, q: quit.\n\nOptions");
  description.add_options()("help", "print this text")                                             //
      ("picture", options::value(&job.image), "photograph of the target with some wall round it")  //
      ("output", options::value(&job.output)->default_value(job.output), "image to write")         //
      ("corners", options::value(&job.corners),
       "x1,y1,...,x4,y4 instead of clicking; pixel centres are integers")                //
      ("fit", options::bool_switch(&job.fit), "fit the corners to the edges near them")  //
      ("params", options::value(&job.params), tools::kParamsHelp);
  return description;
}

int run(const Job& job) {
  if (job.image.empty()) throw InputError("no image given; see --help");
  if (std::error_code none; fs::equivalent(job.image, job.output, none))
    throw InputError("--output " + job.output + " is the photograph itself; give another name");
  const auto params = configuration::readOverlay(job.params).window_detector.detector;
  cv::Mat image;
  if (fs::exists(job.image)) image = cv::imread(job.image, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (image.empty()) throw InputError(job.image + ": cannot be read as an image");
  std::vector<double> corners;
  if (!job.corners.empty()) {
    corners = tools::numbers("--corners", job.corners, 8);
  } else {
    if (!tools::hasDisplay())
      throw InputError("there is no display to click in: give --corners x1,y1,...,x4,y4");
    const auto clicked = tools::CornerClicks(image).run();
    if (!clicked) throw std::runtime_error("given up, nothing written");
    corners = *clicked;
  }
  if (job.fit) {
    const auto fit = tools::fitted(image, corners);
    if (fit.corners.empty())
      throw std::runtime_error("not fitted: " + fit.said + "; mend the corners, or leave out --fit");
    std::cout << "moved by the fit: " << fit.said << "\n";
    corners = fit.corners;
  }
  const auto reference = adapters::makeReference(image, corners, params);
  const auto beside = tools::besideEdges(image, corners);
  if (beside.corners.empty())
    std::cerr << "make_reference: warning: " << beside.said << "\n";
  else
    std::cout << beside.said << "\n";
  adapters::saveReference(job.output, reference);
  const fs::path written = fs::absolute(job.output);
  const char* const called_by = std::getenv("WINDOW_INGRESS_RUN");  // scripts/run, as the user called it
  std::cout << "written: " << written.string() << "\nlook at: "
            << (written.parent_path() / (written.stem().string() + "_understood.png")).string()
            << "\nuse it:  " << (called_by ? called_by + std::string(" ") : "")
            << "roslaunch window_ingress ingress.launch config:="
            << fs::path(written).replace_extension(".yaml").string() << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return tools::runTool("make_reference", argc, argv, describe, run,
                        options::positional_options_description().add("picture", 1));
}
