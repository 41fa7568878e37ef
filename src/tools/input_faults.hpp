#pragma once

#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/input_error.hpp"

namespace window_ingress::tools {

/// All that is wrong, to be told at once.
class InputFaults {
 public:
  template <typename Step>
  bool collect(const Step& step) {
    try {
      step();
      return true;
    } catch (const InputError& fault) {
      texts_.push_back(fault.what());
    }
    return false;
  }
  void throwIfAny() const {
    if (!texts_.empty()) throw InputError(parameters::joined(texts_, "\n"));
  }

 private:
  std::vector<std::string> texts_;
};

}  // namespace window_ingress::tools
