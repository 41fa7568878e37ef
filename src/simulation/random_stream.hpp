#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <string>

namespace window_ingress::simulation {

/// Random numbers for one purpose. Streams of different names are independent: more draws from one stream, or
/// a new stream, do not change the others. The numbers do not depend on the standard library's distributions.
class RandomStream {
 public:
  RandomStream(std::uint32_t seed, const std::string& name);

  double uniform(double low, double high);  ///< in [low, high)
  int uniformInt(int low, int high);        ///< in low .. high, inclusive
  double normal(double sigma = 1.0);        ///< zero mean
  Eigen::Vector3d normals(double sigma);    ///< three independent numbers, zero mean
  std::uint64_t bits();

 private:
  std::mt19937_64 engine_;
};

}  // namespace window_ingress::simulation
