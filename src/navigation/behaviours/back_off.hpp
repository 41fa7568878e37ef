#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// BACK_OFF (P17): away from the window along its last trusted normal in odom, to where it can be seen again.
/// Within the reveal neither turning nor sideways; clear of it, back onto the normal, and yaw points the
/// camera at where the window must be.
class BackOff : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  Decision withoutNormal(const MissionState& memory) const;
  std::optional<Event> judge(const Situation& situation, const MissionState& memory,
                             const RelativeState& relative, std::string& reason);

  int frames_ = 0;
};

}  // namespace window_ingress::navigation
