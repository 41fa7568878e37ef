/// Trackbars over the detector's stages, on images, a bag or a live camera; saves the yaml that nodes and
/// tools load. See --help.
#include <iostream>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/images/reference_source.hpp"
#include "command_line.hpp"
#include "display.hpp"
#include "evaluation/statistics.hpp"
#include "params_file.hpp"
#include "slider.hpp"
#include "tuning.hpp"
#include "value_table.hpp"
#include "window_ingress/text/text.hpp"

namespace {

using namespace window_ingress;
using parameters::Field;
using tools::Bench;

const char *const kStages = "stages", *const kSliders = "parameters";
const char* const kKeys =
    "keys: g/G next or previous group of parameters, n/p next or previous image, d defaults of this group, s "
    "save, h these keys, q or Esc quit";

struct Job {
  std::string source, output, params, corners, topic, sheet;
  adapters::ReferenceParams reference;
  std::vector<std::string> settings;
  int every = 10, most = 100, width = 400;
  bool headless = false, overwrite = false;
};

tools::OptionList describe(Job& job) {
  tools::OptionList add(
      std::string("Usage: tune_detector SOURCE --output OVERLAY.yaml [OPTION...]\n"
                  "SOURCE: an image, a folder of images, a bag, or a topic of images (begins with '/').\n") +
      kKeys);
  add("source", job.source, "see above");
  add("output", job.output, "yaml file with the detector's values that differ from the defaults");
  add("overwrite", job.overwrite, tools::kOverwriteHelp);
  add("params", job.params, tools::kParamsHelp);
  add.add_options()("set", boost::program_options::value(&job.settings)->composing(),
                    "NAME=VALUE, like edges/floor=4.5; may be repeated");
  add("reference", job.reference.picture, "image of the target");
  add("reference-corners", job.corners, "x1,y1,...,x4,y4: inner border of the opening in it");
  add("image", job.topic, "topic of the images in a bag; default: the only one");
  add("every", job.every, "use every N-th image of a bag", {1, 1e6});
  add("most", job.most, "maximum number of images from a bag", {1, 1e6});
  add("width", job.width, "width of each image on the sheet of stages [px]", {64, 4096});
  add("headless", job.headless, "no windows: look at all images once, print, save");
  add("sheet", job.sheet, "headless: also write the sheet of stages of the first image");
  add.unnamed.add("source", 1);
  return add;
}

void save(const std::string& file, const Bench& bench) {
  if (file.empty()) throw InputError("--output is missing: where to save");
  const std::string about =
      "tune_detector: the detector's values that differ from the defaults, without the reference. Put them "
      "into the file of config:=; tools take this file as --params.";
  const std::string overlay = tools::saveParams(file, about, bench.params());
  std::cout << "written: " << file << "\n" << overlay << std::flush;
}

int runHeadless(const Job& job, tools::TuningSource& source, Bench& bench) {
  if (source.count() == 0) throw InputError("--headless needs images or a bag");
  std::vector<double> milliseconds;
  int found = 0;
  for (int i = 0; i < source.count(); ++i, source.step(1)) {
    std::cout << source.name() << ": " << bench.look(source.image()) << "\n";
    milliseconds.push_back(bench.milliseconds());
    found += bench.found();
  }
  std::cout << formatted("windows in %d of %d images, median %.1f ms\n", found, source.count(),
                         evaluation::quantile(milliseconds, 0.5));
  if (!job.sheet.empty() && !cv::imwrite(job.sheet, bench.sheet(source.image(), job.width)))
    throw InputError(job.sheet + ": cannot be written");
  if (!job.output.empty()) save(job.output, bench);
  return 0;
}

/// Two windows: the sheet of stages, and a slider for each parameter of one group.
class Desk {
 public:
  Desk(const Job& job, tools::TuningSource& source, Bench& bench)
      : job_(job), source_(source), bench_(bench) {
    for (const Field& field : bench.fields()) {
      const std::string group = groupOf(field);
      if (groups_.empty() || groups_.back() != group) groups_.push_back(group);
    }
    std::cout << kKeys << std::endl;
    cv::namedWindow(kStages, cv::WINDOW_AUTOSIZE);
    open(0);
  }

  int run() {
    for (;;) {
      show();
      const int key = cv::waitKey(30) & 0xff;
      if (key == 'q' || key == 27) return quit();
      press(static_cast<char>(key));
    }
  }

 private:
  int quit() const {
    if (is_changed_) std::cout << "the last changes were not saved" << std::endl;
    return 0;
  }

  struct Bar {
    const Field* field;
    tools::Slider slider;
    Desk* desk;
  };

  static std::string groupOf(const Field& field) {
    const std::size_t end = field.name.find('/');
    return end == std::string::npos ? "scores" : field.name.substr(0, end);
  }

  static void moved(int position, void* at) {
    const Bar& bar = *static_cast<const Bar*>(at);
    if (bar.slider.positionOf(bar.field->get()) == position) return;
    bar.field->set(bar.slider.valueAt(position));
    const auto unit = tools::unitOf(bar.field->name);
    std::cout << bar.field->name << ": " << parameters::toText(*bar.field) << (unit.empty() ? "" : " " + unit)
              << std::endl;
    bar.desk->dirty_ = bar.desk->is_changed_ = true;
    bar.desk->bench_.changed();
  }

  void open(int group) {
    if (!bars_.empty()) cv::destroyWindow(kSliders);
    group_ = (group + static_cast<int>(groups_.size())) % static_cast<int>(groups_.size());
    cv::namedWindow(kSliders, cv::WINDOW_AUTOSIZE);
    bars_.clear();
    for (const Field& field : bench_.fields())
      if (groupOf(field) == groups_[static_cast<std::size_t>(group_)])
        bars_.push_back({&field, tools::Slider(field), this});
    for (Bar& bar : bars_) {
      cv::createTrackbar(bar.field->name, kSliders, nullptr, bar.slider.positions(), moved, &bar);
      cv::setTrackbarPos(bar.field->name, kSliders, bar.slider.positionOf(bar.field->get()));
    }
    cv::setWindowTitle(kSliders,
                       "parameters: " + groups_[static_cast<std::size_t>(group_)] + " (g: next group)");
    dirty_ = true;
  }

  void press(char key) {
    if (key == 'g' || key == 'G') open(group_ + (key == 'g' ? 1 : -1));
    if (key == 'n' || key == 'p') source_.step(key == 'n' ? 1 : -1), dirty_ = true;
    if (key == 'd') restoreDefaults();
    if (key == 's') save(job_.output, bench_), is_changed_ = false;
    if (key == 'h') std::cout << kKeys << std::endl;
  }

  void restoreDefaults() {
    detection::DetectorParams defaults;
    const auto fields = parameters::fieldsOf(defaults);
    for (const Bar& bar : bars_) bar.field->set(parameters::find(fields, bar.field->name)->get());
    is_changed_ = true;
    bench_.changed();
    open(group_);
  }

  void show() {
    const cv::Mat image = source_.image();
    if (image.empty() || (!dirty_ && source_.count() > 0)) return;
    dirty_ = false;
    const std::string line = bench_.look(image);
    cv::Mat sheet = bench_.sheet(image, job_.width);
    cv::copyMakeBorder(sheet, sheet, 0, 26, 0, 0, cv::BORDER_CONSTANT, cv::Scalar::all(24));
    cv::putText(sheet, line, {8, sheet.rows - 8}, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(255), 1,
                cv::LINE_AA);
    std::vector<const Field*> shown;
    for (const Bar& bar : bars_) shown.push_back(bar.field);
    cv::imshow(kSliders, tools::valueTable(shown));
    cv::imshow(kStages, sheet);
    cv::setWindowTitle(kStages, source_.name());
  }

  const Job& job_;
  tools::TuningSource& source_;
  Bench& bench_;
  std::vector<std::string> groups_;
  std::vector<Bar> bars_;
  int group_ = 0;
  bool dirty_ = true;        ///< what is shown is not up to date
  bool is_changed_ = false;  ///< since the last save
};

int run(Job job) {
  if (job.source.empty()) throw InputError("no SOURCE given; see --help");
  if (!job.headless && job.output.empty())
    throw InputError("--output is missing: where 's' saves; see --help");
  if (!job.overwrite) tools::checkReplacesNothing({job.output, job.sheet});
  if (!job.corners.empty()) job.reference.corners = tools::numbers("--reference-corners", job.corners, 8);
  auto start = tools::readParams(job.params, job.reference.picture, job.reference.corners);
  const auto fields = parameters::fieldsOf(start);
  for (const std::string& setting : job.settings) parameters::assign(fields, setting);
  std::optional<detection::ReferenceAppearance> reference;
  if (!job.reference.picture.empty()) reference = adapters::loadReference(job.reference, start);
  const auto source = tools::openSource(job.source, job.topic, job.every, job.most);
  Bench bench(start, reference);
  if (const auto doubt = tools::doubtOf(job.reference.picture, job.reference.corners); !doubt.empty())
    std::cout << "warning: " << doubt << std::endl;
  if (job.headless) return runHeadless(job, *source, bench);
  if (!tools::hasDisplay())
    throw InputError("there is no display for the trackbars; --headless --set NAME=VALUE does without");
  return Desk(job, *source, bench).run();
}

}  // namespace

int main(int argc, char** argv) {
  return tools::runTool("tune_detector", [&] {
    ros::init(argc, argv, "tune_detector",
              ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
    return tools::runTool("tune_detector", argc, argv, describe, run);
  });
}
