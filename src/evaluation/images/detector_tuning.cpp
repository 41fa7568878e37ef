#include "evaluation/images/detector_tuning.hpp"

#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::evaluation {
namespace {

using parameters::Field;

constexpr double kMinGain = 1e-6;
constexpr double kNotWorth = 0.003;                         // of merit: a change that gains less is undone
constexpr double kLargestFactor = 5.0, kLargestPart = 0.5;  // of a move: factor, part of the range

/// One move of one field, which can be repeated.
struct Move {
  std::size_t field = 0;
  double factor = 1.0, summand = 0.0;
};

class Search {
 public:
  Search(const std::vector<LabelledImage>& samples, const detection::DetectorParams& start,
         const detection::ReferenceAppearance* reference, const TuningOptions& options,
         const TuningProgress& progress)
      : samples_(samples),
        reference_(reference),
        progress_(progress),
        params_(start),
        trials_(options.trials),
        random_(options.seed) {
    const auto all = parameters::fieldsOf(params_);
    for (const std::string& name : options.names) {
      const Field* field = parameters::find(all, name);
      if (!field) throw std::invalid_argument("the detector has no parameter '" + name + "'");
      fields_.push_back(*field);
      start_.push_back(field->get());
    }
    if (samples.empty() || fields_.empty())
      throw std::invalid_argument("nothing to tune, or nothing to tune on");
    best_ = countDetections(samples_, params_, reference_);
    start_merit_ = best_.merit();
  }

  detection::DetectorParams run() {
    std::optional<Move> again;
    while (done_ < trials_) {
      const Move move = again ? *again : draw();
      again = tries(move) ? std::optional<Move>(move) : std::nullopt;
    }
    takeBackWhatIsNotNeeded();
    return params_;
  }

 private:
  double uniform(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }

  // Positive numbers move by a factor, others by a part of their range.
  Move draw() {
    Move move;
    move.field = random_() % fields_.size();
    const Field& field = fields_[move.field];
    if (field.isSwitch())
      move.factor = -1.0, move.summand = 1.0;
    else if (field.get() > 0.0 && uniform(0.0, 1.0) < 0.7)
      move.factor = std::exp(uniform(-1.0, 1.0) * std::log(kLargestFactor));
    else
      move.summand = uniform(-kLargestPart, kLargestPart) * (field.maximum - field.minimum);
    if (field.isWhole()) move.summand += move.factor < 1.0 || move.summand < 0.0 ? -0.5 : 0.5;
    return move;
  }

  bool tries(const Move& move) {
    const Field& field = fields_[move.field];
    const double before = field.get();
    field.set(move.factor * before + move.summand);
    ++done_;
    const bool better = field.get() != before && reaches(best_.merit() + kMinGain);
    if (!better) field.set(before);
    progress_(done_, best_);
    return better;
  }

  bool reaches(double merit) {
    const DetectionCounts counts = countDetections(samples_, params_, reference_);
    if (counts.merit() < merit) return false;
    best_ = counts;
    return true;
  }

  void takeBackWhatIsNotNeeded() {
    const double enough = std::max(start_merit_, best_.merit() - kNotWorth);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const double tuned = fields_[i].get();
      if (tuned == start_[i]) continue;
      fields_[i].set(start_[i]);
      if (!reaches(enough)) fields_[i].set(tuned);
    }
  }

  const std::vector<LabelledImage>& samples_;
  const detection::ReferenceAppearance* reference_;
  const TuningProgress& progress_;
  detection::DetectorParams params_;
  std::vector<Field> fields_;  // refer to params_
  std::vector<double> start_;
  double start_merit_ = 0.0;
  DetectionCounts best_;
  int trials_, done_ = 0;
  std::mt19937 random_;
};

}  // namespace

std::vector<std::string> usualFields() {
  return {"preprocess/search_side_px",
          "preprocess/blur_sigma_px",
          "preprocess/equalise",
          "edges/high_quantile",
          "edges/low_ratio",
          "edges/floor",
          "edges/ceiling",
          "lines/min_length",
          "lines/min_density",
          "closing/radius",
          "contours/epsilon",
          "segment_quads/extension",
          "segment_quads/min_coverage",
          "min_score",
          "min_score_reference",
          "min_correlation"};
}

detection::DetectorParams tuneDetector(const std::vector<LabelledImage>& samples,
                                       const detection::DetectorParams& start,
                                       const detection::ReferenceAppearance* reference,
                                       const TuningOptions& options, const TuningProgress& progress) {
  return Search(samples, start, reference, options, progress).run();
}

}  // namespace window_ingress::evaluation
