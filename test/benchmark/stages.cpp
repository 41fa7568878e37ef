#include <memory>
#include <opencv2/imgproc.hpp>

#include "detection/candidates/candidate_search.hpp"
#include "subjects.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace window_ingress::bench {
namespace {

using namespace window_ingress::detection;

/// The stages in the order of the search, each with the results of those before it, on the first image.
struct Stages {
  explicit Stages(const Sequence& from) : sequence(from), image(from.images.front()) {
    level = preprocess(image, params.preprocess);
    map = cannyEdges(level.image, params.edges);
    segments = lines.run(runs.run(map, nullptr), map.edges.size());
    dilation_px = closeGaps(map.edges, params.closing, closed);
    rivals = search.run(image, nullptr, trace);
  }

  const Sequence& sequence;
  cv::Mat image;
  DetectorParams params;
  EdgeChains runs;
  HoughSegments lines{params.lines};
  SegmentQuads quads{params.segment_quads};
  CandidateSearch search{params};
  SearchLevel level;
  EdgeMap map;
  std::vector<Segment> segments;
  cv::Mat closed;
  int dilation_px = 0;
  DetectionTrace trace;
  std::vector<ScoredCandidate> rivals;
};

bool runPreprocess(Stages& s) { return !preprocess(s.image, s.params.preprocess).image.empty(); }
bool runEdges(Stages& s) { return !cannyEdges(s.level.image, s.params.edges).edges.empty(); }
bool runLines(Stages& s) { return !s.lines.run(s.runs.run(s.map, nullptr), s.map.edges.size()).empty(); }
bool runClosing(Stages& s) { return closeGaps(s.map.edges, s.params.closing, s.closed) > 0; }
bool runContours(Stages& s) {
  Outlines outlines;
  addOutlines(s.closed, s.dilation_px, s.params.contours, CandidateSource::kContour, outlines);
  return !outlines.candidates.empty();
}
bool runSegmentQuads(Stages& s) {
  return !s.quads.run(s.segments, s.params.gates.min_area * s.level.image.size().area(), SegmentQuads::kQuick)
              .candidates.empty();
}
bool runHalfSearch(Stages& s) {
  s.trace = DetectionTrace();
  return !s.search.run(s.image, nullptr, s.trace).empty();
}
bool runAppearance(Stages& s) {
  bool compared = false;
  for (const ScoredCandidate& rival : s.rivals)
    compared |= s.sequence.reference->compare(s.image, rival.quad, s.params.appearance).has_value();
  return compared;
}
bool runBorders(Stages& s) {
  double inliers = 0.0;
  return refineBorders(s.image, {s.rivals.front().quad, 2.5}, s.sequence.cameraOrNull(), &inliers)
      .has_value();
}

using Run = bool (*)(Stages&);

Subject stage(const char* name, Run run, bool (*applies)(const Stages&) = nullptr) {
  return {std::string("stage_") + name, [run, applies](const Sequence& sequence) -> Step {
            auto stages = std::make_shared<Stages>(sequence);
            if (applies && !applies(*stages)) return {};
            return [run, stages] { return run(*stages); };
          }};
}

}  // namespace

std::vector<Subject> ownStages() {
  const auto has_reference = [](const Stages& s) { return s.sequence.reference.has_value(); };
  const auto has_rival = [](const Stages& s) { return !s.rivals.empty(); };
  return {stage("preprocess", runPreprocess),
          stage("edges", runEdges),
          stage("lines", runLines),
          stage("closing", runClosing),
          stage("contours", runContours),
          stage("segment_quads", runSegmentQuads),
          stage("all_to_candidates", runHalfSearch),
          stage("appearance_of_all", runAppearance, has_reference),
          stage("borders_of_one", runBorders, has_rival)};
}

}  // namespace window_ingress::bench
