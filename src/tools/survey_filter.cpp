/// Measures the filter over time on synthetic approaches; see --help.

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/output_file.hpp"
#include "evaluation/poses/filter_survey.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace {

using namespace window_ingress;
using evaluation::FilterSample;
using evaluation::SizeTold;

struct Options {
  int runs = 200;
  std::uint32_t seed = 1;
  std::string size = "known", output, params;
};

tools::OptionList describe(Options& o) {
  tools::OptionList add(
      "Usage: survey_filter --output DIR [options]\n"
      "Flies synthetic approaches (no images: borders with noise and lasting errors, odometry that drifts,\n"
      "attitude that is wrong) through estimator and filter and compares with the truth.\n"
      "Writes DIR/filter.csv with a row an image; prints the normalised error squared and its 95 % band.\n");
  add.required("output,o", o.output, "folder of the results");
  add("runs", o.runs, "approaches", {2, 1e5});
  add("seed", o.seed, "seed of the first approach");
  add("size", o.size, "size of the opening: known or unknown");
  add("params", o.params, tools::kParamsHelp);
  return add;
}

void write(std::ostream& out, int run, const FilterSample& s) {
  constexpr double kDegrees = 180.0 / M_PI;
  out << run << ',' << s.time_sec << ',' << s.flown_m << ',' << s.position_m.x() << ',' << s.position_m.y()
      << ',' << s.trusted << ',' << s.nees << ',' << s.position_error_m << ',' << s.yaw_error_rad * kDegrees
      << ',' << s.yaw_sigma_rad * kDegrees << ',' << s.relative_yaw_rad * kDegrees << ','
      << s.filtered_yaw_rad * kDegrees << ',';
  if (s.single_yaw_rad) out << *s.single_yaw_rad * kDegrees;
  out << ',' << s.width_error << ',' << s.width_sigma << ',' << s.apparent_width_m << ',' << s.nis << '\n';
}

/// All samples at which this distance was flown, one per run.
class AtWay {
 public:
  explicit AtWay(double share) : share_(share) {}
  void add(const std::vector<FilterSample>& run) {
    const auto at = std::find_if(run.begin(), run.end(), [&](const FilterSample& sample) {
      return sample.flown_m >= share_ * run.back().flown_m;
    });
    if (at == run.end() || !at->trusted) return;
    nees_.push_back(at->nees);
    yaw_.push_back(std::abs(at->yaw_error_rad) * 180.0 / M_PI);
    position_.push_back(at->position_error_m);
    width_.push_back(std::abs(at->width_error));
    width_squares_ += std::pow(at->width_error / at->width_sigma, 2);
  }
  void print() const {
    if (nees_.empty()) return;
    const double mean = evaluation::mean(nees_);
    const int count = static_cast<int>(nees_.size());
    const auto band = evaluation::chiSquaredBand(4, count);
    std::printf("%3.0f %% of the way | %4d | %.2f (%.2f .. %.2f) %s | %.2f | %.1f | %.2f / %.2f\n",
                100.0 * share_, count, mean, band.low, band.high,
                mean >= band.low && mean <= band.high ? "inside " : "OUTSIDE",
                evaluation::quantile(yaw_, 0.5), 100.0 * evaluation::quantile(position_, 0.5),
                100.0 * evaluation::quantile(width_, 0.5), width_squares_ / count);
  }

 private:
  double share_;
  std::vector<double> nees_, yaw_, position_, width_;
  double width_squares_ = 0.0;
};

int survey(const Options& o) {
  if (o.size != "known" && o.size != "unknown") throw InputError("--size: known or unknown");
  const auto filter = configuration::readOverlay(o.params).homography_pose.filter;
  tools::makeFolder(o.output);
  evaluation::OutputFile table(
      o.output + "/filter.csv",
      "run,time_s,flown_m,x_m,y_m,trusted,nees,position_error_m,yaw_error_deg,yaw_sigma_deg,relative_yaw_deg,"
      "filtered_yaw_deg,single_yaw_deg,width_error,width_sigma,apparent_width_m,nis");
  const SizeTold told = o.size == "known" ? SizeTold::kAll : SizeTold::kNothing;
  std::vector<AtWay> ways{AtWay(0.1), AtWay(0.25), AtWay(0.5), AtWay(0.75), AtWay(1.0)};
  double images = 0.0, nees = 0.0;
  int trusted_runs = 0;
  const auto start = std::chrono::steady_clock::now();
  tools::Progress progress("survey_filter", "approaches", o.runs);
  for (int run = 0; run < o.runs; ++run, progress.passed()) {
    const std::uint32_t seed = o.seed + static_cast<std::uint32_t>(run);
    const auto script = evaluation::drawApproach(seed, told);
    evaluation::SyntheticApproach approach(seed, script, estimation::FilterParams());
    estimation::TargetEstimator tracker(evaluation::poseParams(told), filter, {});
    const auto samples = evaluation::follow(approach, tracker, script.opening);
    for (const FilterSample& sample : samples) write(table, run, sample);
    for (AtWay& way : ways) way.add(samples);
    const auto mean = evaluation::meanNees(samples);
    nees += mean.value_or(0.0);
    trusted_runs += mean.has_value();
    images += static_cast<double>(samples.size());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("size %s, %d approaches\n", o.size.c_str(), o.runs);
  std::printf(
      "                  |  runs | NEES, mean (95 %% band of 4) | yaw [deg] | place [cm] | width [%%] / its "
      "NEES\n");
  for (const AtWay& way : ways) way.print();
  const auto band = evaluation::chiSquaredBand(4, std::max(trusted_runs, 1));
  std::printf("whole approaches  | %4d | %.2f (%.2f .. %.2f)\n", trusted_runs,
              nees / std::max(trusted_runs, 1), band.low, band.high);
  std::printf("%.0f us an image, simulation included\n", 1e6 * seconds / images);
  table.finish();
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return tools::runTool("survey_filter", argc, argv, describe, survey); }
