/// The constants of the messages equal the enums of the core; a difference does not compile.
#include <window_ingress/FlightVerdict.h>

#include "adapters/conversions/msg_conversion.hpp"
#include "simulation/referee.hpp"

namespace window_ingress::adapters::msg_constants_test {

template <typename Enum>
constexpr bool same(int constant, Enum value) {
  return constant == static_cast<int>(value);
}

using ChecksMsg = window_ingress::SystemChecks;
using DetectionMsg = window_ingress::WindowDetection;
using ImagePoseMsg = window_ingress::ImagePose;
using OpennessMsg = window_ingress::Openness;
using StateMsg = window_ingress::IngressState;
using VerdictMsg = window_ingress::FlightVerdict;

static_assert(same(DetectionMsg::TOP_LEFT, geometry::kTopLeft) &&
              same(DetectionMsg::TOP_RIGHT, geometry::kTopRight) &&
              same(DetectionMsg::BOTTOM_RIGHT, geometry::kBottomRight) &&
              same(DetectionMsg::BOTTOM_LEFT, geometry::kBottomLeft));
static_assert(same(DetectionMsg::TOP, geometry::kTop) && same(DetectionMsg::RIGHT, geometry::kRight) &&
              same(DetectionMsg::BOTTOM, geometry::kBottom) && same(DetectionMsg::LEFT, geometry::kLeft));

using detection::RejectReason;
static_assert(same(DetectionMsg::OK, RejectReason::kNone) &&
              same(DetectionMsg::BAD_IMAGE, RejectReason::kBadImage) &&
              same(DetectionMsg::NO_CANDIDATE, RejectReason::kNoCandidate) &&
              same(DetectionMsg::CORNERS, RejectReason::kCorners) &&
              same(DetectionMsg::AREA_SMALL, RejectReason::kAreaSmall) &&
              same(DetectionMsg::AREA_LARGE, RejectReason::kAreaLarge) &&
              same(DetectionMsg::ASPECT, RejectReason::kAspect) &&
              same(DetectionMsg::SOLIDITY, RejectReason::kSolidity) &&
              same(DetectionMsg::ANGLE, RejectReason::kAngle) &&
              same(DetectionMsg::BORDER, RejectReason::kBorder) &&
              same(DetectionMsg::LINE_SUPPORT, RejectReason::kLineSupport) &&
              same(DetectionMsg::CONTRAST, RejectReason::kContrast) &&
              same(DetectionMsg::REFINEMENT, RejectReason::kRefinement) &&
              same(DetectionMsg::OUTER_BORDER, RejectReason::kOuterBorder) &&
              same(DetectionMsg::DUPLICATE, RejectReason::kDuplicate) &&
              same(DetectionMsg::PANE, RejectReason::kPane) &&
              same(DetectionMsg::APPEARANCE, RejectReason::kAppearance) &&
              same(DetectionMsg::OTHER_ASPECT, RejectReason::kOtherAspect) &&
              same(DetectionMsg::OTHER_FRAME, RejectReason::kOtherFrame) &&
              same(DetectionMsg::UNLIKE, RejectReason::kUnlike) &&
              same(DetectionMsg::SCORE, RejectReason::kScore) &&
              same(DetectionMsg::OUTSCORED, RejectReason::kOutscored) &&
              same(DetectionMsg::BUDGET, RejectReason::kBudget) &&
              detection::kRejectReasons == DetectionMsg::BUDGET + 1);

static_assert(same(ImagePoseMsg::OK, estimation::PoseReject::kNone) &&
              same(ImagePoseMsg::BAD_CAMERA, estimation::PoseReject::kBadCamera) &&
              same(ImagePoseMsg::BAD_CORNERS, estimation::PoseReject::kBadCorners) &&
              same(ImagePoseMsg::NOT_IN_FRONT, estimation::PoseReject::kNotInFront) &&
              same(ImagePoseMsg::REPROJECTION, estimation::PoseReject::kReprojection) &&
              same(ImagePoseMsg::RANGE, estimation::PoseReject::kRange) &&
              same(ImagePoseMsg::TILT, estimation::PoseReject::kTilt) &&
              same(ImagePoseMsg::NOT_FINITE, estimation::PoseReject::kNotFinite));
static_assert(same(ChecksMsg::FIT_UNKNOWN, estimation::Fit::kUnknown) &&
              same(ChecksMsg::FIT_GO, estimation::Fit::kGo) &&
              same(ChecksMsg::FIT_NO_GO, estimation::Fit::kNoGo));
static_assert(same(ChecksMsg::FRAMES_OPEN, estimation::FramesVerdict::kUndecided) &&
              same(ChecksMsg::FRAMES_GOOD, estimation::FramesVerdict::kGood) &&
              same(ChecksMsg::FRAMES_WRONG, estimation::FramesVerdict::kWrong));
static_assert(same(OpennessMsg::UNKNOWN, openness::Openness::kUnknown) &&
              same(OpennessMsg::OPEN, openness::Openness::kOpen) &&
              same(OpennessMsg::CLOSED, openness::Openness::kClosed));
static_assert(same(StateMsg::IDLE, navigation::State::kIdle) &&
              same(StateMsg::SEARCH, navigation::State::kSearch) &&
              same(StateMsg::ALIGN, navigation::State::kAlign) &&
              same(StateMsg::APPROACH, navigation::State::kApproach) &&
              same(StateMsg::COMMIT, navigation::State::kCommit) &&
              same(StateMsg::PASSED, navigation::State::kPassed) &&
              same(StateMsg::BACK_OFF, navigation::State::kBackOff) &&
              same(StateMsg::HOLD, navigation::State::kHold) &&
              same(StateMsg::ABORTED, navigation::State::kAborted));

static_assert(same(VerdictMsg::RUNNING, simulation::Outcome::kRunning) &&
              same(VerdictMsg::PASSED, simulation::Outcome::kPassed) &&
              same(VerdictMsg::COLLISION, simulation::Outcome::kCollision) &&
              same(VerdictMsg::FALSE_INGRESS, simulation::Outcome::kFalseIngress) &&
              same(VerdictMsg::ABORTED, simulation::Outcome::kAborted) &&
              same(VerdictMsg::TIMEOUT, simulation::Outcome::kTimeout));

}  // namespace window_ingress::adapters::msg_constants_test
