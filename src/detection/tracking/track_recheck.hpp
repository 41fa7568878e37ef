#pragma once

#include <optional>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Whether a track follows what the search finds. A search can be wrong in the one image in which a track
/// starts; over several images the place that it finds again and again is the right one.
///
/// A new track is on probation: every few images the search is asked as well. As many answers as
/// `TrackParams::confirmations` that agree confirm it; as many in a row that name one other place end it. A
/// confirmed track is asked about again only while it is doubtful, and then only its borders are corrected:
/// another window never takes its place.
class TrackRecheck {
 public:
  static constexpr int kEveryFrames = 2;  ///< frames between searches that are asked

  explicit TrackRecheck(const TrackParams& params) : params_(params) {}

  void start();    ///< a new window is followed
  void restart();  ///< the same window again, or its borders elsewhere: what is confirmed remains so

  /// Something else says that the track may be wrong: the search is asked until it has confirmed it anew.
  void doubt() { doubtful_ = true; }

  /// Called in each image in which the window is followed whole. \return true: ask the search
  bool isDue();
  /// \param searched its answer in the same image, if it has one; both undistorted
  /// \return true: it is to be followed in place of the track
  bool prefers(const std::optional<geometry::Quadrilateral>& searched,
               const geometry::Quadrilateral& followed);

  bool isConfirmed() const { return confirmed_; }

 private:
  TrackParams params_;
  bool confirmed_ = false, doubtful_ = false;
  int frames_ = 0, asked_ = 0, for_ = 0, against_ = 0;
  geometry::Quadrilateral rival_;  ///< relative to the track: in its sizes, from its centre
};

}  // namespace window_ingress::detection
