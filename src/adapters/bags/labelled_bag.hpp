#pragma once

#include <vector>

#include "adapters/bags/bag_topics.hpp"
#include "evaluation/images/labelled_image.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::adapters {

/// Images of a bag with what they show, by a topic with the true pose of the window.
/// \param topics as chosen by `chooseTopics`, `truth` among them
/// \param every take one image of so many
/// \throws InputError if the bag is damaged, or nothing in it can be used
std::vector<evaluation::LabelledImage> labelledImages(const rosbag::Bag& bag, const BagTopics& topics,
                                                      const geometry::OpeningSize& opening, int every);

/// Images of a bag alone, decoded. \param most stop after so many
std::vector<cv::Mat> imagesOf(const rosbag::Bag& bag, const BagTopics& topics, int every, int most);

}  // namespace window_ingress::adapters
