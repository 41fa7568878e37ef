#pragma once

#include <algorithm>
#include <optional>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Checks a track against the search. A search can be wrong in the one image in which a track starts. Over
/// several images, the place that it finds repeatedly is the right one.
///
/// A new track is on probation: every few images the search is asked as well. After
/// `TrackParams::confirmations` answers that agree, the track is confirmed. As many successive answers for
/// one other place end it. A confirmed track is checked again only while it is doubtful, and then only its
/// borders are corrected: another window never replaces it.
class TrackRecheck {
  using Quadrilateral = geometry::Quadrilateral;

 public:
  static constexpr int kEveryFrames = 2;  ///< frames between searches

  explicit TrackRecheck(const TrackParams& params) : params_(params) {}

  /// A new window is tracked.
  void start() {
    restart();
    confirmed_ = false;
  }
  /// The same window was found again, or its borders moved; keeps the confirmation.
  void restart() {
    frames_ = asked_ = for_ = against_ = 0;
    doubtful_ = false;
  }

  /// The track may be wrong: asks the search until it has confirmed the track anew.
  void doubt() { doubtful_ = true; }

  /// To be called for each image in which the whole window is tracked. \return true: ask the search
  bool isDue() {
    if (confirmed_ && !doubtful_) return false;
    if (asked_ >= kMaxQuestions * params_.confirmations) {
      const bool pauses = ++frames_ < kPauseFrames;
      if (pauses || !doubtful_) return false;
      asked_ = 0;
    }
    if (++frames_ < kEveryFrames) return false;
    frames_ = 0;
    ++asked_;
    return true;
  }

  /// \param searched the search's answer in the same image, if any; both undistorted
  /// \return true: track this answer instead
  bool prefers(const std::optional<Quadrilateral>& searched, const Quadrilateral& followed) {
    if (!searched || !geometry::isFinite(*searched)) return false;
    const double size = geometry::rootArea(followed), off = geometry::furthestCorner(*searched, followed);
    if (!(off > std::max(kAgreePx, kAgreePart * size))) {
      against_ = 0;
      if (++for_ >= params_.confirmations) confirmed_ = true, doubtful_ = false, for_ = asked_ = 0;
      return false;
    }
    if (confirmed_ && off > kSameSpot * size) return false;
    const Quadrilateral competitor = relativeTo(followed, *searched);
    against_ = against_ > 0 && geometry::furthestCorner(competitor, competitor_) < kSameCompetitor
                   ? against_ + 1
                   : 1;
    competitor_ = competitor;
    if (against_ < params_.confirmations) return false;
    restart();
    return true;
  }

  bool isConfirmed() const { return confirmed_; }

 private:
  // Corners of one window agree within the larger of these [px], [sizes].
  static constexpr double kAgreePx = 2.5, kAgreePart = 0.02;
  static constexpr double kSameCompetitor = 0.08;  // corners of one competitor in two images [sizes]
  static constexpr double kSameSpot = 0.12;        // corners of other borders of the same window [sizes]
  static constexpr int kMaxQuestions = 4;          // times the confirmations; then checks pause
  static constexpr int kPauseFrames = 60;

  static Quadrilateral relativeTo(const Quadrilateral& frame, const Quadrilateral& quad) {
    Quadrilateral relative;
    for (int i = 0; i < 4; ++i)
      relative[i] = (quad[i] - geometry::centroid(frame)) / std::max(1.0, geometry::rootArea(frame));
    return relative;
  }

  TrackParams params_;
  bool confirmed_ = false, doubtful_ = false;
  int frames_ = 0, asked_ = 0, for_ = 0, against_ = 0;
  Quadrilateral competitor_;  ///< relative to the track's centre [its sizes]
};

}  // namespace window_ingress::detection
