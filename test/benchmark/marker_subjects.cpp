/// Detectors of printed markers. They search for quadrilaterals, too, and are known to be fast. Both get a
/// grey image. A detector whose library is not installed is left out.
#include <memory>
#include <opencv2/imgproc.hpp>

#include "subjects.hpp"

#ifdef WINDOW_INGRESS_WITH_APRILTAG
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#endif
#ifdef WINDOW_INGRESS_WITH_ARUCO
#include <opencv2/core/version.hpp>
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
#include <opencv2/objdetect/aruco_detector.hpp>
#define WINDOW_INGRESS_ARUCO_IS_A_CLASS
#else
#include <opencv2/aruco.hpp>
#endif
#endif

namespace window_ingress::bench {
namespace {

[[maybe_unused]] std::vector<cv::Mat> greyImages(const Sequence& sequence) {
  std::vector<cv::Mat> grey(sequence.images.size());
  for (std::size_t i = 0; i < grey.size(); ++i) cv::cvtColor(sequence.images[i], grey[i], cv::COLOR_BGR2GRAY);
  return grey;
}

#ifdef WINDOW_INGRESS_WITH_APRILTAG

class AprilTag {
 public:
  explicit AprilTag(float decimate) : family_(tag36h11_create()), detector_(apriltag_detector_create()) {
    apriltag_detector_add_family(detector_, family_);
    detector_->quad_decimate = decimate;
    detector_->nthreads = 1;
  }
  AprilTag(const AprilTag&) = delete;
  AprilTag& operator=(const AprilTag&) = delete;
  ~AprilTag() {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }

  bool run(const cv::Mat& grey) {
    image_u8_t image = {grey.cols, grey.rows, static_cast<int32_t>(grey.step), grey.data};
    zarray_t* found = apriltag_detector_detect(detector_, &image);
    apriltag_detections_destroy(found);
    return detector_->nquads > 0;
  }

 private:
  apriltag_family_t* family_;
  apriltag_detector_t* detector_;
};

Step aprilTag(const Sequence& sequence, float decimate) {
  auto detector = std::make_shared<AprilTag>(decimate);
  return [detector, grey = greyImages(sequence), order = ToAndFro(sequence.images.size())]() mutable {
    return detector->run(grey[order.next()]);
  };
}

#endif

#ifdef WINDOW_INGRESS_WITH_ARUCO

class ArUco {
 public:
  bool run(const cv::Mat& grey) {
#ifdef WINDOW_INGRESS_ARUCO_IS_A_CLASS
    detector_.detectMarkers(grey, corners_, ids_, rejected_);
#else
    cv::aruco::detectMarkers(grey, dictionary_, corners_, ids_, parameters_, rejected_);
#endif
    return corners_.size() + rejected_.size() > 0;
  }

 private:
#ifdef WINDOW_INGRESS_ARUCO_IS_A_CLASS
  cv::aruco::ArucoDetector detector_{cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11)};
#else
  cv::Ptr<cv::aruco::Dictionary> dictionary_ =
      cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  cv::Ptr<cv::aruco::DetectorParameters> parameters_ = cv::aruco::DetectorParameters::create();
#endif
  std::vector<std::vector<cv::Point2f>> corners_, rejected_;
  std::vector<int> ids_;
};

Step arUco(const Sequence& sequence) {
  auto detector = std::make_shared<ArUco>();
  return [detector, grey = greyImages(sequence), order = ToAndFro(sequence.images.size())]() mutable {
    return detector->run(grey[order.next()]);
  };
}

#endif

}  // namespace

std::vector<Subject> markerSubjects() {
  std::vector<Subject> subjects;
#ifdef WINDOW_INGRESS_WITH_APRILTAG
  subjects.push_back({"apriltag_decimate_2", [](const Sequence& s) { return aprilTag(s, 2.0f); }});
  subjects.push_back({"apriltag_decimate_1", [](const Sequence& s) { return aprilTag(s, 1.0f); }});
#endif
#ifdef WINDOW_INGRESS_WITH_ARUCO
  subjects.push_back({"aruco", arUco});
#endif
  return subjects;
}

}  // namespace window_ingress::bench
