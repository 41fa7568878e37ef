/// Arguments of the measuring programs: --key=value, and words that select what is measured.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace window_ingress::bench {

class Arguments {
 public:
  Arguments(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
      const std::string text = argv[i];
      (text.rfind("--", 0) == 0 ? options_ : words_).push_back(text);
    }
  }

  /// Value of --key=value, or `otherwise`.
  std::string value(const std::string& key, const std::string& otherwise) const {
    const std::string head = "--" + key + "=";
    for (const std::string& option : options_)
      if (option.rfind(head, 0) == 0) return option.substr(head.size());
    return otherwise;
  }

  /// True if the words select this name; no words select everything.
  bool names(const std::string& what) const {
    return words_.empty() || std::find(words_.begin(), words_.end(), what) != words_.end();
  }

 private:
  std::vector<std::string> options_, words_;
};

}  // namespace window_ingress::bench
