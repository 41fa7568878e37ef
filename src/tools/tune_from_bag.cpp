/// Fits detector thresholds to images with known windows, and reports the benefit on other images. See
/// --help.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "adapters/bags/bag_reading.hpp"
#include "adapters/images/reference_source.hpp"
#include "command_line.hpp"
#include "evaluation/images/detector_tuning.hpp"
#include "params_file.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace {

using namespace window_ingress;
using evaluation::DetectionCounts;
using parameters::fieldsOf;

struct Job {
  std::vector<std::string> bags;
  adapters::BagTopics topics;
  std::string size, labels, images, corners, params, names, output;
  adapters::ReferenceParams reference;
  int every = 1, trials = 120;
  std::uint32_t seed = 1;
  double held_out = 0.4;
  bool overwrite = false;
};

using Images = std::vector<evaluation::LabelledImage>;

tools::OptionList describe(Job& job) {
  tools::OptionList add(
      "Usage: tune_from_bag --output OVERLAY.yaml --labels FILE.csv --images FOLDER [OPTION...]\n"
      "       tune_from_bag --output OVERLAY.yaml --bag FILE.bag... --truth TOPIC --window-size W,H "
      "[OPTION...]\n"
      "Tries detector settings on some of the images. If they are also better on the held-out rest, writes all "
      "values that differ from the defaults.\nExit code: 0 better and written, 1 not better, nothing written, 2 wrong "
      "usage or unreadable input.");
  add.required("output", job.output, "yaml file for them, to be given as config:= and --params");
  add("overwrite", job.overwrite, tools::kOverwriteHelp);
  add("labels", job.labels, "csv with columns file, x1, y1 .. x4, y4 (no numbers: no window)");
  add("images", job.images, "folder of the images that the csv names");
  add("bag", job.bags, "bags with images, calibration and truth");
  add("truth", job.topics.truth, "PoseStamped with the true T_camera_window, by stamp");
  add("window-size", job.size, "W,H: inner size of the opening [m]");
  add("image", job.topics.image, "topic; default: the only one of its type");
  add("camera-info", job.topics.camera_info, "topic; default: the only one of its type");
  add("every", job.every, "use every N-th image of a bag", {1, 1e6});
  add("reference", job.reference.picture, "image of the target");
  add("reference-corners", job.corners, "x1,y1,...,x4,y4: inner border of the opening in it");
  add("params", job.params, tools::kParamsHelp);
  add("names", job.names, "parameters that may be changed, with commas between, like edges/floor");
  add("trials", job.trials, "settings to try", {1, 1e6});
  add("held-out", job.held_out, "share of the groups that is used for judging only", {0.01, 0.99});
  add("seed", job.seed, "seed of the split and of the search");
  return add;
}

std::vector<std::string> namesOf(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names.empty() ? evaluation::usualFields() : names;
}

void check(const Job& job) {
  if (job.labels.empty() == job.bags.empty()) throw InputError("give either --labels or --bag; see --help");
  if (job.labels.empty() != job.images.empty()) throw InputError("--labels and --images go together");
  if (!job.bags.empty() && (job.topics.truth.empty() || job.size.empty()))
    throw InputError("--bag needs --truth and --window-size: they are the ground truth");
  if (!job.corners.empty() && job.reference.picture.empty())
    throw InputError("--reference-corners needs --reference");
  if (!job.overwrite) tools::checkReplacesNothing({job.output});
}

Images read(const Job& job) {
  if (!job.labels.empty()) return evaluation::readLabelled(job.labels, job.images);
  const auto size = tools::numbers("--window-size", job.size, 2);
  if (!(size[0] > 0.0 && size[1] > 0.0)) throw InputError("--window-size: metres above 0");
  Images samples;
  for (const std::string& file : job.bags) {
    rosbag::Bag bag;
    adapters::openBag(bag, file);
    const auto found =
        adapters::labelledImages(bag, adapters::chooseTopics(bag, job.topics), {size[0], size[1]}, job.every);
    samples.insert(samples.end(), found.begin(), found.end());
  }
  return samples;
}

std::string diff(const detection::DetectorParams& start, const detection::DetectorParams& tuned) {
  detection::DetectorParams before = start, after = tuned;
  const auto old = fieldsOf(before), now = fieldsOf(after);
  std::string text;
  for (const auto& field : parameters::changed(now, old))
    text += "- " + field.name + ": " + parameters::toText(*parameters::find(old, field.name)) + "\n+ " +
            field.name + ": " + parameters::toText(field) + "\n";
  return text;
}

struct Judged {
  DetectionCounts tuned_on, held_out;
  double milliseconds;  ///< an image held out
};

Judged judge(const Images& tuning, const Images& held, const detection::DetectorParams& params,
             const detection::ReferenceAppearance* reference) {
  const auto begun = std::chrono::steady_clock::now();
  const DetectionCounts held_out = evaluation::countDetections(held, params, reference);
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begun;
  return {evaluation::countDetections(tuning, params, reference), held_out,
          spent.count() / std::max<double>(1.0, held.size())};
}

int run(const Job& job) {
  check(job);
  adapters::ReferenceParams wanted = job.reference;
  if (!job.corners.empty()) wanted.corners = tools::numbers("--reference-corners", job.corners, 8);
  const auto start = tools::readParams(job.params, wanted.picture, wanted.corners);
  std::optional<detection::ReferenceAppearance> reference;
  if (!wanted.picture.empty()) reference = adapters::loadReference(wanted, start);
  const detection::ReferenceAppearance* const given = reference ? &*reference : nullptr;

  const auto [tuning, held] = evaluation::split(read(job), job.held_out, job.seed);
  std::printf("%zu images to tune on, %zu held out (groups drawn with seed %u)\n", tuning.size(), held.size(),
              job.seed);
  if (std::all_of(tuning.begin(), tuning.end(), [](const auto& image) { return image.targets.empty(); }))
    throw InputError(
        "no image to tune on shows a labelled window: label more, or draw other groups with --seed");
  const evaluation::TuningOptions search{namesOf(job.names), job.trials, job.seed};
  auto printed = std::chrono::steady_clock::now();
  const auto progress = [&](int done, const DetectionCounts& best) {
    const auto now = std::chrono::steady_clock::now();
    if (done < job.trials && now - printed < std::chrono::seconds(2)) return;
    printed = now;
    std::fprintf(stderr, "tune_from_bag: %d of %d settings tried; best F1 %.3f\n", done, job.trials,
                 best.f1());
  };
  const detection::DetectorParams tuned = evaluation::tuneDetector(tuning, start, given, search, progress);

  if (const auto doubt = tools::doubtOf(wanted.picture, wanted.corners); !doubt.empty())
    std::fprintf(stderr, "tune_from_bag: warning: %s\n", doubt.c_str());
  const Judged before = judge(tuning, held, start, given), after = judge(tuning, held, tuned, given);
  std::printf("tuned on, before: %s\ntuned on, after:  %s\n", before.tuned_on.text().c_str(),
              after.tuned_on.text().c_str());
  std::printf("held out, before: %s, %.1f ms an image\nheld out, after:  %s, %.1f ms an image\n",
              before.held_out.text().c_str(), before.milliseconds, after.held_out.text().c_str(),
              after.milliseconds);
  const std::string changes = diff(start, tuned);
  std::printf("%s", changes.c_str());
  const bool is_better = after.tuned_on.f1() > before.tuned_on.f1();
  if (changes.empty() || !is_better || after.held_out.f1() <= before.held_out.f1()) {
    std::printf("%s: nothing written\n", changes.empty() || !is_better ? "no setting was better"
                                                                       : "not better on the images held out");
    return 1;
  }
  tools::saveParams(
      job.output,
      "tune_from_bag. Held out: " + after.held_out.text() + "; before: " + before.held_out.text() + ".",
      tuned);
  std::printf("written: %s\n", job.output.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return tools::runTool("tune_from_bag", argc, argv, describe, run); }
