#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace window_ingress::simulation {

/// Random numbers for one purpose. Streams of different names are independent: more draws from one stream, or
/// a new stream, do not change the others. The numbers do not depend on the standard library's distributions.
class RandomStream {
 public:
  RandomStream(std::uint32_t seed, const std::string& name) : engine_(mix(seed, name)) {}

  std::uint64_t bits() { return engine_(); }
  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  /// In low .. high, inclusive.
  int uniformInt(int low, int high) {
    return low + static_cast<int>(engine_() % (static_cast<std::uint64_t>(high - low) + 1u));
  }
  /// Zero mean.
  double normal(double sigma = 1.0) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return sigma * radius * std::cos(uniform(0.0, 2.0 * M_PI));
  }
  /// Three independent numbers, zero mean.
  Eigen::Vector3d normals(double sigma) {
    const double x = normal(sigma), y = normal(sigma), z = normal(sigma);
    return {x, y, z};
  }

 private:
  // FNV-1a, then the finaliser of splitmix64: nearby seeds and names give unrelated states.
  static std::uint64_t mix(std::uint32_t seed, const std::string& name) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    hash += 0x9e3779b97f4a7c15u * (seed + 1u);
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    return hash ^ (hash >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace window_ingress::simulation
