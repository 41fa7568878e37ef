#pragma once

#include <cstdint>
#include <optional>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Which window it is. A number stays with a window while it is tracked; after a loss, the window found gets
/// the old number only where the old one must be by now, and only for a while; in a row of equal windows the
/// neighbour gets a number of its own.
class TrackIdentity {
 public:
  static constexpr int kSettled =
      5;  ///< frames after which a lost window is waited for before another one is taken

  /// \param last number that was given before
  explicit TrackIdentity(const TrackParams& params, std::uint32_t last = 0) : params_(params), id_(last) {}

  std::uint32_t id() const { return id_; }  ///< 0 before the first window

  /// The window is followed in this frame.
  void follow(double stamp_sec);
  /// A search found a window: the old number if it is the old window, else a new one.
  void found(bool is_same, double stamp_sec);
  /// Something else knows where the window is: it is waited for.
  void expect(double stamp_sec);
  /// Another window is to be found from here on.
  void change() { ++id_, forget(); }
  /// The place of the old window is still known well enough to say which one it is.
  bool remembers(double stamp_sec) const;
  /// Whether a window seen at `seen` is the one that must be at `expected`: its centre within the gate, its
  /// size like it.
  bool isSame(const geometry::Quadrilateral& seen, const geometry::Quadrilateral& expected) const;
  /// It was followed for so long that another window is not taken in its place while it is remembered.
  bool settled() const { return followed_ >= kSettled; }
  void forget() { known_ = false, followed_ = 0; }

 private:
  TrackParams params_;
  std::uint32_t id_ = 0;
  bool known_ = false;
  int followed_ = 0;
  double last_sec_ = 0.0;
};

/// How like the reference the target has been: a window that is much less so does not take its place while it
/// is out of sight. The limit of `AppearanceMatch` must let the target pass in any light; of two that pass in
/// the same light, one that is clearly less like it is another window.
class AppearanceGate {
 public:
  static constexpr double kMargin =
      0.2;  ///< a window less like the reference than the target was by this is another one
  static constexpr double kValidSec = 10.0;  ///< a comparison says what is allowed for so long [s]

  void forget() { *this = AppearanceGate(); }
  /// Bhattacharyya distance of a confirmed track, at a comparison.
  void note(double distance, double stamp_sec);
  /// Whether a window at this distance may be the target. Anything may where nothing is known, or once the
  /// target has been out of sight for `kValidSec`: the light may be another.
  bool allows(double distance, double stamp_sec) const;

  double best() const { return best_; }  ///< of the target so far, smoothed; 2 where nothing is known

 private:
  static constexpr double kUnknown = 2.0;

  double best_ = kUnknown, smoothed_ = 0.0, last_sec_ = 0.0;
  int notes_ = 0;
};

/// Whether a track follows what the search finds. A search can be wrong in the one image in which a track
/// starts; over several images the place that it finds again and again is the right one.
///
/// A new track is on probation: every few images the search is asked as well. As many answers as
/// `TrackParams::confirmations` that agree confirm it; as many in a row that name one other place end it. A
/// confirmed track is asked about again only while it is doubtful, and then only its borders are corrected:
/// another window never takes its place.
class TrackConfirmation {
 public:
  static constexpr int kEveryFrames = 2;  ///< frames between searches that are asked

  explicit TrackConfirmation(const TrackParams& params) : params_(params) {}

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
