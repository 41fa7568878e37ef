#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// SEARCH (P14): turns in its place, first towards where the window was last seen, and looks from a greater
/// height after each turn without success. It goes nowhere else. Once something is seen it stops turning away
/// from it until enough images have shown it.
class Search : public Behaviour {
 public:
  static constexpr double kMaxTurnPerImage = 0.25;  ///< part of the field of view, from image to image

  /// \param may_climb false after a mission has been near the window: what is above is then not known to be
  /// free
  Search(const NavigatorParams& params, bool may_climb) : Behaviour(params), may_climb_(may_climb) {}

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  Decision lookAt(const Situation& situation, const MissionState& memory);
  /// So that an image is neither smeared nor the window passed over between two (trap: faster finds less).
  double fastestTurn(double image_period_sec) const;
  double sweep(const VehicleState& vehicle, MissionState& memory);
  void countTurn(double heading_rad, MissionState& memory);

  bool may_climb_;
  std::optional<double> height_m_;
  std::optional<double> last_heading_rad_;
  double turned_rad_ = 0.0;
  double direction_ = 1.0;
  bool looks_back_ = true;
  int turns_ = 0;
  int frames_ = 0;
};

}  // namespace window_ingress::navigation
