/// Time stamps of messages, judged as doubles: the difference of two `ros::Time` throws beyond 2^31 s.
#pragma once

#include <ros/time.h>

#include <optional>

namespace window_ingress::adapters {

/// Seconds of a stamp; nothing if it is zero (unstamped) or its nanoseconds are not below 1e9.
std::optional<double> stampSec(const ros::Time& stamp);

/// The nearest stamp of a time in seconds; zero for what a stamp cannot hold.
ros::Time toStamp(double sec);

}  // namespace window_ingress::adapters
