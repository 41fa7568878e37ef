#pragma once

#include <string>
#include <type_traits>
#include <vector>

namespace window_ingress::parameters {

/// Visitor that lists the path of every field and group: "window_detector/detector/edges/floor".
class KeyLister {
 public:
  template <typename... Rest>
  void operator()(const std::string& name, const Rest&...) {
    keys.push_back(prefix_ + name);
  }
  void choice(const std::string& name, const std::string&, const std::vector<std::string>&) {
    keys.push_back(prefix_ + name);
  }
  template <typename Params>
  void group(const std::string& name, Params& params) {
    keys.push_back(prefix_ + name);
    const std::string outer = prefix_;
    prefix_ += name + "/";
    std::remove_const_t<Params>::visit(params, *this);
    prefix_ = outer;
  }
  std::vector<std::string> keys;

 private:
  std::string prefix_;
};

template <typename Params>
std::vector<std::string> keysOf(const Params& params) {
  KeyLister lister;
  Params::visit(params, lister);
  return lister.keys;
}

/// What to say behind "unknown key": "; did you mean 'vehicle: {half_width_m: ..}'?", or where
/// nothing is like it the few keys that could stand there, or nothing. \param path that nobody reads \param
/// known all that somebody reads
std::string didYouMean(const std::string& path, const std::vector<std::string>& known);

}  // namespace window_ingress::parameters
