#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

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
      add(fault.what());
    }
    return false;
  }
  void throwIfAny() const {
    if (!texts_.empty()) throw InputError(parameters::joined(texts_, "\n"));
  }

 private:
  // Unless one that is told already says it, with more words before.
  void add(const std::string& text) {
    const auto says_it = [&](const std::string& told) { return told.find(text) != std::string::npos; };
    if (std::none_of(texts_.begin(), texts_.end(), says_it)) texts_.push_back(text);
  }

  std::vector<std::string> texts_;
};

}  // namespace window_ingress::tools
